//! animation.png: frames one after the other, for ever, as an animated PNG.

use std::path::Path;

use image::error::{EncodingError, ImageFormatHint};
use image::{ImageError, ImageFormat};

use super::super::canvas::Canvas;
use crate::output::OutputError;
use crate::output::file::write_whole;

/// Frames a second.
const RATE: u16 = 20;

/// Writes `count` pictures of the same size, each drawn when its turn comes.
///
/// # Errors
/// Errors of the file system, and those of `draw`.
pub fn write(
    path: &Path,
    count: usize,
    mut draw: impl FnMut(usize) -> Result<Canvas, OutputError>,
) -> Result<(), OutputError> {
    let failed = |source: png::EncodingError| {
        let source = EncodingError::new(ImageFormatHint::Exact(ImageFormat::Png), source);
        OutputError::Image { path: path.to_owned(), source: ImageError::Encoding(source) }
    };
    let mut next = draw(0)?;
    write_whole(path, |file| {
        let (width, height, _) = next.raw();
        let mut encoder = png::Encoder::new(file, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_animated(count as u32, 0).map_err(failed)?;
        encoder.set_frame_delay(1, RATE).map_err(failed)?;
        let mut writer = encoder.write_header().map_err(failed)?;
        for frame in 1..=count {
            writer.write_image_data(next.raw().2).map_err(failed)?;
            if frame < count {
                next = draw(frame)?;
            }
        }
        writer.finish().map_err(failed)
    })
}
