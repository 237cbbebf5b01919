//! How near a box comes to the camera within the picture.

use ombra_geometry::{Aabb, Point3};

use super::view::{Projected, View};

/// The six faces of a box by the numbers of their corners, going round.
const FACES: [[usize; 4]; 6] = [
    [0, 1, 3, 2],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 3, 7, 6],
    [0, 2, 6, 4],
    [1, 3, 7, 5],
];

/// How many pixels beyond its border count as the picture.
const MARGIN: f64 = 1.0;
/// More than what cutting off rounds, relative to the numbers of the box.
const ROUNDING: f64 = 1e-13;

impl View {
    /// The least depth of a box within what the picture shows, at least 0; `None` if nothing of it is
    /// in the picture.
    ///
    /// What is seen of the box and does not hold the eye has its nearest point on a face. So each face
    /// is cut off at the sides of the view and at the plane of the camera (Sutherland, Hodgman,
    /// "Reentrant Polygon Clipping", 1974), and of what is left the nearest corner counts.
    pub(super) fn nearest(&self, bounds: &Aabb) -> Option<f64> {
        let from_world = self.camera_from_world();
        let corners = bounds.wide().corners().map(|p| from_world.point(p));
        let projected = corners.map(|p| self.project(p));
        if !projected.iter().all(Projected::is_finite) {
            return Some(0.0);
        }
        let eye = from_world.inverse().point(Point3::ORIGIN.wide());
        if bounds.wide().contains(eye) {
            return Some(0.0);
        }
        let [width, height] = self.pixels();
        let size = |p: &Projected| p.x.abs() + p.y.abs() + (width + height) * p.w.abs();
        let largest = |of: &dyn Fn(&Projected) -> f64| projected.iter().map(of).fold(0.0, f64::max);
        let slack = ROUNDING * largest(&size);
        let faces = FACES.map(|face| face.map(|corner| projected[corner]));
        let seen = faces.iter().flat_map(|face| self.cut_off(face, slack));
        let nearest = seen.map(|corner| corner.depth).reduce(f64::min)?;
        let rounding = ROUNDING * largest(&|p| p.depth.abs());
        Some((nearest - rounding).max(0.0))
    }

    /// What is left of a polygon in front of the camera and within the picture, and so little beyond.
    fn cut_off(&self, polygon: &[Projected], slack: f64) -> Vec<Projected> {
        let [width, height] = self.pixels();
        let sides: [&dyn Fn(&Projected) -> f64; 5] = [
            &|p| p.depth,
            &|p| p.x + MARGIN * p.w + slack,
            &|p| (width + MARGIN) * p.w - p.x + slack,
            &|p| p.y + MARGIN * p.w + slack,
            &|p| (height + MARGIN) * p.w - p.y + slack,
        ];
        let mut left = polygon.to_vec();
        for side in sides {
            let whole = std::mem::take(&mut left);
            for (i, a) in whole.iter().enumerate() {
                let b = &whole[(i + 1) % whole.len()];
                let (of_a, of_b) = (side(a), side(b));
                if of_a >= 0.0 {
                    left.push(*a);
                }
                if (of_a >= 0.0) != (of_b >= 0.0) {
                    left.push(a.between(b, of_a / (of_a - of_b)));
                }
            }
        }
        left
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Settings;
    use ombra_geometry::{Angle, Vector3};
    use ombra_scene::Camera;
    use ombra_scene::camera::{Orthographic, Perspective, Pose, Projection};

    fn view(projection: Projection) -> View {
        let pose = Pose::look_at(Point3::ORIGIN, Point3::new(0.0, 0.0, -1.0), Vector3::Y).unwrap();
        let settings = Settings {
            width: 100,
            height: 100,
            ..Settings::default()
        };
        View::new(&Camera { pose, projection }, &settings, 100.0).unwrap()
    }

    fn nearest(view: &View, min: [f32; 3], max: [f32; 3]) -> Option<f64> {
        view.nearest(&Aabb::around([Point3::from(min), Point3::from(max)]))
    }

    #[test]
    fn only_what_is_in_the_picture_counts() {
        let right = view(Projection::Perspective(Perspective::new(
            Angle::from_degrees(90.0),
        )));
        let near = |min, max| nearest(&right, min, max);
        let ahead = near([-1.0, -1.0, -5.0], [1.0, 1.0, -3.0]).unwrap();
        assert!((ahead - 3.0).abs() < 1e-9, "{ahead}");
        assert_eq!(near([-1.0, -1.0, 3.0], [1.0, 1.0, 5.0]), None, "behind");
        assert_eq!(
            near([-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]),
            Some(0.0),
            "around"
        );
        assert_eq!(near([20.0, -1.0, -5.0], [30.0, 1.0, 5.0]), None, "beside");
        // A floor from below the eye to far away comes into the picture at its depth below the eye.
        let floor = near([-9.0, -2.0, -50.0], [9.0, -2.0, 50.0]).unwrap();
        assert!((floor - 2.0).abs() < 0.1, "{floor}");
        // Where rounding is more than the way to it, it is near.
        assert_eq!(near([-1e30, -2.0, -1e30], [1e30, -2.0, 1e30]), Some(0.0));
    }

    #[test]
    fn without_perspective_too() {
        let flat = view(Projection::Orthographic(Orthographic { height: 2.0 }));
        let near = |min, max| nearest(&flat, min, max);
        assert_eq!(near([-9.0, -9.0, -5.0], [9.0, 9.0, 5.0]), Some(0.0));
        assert!(near([-1.0, -1.0, -5.0], [1.0, 1.0, -3.0]).is_some());
        assert_eq!(near([1.1, -1.0, -5.0], [2.0, 1.0, -3.0]), None);
    }
}
