//! Loops that are sure to be unrolled.

/// Runs `$body` with `$k` each of `0..$end`, at most 14, every one a constant of its own. Whether a loop that says the same is
/// unrolled is up to the compiler; where it is not, its arrays stand in memory instead of registers, at half the speed.
macro_rules! unrolled {
    ($k:ident < $end:expr => $body:block) => {
        $crate::cpu::unrolled::unrolled!(@each $k, $end, $body, 0 1 2 3 4 5 6 7 8 9 10 11 12 13)
    };
    (@each $k:ident, $end:expr, $body:block, $($value:literal)*) => {
        $(if $value < $end {
            let $k: usize = $value;
            $body
        })*
    };
}

pub(crate) use unrolled;
