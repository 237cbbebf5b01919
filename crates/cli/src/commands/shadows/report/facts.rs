//! What is so of all reports: what was measured, when, and how.

use serde_json::Value;

use super::super::clock::Clock;
use super::super::output::EXACT;
use super::frame::{Cell, Fact};
use super::resources::Resource;
use super::study::Study;

/// What the grid of places means for areas.
const AREAS: &str = "each area is covered by a grid of places, the middles of square cells; those that lie in a building are left out, \
     and each place stands for an equal part of the area. A share of an area is a share of its places: where the edge of a shadow \
     is, it is off by up to half a cell";

impl Study<'_> {
    /// What is so of all reports.
    pub(super) fn facts(&self, clock: &Clock) -> Vec<Fact> {
        let fact = |key, name, cell| Fact { key, name, cell };
        let edits = &self.args.what_if;
        let with = edits
            .with
            .iter()
            .map(|path| format!("with {}", path.display()));
        let without = edits.without.iter().map(|name| format!("without {name}"));
        let heights = edits.height.iter();
        let heights = heights.map(|(name, metres)| format!("{name} {metres} m tall"));
        let change: Vec<String> = with.chain(without).chain(heights).collect();
        let instants = self
            .when
            .spans
            .iter()
            .flat_map(|span| [span.start, span.end]);
        let origin = &self.before.origin;
        let (latitude, longitude) = (origin.latitude(), origin.longitude());
        let title = self.args.title.as_ref();
        let mut facts: Vec<Fact> = title
            .map(|title| fact("title", "Title", Cell::text(title)))
            .into_iter()
            .collect();
        facts.extend([
            fact("city", "City", Cell::text(&self.args.city)),
            fact(
                "change",
                "Change",
                match change.is_empty() {
                    true => Cell::shown(Value::Null, "none"),
                    false => Cell::text(change.join(", ")),
                },
            ),
            fact(
                "place",
                "Where the sun is reckoned for",
                Cell::text(place(latitude, longitude)),
            ),
            fact(
                "when",
                "Days and hours",
                Cell::text(self.when.text.replace(", ", ",").replace(',', ", ")),
            ),
            fact("time_zone", "Time zone", Cell::text(&self.when.zone)),
            fact("clock", "Times are in", Cell::text(clock.name(instants))),
        ]);
        facts.push(fact(
            "method",
            "Method",
            Cell::text(
                "exact: when each wall begins and ends to cover the sun, no instants are sampled",
            ),
        ));
        let air = if self.args.sun.refraction {
            "lifted by the air of the sea"
        } else {
            "without refraction"
        };
        let bound = format!("{EXACT}; the sun is {}, {air}", self.when.sun());
        facts.push(fact("bound", "Bound of error", Cell::text(bound)));
        if let Some(around) = &self.around {
            let value = serde_json::to_value(around).unwrap_or(Value::Null);
            let cell = Cell::shown(value, around.describe());
            facts.push(fact("surroundings", "What lies beyond the file", cell));
        }
        facts
    }

    /// The same of reports about areas.
    pub(super) fn facts_of_areas(&self, clock: &Clock) -> Vec<Fact> {
        let places = self.resources.iter().map(Resource::places).sum();
        let mut facts = self.facts(clock);
        facts.extend(self.facts_of_grid(places));
        facts.push(Fact {
            key: "areas",
            name: "What areas mean",
            cell: Cell::text(AREAS),
        });
        facts
    }

    /// How fine the places lie, and how many there are.
    pub(super) fn facts_of_grid(&self, places: usize) -> [Fact; 2] {
        let fact = |key, name, cell| Fact { key, name, cell };
        let cell = Cell::number(self.args.places.cell, 2);
        [
            fact("cell_m", "Places are apart, metres", cell),
            fact("places", "Places measured", Cell::count(places)),
        ]
    }
}

/// Degrees, as people say them.
fn place(latitude: f64, longitude: f64) -> String {
    let side = |degrees: f64, names: [&str; 2]| {
        let name = names[usize::from(degrees < 0.0)];
        format!("{:.5}° {name}", degrees.abs())
    };
    let (north, east) = (
        side(latitude, ["north", "south"]),
        side(longitude, ["east", "west"]),
    );
    format!("{north}, {east}")
}

#[cfg(test)]
mod tests {
    use super::place;

    #[test]
    fn places_lie_north_or_south_east_or_west() {
        assert_eq!(place(52.5, 13.4), "52.50000° north, 13.40000° east");
        assert_eq!(place(-33.0, -73.98), "33.00000° south, 73.98000° west");
    }
}
