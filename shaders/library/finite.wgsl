// Whether a number is one, by its exponent bits: WGSL lets compilers assume that every comparison is of finite numbers.

fn finite(x: real) -> bool {
    return (bitcast<u32>(f32(x)) & 0x7f800000u) != 0x7f800000u;
}
