//! What may be changed of a city.

use std::path::PathBuf;

use clap::Args;
use ombra::city::{Edits, Origin};
use ombra::formats::city::read_city_about;

use super::super::args::{ShadowsArgs, metres};
use crate::commands::Talk;

/// What if: minutes before and after a change of the city's buildings.
#[derive(Clone, Debug, Args)]
pub(crate) struct WhatIfArgs {
    /// What if the buildings of this file stood there, too: the outputs hold minutes before, after, and net; may be given several times
    #[arg(long, value_name = "FILE")]
    pub(crate) with: Vec<PathBuf>,

    /// What if these buildings were gone: names in the city's file, or #0, #1, … by their number
    #[arg(long, value_name = "ID", value_delimiter = ',')]
    pub(crate) without: Vec<String>,

    /// What if a building of the city's file were so tall above its ground: ID=120m; may be given several times
    #[arg(long, value_name = "ID=METRES", value_parser = height)]
    pub(crate) height: Vec<(String, f64)>,
}

impl WhatIfArgs {
    /// Whether anything is to be changed.
    pub(crate) fn is_asked(&self) -> bool {
        !(self.with.is_empty() && self.without.is_empty() && self.height.is_empty())
    }

    /// With the buildings of files, read as those of the city are.
    pub(in crate::commands::shadows) fn read(
        &self,
        args: &ShadowsArgs,
        origin: &Origin,
        talk: &Talk,
    ) -> anyhow::Result<Edits> {
        let mut with = Vec::new();
        for path in &self.with {
            let added = read_city_about(path, &args.city_options(), origin)?;
            for finding in &added.findings {
                talk.say(&format!("{}: {finding}", path.display()));
            }
            if !added.terrain.is_empty() {
                talk.say(&format!("{}: its terrain is left out", path.display()));
            }
            with.extend(added.buildings);
        }
        Ok(Edits {
            with,
            without: self.without.clone(),
            heights: self.height.clone(),
        })
    }
}

/// The name may have equals signs of its own.
fn height(text: &str) -> Result<(String, f64), String> {
    match text.rsplit_once('=') {
        Some((name, height)) if !name.is_empty() => Ok((name.to_owned(), metres(height)?)),
        _ => Err("a building and metres are wanted, as way/123=120m".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_height_is_a_name_and_metres() {
        assert_eq!(height("way/1=120m"), Ok(("way/1".to_owned(), 120.0)));
        assert_eq!(height("a=b=9.5"), Ok(("a=b".to_owned(), 9.5)));
        for wrong in ["", "120m", "=120m", "a=", "a=tall", "a=-1"] {
            assert!(height(wrong).is_err(), "{wrong}");
        }
    }
}
