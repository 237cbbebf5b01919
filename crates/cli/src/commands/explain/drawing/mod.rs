//! The rays of a pixel as a drawing, in plan and in section, to scale.

mod labels;
mod legend;
mod objects;
mod outline;
mod rays;
mod svg;
mod view;

use ombra::geometry::{Aabb, Point3, Vector3};
use ombra::scene::{Light, Scene};

use super::Kept;
use super::document::Heading;
use super::path::{Path, paths};
use super::solid::Solids;
use labels::Labels;
use svg::Svg;
use view::{Directions, View};

/// The width of the page, and the margin around what is drawn, in pixels.
const WIDTH: f64 = 1000.0;
const MARGIN: f64 = 24.0;
/// The height of the title.
const TITLE: f64 = 54.0;
/// Above each view is its name.
const NAME: f64 = 24.0;
/// How high a view is at least and at most.
const HEIGHT: [f64; 2] = [120.0, 560.0];

/// What is drawn.
pub(crate) struct Drawing<'a> {
    pub(crate) heading: &'a Heading,
    pub(crate) scene: &'a Scene,
    pub(crate) kept: &'a Kept,
}

impl Drawing<'_> {
    /// The drawing as SVG.
    pub(crate) fn svg(&self) -> String {
        let (paths, left_out) = paths(&self.kept.samples);
        let ray = paths
            .first()
            .map_or(Vector3::new(0.0, 0.0, -1.0), |path| path.along);
        let directions = Directions::of(ray, self.scene.up.wide());
        let [plan, section] = self.views(&paths, directions);
        let legend_top = section.corner[1] + section.size[1] + 18.0;

        let mut svg = Svg::new(WIDTH, legend_top + legend::HEIGHT);
        self.title(&mut svg, paths.len(), left_out);
        let eye = paths
            .first()
            .map_or(Point3::new(0.0, 0.0, 0.0), |path| path.from);
        let mut unnamed = 0;
        for view in [&plan, &section] {
            let mut labels = Labels::default();
            svg.begin_view(view);
            let solids = Solids {
                scene: self.scene,
                tolerance: 0.2 / view.scale,
                reach: reach(&paths, self.scene, view.size[0] / view.scale),
            };
            objects::draw(&mut svg, view, &solids, &paths, eye, &mut labels);
            unnamed += rays::draw(&mut svg, view, self.scene, &paths, &mut labels);
            svg.end_view(view);
        }
        legend::draw(&mut svg, legend_top, section.scale, &paths, unnamed);
        svg.finish()
    }

    fn title(&self, svg: &mut Svg, drawn: usize, left_out: usize) {
        let Heading {
            scene,
            width,
            height,
            pixel: [x, y],
            integrator,
            ..
        } = self.heading;
        let text = format!("{scene}: the rays of pixel {x},{y} of {width}x{height} ({integrator})");
        svg.text([MARGIN, 28.0], &text, "class=\"title\"");
        let all = self.kept.rays + self.kept.left_out.1;
        let mut below = format!("{drawn} of {all} rays drawn");
        let not_sent = self.kept.rays - drawn - left_out;
        if not_sent > 0 {
            let were = if not_sent == 1 { "was" } else { "were" };
            below +=
                &format!("; {not_sent} {were} not sent: too many bounces, or too little light");
        }
        if left_out > 0 {
            below += &format!("; {left_out} that count least are left out");
        }
        if let Some(notice) = self.kept.notice() {
            below += &format!("; so are {notice}");
        }
        svg.text([MARGIN, 46.0], &below, "class=\"small\"");
    }

    /// Plan above section, at one scale and with the same left and right.
    fn views(&self, paths: &[Path], directions: Directions) -> [View; 2] {
        let bounds = self.frame(paths, directions);
        let [ahead, left, up] =
            [0, 1, 2].map(|axis| [bounds.min.to_array()[axis], bounds.max.to_array()[axis]]);
        let extent = |[low, high]: [f64; 2]| (high - low).max(f64::MIN_POSITIVE);
        let width = WIDTH - 2.0 * MARGIN;
        let tallest = extent(left).max(extent(up));
        let scale = (width / extent(ahead)).min(HEIGHT[1] / tallest);
        let view = |name, upward, toward, cut, [low, high]: [f64; 2], top| {
            let height = ((high - low) * scale).max(HEIGHT[0]);
            let middle = f64::midpoint(low, high);
            let centre = f64::midpoint(ahead[0], ahead[1]);
            View {
                name,
                right: directions.ahead,
                upward,
                toward,
                cut,
                corner: [MARGIN, top],
                size: [width, height],
                origin: [centre - width / scale / 2.0, middle + height / scale / 2.0],
                scale,
            }
        };
        let top = TITLE + NAME;
        let plan = view(
            "Plan: seen from above",
            directions.left,
            directions.up,
            false,
            left,
            top,
        );
        let below = top + plan.size[1] + NAME + 8.0;
        let section = view(
            "Section: seen from the side; bold is what the upright plane through the camera ray cuts",
            directions.up,
            -directions.left,
            true,
            up,
            below,
        );
        [plan, section]
    }

    /// What is shown, as ahead, left and up: the ends of rays, what they met if it is not much larger,
    /// and lights if they are not much farther.
    fn frame(&self, paths: &[Path], directions: Directions) -> Aabb<f64> {
        let coordinates = |point| {
            let [x, y, z] = directions.coordinates(point);
            Point3::new(x, y, z)
        };
        let ends = paths
            .iter()
            .flat_map(|path| std::iter::once(path.from).chain(path.to.filter(|_| path.met)));
        let ends = Aabb::around(ends.filter(|end| end.is_finite()).map(coordinates));
        if ends.is_empty() {
            let one = Point3::new(1.0, 1.0, 1.0);
            return Aabb::around([Point3::new(-1.0, -1.0, -1.0), one]);
        }
        let size = ends.extent().length();
        let mut frame = ends;
        for object in self.objects_met() {
            let bounds = object_bounds(self.scene, object);
            let Some(corners) = bounds.map(|bounds| bounds.corners().map(coordinates)) else {
                continue;
            };
            let around = Aabb::around(corners);
            if around.extent().length() <= 2.0 * size {
                frame = frame.union(around);
            }
        }
        for light in &self.scene.lights {
            if let Some(position) = light_position(light) {
                let with = frame.union(Aabb::around([coordinates(position)]));
                if with.extent().length() <= 1.6 * frame.extent().length() {
                    frame = with;
                }
            }
        }
        // A single place has an extent all the same.
        let least = frame.centre().to_vector().max_norm().max(1.0) * 1e-3;
        frame.padded((0.06 * frame.extent().length()).max(least))
    }

    fn objects_met(&self) -> impl Iterator<Item = usize> {
        let rays = self.kept.samples.iter().flat_map(|sample| &sample.rays);
        rays.flat_map(|ray| {
            let met = ray.met.iter().map(|place| place.hit.instance.index());
            met.chain(ray.crossed.iter().map(|one| one.hit.instance.index()))
        })
    }
}

/// Where a light is, unless it is infinitely far away.
pub(super) fn light_position(light: &Light) -> Option<Point3<f64>> {
    match light {
        Light::Point { position, .. }
        | Light::Spot { position, .. }
        | Light::Luminous { position, .. } => Some(position.wide()),
        Light::Area {
            corner,
            edge_u,
            edge_v,
            ..
        } => Some((*corner + *edge_u * 0.5 + *edge_v * 0.5).wide()),
        _ => None,
    }
}

/// The box around an object; none if it has no end.
pub(crate) fn object_bounds(scene: &Scene, index: usize) -> Option<Aabb<f64>> {
    use ombra::accel::Primitives as _;
    let object = &scene.objects[index];
    let geometry = &scene.geometries[object.geometry.index()];
    let primitives = (0..geometry.len() as u32).map(|primitive| geometry.bounds(primitive));
    let local = primitives.fold(Aabb::EMPTY, Aabb::union);
    let world = object.world_from_object.aabb(&local);
    (!world.is_empty() && world.is_finite()).then(|| world.wide())
}

/// As far as endless planes are drawn: over all that is shown.
fn reach(paths: &[Path], scene: &Scene, width: f64) -> Aabb<f64> {
    let ends = paths.iter().flat_map(|path| {
        let end = path.to.filter(|_| path.met);
        std::iter::once(path.from).chain(end)
    });
    let lights = scene.lights.iter().filter_map(light_position);
    let ends = ends.chain(lights.take(1)).filter(|end| end.is_finite());
    Aabb::around(ends).padded(width)
}
