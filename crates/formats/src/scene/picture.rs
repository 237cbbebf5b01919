//! What a scene wants to be rendered like.

use std::ops::RangeInclusive;

use ombra_render::display::{Response, Transfer};
use ombra_render::{MAX_DEPTH, MAX_SIDE, MAX_SPP, SamplerKind};
use toml::Spanned;

use super::build::{above_zero, wrong};
use super::description::{FilmSpec, PictureSpec, SamplerSpec, TransferSpec};
use super::line_of;
use crate::error::FormatError;

/// What a scene wants to be rendered like, unless somebody says otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Picture {
    /// Width and height in pixels, each from 1 to [`MAX_SIDE`].
    pub size: Option<[u32; 2]>,
    /// Samples a pixel, from 1 to [`MAX_SPP`].
    pub spp: Option<u32>,
    /// How often light may bounce, at most [`MAX_DEPTH`].
    pub max_depth: Option<u32>,
    /// How samples are spread.
    pub sampler: Option<SamplerKind>,
    /// How the film answers to light.
    pub response: Option<Response>,
}

pub(super) fn picture(
    spec: &PictureSpec,
    film: Option<&Spanned<FilmSpec>>,
    text: &str,
) -> Result<Picture, FormatError> {
    let place = |start| line_of(text.as_bytes(), start);
    if let Some(size) = &spec.size
        && !size.get_ref().iter().all(|n| (1..=MAX_SIDE).contains(n))
    {
        let [width, height] = size.get_ref();
        let error = wrong(format!(
            "size is [{width}, {height}]; 1 to {MAX_SIDE} pixels are needed each way"
        ));
        return Err(error.at(place(size.span().start)));
    }
    let within = |number: &Option<Spanned<u32>>, range: RangeInclusive<u32>, what: &str| {
        let Some(number) = number else {
            return Ok(None);
        };
        let n = *number.get_ref();
        if range.contains(&n) {
            return Ok(Some(n));
        }
        let (from, to) = range.into_inner();
        let name = what.split(' ').next().unwrap_or(what);
        let error = wrong(format!(
            "{name} is {n}; {from} to {to}{} are needed",
            &what[name.len()..]
        ));
        Err(error.at(place(number.span().start)))
    };
    Ok(Picture {
        size: spec.size.as_ref().map(Spanned::get_ref).copied(),
        spp: within(&spec.spp, 1..=MAX_SPP, "spp samples a pixel")?,
        max_depth: within(&spec.max_depth, 0..=MAX_DEPTH, "max_depth bounces")?,
        sampler: spec.sampler.map(SamplerKind::from),
        response: film
            .map(|film| response(film.get_ref()).map_err(|e| e.at(place(film.span().start))))
            .transpose()?,
    })
}

fn response(spec: &FilmSpec) -> Result<Response, FormatError> {
    let default = Response::default();
    let fog = spec.fog.unwrap_or(default.fog);
    if !(0.0..=f32::MAX).contains(&fog) {
        return Err(wrong(format!("fog is {fog}; 0 or more is needed")));
    }
    Ok(Response {
        sensitivity: above_zero(
            "sensitivity",
            spec.sensitivity.unwrap_or(default.sensitivity),
        )?,
        fog,
        white: above_zero("white", spec.white.unwrap_or(default.white))?,
        transfer: match spec.transfer {
            TransferSpec::Srgb => Transfer::Srgb,
            TransferSpec::Linear => Transfer::Linear,
        },
    })
}

impl From<SamplerSpec> for SamplerKind {
    fn from(spec: SamplerSpec) -> Self {
        match spec {
            SamplerSpec::Sobol => Self::Sobol,
            SamplerSpec::Independent => Self::Independent,
        }
    }
}
