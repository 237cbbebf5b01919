//! SVG, as text.

use std::fmt::Write as _;

use ombra_study::html::escaped;

use super::view::{Place, View};

/// A page that grows.
pub(crate) struct Svg {
    text: String,
    /// Gradients so far.
    fades: usize,
}

const STYLE: &str = "text{font-family:Helvetica,Arial,'DejaVu Sans',sans-serif;fill:#222}\
.title{font-size:17px;font-weight:bold}.small{font-size:12px;fill:#555}.name{font-size:12.5px;fill:#333}\
.label{font-size:11px;font-weight:bold;paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}\
.object{font-size:11px;fill:#777;font-style:italic;paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}\
path,line,circle{fill:none;stroke-linecap:round;stroke-linejoin:round}";

impl Svg {
    pub(crate) fn new(width: f64, height: f64) -> Self {
        let (width, height) = (width.ceil(), height.ceil());
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\">\n<style>{STYLE}</style>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
        );
        Self { text, fades: 0 }
    }

    /// What follows is clipped to a view.
    pub(crate) fn begin_view(&mut self, view: &View) {
        let ([x, y], [width, height]) = (view.corner, view.size);
        self.text([x, y - 8.0], view.name, "class=\"name\"");
        let id = format!("view{:.0}", y);
        self.add(&format!(
            "<clipPath id=\"{id}\"><rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"/></clipPath>\n\
             <g clip-path=\"url(#{id})\">\n"
        ));
    }

    /// Ends the clipping, and draws a frame.
    pub(crate) fn end_view(&mut self, view: &View) {
        let ([x, y], [width, height]) = (view.corner, view.size);
        self.add(&format!(
            "</g>\n<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"none\" stroke=\"#bbb\"/>\n"
        ));
    }

    fn add(&mut self, text: &str) {
        self.text.push_str(text);
    }

    /// Letters; `attributes` are SVG's.
    pub(crate) fn text(&mut self, [x, y]: Place, text: &str, attributes: &str) {
        let text = escaped(text);
        self.add(&format!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" {attributes}>{text}</text>\n"
        ));
    }

    /// Many segments as one path.
    pub(crate) fn segments(&mut self, segments: &[[Place; 2]], attributes: &str) {
        if segments.is_empty() {
            return;
        }
        let mut path = String::new();
        let mut at = None;
        for [from, to] in segments {
            let tenth = |place: &Place| place.map(|x| (x * 10.0).round() as i64);
            if at != Some(tenth(from)) {
                // Writing to a string does not fail.
                let _ = write!(path, "M{:.1} {:.1}", from[0], from[1]);
            }
            let _ = write!(path, "L{:.1} {:.1}", to[0], to[1]);
            at = Some(tenth(to));
        }
        self.add(&format!("<path d=\"{path}\" {attributes}/>\n"));
    }

    /// A closed outline, filled.
    pub(crate) fn polygon(&mut self, places: &[Place], attributes: &str) {
        let list: Vec<_> = places
            .iter()
            .map(|[x, y]| format!("{x:.1},{y:.1}"))
            .collect();
        self.add(&format!(
            "<polygon points=\"{}\" {attributes}/>\n",
            list.join(" ")
        ));
    }

    pub(crate) fn dot(&mut self, [x, y]: Place, radius: f64, colour: &str) {
        self.add(&format!(
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" style=\"fill:{colour}\"/>\n"
        ));
    }

    /// A line; one that fades goes on for ever.
    pub(crate) fn line(&mut self, [from, to]: [Place; 2], stroke: &Stroke<'_>) {
        let [[x1, y1], [x2, y2]] = [from, to];
        let colour = stroke.colour;
        let paint = if stroke.fades {
            let id = format!("fade{}", self.fades);
            self.fades += 1;
            self.add(&format!(
                "<linearGradient id=\"{id}\" gradientUnits=\"userSpaceOnUse\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\">\
                 <stop offset=\"0.4\" stop-color=\"{colour}\"/><stop offset=\"1\" stop-color=\"{colour}\" stop-opacity=\"0.25\"/></linearGradient>\n"
            ));
            format!("url(#{id})")
        } else {
            colour.to_owned()
        };
        let dashes = match stroke.dashes {
            "" => String::new(),
            dashes => format!(" stroke-dasharray=\"{dashes}\""),
        };
        let width = stroke.width;
        self.add(&format!(
            "<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" stroke=\"{paint}\" stroke-width=\"{width:.2}\"{dashes}/>\n"
        ));
    }

    pub(crate) fn finish(mut self) -> String {
        self.add("</svg>\n");
        self.text
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stroke<'a> {
    pub(crate) colour: &'a str,
    pub(crate) width: f64,
    pub(crate) dashes: &'a str,
    pub(crate) fades: bool,
}
