//! The committed pictures of README.md and docs/, rendered again by the commands of one table.

use std::path::Path;

use anyhow::{Context, Result, ensure};
use clap::Args;

use crate::cargo;

/// A picture and the words after `ombra` that make it; the file is appended to them.
struct Picture {
    file: &'static str,
    arguments: &'static str,
}

/// The table: a picture that is committed has a row here.
const TABLE: &[Picture] = &[
    Picture {
        file: "docs/pictures/whitted.png",
        arguments: "render whitted --size 640x360 --spp 16",
    },
    Picture {
        file: "docs/pictures/whitted-raster.png",
        arguments: "render whitted --size 640x360 --spp 16 --integrator raster",
    },
    Picture {
        file: "docs/pictures/teapot.png",
        arguments: "render teapot --size 384x256 --spp 16",
    },
    Picture {
        file: "docs/pictures/teapot-cost.png",
        arguments: "render teapot --size 384x256 --spp 4 --integrator cost",
    },
    Picture {
        file: "docs/pictures/shapes.png",
        arguments: "render shapes --size 480x300 --spp 16",
    },
];

/// Which pictures.
#[derive(Debug, Args)]
pub(crate) struct Options {
    /// Only pictures whose file name holds this
    #[arg(default_value = "")]
    name: String,
}

/// Renders them with the release build.
///
/// # Errors
/// When there is no such picture, or one cannot be rendered.
pub(crate) fn run(options: &Options) -> Result<()> {
    let chosen = || TABLE.iter().filter(|row| row.file.contains(&options.name));
    ensure!(
        chosen().next().is_some(),
        "the table in xtask/src/pictures.rs has no picture \"{}\"",
        options.name
    );
    for picture in chosen() {
        if let Some(folder) = Path::new(picture.file).parent() {
            std::fs::create_dir_all(cargo::root().join(folder))?;
        }
        println!("{}", picture.file);
        let mut render = cargo::cargo("run --quiet --release --bin ombra --");
        render.args(picture.arguments.split_whitespace());
        render.args(["--output", picture.file]);
        cargo::run(&mut render).with_context(|| picture.file.to_owned())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_picture_of_the_table_is_committed() {
        for picture in TABLE {
            let file = cargo::root().join(picture.file);
            assert!(file.is_file(), "{} is not there", picture.file);
        }
    }

    #[test]
    fn a_picture_that_is_not_in_the_table_is_refused() {
        let name = "no such picture".to_owned();
        let message = run(&Options { name }).unwrap_err().to_string();
        assert!(message.contains("\"no such picture\""), "{message}");
    }
}
