//! What a scene wants to be rendered like.

use std::ops::RangeInclusive;

use ombra_render::display::{Response, Transfer};
use ombra_render::{MAX_DEPTH, MAX_SIDE, MAX_SPP, SamplerKind, Settings};
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
    /// See [`Settings::least_importance`].
    pub least_importance: Option<f32>,
    /// How samples are spread.
    pub sampler: Option<SamplerKind>,
    /// How the film answers to light.
    pub response: Option<Response>,
}

impl Picture {
    /// These settings, with what the scene wants in place of what they say.
    #[must_use]
    pub fn settings(&self, otherwise: Settings) -> Settings {
        let [width, height] = self.size.unwrap_or([otherwise.width, otherwise.height]);
        Settings {
            width,
            height,
            spp: self.spp.unwrap_or(otherwise.spp),
            max_depth: self.max_depth.unwrap_or(otherwise.max_depth),
            least_importance: self.least_importance.unwrap_or(otherwise.least_importance),
            sampler: self.sampler.unwrap_or(otherwise.sampler),
            response: self.response.unwrap_or(otherwise.response),
            ..otherwise
        }
    }
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
        least_importance: spec
            .least_importance
            .as_ref()
            .map(|share| {
                let wrong = |e: FormatError| e.at(place(share.span().start));
                at_least_zero("least_importance", *share.get_ref()).map_err(wrong)
            })
            .transpose()?,
        sampler: spec.sampler.map(SamplerKind::from),
        response: film
            .map(|film| response(film.get_ref()).map_err(|e| e.at(place(film.span().start))))
            .transpose()?,
    })
}

fn response(spec: &FilmSpec) -> Result<Response, FormatError> {
    let default = Response::default();
    Ok(Response {
        sensitivity: above_zero(
            "sensitivity",
            spec.sensitivity.unwrap_or(default.sensitivity),
        )?,
        fog: at_least_zero("fog", spec.fog.unwrap_or(default.fog))?,
        white: above_zero("white", spec.white.unwrap_or(default.white))?,
        transfer: match spec.transfer {
            TransferSpec::Srgb => Transfer::Srgb,
            TransferSpec::Linear => Transfer::Linear,
        },
    })
}

fn at_least_zero(what: &str, number: f32) -> Result<f32, FormatError> {
    if (0.0..=f32::MAX).contains(&number) {
        return Ok(number);
    }
    Err(wrong(format!("{what} is {number}; 0 or more is needed")))
}

impl From<SamplerSpec> for SamplerKind {
    fn from(spec: SamplerSpec) -> Self {
        match spec {
            SamplerSpec::Sobol => Self::Sobol,
            SamplerSpec::Independent => Self::Independent,
        }
    }
}
