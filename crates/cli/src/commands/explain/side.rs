//! One side of a comparison: what to render, or a file with a tree that was written before.

use ombra::accel::StructureKind;
use ombra::geometry::triangle::TriangleTest;
use ombra::render::{IntegratorKind, MAX_DEPTH, MAX_SPP};

use super::args::ExplainArgs;
use super::document::Document;
use super::reading::read;

/// What decides a picture of a scene besides its size.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Choice {
    pub(crate) accel: StructureKind,
    pub(crate) triangle_test: TriangleTest,
    pub(crate) integrator: IntegratorKind,
    /// What the scene wants, if nothing is said.
    pub(crate) max_depth: Option<u32>,
    pub(crate) seed: u64,
    pub(crate) spp: u32,
}

/// One side.
#[derive(Debug)]
pub(crate) enum Side {
    Render(Choice),
    File(Box<Document>),
}

/// A side that cannot be understood: wrong usage.
#[derive(Debug)]
pub(crate) struct WrongSide(pub(crate) String);

impl Choice {
    pub(crate) const fn of(args: &ExplainArgs) -> Self {
        Self {
            accel: args.accel.kind,
            triangle_test: args.triangle_test,
            integrator: args.integrator,
            max_depth: args.max_depth,
            seed: args.seed,
            spp: args.spp,
        }
    }

    /// The same but for one pair.
    fn with(mut self, key: &str, value: &str) -> Result<Self, WrongSide> {
        match key {
            "accel" => {
                self.accel = value
                    .parse()
                    .map_err(|error| WrongSide(format!("{error}")))?;
            }
            "integrator" => {
                self.integrator = by_name(
                    IntegratorKind::ALL,
                    IntegratorKind::name,
                    "integrator",
                    value,
                )?;
            }
            "triangle-test" => {
                self.triangle_test = by_name(
                    &TriangleTest::ALL,
                    TriangleTest::name,
                    "triangle test",
                    value,
                )?;
            }
            "max-depth" => {
                self.max_depth = Some(whole(key, value, 0, MAX_DEPTH.into())? as u32);
            }
            "spp" => self.spp = whole(key, value, 1, MAX_SPP.into())? as u32,
            "seed" => self.seed = whole(key, value, 0, u64::MAX)?,
            _ => {
                return Err(WrongSide(format!(
                    "no key \"{key}\"; there are: accel, integrator, max-depth, seed, spp, triangle-test"
                )));
            }
        }
        Ok(self)
    }
}

/// Understands `this`, pairs, or the name of a file.
pub(crate) fn side(text: &str, base: &Choice) -> anyhow::Result<Result<Side, WrongSide>> {
    if text == "this" {
        return Ok(Ok(Side::Render(base.clone())));
    }
    if std::fs::exists(text).unwrap_or(false) {
        return Ok(Ok(Side::File(Box::new(read(text)?))));
    }
    if !text.contains('=') {
        return Ok(Err(WrongSide(format!(
            "\"{text}\" is neither `this`, nor pairs such as accel=kd-ropes,seed=7, nor a file that is there"
        ))));
    }
    let mut choice = base.clone();
    for pair in text.split(',') {
        let Some((key, value)) = pair.split_once('=') else {
            return Ok(Err(WrongSide(format!(
                "\"{pair}\" is no pair such as seed=7"
            ))));
        };
        choice = match choice.with(key.trim(), value.trim()) {
            Ok(choice) => choice,
            Err(wrong) => return Ok(Err(wrong)),
        };
    }
    Ok(Ok(Side::Render(choice)))
}

fn by_name<T: Copy>(
    all: &[T],
    name: fn(T) -> &'static str,
    what: &str,
    wanted: &str,
) -> Result<T, WrongSide> {
    all.iter()
        .copied()
        .find(|&one| name(one) == wanted)
        .ok_or_else(|| {
            let names: Vec<_> = all.iter().map(|&one| name(one)).collect();
            WrongSide(format!(
                "no {what} \"{wanted}\"; there are: {}",
                names.join(", ")
            ))
        })
}

fn whole(key: &str, text: &str, least: u64, most: u64) -> Result<u64, WrongSide> {
    let number = text.parse().ok().filter(|n| (least..=most).contains(n));
    number.ok_or_else(|| {
        WrongSide(format!(
            "{key}={text}: {key} is a whole number from {least} to {most}"
        ))
    })
}
