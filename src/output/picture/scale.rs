//! From a value to a place on the colour map.

use super::colour::{ColourMap, Palette, Rgb};

/// Colours of a range of values.
#[derive(Debug, Clone)]
pub struct ColourScale {
    pub low: f64,
    pub high: f64,
    /// Values lie below `low`: the bar says so by an arrow.
    pub cut_low: bool,
    /// Values lie above `high`.
    pub cut_high: bool,
    palette: Palette,
    /// Values at the two ends of the palette.
    ends: (f64, f64),
}

impl ColourScale {
    /// For signed values with singular corners. All of the range is shown unless its outer hundredths stretch it by
    /// more than half; then it is cut to the 1st and 99th percentile. Where both signs matter the neutral colour is zero.
    pub fn signed(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let (least, most) = (percentile(&sorted, 0.0), percentile(&sorted, 1.0));
        let (mut low, mut high) = (percentile(&sorted, 0.01), percentile(&sorted, 0.99));
        if most - least <= 1.5 * (high - low) || high <= low {
            (low, high) = (least, most);
        }
        if high <= low {
            let half = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
            (low, high) = (low - half, high + half);
        }
        let (cut_low, cut_high) = (least < low, most > high);
        let largest = high.max(-low);
        let (map, ends) = if high.min(-low) >= 0.1 * largest {
            (ColourMap::Diverging, (-largest, largest))
        } else {
            (ColourMap::Sequential, (low, high))
        };
        Self { low, high, cut_low, cut_high, palette: Palette::new(map), ends }
    }

    /// For magnitudes: from zero to the largest.
    pub fn magnitude(values: &[f64]) -> Self {
        let largest = values.iter().copied().fold(0.0, f64::max);
        let high = if largest > 0.0 { largest } else { 1.0 };
        let palette = Palette::new(ColourMap::Sequential);
        Self { low: 0.0, high, cut_low: false, cut_high: false, palette, ends: (0.0, high) }
    }

    pub fn colour(&self, value: f64) -> Rgb {
        let (first, last) = self.ends;
        self.palette.at((value.clamp(self.low, self.high) - first) / (last - first))
    }
}

/// The value that a share of the sorted values lies below, interpolated; 0 where there is none.
pub fn percentile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return 0.0 };
    let place = share * last as f64;
    let k = (place as usize).min(last);
    let next = sorted[(k + 1).min(last)];
    sorted[k] + (next - sorted[k]) * (place - k as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_interpolate() {
        let sorted = [1.0, 2.0, 4.0, 8.0, 16.0];
        assert_eq!([0.0, 0.25, 0.375, 1.0].map(|s| percentile(&sorted, s)), [1.0, 2.0, 3.0, 16.0]);
        assert_eq!((percentile(&[], 0.5), percentile(&[3.0], 0.99)), (0.0, 3.0));
    }

    fn ramp(from: f64, to: f64) -> Vec<f64> {
        (0..=1000).map(|k| from + (to - from) * f64::from(k) / 1000.0).collect()
    }

    #[test]
    fn a_singular_corner_does_not_set_the_scale() {
        let smooth = ColourScale::signed(&ramp(-1.0, 2.0));
        assert_eq!((smooth.low, smooth.high, smooth.cut_low, smooth.cut_high), (-1.0, 2.0, false, false));
        let mut values = ramp(-1.0, 2.0);
        values.extend([500.0, 900.0]);
        let cut = ColourScale::signed(&values);
        assert!(cut.high < 2.0 && cut.high > 1.9 && cut.cut_high && cut.cut_low);
        assert_eq!(cut.colour(900.0), cut.colour(cut.high));
    }

    #[test]
    fn zero_is_neutral_where_both_signs_matter() {
        let grey = Palette::new(ColourMap::Diverging).at(0.5);
        assert_eq!(ColourScale::signed(&ramp(-1.0, 2.0)).colour(0.0), grey);
        let positive = ColourScale::signed(&ramp(3.0, 4.0));
        assert_eq!(positive.colour(3.0), Palette::new(ColourMap::Sequential).at(0.0));
    }

    #[test]
    fn a_constant_field_still_has_a_range() {
        for value in [0.0, -3.0, 1e-9] {
            let scale = ColourScale::signed(&[value; 5]);
            assert!(scale.low < value && value < scale.high && !scale.cut_low && !scale.cut_high);
        }
        assert_eq!(ColourScale::magnitude(&[0.0]).high, 1.0);
        assert_eq!(ColourScale::magnitude(&[0.2, 0.7]).high, 0.7);
    }
}
