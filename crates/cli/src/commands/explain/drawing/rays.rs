//! The rays themselves, with arrowheads and numbers.

use ombra::render::explain::RayKind;
use ombra::scene::Scene;

use super::super::path::Path;
use super::labels::Labels;
use super::light_position;
use super::svg::{Stroke, Svg};
use super::view::{Place, View};

/// The colour of a kind of ray.
pub(crate) const fn colour(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Camera => "#111111",
        RayKind::Reflected => "#c2185b",
        RayKind::Transmitted => "#1565c0",
        RayKind::Shadow { .. } => "#d08700",
        _ => "#2e7d32",
    }
}

/// Draws the rays in a view, and gives how many have no number because there is no room.
pub(crate) fn draw(
    svg: &mut Svg,
    view: &View,
    scene: &Scene,
    paths: &[Path],
    labels: &mut Labels,
) -> usize {
    let within = [
        view.corner[0] + 1.0,
        view.corner[1] + 1.0,
        view.corner[0] + view.size[0] - 1.0,
        view.corner[1] + view.size[1] - 1.0,
    ];
    // What matters most comes last, over the others.
    let mut order: Vec<_> = paths.iter().map(|path| (path, line(path, view))).collect();
    order.sort_by(|(a, _), (b, _)| {
        let shadow = |path: &Path| path.kind.is_question();
        shadow(b)
            .cmp(&shadow(a))
            .then(a.weight.total_cmp(&b.weight))
    });
    for (path, line) in &order {
        if let Some(line) = line {
            ray(svg, path, line);
            labels.add_line([line.from, line.to]);
        }
    }
    marks(svg, view, scene, paths, labels);
    let mut unnamed = 0;
    for (path, line) in order.iter().rev() {
        let Some(line) = line else {
            continue;
        };
        let middles = candidates(line);
        match labels.find(&path.name, middles, within) {
            Some([x, y]) => svg.text(
                [x, y + 3.8],
                &path.name,
                &format!(
                    "class=\"label\" text-anchor=\"middle\" style=\"fill:{}\"",
                    colour(path.kind)
                ),
            ),
            None => unnamed += 1,
        }
    }
    unnamed
}

/// A ray on the page.
struct Line {
    from: Place,
    to: Place,
    /// Whether it goes on beyond what is drawn.
    goes_on: bool,
}

/// Where a ray is on the page, if any of it is.
fn line(path: &Path, view: &View) -> Option<Line> {
    let from = view.place(path.from);
    let far = 4.0 * (view.size[0] + view.size[1]) / view.scale;
    let end = path.to.filter(|to| to.is_finite());
    let whole = view.place(end.unwrap_or(path.from + path.along * far));
    let [start, stop] = view.clip(from, whole)?;
    let goes_on = end.is_none() || !view.holds(whole);
    // An arrow is seen best a little within the frame.
    let length = (stop[0] - start[0]).hypot(stop[1] - start[1]);
    let to = if goes_on && length > 8.0 {
        let s = 1.0 - 4.0 / length;
        [
            start[0] + (stop[0] - start[0]) * s,
            start[1] + (stop[1] - start[1]) * s,
        ]
    } else {
        stop
    };
    Some(Line {
        from: start,
        to,
        goes_on,
    })
}

fn ray(svg: &mut Svg, path: &Path, line: &Line) {
    let colour = colour(path.kind);
    let question = path.kind.is_question();
    let width = if question {
        0.9
    } else {
        0.8 + 1.6 * f64::from(path.weight.clamp(0.0, 1.0)).sqrt()
    };
    let dashes = match (question, path.blocked) {
        (true, true) => "2 4",
        (true, false) => "7 3",
        _ => "",
    };
    let stroke = Stroke {
        colour,
        width,
        dashes,
        fades: line.goes_on,
    };
    svg.line([line.from, line.to], &stroke);
    let (dx, dy) = (line.to[0] - line.from[0], line.to[1] - line.from[1]);
    let length = dx.hypot(dy);
    if length < 1.5 {
        // It comes toward the viewer, or goes away.
        svg.dot(line.to, 2.2, colour);
        return;
    }
    let size = (4.0 + 1.5 * width).min(0.6 * length);
    let (dx, dy) = (dx / length, dy / length);
    let [x, y] = line.to;
    let (back_x, back_y) = (x - dx * size, y - dy * size);
    let half = 0.38 * size;
    svg.polygon(
        &[
            [x, y],
            [back_x - dy * half, back_y + dx * half],
            [back_x + dy * half, back_y - dx * half],
        ],
        &format!("fill=\"{colour}\""),
    );
}

/// Where the number of a ray may stand: beside it, the middle first.
fn candidates(line: &Line) -> Vec<Place> {
    let (dx, dy) = (line.to[0] - line.from[0], line.to[1] - line.from[1]);
    let length = dx.hypot(dy);
    let mut middles = Vec::new();
    if length < 14.0 {
        let [x, y] = line.to;
        for (a, b) in [
            (9.0, -7.0),
            (9.0, 8.0),
            (-9.0, -7.0),
            (-9.0, 8.0),
            (0.0, -11.0),
            (0.0, 12.0),
        ] {
            middles.push([x + a, y + b]);
        }
        return middles;
    }
    let (across_x, across_y) = (-dy / length, dx / length);
    for away in [9.0, 14.0] {
        for s in [0.5, 0.4, 0.6, 0.3, 0.7, 0.8, 0.2, 0.9] {
            for side in [1.0, -1.0] {
                middles.push([
                    line.from[0] + dx * s + across_x * side * away,
                    line.from[1] + dy * s + across_y * side * away,
                ]);
            }
        }
    }
    middles
}

/// The camera and the lights.
fn marks(svg: &mut Svg, view: &View, scene: &Scene, paths: &[Path], labels: &mut Labels) {
    let within = [
        view.corner[0],
        view.corner[1],
        view.corner[0] + view.size[0],
        view.corner[1] + view.size[1],
    ];
    let around = |[x, y]: Place, half: f64| {
        [
            [x, y - 15.0],
            [x, y + 15.0],
            [x + half + 10.0, y],
            [x - half - 10.0, y],
        ]
    };
    if let Some(camera) = paths.first() {
        let [x, y] = view.place(camera.from);
        let [dx, dy] = view.direction(camera.along);
        let length = dx.hypot(dy).max(1e-9);
        let (dx, dy) = (dx / length * 11.0, dy / length * 11.0);
        svg.polygon(
            &[
                [x, y],
                [x - dx - dy * 0.55, y - dy + dx * 0.55],
                [x - dx + dy * 0.55, y - dy - dx * 0.55],
            ],
            "fill=\"#111\"",
        );
        labels.take([x - 9.0, y - 6.0, x + 3.0, y + 6.0]);
        if let Some([x, y]) = labels.find("camera", around([x, y], 18.0), within) {
            svg.text(
                [x, y + 3.8],
                "camera",
                "class=\"object\" text-anchor=\"middle\"",
            );
        }
    }
    for (index, light) in scene.lights.iter().enumerate() {
        let Some(place) = light_position(light).map(|position| view.place(position)) else {
            continue;
        };
        if !view.holds(place) {
            continue;
        }
        let spokes: Vec<_> = (0..8)
            .map(|i| {
                let (sin, cos) = (f64::from(i) * std::f64::consts::FRAC_PI_4).sin_cos();
                let at = |radius: f64| [place[0] + cos * radius, place[1] + sin * radius];
                [at(4.5), at(8.0)]
            })
            .collect();
        svg.segments(&spokes, "stroke=\"#d08700\" stroke-width=\"1.4\"");
        svg.dot(place, 3.0, "#f5b301");
        let [x, y] = place;
        labels.take([x - 8.0, y - 8.0, x + 8.0, y + 8.0]);
        let name = format!("light {index}");
        if let Some([x, y]) = labels.find(&name, around(place, 20.0), within) {
            svg.text(
                [x, y + 3.8],
                &name,
                "class=\"object\" text-anchor=\"middle\"",
            );
        }
    }
}
