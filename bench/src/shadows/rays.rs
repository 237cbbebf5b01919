//! One ray a minute: Embree's where it is there, ombra's where it is not.

use std::path::Path;

use ombra_accrual::Sampled;
use ombra_city::Facet;
use ombra_sun::Sky;

use super::jobs::Period;
use super::samples::STEP;
use super::timing::Contestant;
use crate::against::embree::{Embree, ShadowScene};

/// Who traces.
#[derive(Debug)]
pub(super) struct Tracer {
    embree: Option<Embree>,
    /// Why it is not Embree, and how to get that.
    pub(super) missing: Option<String>,
}

/// A tracer over a city.
pub(super) enum Rays {
    Embree(ShadowScene),
    Own(Box<Sampled>),
}

impl Tracer {
    /// Embree, if it is there.
    ///
    /// # Errors
    /// When it was named and is not there.
    pub(super) fn find(named: Option<&Path>) -> anyhow::Result<Self> {
        let (embree, missing) = match Embree::load(named) {
            Ok(embree) => (Some(embree), None),
            Err(error) if named.is_none() => (None, Some(format!("{error:#}"))),
            Err(error) => return Err(error),
        };
        Ok(Self { embree, missing })
    }

    pub(super) fn words(&self) -> String {
        match &self.embree {
            Some(embree) => format!("Embree {}, build of high quality", embree.version),
            None => "ombra's own rays, many a call".to_owned(),
        }
    }

    pub(super) fn over(&self, facets: &[Facet]) -> anyhow::Result<Rays> {
        Ok(match &self.embree {
            Some(embree) => Rays::Embree(embree.shadow_scene(&Facet::mesh(facets))?),
            None => Rays::Own(Box::new(Sampled::new(facets))),
        })
    }
}

impl Rays {
    /// Single rays first, then packets.
    pub(super) fn contestants<'a>(&'a self, sky: &Sky, period: &'a Period) -> Vec<Contestant<'a>> {
        let samples = &period.samples;
        match self {
            Self::Embree(scene) => vec![
                Contestant::new("embree, single", |places| scene.single(places, samples)),
                Contestant::new("embree, 16 places", |places| {
                    scene.packets_of_places(places, samples)
                }),
                Contestant::new("embree, 16 minutes", |places| {
                    scene.packets_of_minutes(places, samples)
                }),
            ],
            Self::Own(sampled) => {
                let samples = ombra_accrual::Samples::new(sky, &period.spans, STEP);
                vec![Contestant::new("ombra, sampled", move |places| {
                    sampled.seconds(&samples, places)
                })]
            }
        }
    }
}
