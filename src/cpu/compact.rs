//! Keeping some of a few indexes: the innermost step of the neighbour search.

/// Indexes that are looked at together.
pub const WIDTH: usize = 8;

/// Writes those of the first [`WIDTH`] indexes whose bit is set in `kept` to the front of `out`, in their order. What stands behind them
/// among the first [`WIDTH`] entries is spoilt.
///
/// # Panics
/// If either is shorter than that.
#[inline(always)]
pub fn write(index: &[u32], kept: u32, out: &mut [u32]) {
    let (index, out) = (&index[..WIDTH], &mut out[..WIDTH]);
    #[cfg(all(target_arch = "x86_64", target_feature = "avx512vl"))]
    // SAFETY: an unaligned load and an unaligned store of eight entries each, which is how long both are; the features are there.
    unsafe {
        use std::arch::x86_64::*;
        let all = _mm256_loadu_si256(index.as_ptr().cast());
        _mm256_storeu_si256(out.as_mut_ptr().cast(), _mm256_maskz_compress_epi32(kept as __mmask8, all));
    }
    #[cfg(not(all(target_arch = "x86_64", target_feature = "avx512vl")))]
    {
        // No branch: which are kept follows no pattern.
        let mut place = 0;
        for (k, &index) in index.iter().enumerate() {
            out[place.min(WIDTH - 1)] = index;
            place += (kept >> k & 1) as usize;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_those_whose_bit_is_set_in_their_order() {
        let index: [u32; WIDTH] = std::array::from_fn(|k| 100 + k as u32);
        for kept in 0..1_u32 << WIDTH {
            let mut out = [0; WIDTH];
            write(&index, kept, &mut out);
            let right: Vec<u32> = (0..WIDTH).filter(|k| kept >> k & 1 != 0).map(|k| index[k]).collect();
            assert_eq!(out[..right.len()], right);
        }
    }
}
