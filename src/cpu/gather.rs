//! Gathering values of scattered points into a pack: the innermost loop of every operator.
//!
//! Interleaved vectors are loaded whole, x and y together, and sorted into two packs by shuffles: half the loads that
//! component-wise gathering takes.

use wide::{f32x8, f64x4};

/// `[values[2 i], ..]` and `[values[2 i + 1], ..]` for the four indexes.
///
/// # Safety
/// Twice every index, plus one, is below `values.len()`.
#[inline(always)]
pub unsafe fn vectors_f64(values: &[f64], index: &[u32; 4]) -> [f64x4; 2] {
    #[cfg(all(target_arch = "x86_64", target_feature = "avx"))]
    // SAFETY: the loads are unaligned ones of two values each, in range by the caller's promise; the features are there.
    unsafe {
        use std::arch::x86_64::*;
        let pair = |lane: usize| _mm_loadu_pd(values.as_ptr().add(2 * index[lane] as usize));
        let even = _mm256_set_m128d(pair(2), pair(0));
        let odd = _mm256_set_m128d(pair(3), pair(1));
        [_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd)].map(|pack| std::mem::transmute::<_, f64x4>(pack))
    }
    #[cfg(not(all(target_arch = "x86_64", target_feature = "avx")))]
    // SAFETY: the caller's promise.
    unsafe {
        let at = |lane: usize, c: usize| *values.get_unchecked(2 * index[lane] as usize + c);
        [0, 1].map(|c| f64x4::new([at(0, c), at(1, c), at(2, c), at(3, c)]))
    }
}

/// The same for eight `f32` vectors.
///
/// # Safety
/// Twice every index, plus one, is below `values.len()`.
#[inline(always)]
pub unsafe fn vectors_f32(values: &[f32], index: &[u32; 8]) -> [f32x8; 2] {
    #[cfg(all(target_arch = "x86_64", target_feature = "avx"))]
    // SAFETY: as above, with loads of eight bytes.
    unsafe {
        use std::arch::x86_64::*;
        let pair = |lane: usize| values.as_ptr().add(2 * index[lane] as usize).cast::<f64>();
        let two = |first: usize, second: usize| _mm_castpd_ps(_mm_loadh_pd(_mm_load_sd(pair(first)), pair(second)));
        let low = _mm256_set_m128(two(4, 5), two(0, 1));
        let high = _mm256_set_m128(two(6, 7), two(2, 3));
        [_mm256_shuffle_ps::<0b10_00_10_00>(low, high), _mm256_shuffle_ps::<0b11_01_11_01>(low, high)]
            .map(|pack| std::mem::transmute::<_, f32x8>(pack))
    }
    #[cfg(not(all(target_arch = "x86_64", target_feature = "avx")))]
    // SAFETY: the caller's promise.
    unsafe {
        let at = |lane: usize, c: usize| *values.get_unchecked(2 * index[lane] as usize + c);
        [0, 1].map(|c| f32x8::new(std::array::from_fn(|lane| at(lane, c))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_lane_gets_its_own_vector() {
        let values: Vec<f64> = (0..40).map(f64::from).collect();
        let index = [7, 0, 19, 3];
        // SAFETY: the largest index is 19 of 20 vectors.
        let [x, y] = unsafe { vectors_f64(&values, &index) };
        assert_eq!(x.to_array(), index.map(|i| 2.0 * f64::from(i)));
        assert_eq!(y.to_array(), index.map(|i| 2.0 * f64::from(i) + 1.0));

        let values: Vec<f32> = (0..40).map(|value| value as f32).collect();
        let index = [7, 0, 19, 3, 11, 12, 1, 18];
        // SAFETY: as above.
        let [x, y] = unsafe { vectors_f32(&values, &index) };
        assert_eq!(x.to_array(), index.map(|i| 2.0 * i as f32));
        assert_eq!(y.to_array(), index.map(|i| 2.0 * i as f32 + 1.0));
    }
}
