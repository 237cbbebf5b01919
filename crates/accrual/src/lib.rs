//! How long every place lies in shadow: exact in time, and sampled.
//!
//! [`Occluders`] are the polygons of a city, [`Exact`] measures how long they stand before the sun, seen
//! from places, over [sheets](ombra_sun::Sheet) of its way. [`Fast`] measures a long period by
//! some of its days.

mod again;
mod cover;
mod coverage;
mod dark;
mod exact;
mod fast;
mod ground;
mod kernel;
mod occluder;
mod on_faces;
mod sampled;
mod spells;
mod tile;
mod tiles;
mod way;
mod ways;

pub use again::Again;
pub use coverage::{Coverage, Peak, gained, new_shadow, shadow};
pub use dark::Dark;
pub use exact::Exact;
pub use fast::{Difference, Fast};
pub use ground::Ground;
pub use occluder::Occluders;
pub use on_faces::OnFaces;
pub use sampled::{Sampled, Samples};
pub use spells::{Counted, Share, Spells, Stretch, Stretches, Summary};
pub use tiles::Tiles;
