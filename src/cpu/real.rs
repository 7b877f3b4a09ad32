//! The float types that the operations run in, and packs of them: several points side by side in one register.

use std::fmt::{Debug, LowerExp};
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use bytemuck::Pod;
use wide::{f32x8, f64x4};

use super::gather;

/// `f32` or `f64`.
pub trait Real:
    Pod
    + Debug
    + LowerExp
    + Default
    + PartialOrd
    + Send
    + Sync
    + Sum
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    type Pack: Pack<Self>;
    const EPSILON: Self;
    /// `f32` or `f64`.
    const NAME: &'static str;
    fn from_f64(value: f64) -> Self;
    fn to_f64(self) -> f64;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    fn floor(self) -> Self;
    fn is_finite(self) -> bool;

    fn zero() -> Self {
        Self::default()
    }

    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
}

/// A few consecutive points' values, one lane each.
pub trait Pack<T: Real>:
    Copy
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    const LANES: usize;
    fn splat(value: T) -> Self;
    /// The first `LANES` values.
    fn load(values: &[T]) -> Self;
    fn store(self, values: &mut [T]);
    fn from_lanes(lane: impl FnMut(usize) -> T) -> Self;
    fn lane(&self, lane: usize) -> T;
    fn sqrt(self) -> Self;
    /// `self * factor + term`, rounded once where the processor can.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    fn max(self, other: Self) -> Self;
    fn min(self, other: Self) -> Self;
    /// `yes` where `self > bound`, else `no`, lane by lane.
    fn select_above(self, bound: Self, yes: Self, no: Self) -> Self;
    /// The lanes where `self > bound`, a bit each.
    fn above(self, bound: Self) -> u32;

    fn zero() -> Self {
        Self::splat(T::zero())
    }

    /// `values[index[lane]]`.
    ///
    /// # Safety
    /// The first `LANES` indexes are below `values.len()`.
    #[inline(always)]
    unsafe fn gather(values: &[T], index: &[u32]) -> Self {
        debug_assert!(index[..Self::LANES].iter().all(|&i| (i as usize) < values.len()));
        let index = &index[..Self::LANES];
        // SAFETY: the caller's promise.
        Self::from_lanes(|lane| unsafe { *values.get_unchecked(index[lane] as usize) })
    }

    /// The x and y parts of interleaved vectors: `values[2 index]`, `values[2 index + 1]`.
    ///
    /// # Safety
    /// Twice each of the first `LANES` indexes, plus one, is below `values.len()`.
    unsafe fn gather_vectors(values: &[T], index: &[u32]) -> [Self; 2];

    /// The x and y parts of the first `LANES` interleaved vectors.
    #[inline(always)]
    fn load_vectors(values: &[T]) -> [Self; 2] {
        let values = &values[..2 * Self::LANES];
        [Self::from_lanes(|lane| values[2 * lane]), Self::from_lanes(|lane| values[2 * lane + 1])]
    }

    /// Writes them back.
    #[inline(always)]
    fn store_vectors([x, y]: [Self; 2], values: &mut [T]) {
        for (lane, value) in values.chunks_exact_mut(2).take(Self::LANES).enumerate() {
            (value[0], value[1]) = (x.lane(lane), y.lane(lane));
        }
    }
}

macro_rules! real {
    ($real:ty, $pack:ty, [$($lane:literal),*], $gather:path) => {
        impl Real for $real {
            type Pack = $pack;
            const EPSILON: Self = <$real>::EPSILON;
            const NAME: &'static str = stringify!($real);

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as $real
            }

            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                <$real>::sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                <$real>::abs(self)
            }

            #[inline(always)]
            fn floor(self) -> Self {
                <$real>::floor(self)
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                <$real>::is_finite(self)
            }
        }

        impl Pack<$real> for $pack {
            const LANES: usize = [$($lane),*].len();

            #[inline(always)]
            fn splat(value: $real) -> Self {
                <$pack>::splat(value)
            }

            #[inline(always)]
            fn load(values: &[$real]) -> Self {
                let values = &values[..Self::LANES];
                <$pack>::new([$(values[$lane]),*])
            }

            #[inline(always)]
            fn store(self, values: &mut [$real]) {
                values[..Self::LANES].copy_from_slice(&self.to_array());
            }

            #[inline(always)]
            fn from_lanes(mut lane: impl FnMut(usize) -> $real) -> Self {
                <$pack>::new([$(lane($lane)),*])
            }

            #[inline(always)]
            unsafe fn gather_vectors(values: &[$real], index: &[u32]) -> [Self; 2] {
                debug_assert!(index[..Self::LANES].iter().all(|&i| 2 * (i as usize) + 1 < values.len()));
                let index = &index[..Self::LANES];
                // SAFETY: the caller's promise.
                unsafe { $gather(values, &[$(index[$lane]),*]) }
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                <$pack>::mul_add(self, factor, term)
            }

            #[inline(always)]
            fn lane(&self, lane: usize) -> $real {
                self.as_array()[lane]
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                <$pack>::sqrt(self)
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                self.fast_max(other)
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                self.fast_min(other)
            }

            #[inline(always)]
            fn select_above(self, bound: Self, yes: Self, no: Self) -> Self {
                self.simd_gt(bound).select(yes, no)
            }

            #[inline(always)]
            fn above(self, bound: Self) -> u32 {
                self.simd_gt(bound).to_bitmask() as u32
            }
        }
    };
}

/// A pack of one: the same arithmetic for a single point.
#[derive(Debug, Clone, Copy)]
pub struct One<T>(pub T);

macro_rules! one_operator {
    ($($operator:ident $function:ident $sign:tt),*) => {$(
        impl<T: Real> $operator for One<T> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(self.0 $sign other.0)
            }
        }
    )*};
}

one_operator!(Add add +, Sub sub -, Mul mul *, Div div /);

impl<T: Real> Neg for One<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<T: Real> AddAssign for One<T> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        self.0 += other.0;
    }
}

impl<T: Real> SubAssign for One<T> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        self.0 -= other.0;
    }
}

impl<T: Real> Pack<T> for One<T> {
    const LANES: usize = 1;

    #[inline(always)]
    fn splat(value: T) -> Self {
        Self(value)
    }

    #[inline(always)]
    fn load(values: &[T]) -> Self {
        Self(values[0])
    }

    #[inline(always)]
    fn store(self, values: &mut [T]) {
        values[0] = self.0;
    }

    #[inline(always)]
    fn from_lanes(mut lane: impl FnMut(usize) -> T) -> Self {
        Self(lane(0))
    }

    #[inline(always)]
    fn lane(&self, _: usize) -> T {
        self.0
    }

    #[inline(always)]
    unsafe fn gather_vectors(values: &[T], index: &[u32]) -> [Self; 2] {
        let at = 2 * index[0] as usize;
        [Self(values[at]), Self(values[at + 1])]
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        Self(self.0 * factor.0 + term.0)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    #[inline(always)]
    fn select_above(self, bound: Self, yes: Self, no: Self) -> Self {
        if self.0 > bound.0 { yes } else { no }
    }

    #[inline(always)]
    fn above(self, bound: Self) -> u32 {
        u32::from(self.0 > bound.0)
    }
}

real!(f64, f64x4, [0, 1, 2, 3], gather::vectors_f64);
real!(f32, f32x8, [0, 1, 2, 3, 4, 5, 6, 7], gather::vectors_f32);
