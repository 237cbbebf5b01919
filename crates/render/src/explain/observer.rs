//! How ray programs say what they do.

use ombra_accel::Statistics;
use ombra_geometry::{Hit, Ray};
use ombra_pipeline::{Context, Exception, RayProgram, RayType};
use ombra_scene::{Interaction, Rgb};

use super::tree::{Absorbed, End, LightWay, Part, Place, RayKind, Split};

/// Is told what the ray programs of an integrator do while they do it.
///
/// `()` is told nothing and costs nothing: programs are compiled for it as if the calls were not
/// there. So what is explained is the very code that renders.
pub(crate) trait Observer: Sync {
    /// Whether it listens.
    const LISTENS: bool;

    /// Something happened; `event` is only made for one who listens.
    fn tell(&self, event: impl FnOnce() -> Event);
}

impl Observer for () {
    const LISTENS: bool = false;

    #[inline]
    fn tell(&self, _event: impl FnOnce() -> Event) {}
}

/// What ray programs tell.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Event {
    /// A ray is wanted. What follows is about it, until it is done; rays that are wanted in between
    /// are its children.
    Wanted {
        kind: RayKind,
        ray: Ray,
        weight: Rgb,
    },
    /// It met this place first.
    Met(Place),
    /// It met this on the way; without a transmission nothing gets through.
    Crossed { hit: Hit, transmission: Option<Rgb> },
    /// What it cost to find what it met.
    Cost(Statistics),
    /// This adds to its light.
    Adds(Part),
    /// It was asked what arrives of a light. `None` if it was the ray that was done last that asked.
    Light {
        light: usize,
        diffuse: Rgb,
        specular: Rgb,
        way: Option<LightWay>,
    },
    /// All that it brings loses this on the way; told before its children are wanted.
    Absorbs(Absorbed),
    /// The surface is transparent.
    Splits(Split),
    /// Why the tree goes on or ends here; if nobody says, that depends on whether a place was met.
    Ends(End),
    /// It is done, and has brought this.
    Done(Rgb),
}

impl Event {
    /// The ray of a camera is wanted, which counts in full.
    pub(crate) const fn camera(ray: &Ray) -> Self {
        Self::Wanted {
            kind: RayKind::Camera,
            ray: *ray,
            weight: Rgb::WHITE,
        }
    }

    /// A surface is on the way.
    pub(crate) const fn crossed(hit: &Hit, transmission: Option<Rgb>) -> Self {
        Self::Crossed {
            hit: *hit,
            transmission,
        }
    }

    /// A place was met.
    pub(crate) fn met(hit: &Hit, place: &Interaction) -> Self {
        Self::Met(Place {
            hit: *hit,
            point: place.point,
            normal: place.normal,
            shading_normal: place.shading_normal,
            uv: place.uv,
            front: place.is_front(),
        })
    }
}

/// Traces a ray, and counts the steps for one who listens.
#[inline]
pub(crate) fn trace<R, P, O>(
    observer: &O,
    cx: &mut Context<'_, P>,
    ray: &Ray,
    payload: &mut R::Payload,
) -> Result<(), Exception>
where
    R: RayType,
    P: RayProgram<R>,
    O: Observer,
{
    if !O::LISTENS {
        return cx.trace::<R>(ray, payload);
    }
    let mut steps = Statistics::default();
    cx.trace_counted::<R>(ray, payload, Some(&mut steps))?;
    observer.tell(|| Event::Cost(steps));
    Ok(())
}
