//! What is measured along camera rays: one integrator a file, each a set of ray programs.

mod ao;
mod cost;
mod depth;
mod kind;
mod normals;
mod whitted;

use ombra_pipeline::RayType;
use ombra_scene::Rgb;

pub(crate) use ao::AmbientOcclusion;
pub(crate) use cost::Cost;
pub(crate) use depth::Depth;
pub use kind::IntegratorKind;
pub(crate) use normals::Normals;
pub(crate) use whitted::Whitted;

/// The rays of integrators that only ask what the camera sees; the payload is what a pixel gets.
pub(crate) enum View {}

impl RayType for View {
    type Payload = Rgb;
    const NAME: &'static str = "view";
}
