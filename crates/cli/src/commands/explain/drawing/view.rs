//! From space to paper.

use ombra::geometry::{Point3, Vector3};

/// A place on the page, in pixels, y down.
pub(crate) type Place = [f64; 2];

/// The directions of a drawing: both views have the way of the camera ray over the ground to the
/// right.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Directions {
    /// Along the camera ray, level.
    pub(crate) ahead: Vector3<f64>,
    /// To the left of it.
    pub(crate) left: Vector3<f64>,
    pub(crate) up: Vector3<f64>,
}

impl Directions {
    pub(crate) fn of(ray: Vector3<f64>, up: Vector3<f64>) -> Self {
        let up = up.normalized().unwrap_or(Vector3::new(0.0, 1.0, 0.0));
        let level = ray - up * ray.dot(up);
        // A ray straight up or down has no way over the ground: any will do.
        let ahead = if level.length() > 1e-6 * ray.length() {
            level / level.length()
        } else {
            up.orthonormal_basis().0
        };
        Self {
            ahead,
            left: up.cross(ahead),
            up,
        }
    }

    /// Ahead, left and up of the origin.
    pub(crate) fn coordinates(&self, point: Point3<f64>) -> [f64; 3] {
        let v = point.to_vector();
        [v.dot(self.ahead), v.dot(self.left), v.dot(self.up)]
    }
}

/// A rectangle of the page that shows a part of space, seen along one of the directions.
#[derive(Clone, Debug)]
pub(crate) struct View {
    pub(crate) name: &'static str,
    pub(crate) right: Vector3<f64>,
    pub(crate) upward: Vector3<f64>,
    /// Toward the viewer.
    pub(crate) toward: Vector3<f64>,
    /// Whether what the plane of the camera ray cuts is drawn.
    pub(crate) cut: bool,
    /// The upper left corner on the page, and the size.
    pub(crate) corner: Place,
    pub(crate) size: [f64; 2],
    /// What is at the upper left corner, to the right and upward.
    pub(crate) origin: [f64; 2],
    /// Pixels a unit.
    pub(crate) scale: f64,
}

impl View {
    pub(crate) fn place(&self, point: Point3<f64>) -> Place {
        let v = point.to_vector();
        let (x, y) = (v.dot(self.right), v.dot(self.upward));
        [
            self.corner[0] + (x - self.origin[0]) * self.scale,
            self.corner[1] + (self.origin[1] - y) * self.scale,
        ]
    }

    /// A direction on the page, as long as it looks.
    pub(crate) fn direction(&self, v: Vector3<f64>) -> [f64; 2] {
        [v.dot(self.right), -v.dot(self.upward)]
    }

    pub(crate) fn holds(&self, [x, y]: Place) -> bool {
        let [left, top] = self.corner;
        (left..=left + self.size[0]).contains(&x) && (top..=top + self.size[1]).contains(&y)
    }

    /// The part of a segment within the rectangle; Liang, Barsky, "A New Concept and Method for Line
    /// Clipping", ACM Transactions on Graphics 3(1), 1984.
    pub(crate) fn clip(&self, from: Place, to: Place) -> Option<[Place; 2]> {
        let delta = [to[0] - from[0], to[1] - from[1]];
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let (low, high) = (self.corner[axis], self.corner[axis] + self.size[axis]);
            if delta[axis].abs() < 1e-12 {
                if !(low..=high).contains(&from[axis]) {
                    return None;
                }
                continue;
            }
            let (a, b) = (
                (low - from[axis]) / delta[axis],
                (high - from[axis]) / delta[axis],
            );
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        let at = |s: f64| [from[0] + delta[0] * s, from[1] + delta[1] * s];
        (enter <= leave).then(|| [at(enter), at(leave)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> View {
        View {
            name: "test",
            right: Vector3::new(1.0, 0.0, 0.0),
            upward: Vector3::new(0.0, 1.0, 0.0),
            toward: Vector3::new(0.0, 0.0, 1.0),
            cut: false,
            corner: [10.0, 20.0],
            size: [100.0, 50.0],
            origin: [-1.0, 2.0],
            scale: 10.0,
        }
    }

    #[test]
    fn up_in_space_is_up_on_the_page() {
        let view = view();
        assert_eq!(view.place(Point3::new(-1.0, 2.0, 9.0)), [10.0, 20.0]);
        assert_eq!(view.place(Point3::new(0.0, 1.0, 0.0)), [20.0, 30.0]);
    }

    #[test]
    fn segments_are_clipped_to_the_rectangle() {
        let view = view();
        assert_eq!(
            view.clip([-90.0, 30.0], [310.0, 30.0]),
            Some([[10.0, 30.0], [110.0, 30.0]])
        );
        assert_eq!(view.clip([0.0, 0.0], [200.0, 0.0]), None);
        assert_eq!(
            view.clip([50.0, 30.0], [50.0, 30.0]),
            Some([[50.0, 30.0], [50.0, 30.0]])
        );
    }

    #[test]
    fn a_ray_straight_down_has_directions_too() {
        let down = Vector3::new(0.0, -1.0, 0.0);
        let directions = Directions::of(down, -down);
        assert!((directions.ahead.length() - 1.0).abs() < 1e-12);
        assert!(directions.ahead.dot(directions.up).abs() < 1e-12);
    }
}
