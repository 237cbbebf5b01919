//! Places and buildings as tables have them.

use ombra::accrual::Share;
use ombra::city::{City, Facet};
use ombra::formats::places::PlaceShare;
use ombra::geometry::Point3;

/// Longitude, latitude and height.
pub(super) fn position(city: &City, at: Point3) -> [f64; 3] {
    let [longitude, latitude] = city.origin.to_geographic([at.x, at.y].map(f64::from));
    [longitude, latitude, f64::from(at.z)]
}

/// What one building takes from a place.
pub(super) fn share<'a>(share: &Share, city: &'a City) -> PlaceShare<'a> {
    named(share, |number| city.buildings[number].id.as_deref())
}

/// The same, where names are found by number.
pub(super) fn named<'a>(
    share: &Share,
    id: impl FnOnce(usize) -> Option<&'a str>,
) -> PlaceShare<'a> {
    PlaceShare {
        building: (share.owner < Facet::CONTEXT).then_some(share.owner),
        building_id: match share.owner {
            Facet::CONTEXT => Some("other"),
            Facet::TERRAIN => Some("terrain"),
            number => id(number as usize),
        },
        minutes: (share.seconds / 60.0) as f32,
        alone: (share.alone / 60.0) as f32,
    }
}
