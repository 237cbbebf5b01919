//! What a scene wants to be rendered like.

use toml::Spanned;

use super::build::wrong;
use super::description::PictureSpec;
use super::line_of;
use crate::error::FormatError;

/// Most pixels in a row or a column.
const MOST_PIXELS: u32 = 65_536;
/// Most samples a pixel.
const MOST_SAMPLES: u32 = 16_777_216;

/// What a scene wants to be rendered like, unless somebody says otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Picture {
    /// Width and height in pixels, each from 1 to 65,536.
    pub size: Option<[u32; 2]>,
    /// Samples a pixel, from 1 to 16,777,216.
    pub spp: Option<u32>,
}

pub(super) fn picture(spec: &PictureSpec, text: &str) -> Result<Picture, FormatError> {
    let place = |start| line_of(text.as_bytes(), start);
    if let Some(size) = &spec.size
        && !size.get_ref().iter().all(|n| (1..=MOST_PIXELS).contains(n))
    {
        let [width, height] = size.get_ref();
        let error = wrong(format!(
            "size is [{width}, {height}]; 1 to {MOST_PIXELS} pixels are needed each way"
        ));
        return Err(error.at(place(size.span().start)));
    }
    if let Some(spp) = &spec.spp
        && !(1..=MOST_SAMPLES).contains(spp.get_ref())
    {
        let error = wrong(format!(
            "spp is {}; 1 to {MOST_SAMPLES} samples a pixel are needed",
            spp.get_ref()
        ));
        return Err(error.at(place(spp.span().start)));
    }
    Ok(Picture {
        size: spec.size.as_ref().map(Spanned::get_ref).copied(),
        spp: spec.spp.as_ref().map(Spanned::get_ref).copied(),
    })
}
