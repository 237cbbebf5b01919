//! Whole files, through the one door.

mod bad;
mod hostile;
mod info;
pub(super) mod read;
mod real;

use std::path::{Path, PathBuf};

use ombra_city::City;

use super::{CityOptions, read_city_bytes};

/// Data from outside the project; `None`, and a line that says so, where it is not there.
pub(crate) fn outside_data(name: &str) -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("OMBRA_TEST_DATA").map_or(beside, PathBuf::from);
    let path = folder.join(name);
    if path.exists() {
        return Some(path);
    }
    eprintln!("skipped: {} is not there", path.display());
    None
}

fn read(text: &str) -> Result<City, String> {
    read_with(text, &CityOptions::default())
}

fn read_with(text: &str, options: &CityOptions) -> Result<City, String> {
    read_city_bytes("city", text.as_bytes(), options).map_err(|error| {
        let text = error.to_string();
        assert!(!text.contains('\n'), "an error is one line: {text}");
        text
    })
}

pub(super) fn findings(city: &City) -> Vec<String> {
    city.findings.iter().map(ToString::to_string).collect()
}

/// The z of the highest corner of each building.
pub(super) fn tops(city: &City) -> Vec<f32> {
    let top = |building: &ombra_city::Building| {
        let tops = building.parts.iter().map(|part| part.range()[1]);
        tops.fold(f32::MIN, f32::max)
    };
    city.buildings.iter().map(top).collect()
}
