//! Dots with their names beside them.

use super::scale::label;
use super::{Anchor, Scale, Svg, width_of};
use crate::family::Family;
use crate::numbers::short;

const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 548.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 366.0;
const RADIUS: f64 = 6.0;

/// One structure.
pub(crate) struct Dot {
    pub(crate) name: &'static str,
    pub(crate) at: [f64; 2],
}

/// A plot of dots.
pub(crate) struct Scatter<'a> {
    pub(crate) title: &'a str,
    /// What is along each axis.
    pub(crate) axes: [&'a str; 2],
    pub(crate) scales: [Scale; 2],
    pub(crate) dots: Vec<Dot>,
    /// Names of dots that a dashed line joins, from left to right.
    pub(crate) front: Vec<&'static str>,
}

/// A part of the drawing that is taken: left, top, right, bottom.
type Taken = [f64; 4];

impl Scatter<'_> {
    pub(crate) fn draw(&self) -> Svg {
        let mut svg = Svg::new(WIDTH, HEIGHT);
        svg.text([0.0, 16.0], Anchor::Start, "head", self.title);
        let [x, y] = self.scales;
        let across = |number: f64| LEFT + x.place(number) * (RIGHT - LEFT);
        let up = |number: f64| BOTTOM - y.place(number) * (BOTTOM - TOP);
        for tick in x.ticks() {
            let at = across(tick);
            svg.line([at, TOP], [at, BOTTOM], "rule");
            svg.text([at, BOTTOM + 17.0], Anchor::Middle, "quiet", &label(tick));
        }
        for tick in y.ticks() {
            let at = up(tick);
            svg.line([LEFT, at], [RIGHT, at], "rule");
            svg.text([LEFT - 7.0, at + 4.0], Anchor::End, "quiet", &label(tick));
        }
        svg.line([LEFT, BOTTOM], [RIGHT, BOTTOM], "axis");
        svg.line([LEFT, TOP], [LEFT, BOTTOM], "axis");
        let middle = (LEFT + RIGHT) / 2.0;
        svg.text([middle, BOTTOM + 40.0], Anchor::Middle, "", self.axes[0]);
        svg.upward([13.0, (TOP + BOTTOM) / 2.0], "", self.axes[1]);
        let place = |dot: &Dot| [across(dot.at[0]), up(dot.at[1])];
        let joined = self
            .front
            .iter()
            .filter_map(|name| self.dots.iter().find(|d| d.name == *name));
        let joined: Vec<_> = joined.map(place).collect();
        if joined.len() > 1 {
            svg.path(&joined, "front");
        }
        let mut taken: Vec<Taken> = self.dots.iter().map(|dot| around(place(dot))).collect();
        for dot in &self.dots {
            let from = place(dot);
            let (to, anchor, own) = label_place(from, dot.name, &taken);
            taken.push(own);
            // A name that stands away from its dot is led to it.
            let near = (to[0] - from[0]).hypot(to[1] - 4.0 - from[1]) < 3.0 * RADIUS;
            if !near {
                let edge = [to[0], to[1] - 4.0];
                svg.line(from, edge, "leader");
            }
            let class = format!("dot {}", Family::of(dot.name).class());
            let [a, b] = dot.at.map(short);
            let title = format!("{}: {} {a}, {} {b}", dot.name, self.axes[0], self.axes[1]);
            svg.dot(from, RADIUS, &class, &title);
            svg.text(to, anchor, "name", dot.name);
        }
        svg
    }
}

fn around([x, y]: [f64; 2]) -> Taken {
    [x - RADIUS, y - RADIUS, x + RADIUS, y + RADIUS]
}

/// The first of some places around a dot where its name covers nothing else.
fn label_place(dot: [f64; 2], name: &str, taken: &[Taken]) -> ([f64; 2], Anchor, Taken) {
    const HALF: f64 = 7.0;
    let wide = width_of(name);
    let mut first = None;
    for distance in [10.0, 18.0, 28.0, 40.0, 54.0, 70.0, 88.0] {
        for degrees in [
            0.0_f64, 180.0, -90.0, 90.0, -35.0, 35.0, -145.0, 145.0, -65.0, 65.0,
        ] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let at = [dot[0] + cos * distance, dot[1] + sin * distance];
            let (anchor, left) = match () {
                () if cos > 0.3 => (Anchor::Start, at[0]),
                () if cos < -0.3 => (Anchor::End, at[0] - wide),
                () => (Anchor::Middle, at[0] - wide / 2.0),
            };
            let own = [left, at[1] - HALF, left + wide, at[1] + HALF];
            let place = ([at[0], at[1] + 4.0], anchor, own);
            let inside = own[0] > LEFT && own[1] > TOP && own[2] < WIDTH && own[3] < BOTTOM;
            let free = |other: &Taken| {
                own[2] < other[0] || other[2] < own[0] || own[3] < other[1] || other[3] < own[1]
            };
            if inside && taken.iter().all(free) {
                return place;
            }
            first.get_or_insert(place);
        }
    }
    first.unwrap_or((dot, Anchor::Start, around(dot)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_dots_in_one_place_do_not_cover_one_another() {
        let dot = [300.0, 200.0];
        let mut taken = vec![around(dot)];
        for name in ["kd-stack", "kd-restart", "kd-short-stack", "kd-ropes"] {
            let (_, _, own) = label_place(dot, name, &taken);
            for other in &taken {
                let apart = own[2] < other[0]
                    || other[2] < own[0]
                    || own[3] < other[1]
                    || other[3] < own[1];
                assert!(apart, "{name}: {own:?} {other:?}");
            }
            taken.push(own);
        }
    }
}
