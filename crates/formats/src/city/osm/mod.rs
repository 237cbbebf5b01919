//! OpenStreetMap: its XML (`.osm`) and its PBF (`.osm.pbf`).
//!
//! Read are closed ways and multipolygon relations tagged `building` or `building:part`, as "Simple
//! 3D Buildings" has them (<https://wiki.openstreetmap.org/wiki/Simple_3D_Buildings>). The file is
//! gone through three times, for relations, for ways and for nodes, so that of all that is on the
//! map only what buildings need is ever in memory.

mod buildings;
mod courtyards;
mod element;
mod kept;
mod pbf;
mod rings;
mod room;
#[cfg(test)]
pub(super) mod tests;
mod xml;

use ombra_city::{Crs, Draft};

use super::CityOptions;
use crate::error::FormatError;
use crate::limits::Limits;
use element::{Kind, Visit};
use kept::Kept;
use room::Room;

/// A file of OpenStreetMap.
#[derive(Clone, Copy, Debug)]
pub(super) enum File<'a> {
    Xml(&'a [u8]),
    Pbf(&'a [u8]),
}

impl<'a> File<'a> {
    /// `None` for what is no such file. Something else in XML is an error of its own.
    pub(super) fn recognised(bytes: &'a [u8]) -> Option<Self> {
        if pbf::is_pbf(bytes) {
            Some(Self::Pbf(bytes))
        } else if xml::is_osm(bytes) {
            Some(Self::Xml(bytes))
        } else {
            None
        }
    }

    /// Visits all elements of a kind.
    fn each(self, kind: Kind, limits: &Limits, visit: Visit<'_>) -> Result<(), FormatError> {
        match self {
            Self::Xml(bytes) => xml::each(bytes, kind, visit),
            Self::Pbf(bytes) => pbf::each(bytes, kind, limits, visit),
        }
    }
}

pub(super) fn read(file: File<'_>, options: &CityOptions) -> Result<Draft, FormatError> {
    let mut room = Room::default();
    let kept = Kept::read(file, &options.limits, &mut room)?;
    // OpenStreetMap is in WGS 84, always.
    let mut draft = Draft::new(Crs::wgs84());
    buildings::add(&mut draft, &kept, options, &mut room)?;
    Ok(draft)
}
