//! What does not make a shape.

/// Why some parameters make no shape.
///
/// Parameters are called what the constructor calls them, spaces instead of underscores.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A number is NaN or infinite.
    #[error("the {parameter} is not finite")]
    NotFinite {
        /// Which parameter.
        parameter: &'static str,
    },
    /// A length is 0 or less.
    #[error("the {parameter} is {value}; it must be above 0")]
    NotPositive {
        /// Which parameter.
        parameter: &'static str,
        /// What it is.
        value: f32,
    },
    /// A length is negative, where 0 would do.
    #[error("the {parameter} is {value}; it must not be below 0")]
    Negative {
        /// Which parameter.
        parameter: &'static str,
        /// What it is.
        value: f32,
    },
    /// Something that must be the smaller one is not.
    #[error("the {parameter} is {value}; it must be below the {other}, which is {limit}")]
    NotBelow {
        /// Which parameter.
        parameter: &'static str,
        /// What it is.
        value: f32,
        /// What it must be below.
        other: &'static str,
        /// What that is.
        limit: f32,
    },
    /// A direction is (0, 0, 0), or two points that give one are the same.
    #[error("the {parameter} has no direction: its length is 0")]
    NoDirection {
        /// Which parameter.
        parameter: &'static str,
    },
    /// Two directions that must differ are parallel, or the corners of a triangle lie on a line.
    #[error("the {parameter} are parallel")]
    Parallel {
        /// Which parameters.
        parameter: &'static str,
    },
    /// A field of view is not between 0 and 180 degrees.
    #[error("the {parameter} is {degrees}°; it must be above 0° and below 180°")]
    AngleOutOfRange {
        /// Which parameter.
        parameter: &'static str,
        /// What it is, in degrees.
        degrees: f32,
    },
    /// A solid without volume: a box or polyhedron with no thickness, or half-spaces that have no
    /// point in common.
    #[error("the solid has no volume")]
    NoVolume,
    /// Half-spaces that do not close: what they have in common reaches to infinity.
    #[error("the half-spaces do not bound a solid: it is endless")]
    Unbounded,
    /// A face names a corner that is not there.
    #[error("face {face} uses corner {index}, but there are {corners}")]
    IndexOutOfRange {
        /// Which face, from 0.
        face: usize,
        /// The index it names.
        index: u32,
        /// How many corners there are.
        corners: usize,
    },
    /// A face has fewer than three corners, or all of them on a line.
    #[error("face {face} has no area")]
    FaceWithoutArea {
        /// Which face, from 0.
        face: usize,
    },
    /// A corner lies in front of a face: the solid is not convex, the face is not flat, or its
    /// corners run clockwise seen from outside.
    #[error(
        "corner {corner} lies outside face {face}: the solid is not convex there, or the face \
             runs clockwise seen from outside"
    )]
    NotConvex {
        /// Which face, from 0.
        face: usize,
        /// Which corner, from 0.
        corner: usize,
    },
}

/// Refuses a parameter that is not finite.
pub(super) fn finite(parameter: &'static str, finite: bool) -> Result<(), ShapeError> {
    if finite {
        Ok(())
    } else {
        Err(ShapeError::NotFinite { parameter })
    }
}

/// A length above 0, in double precision.
pub(super) fn positive(parameter: &'static str, value: f32) -> Result<f64, ShapeError> {
    finite(parameter, value.is_finite())?;
    if value > 0.0 {
        Ok(f64::from(value))
    } else {
        Err(ShapeError::NotPositive { parameter, value })
    }
}

/// The unit vector along a direction.
pub(super) fn direction(
    parameter: &'static str,
    vector: crate::Vector3<f64>,
) -> Result<crate::Vector3<f64>, ShapeError> {
    finite(parameter, vector.is_finite())?;
    vector
        .normalized()
        .ok_or(ShapeError::NoDirection { parameter })
}
