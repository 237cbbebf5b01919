//! Things that throw shadow, and when.

use jiff::civil::{Date, date};
use ombra_city::Facet;
use ombra_geometry::Point3;
use ombra_sun::{Hours, Place, Refraction, Sheet, Sky, Span};

use crate::numbers::Numbers;

/// The walls and the roof of a box that is turned about the vertical: centre, half sides, angle in radians, from and to
/// which height.
pub(crate) struct Block {
    pub(crate) centre: [f32; 2],
    pub(crate) half: [f32; 2],
    pub(crate) angle: f32,
    pub(crate) low: f32,
    pub(crate) high: f32,
}

impl Block {
    pub(crate) fn random(numbers: &mut Numbers, side: f32, most: f32) -> Self {
        Self {
            centre: [numbers.within(-side, side), numbers.within(-side, side)],
            half: [numbers.within(3.0, 15.0), numbers.within(3.0, 15.0)],
            angle: numbers.within(0.0, 3.0),
            low: 0.0,
            high: numbers.within(3.0, most),
        }
    }

    fn ring(&self) -> [[f32; 2]; 4] {
        let (sin, cos) = self.angle.sin_cos();
        let [a, b] = self.half;
        [[a, b], [-a, b], [-a, -b], [a, -b]].map(|[u, v]| {
            let [x, y] = self.centre;
            [x + u * cos - v * sin, y + u * sin + v * cos]
        })
    }

    pub(crate) fn contains(&self, place: Point3) -> bool {
        let (sin, cos) = self.angle.sin_cos();
        let [dx, dy] = [place.x - self.centre[0], place.y - self.centre[1]];
        let (u, v) = (dx * cos + dy * sin, dy * cos - dx * sin);
        u.abs() <= self.half[0] && v.abs() <= self.half[1] && place.z < self.high
    }

    /// With a floor, so that it is closed.
    pub(crate) fn facets(&self, owner: u32) -> Vec<Facet> {
        let ring = self.ring();
        let at = |k: usize, z| Point3::new(ring[k % 4][0], ring[k % 4][1], z);
        let facet = |corners| Facet {
            corners,
            is_two_sided: false,
            owner,
        };
        let wall = |k| {
            facet([
                at(k, self.low),
                at(k + 1, self.low),
                at(k + 1, self.high),
                at(k, self.high),
            ])
        };
        let mut facets: Vec<Facet> = (0..4).map(wall).collect();
        facets.push(facet([0, 1, 2, 3].map(|k| at(k, self.high))));
        facets.push(facet([3, 2, 1, 0].map(|k| at(k, self.low))));
        facets
    }
}

/// A city of blocks, and places on its ground outside of them.
pub(crate) fn city(seed: u64, blocks: usize) -> (Vec<Facet>, Vec<Point3>) {
    let mut numbers = Numbers(seed);
    let blocks: Vec<Block> = (0..blocks)
        .map(|_| Block::random(&mut numbers, 150.0, 60.0))
        .collect();
    let facets = (0..)
        .zip(&blocks)
        .flat_map(|(owner, block)| block.facets(owner));
    let facets = facets.collect();
    let mut places = Vec::new();
    while places.len() < 48 {
        let place = Point3::new(
            numbers.within(-80.0, 80.0),
            numbers.within(-80.0, 80.0),
            0.0,
        );
        if !blocks.iter().any(|block| block.contains(place)) {
            places.push(place);
        }
    }
    (facets, places)
}

pub(crate) fn sky(latitude: f64) -> Sky {
    Sky::new(Place::new(latitude, 0.0, 0.0).unwrap(), Refraction::None).unwrap()
}

/// When the sun is up.
pub(crate) fn spans(sky: &Sky, dates: &[Date]) -> Vec<Span> {
    let zone = jiff::tz::TimeZone::UTC;
    let up = |&day: &Date| Hours::default().spans(sky, &zone, day);
    dates.iter().flat_map(up).collect()
}

pub(crate) fn sheets(sky: &Sky, spans: &[Span]) -> Vec<Sheet> {
    spans
        .iter()
        .flat_map(|&span| Sheet::cover(sky, span))
        .collect()
}

pub(crate) fn four_days() -> [Date; 4] {
    [
        date(2026, 3, 21),
        date(2026, 6, 21),
        date(2026, 9, 22),
        date(2026, 12, 21),
    ]
}
