//! What a surface does with light, whoever brings it: rays and the rasterizer shade alike.

mod phong;
mod side;

pub(crate) use phong::{scattered, terms};
pub(crate) use side::Side;
