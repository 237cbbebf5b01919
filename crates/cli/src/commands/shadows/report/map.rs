//! The map of a report: what stands around, what is protected, what is new, as SVG.

mod cells;

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use ombra::city::{Building, Extent, Grid, Part};
use ombra_study::html::escaped;

use super::resources::Area;
pub(super) use cells::Cells;
use cells::{STEPS, colour, picture};

/// How wide a map is, in units of its own.
const WIDTH: f64 = 900.0;

/// A map that grows.
pub(super) struct MapDrawing {
    /// What it shows, in local metres.
    extent: Extent,
    /// Units of the map to a metre.
    scale: f64,
    body: String,
}

impl MapDrawing {
    /// Of an extent and a little around it.
    pub(super) fn new(extent: Extent) -> Self {
        let side = [0, 1].map(|k| extent.high[k] - extent.low[k]);
        let extent = extent.widened(0.05 * side[0].max(side[1]).max(20.0));
        Self {
            scale: WIDTH / (extent.high[0] - extent.low[0]),
            extent,
            body: String::new(),
        }
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let Extent { low, high } = self.extent;
        [(x - low[0]) * self.scale, (high[1] - y) * self.scale]
    }

    /// Rings as a closed path, or open lines as one that is not.
    pub(super) fn path<'p>(
        &mut self,
        lines: impl IntoIterator<Item = &'p [[f64; 2]]>,
        is_closed: bool,
        attributes: &str,
    ) {
        let mut path = String::new();
        for line in lines {
            for (index, &corner) in line.iter().enumerate() {
                let [x, y] = self.at(corner);
                // Writing to a string does not fail.
                let _ = write!(path, "{}{x:.1} {y:.1}", if index == 0 { 'M' } else { 'L' });
            }
            path += if is_closed { "Z" } else { "" };
        }
        if !path.is_empty() {
            let _ = writeln!(self.body, "<path d=\"{path}\" {attributes}/>");
        }
    }

    /// Those buildings that lie in sight.
    pub(super) fn buildings<'b>(
        &mut self,
        buildings: impl IntoIterator<Item = &'b Building>,
        attributes: &str,
    ) {
        let Extent { low, high } = self.extent;
        let is_seen = |building: &&Building| {
            let [from, to] = building.bounds();
            (0..2).all(|k| f64::from(from[k]) <= high[k] && low[k] <= f64::from(to[k]))
        };
        let seen = buildings.into_iter().filter(is_seen);
        let rings: Vec<Vec<[f64; 2]>> = seen.flat_map(outline).collect();
        self.path(rings.iter().map(Vec::as_slice), true, attributes);
    }

    /// Outlines and names of areas.
    pub(super) fn areas<'a>(&mut self, areas: impl IntoIterator<Item = &'a Area> + Clone) {
        let rings = areas.clone().into_iter().flat_map(|area| &area.polygons);
        let rings = rings.flatten().map(Vec::as_slice);
        self.path(rings, true, "class=\"area\"");
        for area in areas {
            let [low, high] = area.within.bounds();
            let middle = self.at([0, 1].map(|k| 0.5 * (low[k] + high[k])));
            self.label(middle, &area.name);
        }
    }

    /// A dot where something is so, and what, beside it.
    pub(super) fn mark(&mut self, place: [f64; 2], text: &str) {
        let [x, y] = self.at(place);
        let _ = writeln!(
            self.body,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\" class=\"mark\"/>"
        );
        let text = escaped(text);
        let (x, y) = (x + 9.0, y + 5.0);
        let _ = writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" class=\"left\">{text}</text>"
        );
    }

    /// Letters at a place of the map, in its own units.
    fn label(&mut self, [x, y]: [f64; 2], text: &str) {
        let text = escaped(text);
        let _ = writeln!(self.body, "<text x=\"{x:.1}\" y=\"{y:.1}\">{text}</text>");
    }

    /// The cells of a grid by their values, as a picture.
    pub(super) fn cells(&mut self, cells: &Cells<'_>) {
        let Grid {
            width,
            height,
            cell,
            ..
        } = *cells.grid;
        let [x, y] = self.at(cells.grid.north_west());
        let [w, h] = [width, height].map(|count| f64::from(count) * cell * self.scale);
        let url = STANDARD.encode(picture(cells));
        let _ = writeln!(
            self.body,
            "<image x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\" preserveAspectRatio=\"none\" \
             class=\"cells\" href=\"data:image/png;base64,{url}\"/>"
        );
    }

    /// The whole map; `legend` says what the strongest colour means, if colours mean anything.
    pub(super) fn finish(self, title: &str, legend: Option<&str>) -> String {
        let height = ((self.extent.high[1] - self.extent.low[1]) * self.scale).ceil();
        let mut foot = String::new();
        let bar = scale_bar(self.extent.high[0] - self.extent.low[0]);
        let (long, base) = (bar * self.scale, height + 26.0);
        let _ = writeln!(
            foot,
            "<path d=\"M14 {base}h{long:.1}m0 -5v10M14 {}v10\" class=\"bar\"/>\
             <text x=\"{:.1}\" y=\"{}\" class=\"left\">{bar} m</text>\
             <path d=\"M{} {}l6 16l-6 -4l-6 4z\" class=\"north\"/><text x=\"{}\" y=\"{}\">N</text>",
            base - 5.0,
            22.0 + long,
            base + 5.0,
            WIDTH - 20.0,
            base - 12.0,
            WIDTH - 20.0,
            base + 20.0,
        );
        if let Some(legend) = legend {
            let x = 0.42 * WIDTH;
            let steps = (1..=STEPS).map(|step| {
                let [r, g, b] = colour(step);
                let x = x + 10.0 * f64::from(step - 1);
                format!("<rect x=\"{x}\" y=\"{}\" width=\"10\" height=\"12\" fill=\"rgb({r},{g},{b})\"/>", base - 8.0)
            });
            foot.extend(steps);
            let _ = writeln!(
                foot,
                "<text x=\"{}\" y=\"{}\" class=\"right\">0</text><text x=\"{}\" y=\"{}\" class=\"left\">{}</text>",
                x - 6.0,
                base + 4.0,
                x + 10.0 * f64::from(STEPS) + 6.0,
                base + 4.0,
                escaped(legend)
            );
        }
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {}\" role=\"img\" aria-label=\"{}\">\n\
             <style>{STYLE}</style>\n<rect width=\"{WIDTH}\" height=\"{}\" fill=\"#fff\"/>\n\
             <svg width=\"{WIDTH}\" height=\"{height}\">\n{}</svg>\n\
             <path d=\"M0 {height}H{WIDTH}\" stroke=\"#888\"/>\n{foot}</svg>\n",
            height + 52.0,
            escaped(title),
            height + 52.0,
            self.body
        )
    }
}

const STYLE: &str = "\
.stands{fill:#d9d6cf;stroke:#b3aea4;stroke-width:.4}\
.new{fill:#e07b39;stroke:#8a3c07;stroke-width:1.2;fill-opacity:.85}\
.gone{fill:none;stroke:#8a3c07;stroke-width:1.2;stroke-dasharray:5 3}\
.area{fill:none;stroke:#1d7a3a;stroke-width:2.2;fill-rule:evenodd}\
.ring{fill:none;stroke:#333;stroke-width:1.3;stroke-dasharray:7 4}\
.line{fill:none;stroke:#2b3a8f;stroke-width:1.1}\
.limit{fill:none;stroke:#b3261e;stroke-width:2.2}\
.mark{fill:#b3261e;stroke:#fff;stroke-width:1.5}\
.cells{image-rendering:pixelated}\
.bar{fill:none;stroke:#222;stroke-width:1.5}.north{fill:#222}\
text{font:600 13px system-ui,sans-serif;fill:#222;text-anchor:middle;paint-order:stroke;stroke:#fff;stroke-width:3px;\
stroke-linejoin:round}.left{text-anchor:start}.right{text-anchor:end}";

/// A round number of metres, about a fifth of a width.
fn scale_bar(width: f64) -> f64 {
    let about = 0.25 * width;
    let ten = 10_f64.powf(about.log10().floor());
    let steps = [5.0, 2.0, 1.0].map(|step| step * ten);
    steps.into_iter().find(|&step| step <= about).unwrap_or(ten)
}

/// What of a building is seen from above: the outlines of its prisms, and its faces that are not upright.
pub(super) fn outline(building: &Building) -> Vec<Vec<[f64; 2]>> {
    let wide = |at: [f32; 2]| at.map(f64::from);
    let mut rings = Vec::new();
    for part in &building.parts {
        match part {
            Part::Prism(prism) => rings.extend(
                (prism.outline.rings()).map(|ring| ring.iter().copied().map(wide).collect()),
            ),
            Part::Faces(faces) => {
                for face in &faces.faces {
                    let ring: Vec<_> = face.rings[0].iter().map(|p| wide([p.x, p.y])).collect();
                    if is_wide(&ring) {
                        rings.push(ring);
                    }
                }
            }
        }
    }
    rings
}

/// Whether a ring faces up: of two faces above one another the upper one is enough.
pub(super) fn is_wide(ring: &[[f64; 2]]) -> bool {
    let next = ring.iter().skip(1).chain(ring.first());
    let twice: f64 = ring
        .iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
        .sum();
    twice > 0.1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_round() {
        for (width, bar) in [(1000.0, 200.0), (90.0, 20.0), (4000.0, 1000.0), (7.0, 1.0)] {
            assert_eq!(scale_bar(width), bar, "{width}");
        }
    }

    #[test]
    fn a_map_holds_what_it_was_given_and_nothing_from_elsewhere() {
        let mut map = MapDrawing::new(Extent {
            low: [0.0; 2],
            high: [100.0, 50.0],
        });
        let grid = Grid::within([0.0; 2], [2.0, 2.0], 1.0).unwrap();
        let values = [0.0, 1.0, f32::NAN, 4.0];
        map.cells(&Cells {
            grid: &grid,
            values: &values,
            most: 4.0,
        });
        map.mark([50.0, 25.0], "<here>");
        let svg = map.finish("a \"b\"", Some("4 h"));
        assert!(svg.contains("&lt;here&gt;") && svg.contains("data:image/png;base64,"));
        assert!(svg.contains("aria-label=\"a &quot;b&quot;\""));
        assert_eq!(svg.matches("http").count(), 1, "the name of SVG alone");
    }
}
