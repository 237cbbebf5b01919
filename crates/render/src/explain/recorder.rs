//! The observer that writes a tree down.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use ombra_accel::Statistics;
use ombra_scene::Rgb;

use super::observer::{Event, Observer};
use super::tree::{Crossing, End, LightPart, LightWay, Part, SampleTree, TracedRay};

/// The most rays of one sample: a tree that has more is not kept, so that it takes a gigabyte at
/// most.
pub const MAX_RAYS: usize = 1 << 20;

/// Writes down the rays of one sample.
#[derive(Debug)]
pub(super) struct Recorder {
    /// One thread writes: a launch of a single index runs on one.
    tree: Mutex<Tree>,
    /// Becomes true when there are too many rays.
    full: AtomicBool,
    max_rays: usize,
    camera_weight: Rgb,
}

/// A tree while it grows.
#[derive(Debug, Default)]
struct Tree {
    rays: Vec<TracedRay>,
    /// The rays that are not done yet, the camera ray first.
    open: Vec<usize>,
    /// The ray that was done last.
    last: usize,
}

impl Recorder {
    /// For one of `spp` samples of a pixel.
    pub(super) fn new(spp: u32, max_rays: usize) -> Self {
        Self {
            tree: Mutex::default(),
            full: AtomicBool::new(false),
            max_rays,
            camera_weight: Rgb::grey(1.0 / spp as f32),
        }
    }

    /// Whether there are too many rays. Stops a launch.
    pub(super) const fn full(&self) -> &AtomicBool {
        &self.full
    }

    /// What was written down.
    pub(super) fn finish(self, index: u32) -> SampleTree {
        let tree = self.tree.into_inner();
        let rays = tree.unwrap_or_else(PoisonError::into_inner).rays;
        let radiance = rays.first().map_or(Rgb::BLACK, |camera| camera.radiance);
        SampleTree {
            index,
            radiance,
            rays,
        }
    }
}

impl Observer for &Recorder {
    const LISTENS: bool = true;

    fn tell(&self, event: impl FnOnce() -> Event) {
        if self.full.load(Ordering::Relaxed) {
            return;
        }
        let mut tree = self.tree.lock().unwrap_or_else(PoisonError::into_inner);
        if tree.rays.len() >= self.max_rays {
            self.full.store(true, Ordering::Relaxed);
            return;
        }
        tree.write(event(), self.camera_weight);
    }
}

impl Tree {
    fn write(&mut self, event: Event, camera_weight: Rgb) {
        if let Event::Wanted { kind, ray, weight } = event {
            let parent = self.open.last().copied();
            let above = parent.map(|parent| &self.rays[parent]);
            let deeper = u32::from(!kind.is_question());
            self.open.push(self.rays.len());
            self.rays.push(TracedRay {
                parent,
                kind,
                step: above.map_or(0, |above| above.step + deeper),
                ray,
                weight,
                weight_in_pixel: above.map_or(camera_weight, |above| {
                    let left = above.absorbed.map_or(Rgb::WHITE, |absorbed| absorbed.left);
                    above.weight_in_pixel * left
                }) * weight,
                met: None,
                crossed: Vec::new(),
                parts: Vec::new(),
                absorbed: None,
                split: None,
                end: End::Background,
                radiance: Rgb::BLACK,
                cost: Statistics::default(),
            });
            return;
        }
        // Programs tell nothing before they want a ray.
        let Some(&index) = self.open.last() else {
            return;
        };
        let last = self.last;
        let ray = &mut self.rays[index];
        match event {
            Event::Wanted { .. } => {}
            Event::Met(place) => {
                ray.met = Some(place);
                ray.end = End::Surface;
            }
            Event::Crossed { hit, transmission } => {
                ray.crossed.push(Crossing { hit, transmission });
            }
            Event::Cost(steps) => ray.cost += steps,
            Event::Adds(part) => ray.parts.push(part),
            Event::Light {
                light,
                diffuse,
                specular,
                way,
            } => ray.parts.push(Part::Light(LightPart {
                light,
                diffuse,
                specular,
                way: way.unwrap_or(LightWay::Ray(last)),
            })),
            Event::Absorbs(absorbed) => ray.absorbed = Some(absorbed),
            Event::Splits(split) => ray.split = Some(split),
            Event::Ends(end) => ray.end = end,
            Event::Done(radiance) => {
                ray.radiance = radiance;
                self.done(index);
            }
        }
    }

    fn done(&mut self, index: usize) {
        // Structures show surfaces in an order of their own.
        self.rays[index].crossed.sort_by(|a, b| {
            let ids = |crossing: &Crossing| {
                let hit = crossing.hit;
                (hit.instance.index(), hit.primitive.index())
            };
            let near = a.hit.t.total_cmp(&b.hit.t);
            near.then_with(|| ids(a).cmp(&ids(b)))
        });
        self.open.pop();
        self.last = index;
    }
}
