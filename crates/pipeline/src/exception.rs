//! What can go wrong in a program, and where.

use std::borrow::Cow;

use ombra_geometry::Ray;

/// Something exceptional in a program.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Exception {
    /// A ray that cannot hit anything was traced: see [`Ray::is_valid`].
    #[error("invalid {ray_type} ray: {ray:?}")]
    InvalidRay {
        /// The ray type's name.
        ray_type: &'static str,
        /// The ray.
        ray: Ray,
    },
    /// Traces were nested deeper than the pipeline allows.
    #[error("traces were nested deeper than {limit}")]
    DepthExceeded {
        /// How deep the pipeline allows.
        limit: u32,
    },
    /// Traces were nested deeper than the stack of a thread allows, although not deeper than the
    /// pipeline does. At what depth depends on what the compiler made of the programs, not on the
    /// number of threads.
    #[error("the stack is used up by traces nested {depth} deep")]
    StackOverflow {
        /// How deep traces were nested.
        depth: u32,
    },
    /// A buffer has no such element.
    #[error("index {index} is out of range: the buffer has {length} elements")]
    IndexOutOfRange {
        /// The index that was asked for.
        index: usize,
        /// How many elements there are.
        length: usize,
    },
    /// The launch was stopped from outside while this launch index traced its rays. From then on it
    /// is refused every trace, so programs must pass this on and settle other exceptions only; the
    /// exception program is not asked. The launch takes the index as one that was not run: a
    /// program whose output shall be whole writes its element when it has traced its last ray.
    #[error("stopped from outside")]
    Stopped,
    /// The program's own.
    #[error("exception {code}: {message}")]
    User {
        /// A number of the program's choice.
        code: u32,
        /// What happened.
        message: Cow<'static, str>,
    },
}

impl Exception {
    /// One of the program's own.
    #[must_use]
    pub fn user(code: u32, message: impl Into<Cow<'static, str>>) -> Self {
        Self::User {
            code,
            message: message.into(),
        }
    }
}

/// An exception and the launch index where it happened.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("at launch index ({}, {}, {}): {exception}", .index[0], .index[1], .index[2])]
pub struct LaunchException {
    /// The launch index.
    pub index: [u32; 3],
    /// What happened.
    #[source]
    pub exception: Exception,
}

/// Why a launch did not end well.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LaunchError {
    /// A program raised an exception that the exception program did not settle: of all these, the
    /// one with the smallest launch index, whatever the number of threads.
    #[error(transparent)]
    Exception(#[from] LaunchException),
    /// The output buffer does not have one element for each launch index.
    #[error("a launch of {launch} indices needs a buffer of as many elements, not {buffer}")]
    BufferSize {
        /// How many launch indices there are: a product of three 32-bit numbers.
        launch: u128,
        /// How many elements there are.
        buffer: usize,
    },
}
