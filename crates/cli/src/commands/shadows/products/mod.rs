//! Further outputs of a run: contour lines, tiles for web maps.

mod args;
mod contours;

use ombra::city::City;

pub(crate) use args::ProductsArgs;

use super::args::ShadowsArgs;
use super::places::{Kind, Places};
use super::when::When;
use super::wrong_usage;
use crate::commands::Talk;

/// What was measured.
pub(super) struct Job<'a> {
    pub(super) args: &'a ShadowsArgs,
    /// After the change, if it is changed.
    pub(super) city: &'a City,
    pub(super) places: &'a Places,
    pub(super) when: &'a When,
    pub(super) minutes: Minutes<'a>,
    /// What says how the numbers came about.
    pub(super) metadata: Vec<(String, String)>,
    pub(super) talk: &'a Talk,
}

/// One number for each place; NaN where there is none.
pub(super) enum Minutes<'a> {
    /// Of the city.
    Plain(&'a [f32]),
    /// Before, after, and after less before.
    Change([&'a [f32]; 3]),
}

/// Writes all that is asked for.
pub(super) fn write(job: &Job<'_>) -> anyhow::Result<()> {
    if let (Some(path), Kind::Grid { grid, .. }) = (&job.args.products.contours, &job.places.kind) {
        contours::write(job, path, grid)?;
    }
    Ok(())
}

/// Refuses what there is none of.
pub(super) fn refuse(args: &ShadowsArgs) {
    let products = &args.products;
    if !args.places.is_grid() && products.contours.is_some() {
        wrong_usage(
            "--contours: lines are of the grid over the ground; leave out --on and --points",
        );
    }
}
