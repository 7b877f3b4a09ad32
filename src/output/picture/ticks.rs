//! Round numbers along an axis, and how they are written.

/// Ticks of one axis. Labels are in units of `10^exponent`.
#[derive(Debug, Clone, PartialEq)]
pub struct Ticks {
    pub values: Vec<f64>,
    pub labels: Vec<String>,
    /// A multiple of 3; 0 where plain numbers stay short.
    pub exponent: i32,
}

impl Ticks {
    /// Multiples of 1, 2 or 5 times a power of ten from `low` to `high`, about `count` of them, at least two where the
    /// range holds two.
    pub fn new(low: f64, high: f64, count: usize) -> Self {
        let range = high - low;
        if !(range.is_finite() && range > 0.0) {
            return Self { values: Vec::new(), labels: Vec::new(), exponent: 0 };
        }
        let wanted = range / count.max(1) as f64;
        let mut power = wanted.log10().floor() as i32;
        let mut mantissa = match wanted / ten(power) {
            m if m < 1.5 => 1,
            m if m < 3.5 => 2,
            m if m < 7.5 => 5,
            _ => 10,
        };
        let between = |mantissa: i64, power: i32| {
            let step = mantissa as f64 * ten(power);
            (low / step - 1e-9).ceil() as i64..=(high / step + 1e-9).floor() as i64
        };
        // A step just too long for the range can miss it: take a finer one.
        while between(mantissa, power).count() < 2 {
            (mantissa, power) = match mantissa {
                10 => (5, power),
                5 => (2, power),
                2 => (1, power),
                _ => (5, power - 1),
            };
        }
        let exponent = exponent(low.abs().max(high.abs()));
        let decimals = (exponent - power - i32::from(mantissa == 10)).max(0) as usize;
        let (mut values, mut labels) = (Vec::new(), Vec::new());
        for k in between(mantissa, power) {
            let whole = k * mantissa;
            values.push(whole as f64 * ten(power));
            labels.push(format!("{:.decimals$}", whole as f64 * ten(power - exponent)).replace('-', "−"));
        }
        Self { values, labels, exponent }
    }

    /// Powers of ten from `low` to `high`, both above 0, in plain numbers with `unit` behind each; with their doubles and
    /// fives where that leaves fewer than three. The values are the decimal logarithms.
    pub fn decades(low: f64, high: f64, unit: &str) -> Self {
        let powers = (low.log10() - 1e-9).floor() as i32..=(high.log10() + 1e-9).ceil() as i32;
        let of = |mantissas: &[i32]| {
            let each = powers.clone().flat_map(|power| mantissas.iter().map(move |m| f64::from(*m) * ten(power)));
            each.filter(|value| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(value)).collect::<Vec<f64>>()
        };
        let decades = of(&[1]);
        let values = if decades.len() < 3 { of(&[1, 2, 5]) } else { decades };
        let labels = values.iter().map(|value| format!("{}{unit}", short(*value, 1))).collect();
        Self { values: values.iter().map(|value| value.log10()).collect(), labels, exponent: 0 }
    }

    /// The unit in brackets, with the power of ten that the labels leave out: `[10⁻³ m]`.
    pub fn unit(&self, unit: &str) -> String {
        if self.exponent == 0 { format!("[{unit}]") } else { format!("[10{} {unit}]", raised(self.exponent)) }
    }
}

/// Powers above 22 are inexact either way; below, dividing by an exact power keeps 0.1 what it is.
fn ten(power: i32) -> f64 {
    if power < 0 { 1.0 / 10f64.powi(-power) } else { 10f64.powi(power) }
}

/// The power of a thousand to factor out of numbers up to `largest`.
fn exponent(largest: f64) -> i32 {
    if largest == 0.0 || (0.02..2e4).contains(&largest) {
        return 0;
    }
    // A hair more, so that 1e-3 computed a rounding too small still counts as 1e-3.
    ((largest * (1.0 + 1e-9)).log10() / 3.0).floor() as i32 * 3
}

/// A number in raised digits.
fn raised(number: i32) -> String {
    let raise = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => digit.to_digit(10).and_then(|d| char::from_u32('⁰' as u32 + d)).unwrap_or(digit),
    };
    number.to_string().chars().map(raise).collect()
}

/// A number with `digits` significant digits (more where it is a larger integer) and no trailing zeros, for titles and legends.
pub fn short(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value:.0}");
    }
    let rounded = format!("{value:.*e}", digits.saturating_sub(1));
    let (mantissa, power) = rounded.split_once('e').unwrap_or((&rounded, "0"));
    let power: i32 = power.parse().unwrap_or(0);
    let trim = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    let text = if (-4..6).contains(&power) {
        let decimals = (digits as i32 - 1 - power).max(0) as usize;
        trim(&format!("{value:.decimals$}"))
    } else {
        format!("{}×10{}", trim(mantissa), raised(power))
    };
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_cover_the_range() {
        for (low, high, labels, unit) in [
            (0.0, 1.0, vec!["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"], "[m]"),
            (0.0, 4.0, vec!["0", "1", "2", "3", "4"], "[m]"),
            (-0.23, 0.31, vec!["−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3"], "[m]"),
            (0.0, 1e-3, vec!["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"], "[10⁻³ m]"),
            (0.0, 2.5e-7, vec!["0", "50", "100", "150", "200", "250"], "[10⁻⁹ m]"),
            (-3e5, 4e5, vec!["−300", "−200", "−100", "0", "100", "200", "300", "400"], "[10³ m]"),
            (100.0, 100.05, vec!["100.00", "100.01", "100.02", "100.03", "100.04", "100.05"], "[m]"),
        ] {
            let ticks = Ticks::new(low, high, 5);
            assert_eq!(ticks.labels, labels);
            assert_eq!(ticks.unit("m"), unit);
            assert!(ticks.values.iter().all(|v| (low - 1e-9 * high..=high * (1.0 + 1e-9)).contains(v)));
        }
    }

    #[test]
    fn any_range_gets_two_to_a_few_ticks() {
        for k in 0..400 {
            let low = (f64::from(k) * 0.7).sin() * 3.0;
            let high = low + 10f64.powf(f64::from(k % 37) / 6.0 - 4.0);
            for count in 1..9 {
                let ticks = Ticks::new(low, high, count).values.len();
                assert!((2..=count.max(2) * 2 + 1).contains(&ticks), "{ticks} from {low} to {high}, asked for {count}");
            }
        }
    }

    #[test]
    fn a_range_that_is_none_has_no_ticks() {
        for (low, high) in [(1.0, 1.0), (2.0, 1.0), (0.0, f64::NAN), (0.0, f64::INFINITY)] {
            assert!(Ticks::new(low, high, 5).values.is_empty());
        }
    }

    #[test]
    fn decades_are_plain_numbers_inside_the_range() {
        for (low, high, labels) in [
            (0.007, 130.0, vec!["0.01s", "0.1s", "1s", "10s", "100s"]),
            (0.1, 10.0, vec!["0.1s", "1s", "10s"]),
            (0.15, 7.0, vec!["0.2s", "0.5s", "1s", "2s", "5s"]),
            (1e-7, 1e-5, vec!["1×10⁻⁷s", "1×10⁻⁶s", "1×10⁻⁵s"]),
        ] {
            let ticks = Ticks::decades(low, high, "s");
            assert_eq!(ticks.labels, labels);
            assert!(ticks.values.iter().all(|v| (low.log10() - 1e-6..=high.log10() + 1e-6).contains(v)));
        }
    }

    #[test]
    fn short_numbers() {
        for (value, text) in [
            (0.0, "0"),
            (12.0, "12"),
            (0.3 - 0.2, "0.1"),
            (-0.2140423, "−0.21404"),
            (123456.7, "123457"),
            (2.5e-9, "2.5×10⁻⁹"),
            (1e12, "1×10¹²"),
        ] {
            assert_eq!(short(value, 5), text);
        }
    }
}
