//! Shapes made at random, each with what it is by an implicit function written down a second time.

use ombra_geometry::shape::*;
use ombra_geometry::{Angle, Point3, Vector3};

use crate::random::Random;

type Field = Box<dyn Fn(Point3<f64>) -> f64>;

/// A shape and an independent description of it: the surface is where `carrier` is 0 and `domain` is
/// not above 0. Both are distances near the surface; the carrier grows along the normal.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) shape: Shape,
    pub(crate) carrier: Field,
    pub(crate) domain: Field,
    pub(crate) closed: bool,
    /// Points where surfaces meet or end: corners, rims, tips.
    pub(crate) special: Vec<Point3<f64>>,
}

fn everywhere() -> Field {
    Box::new(|_| -1.0)
}

fn case(
    name: &'static str,
    shape: impl Into<Shape>,
    carrier: Field,
    domain: Option<Field>,
) -> Case {
    Case {
        name,
        shape: shape.into(),
        carrier,
        closed: domain.is_none(),
        domain: domain.unwrap_or_else(everywhere),
        special: Vec::new(),
    }
}

/// One of each kind.
pub(crate) fn cases(seed: u64) -> Vec<Case> {
    let random = &mut Random(seed);
    let size = random.magnitude(-3.0, 3.0);
    let reach = size * random.magnitude(-1.0, 2.0);
    let mut cases = vec![
        sphere(random, size, reach),
        plane(random, reach),
        disk(random, size, reach),
        triangle(random, size, reach),
        rectangle(random, size, reach),
        cuboid(random, size, reach),
        oriented_box(random, size, reach),
        frustum(random, size, reach),
        polyhedron(random, size, reach),
        torus(random, size, reach),
    ];
    for ends in [Ends::Capped, Ends::Open] {
        cases.push(cylinder(random, size, reach, ends));
        cases.push(cone(random, size, reach, ends));
        cases.push(truncated_cone(random, size, reach, ends));
    }
    cases
}

fn sphere(random: &mut Random, size: f64, reach: f64) -> Case {
    let (centre, radius) = (random.point(reach), size as f32);
    let (c, r) = (centre.wide(), f64::from(radius));
    let field = Box::new(move |p: Point3<f64>| (p - c).length() - r);
    case("sphere", Sphere::new(centre, radius), field, None)
}

fn over(point: Point3, normal: Vector3<f64>) -> Field {
    let (point, normal) = (point.wide(), normal.normalized().unwrap());
    Box::new(move |p| (p - point).dot(normal))
}

fn plane(random: &mut Random, reach: f64) -> Case {
    let (point, normal) = (random.point(reach), random.normal());
    let field = over(point, normal.to_vector().wide());
    let shape = Plane::new(point, normal).unwrap();
    case("plane", shape, field, Some(everywhere()))
}

fn disk(random: &mut Random, size: f64, reach: f64) -> Case {
    let (centre, normal, radius) = (random.point(reach), random.normal(), size as f32);
    let n = normal.to_vector().wide();
    let c = centre.wide();
    let out = Box::new(move |p: Point3<f64>| {
        (p - c).cross(n.normalized().unwrap()).length() - f64::from(radius)
    });
    let shape = Disk::new(centre, normal, radius).unwrap();
    let mut disk = case("disk", shape, over(centre, n), Some(out));
    disk.special = rim(c, n, f64::from(radius));
    disk
}

/// Eight points around an axis.
fn rim(centre: Point3<f64>, axis: Vector3<f64>, radius: f64) -> Vec<Point3<f64>> {
    let (x, y) = axis.normalized().unwrap().orthonormal_basis();
    (0..8)
        .map(|i| (f64::from(i) * std::f64::consts::FRAC_PI_4).sin_cos())
        .map(|(sin, cos)| centre + (x * cos + y * sin) * radius)
        .collect()
}

/// A flat convex polygon, counter-clockwise.
fn polygon(name: &'static str, shape: impl Into<Shape>, corners: Vec<Point3>) -> Case {
    let points: Vec<_> = corners.iter().map(|corner| corner.wide()).collect();
    let normal = (points[1] - points[0]).cross(points[2] - points[0]);
    let special = points.clone();
    let out = Box::new(move |p: Point3<f64>| {
        let sides = points.iter().zip(points.iter().cycle().skip(1));
        sides
            .map(|(&a, &b)| (p - a).dot((b - a).cross(normal).normalized().unwrap()))
            .fold(f64::NEG_INFINITY, f64::max)
    });
    let mut flat = case(name, shape, over(corners[0], normal), Some(out));
    flat.special = special;
    flat
}

fn triangle(random: &mut Random, size: f64, reach: f64) -> Case {
    let a = random.point(reach);
    let [b, c] = [(); 2].map(|()| (a.wide() + random.direction() * size).cast());
    polygon("triangle", Triangle::new(a, b, c), vec![a, b, c])
}

fn rectangle(random: &mut Random, size: f64, reach: f64) -> Case {
    // Whole numbers of a power of two, so that corners are exact.
    let unit = 2_f64.powf(size.log2().round()) / 64.0;
    let mut whole = |reach: f64| {
        let v = random.vector(reach / unit);
        Vector3::new(v.x.round() * unit, v.y.round() * unit, v.z.round() * unit).cast::<f32>()
    };
    let (corner, first) = (Point3::ORIGIN + whole(reach.min(1e4 * unit)), whole(size));
    let second = first + whole(size);
    let shape = Rectangle::new(corner, first, second).unwrap();
    let corners = vec![
        corner,
        corner + first,
        corner + first + second,
        corner + second,
    ];
    polygon("rectangle", shape, corners)
}

/// Along three perpendicular axes.
fn box_field(centre: Point3<f64>, axes: [Vector3<f64>; 3], half: [f64; 3]) -> Field {
    Box::new(move |p| {
        let along = |i: usize| (p - centre).dot(axes[i]).abs() - half[i];
        along(0).max(along(1)).max(along(2))
    })
}

fn cuboid(random: &mut Random, size: f64, reach: f64) -> Case {
    let a = random.point(reach);
    let b: Point3 = (a.wide() + random.vector(1.0) * size).cast();
    let (lo, hi) = (a.min(b), a.max(b));
    let (half, centre) = (
        (hi.wide() - lo.wide()) / 2.0,
        lo.wide().lerp(hi.wide(), 0.5),
    );
    let axes = [Vector3::X, Vector3::Y, Vector3::Z].map(Vector3::wide);
    let field = box_field(centre, axes, half.to_array());
    let mut solid = case("cuboid", Cuboid::new(a, b).unwrap(), field, None);
    solid.special = vec![
        a.wide(),
        b.wide(),
        centre - half,
        centre + axes[0] * half.x + axes[1] * half.y,
    ];
    solid
}

fn oriented_box(random: &mut Random, size: f64, reach: f64) -> Case {
    let (centre, x, y) = (
        random.point(reach),
        random.axis(),
        random.direction().cast(),
    );
    let mut length = || (size * random.between(0.1, 1.0)) as f32;
    let lengths = Vector3::new(length(), length(), length());
    let shape = OrientedBox::new(centre, x, y, lengths).unwrap();
    let z = x.wide().cross(y.wide()).normalized().unwrap();
    let x = x.wide().normalized().unwrap();
    let y = z.cross(x);
    let half = lengths.wide() / 2.0;
    let field = box_field(centre.wide(), [x, y, z], half.to_array());
    let mut solid = case("oriented box", shape, field, None);
    let corner = centre.wide() + x * half.x + y * half.y;
    solid.special = vec![corner, corner + z * half.z];
    solid
}

fn frustum(random: &mut Random, size: f64, reach: f64) -> Case {
    let view = FrustumView {
        eye: random.point(reach),
        direction: random.axis(),
        up: random.direction().cast(),
        vertical_fov: Angle::from_degrees(random.between(10.0, 120.0) as f32),
        aspect: random.magnitude(-0.5, 0.5) as f32,
        near: (size * random.between(0.01, 0.5)) as f32,
        far: size as f32,
    };
    let ahead = view.direction.wide().normalized().unwrap();
    let right = ahead.cross(view.up.wide()).normalized().unwrap();
    let up = right.cross(ahead);
    let slope = (f64::from(view.vertical_fov.radians()) / 2.0).tan();
    let wide = slope * f64::from(view.aspect);
    let eye = view.eye.wide();
    let field = Box::new(move |p: Point3<f64>| {
        let v = p - eye;
        let depth = v.dot(ahead);
        let side = (v.dot(right).abs() - depth * wide) / wide.hypot(1.0);
        let lid = (v.dot(up).abs() - depth * slope) / slope.hypot(1.0);
        let ends = (depth - f64::from(view.far)).max(f64::from(view.near) - depth);
        side.max(lid).max(ends)
    });
    let mut solid = case("frustum", Frustum::new(&view).unwrap(), field, None);
    let corner = (ahead + right * wide + up * slope) * f64::from(view.far);
    solid.special = vec![eye + corner, eye + ahead * f64::from(view.near)];
    solid
}

fn polyhedron(random: &mut Random, size: f64, reach: f64) -> Case {
    let centre = random.point(reach);
    // A cube, so that it closes, with its corners and edges cut off.
    let axes = [Vector3::X, Vector3::Y, Vector3::Z].map(Vector3::wide);
    let cube = axes.into_iter().flat_map(|axis| [axis, -axis]);
    let cuts: Vec<_> = (0..12).map(|_| random.direction()).collect();
    let half_spaces: Vec<_> = cube
        .chain(cuts)
        .map(|out| HalfSpace {
            point: (centre.wide() + out * (size * random.between(0.7, 1.3))).cast(),
            normal: out.to_normal().cast(),
        })
        .collect();
    let shape = ConvexPolyhedron::from_half_spaces(&half_spaces).unwrap();
    let special = shape.face_corners().flatten().collect();
    let sides: Vec<_> = half_spaces
        .iter()
        .map(|side| over(side.point, side.normal.to_vector().wide()))
        .collect();
    let field = Box::new(move |p| {
        sides
            .iter()
            .map(|side| side(p))
            .fold(f64::NEG_INFINITY, f64::max)
    });
    let mut solid = case("polyhedron", shape, field, None);
    solid.special = special;
    solid
}

fn torus(random: &mut Random, size: f64, reach: f64) -> Case {
    let (centre, axis, major) = (random.point(reach), random.normal(), size as f32);
    let minor = major * random.magnitude(-3.0, -0.01) as f32;
    let shape = Torus::new(centre, axis, major, minor).unwrap();
    let (c, n) = (centre.wide(), axis.to_vector().wide().normalized().unwrap());
    let (big, small) = (f64::from(major), f64::from(minor));
    let field = Box::new(move |p: Point3<f64>| {
        let (up, out) = ((p - c).dot(n), (p - c).cross(n).length());
        (out - big).hypot(up) - small
    });
    let mut ring = case("torus", shape, field, None);
    ring.special = rim(c, n, big - small);
    ring.special.extend(rim(c + n * small, n, big));
    ring
}

fn cylinder(random: &mut Random, size: f64, reach: f64, ends: Ends) -> Case {
    let from = random.point(reach);
    let to: Point3 =
        (from.wide() + random.direction() * (size * random.magnitude(-1.0, 1.0))).cast();
    let radius = (size * random.magnitude(-1.0, 0.0)) as f32;
    let shape = Cylinder::new(from, to, radius, ends).unwrap();
    let name = match ends {
        Ends::Capped => "capped cylinder",
        Ends::Open => "open cylinder",
    };
    revolved(name, shape, [from, to], [radius; 2], ends)
}

fn cone(random: &mut Random, size: f64, reach: f64, ends: Ends) -> Case {
    let base = random.point(reach);
    let apex: Point3 =
        (base.wide() + random.direction() * (size * random.magnitude(-1.0, 1.0))).cast();
    let radius = (size * random.magnitude(-1.0, 0.0)) as f32;
    let shape = Cone::new(base, apex, radius, ends).unwrap();
    let name = match ends {
        Ends::Capped => "capped cone",
        Ends::Open => "open cone",
    };
    revolved(name, shape, [base, apex], [radius, 0.0], ends)
}

fn truncated_cone(random: &mut Random, size: f64, reach: f64, ends: Ends) -> Case {
    let base = random.point(reach);
    let top: Point3 = (base.wide() + random.direction() * size).cast();
    let radii = [(); 2].map(|()| (size * random.magnitude(-1.0, 0.0)) as f32);
    let shape = Cone::truncated(base, top, radii, ends).unwrap();
    let name = match ends {
        Ends::Capped => "capped truncated cone",
        Ends::Open => "open truncated cone",
    };
    revolved(name, shape, [base, top], radii, ends)
}

fn revolved(
    name: &'static str,
    shape: impl Into<Shape>,
    axis: [Point3; 2],
    radii: [f32; 2],
    ends: Ends,
) -> Case {
    let [base, top] = axis.map(Point3::wide);
    let [base_radius, top_radius] = radii.map(f64::from);
    let height = (top - base).length();
    let up = (top - base) / height;
    let slope = (top_radius - base_radius) / height;
    let side = move |p: Point3<f64>| {
        let (along, out) = ((p - base).dot(up), (p - base).cross(up).length());
        (out - base_radius - slope * along) / slope.hypot(1.0)
    };
    let beyond = move |p: Point3<f64>| (p - top).dot(up).max((base - p).dot(up));
    let mut special = rim(base, up, base_radius);
    special.extend(rim(top, up, top_radius));
    special.extend([base, top]);
    let field: Field = match ends {
        Ends::Capped => Box::new(move |p| side(p).max(beyond(p))),
        Ends::Open => Box::new(side),
    };
    let domain: Option<Field> = match ends {
        Ends::Capped => None,
        Ends::Open => Some(Box::new(beyond)),
    };
    let mut solid = case(name, shape, field, domain);
    solid.special = special;
    solid
}
