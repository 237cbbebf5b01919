//! Tiles for maps on the web.

use std::path::Path;

use ombra::city::Grid;
use ombra::formats::raster::{Raster, Shades, TileSet, Unit};

use super::{Job, Minutes};

/// What two bytes hold.
const MOST: f32 = 32_767.0;

pub(super) fn write(job: &Job<'_>, folder: &Path, grid: &Grid) -> anyhow::Result<()> {
    let origin = &job.city.origin;
    let set = TileSet::new(origin, grid, job.args.products.max_zoom)?;
    let values = job.mapped();
    let raster = Raster::new(origin, *grid, Unit::Minutes, values)?;
    let shades = Shades::new(values, &job.style());
    let cpu = &job.session.cpu;
    cpu.install(|| set.write(folder, &raster, &shades, &job.title(), &job.metadata))?;
    let [first, last] = set.zooms();
    let what = match job.minutes {
        Minutes::Plain(_) => "",
        Minutes::Change(_) => " of the net",
    };
    let are_long = values.iter().any(|minutes| minutes.abs() > MOST);
    job.talk.say(&format!(
        "{}: {} tiles{what}, zoom {first} to {last}{}",
        folder.display(),
        set.count(),
        if are_long {
            "; pictures only: more than 32767 minutes do not fit into two bytes"
        } else {
            ""
        },
    ));
    Ok(())
}
