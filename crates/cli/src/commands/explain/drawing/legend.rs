//! What the colours mean, and how long a unit is.

use ombra::render::explain::RayKind;

use super::super::path::Path;
use super::rays::colour;
use super::svg::{Stroke, Svg};
use super::{MARGIN, WIDTH};

/// How much of the page it takes.
pub(crate) const HEIGHT: f64 = 66.0;

/// Draws the legend of the kinds of ray that there are, and the scale bar.
pub(crate) fn draw(svg: &mut Svg, top: f64, scale: f64, paths: &[Path], unnamed: usize) {
    let shadow = RayKind::Shadow { light: 0 };
    let kinds = [
        (RayKind::Camera, false, "from the camera"),
        (RayKind::Reflected, false, "reflected"),
        (RayKind::Transmitted, false, "transmitted"),
        (shadow, false, "to a light"),
        (shadow, true, "to a light, blocked"),
        (RayKind::Occlusion, false, "free"),
        (RayKind::Occlusion, true, "occluded"),
    ];
    let mut x = MARGIN;
    for (kind, blocked, name) in kinds {
        let same = |path: &&Path| path.kind.name() == kind.name() && path.blocked == blocked;
        if !paths.iter().any(|path| same(&path)) {
            continue;
        }
        let dashes = match (kind.is_question(), blocked) {
            (true, true) => "2 4",
            (true, false) => "7 3",
            _ => "",
        };
        let stroke = Stroke {
            colour: colour(kind),
            width: 1.8,
            dashes,
            fades: false,
        };
        svg.line([[x, top + 8.0], [x + 30.0, top + 8.0]], &stroke);
        svg.text([x + 36.0, top + 12.0], name, "class=\"small\"");
        x += 36.0 + 6.6 * name.len() as f64 + 18.0;
    }
    let mut note = "Numbers are those of `ombra explain`; the wider a line, the more of its light \
                    arrives; what fades goes on"
        .to_owned();
    if unnamed > 0 {
        note += &format!("; {unnamed} numbers had no room");
    }
    svg.text([MARGIN, top + 36.0], &(note + "."), "class=\"small\"");
    bar(svg, top, scale);
}

/// A bar as long as a round number of units.
fn bar(svg: &mut Svg, top: f64, scale: f64) {
    let length = round(130.0 / scale);
    let pixels = length * scale;
    let (right, y) = (WIDTH - MARGIN, top + 10.0);
    let left = right - pixels;
    let bar = [
        [[left, y], [right, y]],
        [[left, y - 4.0], [left, y + 4.0]],
        [[right, y - 4.0], [right, y + 4.0]],
    ];
    svg.segments(&bar, "stroke=\"#222\" stroke-width=\"1.3\"");
    let unit = if length == 1.0 { "unit" } else { "units" };
    let number = if (1e-3..1e6).contains(&length) {
        format!("{length}")
    } else {
        format!("{length:e}")
    };
    let middle = f64::midpoint(left, right);
    svg.text(
        [middle, y + 18.0],
        &format!("{number} {unit}"),
        "class=\"small\" text-anchor=\"middle\"",
    );
}

/// The largest of 1, 2, 5 times a power of ten that is not above a number.
fn round(most: f64) -> f64 {
    let power = 10_f64.powi(most.log10().floor() as i32);
    let times = [5.0, 2.0, 1.0]
        .into_iter()
        .find(|times| times * power <= most);
    times.unwrap_or(1.0) * power
}

#[cfg(test)]
mod tests {
    use super::round;

    #[test]
    fn scale_bars_are_round() {
        for (most, length) in [(1.3, 1.0), (0.7, 0.5), (49.0, 20.0), (10.0, 10.0)] {
            assert!((round(most) - length).abs() < 1e-12, "{most}");
        }
    }
}
