//! The shadows of a day, moment by moment.

use std::path::Path;
use std::sync::atomic::Ordering;

use ombra::accrual::{Occluders, Spells, Tiles};
use ombra::city::{City, Grid};
use ombra::formats::Metadata;
use ombra::formats::frames::FrameWriter;
use ombra::formats::raster::{MapStyle, Raster, Scale, Unit, map_picture};
use rayon::prelude::*;

use super::super::output::{EXACT, OUTSIDE, VERSION};
use super::Job;
use super::moments::{self, Moment};
use crate::progress::Jobs;

/// Tiles are looked at in blocks of so many, and so many pictures are drawn at once.
const BLOCK: usize = 1024;
const PICTURES: usize = 16;

/// Whether it was not interrupted; nothing is written if it was.
pub(super) fn write(job: &Job<'_>, path: &Path, grid: &Grid) -> anyhow::Result<bool> {
    let tiles = &job.places.tiles;
    let moments = moments::of(job.when, job.args.products.every(), tiles.places().len())?;
    let cities = job.before.into_iter().chain([job.city]);
    let shadows: Option<Vec<Shadows>> = cities.map(|city| shadows(job, city, &moments)).collect();
    let Some(shadows) = shadows else {
        job.talk.say("interrupted; no frames written");
        return Ok(false);
    };
    let mut file = FrameWriter::create(path)?;
    let style = MapStyle {
        title: job.title(),
        footer: format!("{VERSION}; {EXACT}; the sun is {}", job.when.sun()),
        scale: match job.before {
            Some(_) => Scale::MomentOfChange,
            None => Scale::Moment,
        },
        outside: job.places.outside(job.city, tiles.places().len()),
        outside_name: OUTSIDE.to_owned(),
        blank: if job.city.buildings.is_empty() {
            "Not ground".to_owned()
        } else {
            String::new()
        },
        ..MapStyle::default()
    };
    let draw = |(index, moment): (usize, &Moment)| {
        let states: Vec<f32> = (0..tiles.places().len())
            .map(|place| match &shadows[..] {
                [all] => f32::from(u8::from(all.holds(place, index))),
                [before, after, ..] => state(before.holds(place, index), after.holds(place, index)),
                [] => f32::NAN,
            })
            .collect();
        let mut values = job.places.spread(&states);
        // A place that a building comes to stand on, or leaves.
        let gone = values
            .iter_mut()
            .zip(job.mapped())
            .filter(|(_, minutes)| minutes.is_nan());
        gone.for_each(|(value, _)| *value = f32::NAN);
        let raster = Raster::new(&job.city.origin, *grid, Unit::Minutes, &values)?;
        let subtitle = format!(
            "{}, {} ({})",
            job.when.ends_on[0], moment.clock, job.when.zone
        );
        anyhow::Ok(map_picture(
            &raster,
            &MapStyle {
                subtitle,
                ..style.clone()
            },
        ))
    };
    let bar = Jobs::unless(job.args.quiet);
    let all: Vec<(usize, &Moment)> = moments.iter().enumerate().collect();
    for part in all.chunks(PICTURES) {
        let pictures = job.session.cpu.install(|| {
            part.par_iter()
                .map(|&one| Ok(file.pack(draw(one)?)?))
                .collect::<anyhow::Result<Vec<_>>>()
        })?;
        for (picture, (index, moment)) in pictures.iter().zip(part) {
            file.add(picture, &moment.clock)?;
            bar.update(*index as u64 + 1, all.len() as u64, "frames");
        }
        if job.session.stop.load(Ordering::Relaxed) {
            bar.finish();
            job.talk.say("interrupted; no frames written");
            return Ok(false);
        }
    }
    bar.finish();
    let metadata = Metadata {
        version: Some(VERSION.to_owned()),
        ..Metadata::default()
    };
    file.finish(&metadata)?;
    let (first, last) = (&moments[0].clock, &moments[moments.len() - 1].clock);
    job.talk.say(&format!(
        "{}: {} frames, {first} to {last}",
        path.display(),
        moments.len()
    ));
    Ok(true)
}

/// Of a place at a moment, as a map of [`Scale::MomentOfChange`] has it.
fn state(before: bool, after: bool) -> f32 {
    match (before, after) {
        (false, false) => 0.0,
        (true, true) => 1.0,
        (false, true) => 2.0,
        (true, false) => 3.0,
    }
}

/// In which moments places lie in shadow, a bit each.
struct Shadows {
    bits: Vec<u64>,
    /// Words of a place.
    words: usize,
}

impl Shadows {
    fn holds(&self, place: usize, moment: usize) -> bool {
        self.bits[place * self.words + moment / 64] >> (moment % 64) & 1 == 1
    }
}

/// `None` if it is interrupted.
fn shadows(job: &Job<'_>, city: &City, moments: &[Moment]) -> Option<Shadows> {
    let (cpu, tiles): (_, &Tiles) = (&job.session.cpu, &job.places.tiles);
    let occluders = cpu.install(|| Occluders::new(&city.facets()));
    let spells = cpu.install(|| Spells::new(&occluders, &job.when.sheets().concat()));
    let words = moments.len().div_ceil(64);
    let places = tiles.places().len();
    let mut bits = Vec::with_capacity(places * words);
    let bar = Jobs::unless(job.args.quiet);
    for first in (0..tiles.len()).step_by(BLOCK) {
        bar.update(
            (bits.len() / words) as u64,
            places as u64,
            "places of frames",
        );
        if job.session.stop.load(Ordering::Relaxed) {
            bar.finish();
            return None;
        }
        let which = first..tiles.len().min(first + BLOCK);
        for stretches in cpu.install(|| spells.stretches_of(tiles, which)).iter() {
            let begin = bits.len();
            bits.resize(begin + words, 0);
            for stretch in stretches {
                let from = moments.partition_point(|moment| moment.at < stretch.from);
                let to = moments.partition_point(|moment| moment.at < stretch.to);
                (from..to).for_each(|moment| bits[begin + moment / 64] |= 1 << (moment % 64));
            }
        }
    }
    bar.finish();
    Some(Shadows { bits, words })
}
