//! Colour maps.
//!
//! *Diverging*: Moreland's cool-warm, computed from its two ends in his Msh space (K. Moreland, Diverging Color Maps for
//! Scientific Visualization, 2009, doi:10.1007/978-3-642-10520-3_9). *Sequential*: viridis, eleven of its colours (van
//! der Walt and Smith 2015, released under CC0), interpolated.

use std::f64::consts::FRAC_PI_3;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rgb(pub [u8; 3]);

impl Rgb {
    pub const BLACK: Self = Self([0; 3]);
    pub const WHITE: Self = Self([255; 3]);
    pub const GRID: Self = Self([225; 3]);
    /// Lines and marks that the colour-blind tell apart (Okabe and Ito 2008).
    pub const BLUE: Self = Self([0, 114, 178]);
    pub const VERMILION: Self = Self([213, 94, 0]);
    pub const GREEN: Self = Self([0, 158, 115]);
    pub const PURPLE: Self = Self([204, 121, 167]);
    pub const ORANGE: Self = Self([230, 159, 0]);
    pub const SKY: Self = Self([86, 180, 233]);

    /// Mixed with white; 0 leaves the colour, 1 is white.
    pub fn paler(self, share: f64) -> Self {
        Self(self.0.map(|c| (f64::from(c) + (255.0 - f64::from(c)) * share).round() as u8))
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourMap {
    Diverging,
    Sequential,
}

const VIRIDIS: [[u8; 3]; 11] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x24, 0x75],
    [0x41, 0x44, 0x87],
    [0x35, 0x5f, 0x8d],
    [0x2a, 0x78, 0x8e],
    [0x21, 0x91, 0x8c],
    [0x22, 0xa8, 0x84],
    [0x44, 0xbf, 0x70],
    [0x7a, 0xd1, 0x51],
    [0xbd, 0xdf, 0x26],
    [0xfd, 0xe7, 0x25],
];
const COOL: [u8; 3] = [59, 76, 192];
const WARM: [u8; 3] = [180, 4, 38];

/// Colours of a map, computed once: maps are looked up for every pixel.
#[derive(Debug, Clone)]
pub struct Palette(Vec<Rgb>);

impl Palette {
    pub fn new(map: ColourMap) -> Self {
        const STEPS: usize = 512;
        let colour = |k: usize| {
            let share = k as f64 / (STEPS - 1) as f64;
            match map {
                ColourMap::Diverging => cool_warm(share),
                ColourMap::Sequential => viridis(share),
            }
        };
        Self((0..STEPS).map(colour).collect())
    }

    /// The colour at a share of the map, clamped to 0 to 1.
    pub fn at(&self, share: f64) -> Rgb {
        self.0[(share.clamp(0.0, 1.0) * (self.0.len() - 1) as f64 + 0.5) as usize]
    }
}

fn viridis(share: f64) -> Rgb {
    let place = share * (VIRIDIS.len() - 1) as f64;
    let k = (place as usize).min(VIRIDIS.len() - 2);
    let part = place - k as f64;
    let mix = |c: usize| f64::from(VIRIDIS[k][c]) * (1.0 - part) + f64::from(VIRIDIS[k + 1][c]) * part;
    Rgb([0, 1, 2].map(|c| mix(c).round() as u8))
}

/// Magnitude, saturation and hue: polar coordinates of CIELAB.
type Msh = [f64; 3];

fn cool_warm(share: f64) -> Rgb {
    let (cool, warm) = (msh(COOL), msh(WARM));
    let white = cool[0].max(warm[0]).max(88.0);
    let (end, part) = if share < 0.5 { (cool, 2.0 * share) } else { (warm, 2.0 - 2.0 * share) };
    // From a saturated end (part 0) to white (part 1), whose hue is chosen so that the path bends away from the kink.
    let spin = end[1] * (white * white - end[0] * end[0]).max(0.0).sqrt() / (end[0] * end[1].sin());
    let hue = if end[2] > -FRAC_PI_3 { end[2] + spin } else { end[2] - spin };
    let mix = |a: f64, b: f64| a + (b - a) * part;
    from_msh([mix(end[0], white), mix(end[1], 0.0), mix(end[2], hue)])
}

fn msh(colour: [u8; 3]) -> Msh {
    let [l, a, b] = lab(colour);
    let magnitude = (l * l + a * a + b * b).sqrt();
    [magnitude, (l / magnitude).acos(), b.atan2(a)]
}

fn from_msh([magnitude, saturation, hue]: Msh) -> Rgb {
    let chroma = magnitude * saturation.sin();
    from_lab([magnitude * saturation.cos(), chroma * hue.cos(), chroma * hue.sin()])
}

/// CIE XYZ of the white of sRGB (D65).
const WHITE: [f64; 3] = [0.95047, 1.0, 1.08883];

/// sRGB to CIELAB (IEC 61966-2-1).
fn lab(colour: [u8; 3]) -> [f64; 3] {
    let [r, g, b] = colour.map(|c| {
        let c = f64::from(c) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    });
    let xyz = [
        0.4124564 * r + 0.3575761 * g + 0.1804375 * b,
        0.2126729 * r + 0.7151522 * g + 0.0721750 * b,
        0.0193339 * r + 0.1191920 * g + 0.9503041 * b,
    ];
    let [x, y, z] = [0, 1, 2].map(|k| {
        let t: f64 = xyz[k] / WHITE[k];
        if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn from_lab([l, a, b]: [f64; 3]) -> Rgb {
    let y = (l + 16.0) / 116.0;
    let root = [y + a / 500.0, y, y - b / 200.0];
    let [x, y, z] = [0, 1, 2].map(|k| {
        let cube = root[k].powi(3);
        WHITE[k] * if cube > 216.0 / 24389.0 { cube } else { (116.0 * root[k] - 16.0) * 27.0 / 24389.0 }
    });
    let linear = [
        3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
        -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
        0.0556434 * x - 0.2040259 * y + 1.0572252 * z,
    ];
    Rgb(linear.map(|c| {
        let c = if c <= 0.0031308 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
        (255.0 * c).round().clamp(0.0, 255.0) as u8
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lightness(palette: &Palette, share: f64) -> f64 {
        lab(palette.at(share).0)[0]
    }

    #[test]
    fn the_sequential_map_grows_lighter_all_the_way() {
        let palette = Palette::new(ColourMap::Sequential);
        let steps: Vec<f64> = (0..=50).map(|k| lightness(&palette, f64::from(k) / 50.0)).collect();
        assert!(steps.is_sorted_by(|a, b| b - a > 0.5), "{steps:?}");
        assert_eq!(palette.at(0.0).0, VIRIDIS[0]);
        assert_eq!(palette.at(7.0).0, VIRIDIS[10]);
    }

    #[test]
    fn the_diverging_map_is_lightest_in_the_middle_and_even_on_both_sides() {
        let palette = Palette::new(ColourMap::Diverging);
        let steps: Vec<f64> = (0..=40).map(|k| lightness(&palette, f64::from(k) / 40.0)).collect();
        assert!(steps[..=20].is_sorted_by(|a, b| a < b) && steps[20..].is_sorted_by(|a, b| a > b), "{steps:?}");
        let (cool, warm) = (palette.at(0.0).0, palette.at(1.0).0);
        assert!(cool.iter().zip(COOL).chain(warm.iter().zip(WARM)).all(|(a, b)| a.abs_diff(b) <= 1));
        // The paper's table gives (221, 221, 221) for the middle.
        assert!(palette.at(0.5).0.iter().all(|c| c.abs_diff(221) <= 1), "{:?}", palette.at(0.5));
    }

    #[test]
    fn lab_knows_white_and_the_primary_red() {
        let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.05);
        assert!(near(lab([255; 3]), [100.0, 0.0, 0.0]));
        assert!(near(lab([255, 0, 0]), [53.24, 80.09, 67.20]));
        assert_eq!(from_lab(lab([12, 200, 99])), Rgb([12, 200, 99]));
    }
}
