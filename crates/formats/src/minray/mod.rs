//! The files of Heckbert's minimal ray tracing contest of 1987 (Graphics Gems IV, 1994, "A Minimal
//! Ray Tracer"): its scenes, which are C headers named `ray.h`, and its pictures.

mod contest;
mod picture;
mod scene;
mod words;

pub use contest::{Contest, ContestSphere, parse_contest, read_contest};
pub use picture::{ContestPicture, read_contest_picture, read_contest_picture_bytes};
