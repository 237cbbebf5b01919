//! Plots as SVG, made to stand in a page or alone.
//!
//! Colours are variables of the style sheet, so that a plot follows the reader from light to dark.

mod bars;
mod scale;
mod scatter;
mod strip;

use std::fmt::Write as _;

pub(crate) use bars::{Bar, Bars};
pub(crate) use scale::Scale;
pub(crate) use scatter::{Dot, Scatter};
pub(crate) use strip::{Mark, Strip};

use crate::html::escaped;

/// What plots look like. Families have a colour each, whatever is drawn of them.
pub(crate) const STYLE: &str = "
:root { --ink: #1b1b1f; --quiet: #5f6068; --grid: #0000001a; --paper: #fff; --band: #2563eb22;
  --none: #77787f; --grids: #c2600a; --octree: #be185d; --kd: #2563eb; --bih: #7c3aed; --bvh: #15803d; }
@media (prefers-color-scheme: dark) { :root { --ink: #ececf1; --quiet: #a5a6b0; --grid: #ffffff24;
  --paper: #121212; --band: #7aa7ff2e; --none: #a0a1a8; --grids: #f5a352; --octree: #f47ab5; --kd: #7fabff;
  --bih: #bd9bff; --bvh: #62d290; } }
.plot { font: 12.5px system-ui, 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif; }
.plot text { fill: var(--ink); font-variant-numeric: tabular-nums; }
.plot .head { font-size: 14px; font-weight: 600; } .plot .quiet { fill: var(--quiet); }
.plot .rule { stroke: var(--grid); } .plot .axis { stroke: var(--quiet); } .plot .band { fill: var(--band); }
.plot .whisker { stroke: var(--ink); stroke-width: 1.2; } .plot .fill { fill: currentColor; }
.plot .line { stroke: currentColor; stroke-width: 2.5; stroke-linecap: round; }
.plot .dot { fill: currentColor; stroke: var(--paper); stroke-width: 1.5; }
.plot .leader { stroke: var(--quiet); stroke-width: .8; }
.plot .front { fill: none; stroke: var(--quiet); stroke-width: 1.2; stroke-dasharray: 5 4; }
.plot .name { paint-order: stroke; stroke: var(--paper); stroke-width: 3px; stroke-linejoin: round; }
.f-none { color: var(--none); } .f-grid { color: var(--grids); } .f-octree { color: var(--octree); }
.f-kd { color: var(--kd); } .f-bih { color: var(--bih); } .f-bvh { color: var(--bvh); }
.f-other { color: var(--ink); }
";

/// Where a text stands by its place.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// A drawing that grows.
pub(crate) struct Svg {
    text: String,
    width: f64,
    height: f64,
}

impl Svg {
    pub(crate) const fn new(width: f64, height: f64) -> Self {
        let text = String::new();
        Self {
            text,
            width,
            height,
        }
    }

    // Writing to a string does not fail.

    pub(crate) fn text(&mut self, [x, y]: [f64; 2], anchor: Anchor, class: &str, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let text = escaped(text);
        let _ = writeln!(
            self.text,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" class=\"{class}\">{text}</text>"
        );
    }

    /// Text from below to above, its middle at the place.
    pub(crate) fn upward(&mut self, [x, y]: [f64; 2], class: &str, text: &str) {
        let text = escaped(text);
        let _ = writeln!(
            self.text,
            "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" text-anchor=\"middle\" class=\"{class}\">{text}</text>"
        );
    }

    pub(crate) fn line(&mut self, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2], class: &str) {
        let _ = writeln!(
            self.text,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" class=\"{class}\"/>"
        );
    }

    /// A box; `opacity` from 0 to 1.
    pub(crate) fn area(&mut self, corner: [f64; 2], size: [f64; 2], class: &str, opacity: f64) {
        let ([x, y], [width, height]) = (corner, size);
        let _ = writeln!(
            self.text,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" rx=\"1\" class=\"{class}\" opacity=\"{opacity}\"/>"
        );
    }

    /// A dot that says more when pointed at.
    pub(crate) fn dot(&mut self, [x, y]: [f64; 2], radius: f64, class: &str, title: &str) {
        let title = escaped(title);
        let _ = writeln!(
            self.text,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" class=\"{class}\"><title>{title}</title></circle>"
        );
    }

    pub(crate) fn path(&mut self, places: &[[f64; 2]], class: &str) {
        let mut path = String::new();
        for (i, [x, y]) in places.iter().enumerate() {
            let _ = write!(path, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
        }
        let _ = writeln!(self.text, "<path d=\"{path}\" class=\"{class}\"/>");
    }

    /// To stand in a page that has [`STYLE`]; `says` is for those who cannot see it.
    pub(crate) fn finish(&self, says: &str) -> String {
        format!(
            "<svg class=\"plot\" viewBox=\"0 0 {} {}\" style=\"max-width: {}px\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
            self.width,
            self.height,
            // Letters are of one size in all plots of a wide page.
            self.width * 1.1,
            escaped(says),
            self.text
        )
    }

    /// To stand alone, on paper of its own.
    pub(crate) fn alone(&self, says: &str) -> String {
        const MARGIN: f64 = 12.0;
        let [width, height] = [self.width, self.height].map(|side| side + 2.0 * MARGIN);
        let paper =
            format!("x=\"-{MARGIN}\" y=\"-{MARGIN}\" width=\"{width}\" height=\"{height}\"");
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"-{MARGIN} -{MARGIN} {width} {height}\" role=\"img\">\n<title>{}</title>\n<style>{STYLE}</style>\n\
             <rect {paper} fill=\"var(--paper)\"/>\n{}</svg>\n",
            escaped(says),
            self.text
        )
    }
}

/// About how wide a text is: a sans-serif's letters are a bit over half as wide as high.
pub(crate) fn width_of(text: &str) -> f64 {
    text.chars().count() as f64 * 6.9
}
