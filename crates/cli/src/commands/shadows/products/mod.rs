//! Further outputs of a run: contour lines, tiles for web maps, the shadows of a day moment by moment, a model.

mod args;
mod atlas;
mod contours;
mod frames;
mod glb;
mod moments;
mod tiles;

use ombra::city::City;
use ombra::formats::raster::{MapStyle, Scale, TileSet, Unit};

pub(crate) use args::ProductsArgs;

use super::args::ShadowsArgs;
use super::places::{Kind, Places};
use super::when::When;
use super::{Session, wrong_usage};
use crate::commands::Talk;

/// What was measured.
pub(super) struct Job<'a> {
    pub(super) args: &'a ShadowsArgs,
    pub(super) session: &'a Session,
    /// Before the change, if there is one.
    pub(super) before: Option<&'a City>,
    /// After it.
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

impl Job<'_> {
    /// What a map is of: minutes, or the net of a change.
    fn mapped(&self) -> &[f32] {
        match self.minutes {
            Minutes::Plain(minutes) => minutes,
            Minutes::Change([_, _, net]) => net,
        }
    }

    /// The colours of a map of that.
    fn style(&self) -> MapStyle {
        MapStyle {
            scale: match self.minutes {
                Minutes::Plain(_) => Scale::Shadow,
                Minutes::Change(_) => Scale::Change,
            },
            unit: if self.when.days > 2 {
                Unit::Hours
            } else {
                Unit::Minutes
            },
            ..MapStyle::default()
        }
    }

    fn title(&self) -> String {
        let own = || format!("Shadow: {}", super::output::stem(&self.args.city));
        self.args.title.clone().unwrap_or_else(own)
    }
}

/// Writes all that is asked for; whether it was not interrupted.
pub(super) fn write(job: &Job<'_>) -> anyhow::Result<bool> {
    let mut is_whole = true;
    let products = &job.args.products;
    if let Kind::Grid { grid, .. } = &job.places.kind {
        if let Some(path) = &products.contours {
            contours::write(job, path, grid)?;
        }
        if let Some(folder) = &products.tiles {
            tiles::write(job, folder, grid)?;
        }
        if let Some(path) = &products.frames {
            is_whole = frames::write(job, path, grid)?;
        }
    }
    if let Some(path) = &products.glb {
        glb::write(job, path)?;
    }
    Ok(is_whole)
}

/// Refuses what there is none of.
pub(super) fn refuse(args: &ShadowsArgs) {
    let products = &args.products;
    let of_grid = [
        ("--contours", products.contours.is_some()),
        ("--tiles", products.tiles.is_some()),
        ("--frames", products.frames.is_some()),
    ];
    if let Some((option, _)) = of_grid.iter().find(|(_, is_asked)| *is_asked)
        && !args.places.is_grid()
    {
        wrong_usage(&format!(
            "{option} is of the grid over the ground; leave out --on and --points"
        ));
    }
    if products.glb.is_some() && args.places.points.is_some() {
        wrong_usage(
            "--glb shows the ground, roofs or facades (--on); points have no surface to show",
        );
    }
    if products.glb.is_some() && args.what_if.is_asked() {
        wrong_usage(
            "--glb shows one city; leave out --with, --without and --height, or write two runs",
        );
    }
    if products.frames.is_some() && args.sun.disc {
        wrong_usage("--frames: at a moment a place lies in shadow or not; leave out --disc");
    }
    if args.title.is_some()
        && args.png.is_none()
        && products.tiles.is_none()
        && products.frames.is_none()
    {
        wrong_usage("--title is for --png, --frames and --tiles");
    }
}

/// Whether there are not too many of anything, before it is measured.
pub(super) fn check(
    args: &ShadowsArgs,
    city: &City,
    places: &Places,
    when: &When,
) -> anyhow::Result<()> {
    let products = &args.products;
    if let (Some(_), Kind::Grid { grid, .. }) = (&products.tiles, &places.kind)
        && let Err(error) = TileSet::new(&city.origin, grid, products.max_zoom)
    {
        wrong_usage(&format!("--tiles: {error}"));
    }
    if products.frames.is_some() {
        moments::of(when, products.every(), places.tiles.places().len())?;
    }
    if products.glb.is_some() {
        glb::check(city, places, args.places.cell);
    }
    Ok(())
}
