//! What is measured along camera rays: one integrator a file, each a set of ray programs.

mod ao;
mod cost;
mod depth;
mod kind;
mod normals;
mod whitted;

use ombra_geometry::Ray;
use ombra_pipeline::{Context, Exception, RayProgram, RayType};
use ombra_scene::Rgb;

use crate::explain::{self, Event, Observer, Part};

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

/// Traces a camera ray that measures.
#[inline]
fn view<P: RayProgram<View>, O: Observer>(
    observer: &O,
    cx: &mut Context<'_, P>,
    ray: &Ray,
    measured: &mut Rgb,
) -> Result<(), Exception> {
    observer.tell(|| Event::camera(ray));
    explain::trace::<View, P, O>(observer, cx, ray, measured)?;
    observer.tell(|| Event::Adds(Part::Measured(*measured)));
    observer.tell(|| Event::Done(*measured));
    Ok(())
}
