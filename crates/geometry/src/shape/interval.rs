//! The part of a line inside a convex solid, cut down one half-space at a time.
//!
//! A line enters a convex solid once and leaves it once. Cutting keeps both ends and which face cut
//! them, so an edge between two faces is never a hole and never two crossings: whichever face wins,
//! there is one end (Kay, Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986, for slabs; Haines,
//! "Fast Ray–Convex Polyhedron Intersection", Graphics Gems II, 1991).

/// The part of a line that is inside, and the faces where it enters and leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub(super) enter: f64,
    pub(super) leave: f64,
    pub(super) enter_face: usize,
    pub(super) leave_face: usize,
}

impl Interval {
    /// The whole line, cut by nothing yet.
    pub(super) const LINE: Self = Self {
        enter: f64::NEG_INFINITY,
        leave: f64::INFINITY,
        enter_face: usize::MAX,
        leave_face: usize::MAX,
    };

    /// Keeps what lies behind a plane: `gap` is how far behind it the line is at 0, `speed` how fast
    /// it approaches. A line in the plane is inside.
    #[inline]
    pub(super) fn cut(&mut self, gap: f64, speed: f64, face: usize) {
        if speed > 0.0 {
            self.end(gap / speed, face);
        } else if speed < 0.0 {
            self.begin(gap / speed, face);
        } else if !(gap >= 0.0) {
            self.clear();
        }
    }

    /// Keeps nothing.
    #[inline]
    pub(super) fn clear(&mut self) {
        (self.enter, self.leave) = (f64::INFINITY, f64::NEG_INFINITY);
    }

    /// Keeps what is not before `at`.
    #[inline]
    pub(super) fn begin(&mut self, at: f64, face: usize) {
        if at > self.enter {
            (self.enter, self.enter_face) = (at, face);
        }
    }

    /// Keeps what is not after `at`.
    #[inline]
    pub(super) fn end(&mut self, at: f64, face: usize) {
        if at < self.leave {
            (self.leave, self.leave_face) = (at, face);
        }
    }

    /// The crossings: none, one where the line only touches, or two.
    #[inline]
    pub(super) fn ends(&self) -> impl Iterator<Item = (f64, usize)> + use<> {
        let enter = (self.enter <= self.leave).then_some((self.enter, self.enter_face));
        let leave = (self.enter < self.leave).then_some((self.leave, self.leave_face));
        enter.into_iter().chain(leave)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_in_a_face_is_inside_and_one_beside_it_is_not() {
        let mut inside = Interval::LINE;
        inside.cut(0.0, 0.0, 0);
        assert_eq!(inside, Interval::LINE);
        let mut outside = Interval::LINE;
        outside.cut(-1.0, 0.0, 0);
        assert_eq!(outside.ends().count(), 0);
    }

    #[test]
    fn a_corner_gives_each_end_once() {
        let mut through = Interval::LINE;
        for face in 0..3 {
            through.cut(0.0, -1.0, face);
            through.cut(2.0, 1.0, 3 + face);
        }
        assert_eq!(through.ends().collect::<Vec<_>>(), [(0.0, 0), (2.0, 3)]);
    }
}
