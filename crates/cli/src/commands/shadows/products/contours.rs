//! Lines of equal time in shadow.

use std::path::Path;

use ombra::city::Grid;
use ombra::formats::contour::{ContourLine, contour_lines, write_contours_geojson};

use super::{Job, Minutes};

pub(super) fn write(job: &Job<'_>, path: &Path, grid: &Grid) -> anyhow::Result<()> {
    let mut levels = job.args.products.levels.clone();
    levels.sort_by(f32::total_cmp);
    levels.dedup();
    let of = |name, values| {
        let lines = contour_lines(grid, values, &levels);
        lines.into_iter().map(move |line| (name, line))
    };
    let lines: Vec<(Option<&str>, ContourLine)> = match job.minutes {
        Minutes::Plain(minutes) => of(None, minutes).collect(),
        Minutes::Change(all) => (["before", "after", "net"].into_iter().zip(all))
            .flat_map(|(name, values)| of(Some(name), values))
            .collect(),
    };
    let all = lines.iter().map(|(name, line)| (*name, line));
    write_contours_geojson(path, &job.city.origin, all, &job.metadata)?;
    job.talk.say(&format!(
        "{}: {} line{}",
        path.display(),
        lines.len(),
        if lines.len() == 1 { "" } else { "s" },
    ));
    Ok(())
}
