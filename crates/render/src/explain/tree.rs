//! The tree of rays, as data.

use ombra_accel::Statistics;
use ombra_geometry::{Hit, Normal3, Point3, Ray};
use ombra_scene::Rgb;

/// All rays of a pixel: a tree for each sample.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelTree {
    /// Which pixel of the picture: column and row, from the upper left corner.
    pub pixel: [u32; 2],
    /// What the pixel shows: the mean over `samples`. Where these are all samples of the pixel it is
    /// what [`render`](crate::render()) gives, to the last bit.
    pub colour: Rgb,
    /// Samples in the order of their indices.
    pub samples: Vec<SampleTree>,
}

/// The rays of one sample.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleTree {
    /// Which sample of the pixel, from 0.
    pub index: u32,
    /// What its camera ray brought: what the sample adds to the pixel.
    pub radiance: Rgb,
    /// The rays in the order in which they were sent: each after its parent and after all that came
    /// of its elder siblings. The camera ray is the first.
    pub rays: Vec<TracedRay>,
}

/// One ray and what became of it.
#[derive(Clone, Debug, PartialEq)]
pub struct TracedRay {
    /// The ray that sent it, as an index into [`SampleTree::rays`]; none sent the camera ray.
    pub parent: Option<usize>,
    /// What it asks for.
    pub kind: RayKind,
    /// How often light is reflected or transmitted on the way from here to the camera: the lecture's
    /// `step`. A shadow ray has that of the ray that sent it.
    pub step: u32,
    /// The ray.
    pub ray: Ray,
    /// The share with which `radiance` counts in that of its parent, per colour.
    pub weight: Rgb,
    /// The same for the pixel: the product of the weights from the camera ray to here and of what is
    /// left on the ways between, over the number of samples.
    pub weight_in_pixel: Rgb,
    /// What it met first. None for a ray that was not sent, that met nothing, or that only asks what
    /// is in the way, see `crossed`.
    pub met: Option<Place>,
    /// What a shadow ray met on its way to the light, near to far: at most one surface is opaque.
    /// Where one is, a structure shows whichever it finds first.
    pub crossed: Vec<Crossing>,
    /// What it is made of besides the light of reflected and transmitted rays, in the order in which
    /// it is added.
    pub parts: Vec<Part>,
    /// What the way here takes of all of that, if it leads through something that absorbs light.
    pub absorbed: Option<Absorbed>,
    /// How a transparent surface divides the light.
    pub split: Option<Split>,
    /// Why the tree goes on or ends here.
    pub end: End,
    /// What it brought: light, or what an integrator measures; of a shadow ray, how much of the light
    /// gets through.
    pub radiance: Rgb,
    /// What it cost to find what it met.
    pub cost: Statistics,
}

/// What a ray asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RayKind {
    /// What the camera sees.
    Camera,
    /// What is seen in the mirror.
    Reflected,
    /// What is seen through the surface.
    Transmitted,
    /// How much of a light arrives.
    Shadow {
        /// Which light of the scene, from 0.
        light: usize,
    },
    /// Whether something is nearby.
    Occlusion,
}

impl RayKind {
    /// What people call it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Camera => "camera",
            Self::Reflected => "reflected",
            Self::Transmitted => "transmitted",
            Self::Shadow { .. } => "shadow",
            Self::Occlusion => "occlusion",
        }
    }

    /// Whether it only asks what is in the way.
    #[must_use]
    pub const fn is_question(self) -> bool {
        matches!(self, Self::Shadow { .. } | Self::Occlusion)
    }
}

/// A place that a ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The numbers and ids.
    pub hit: Hit,
    /// Where, in the space of the world.
    pub point: Point3,
    /// The true unit normal.
    pub normal: Normal3,
    /// The unit normal to shade with.
    pub shading_normal: Normal3,
    /// Surface parameters.
    pub uv: [f32; 2],
    /// Whether the ray came from the outside.
    pub front: bool,
}

/// A surface on the way to a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The numbers and ids.
    pub hit: Hit,
    /// How much it lets through; none if it is opaque.
    pub transmission: Option<Rgb>,
}

/// What a surface shows of its own, without a look into the mirror or through it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Part {
    /// Light of its own.
    Emission(Rgb),
    /// What it scatters of the light from everywhere.
    Ambient(Rgb),
    /// What it scatters of a light.
    Light(LightPart),
    /// What an integrator that does not ask for light has measured.
    Measured(Rgb),
}

/// What a surface scatters of one light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightPart {
    /// Which light of the scene, from 0.
    pub light: usize,
    /// What would be scattered evenly if nothing were in the way.
    pub diffuse: Rgb,
    /// What the highlight would be if nothing were in the way.
    pub specular: Rgb,
    /// The way to the light.
    pub way: LightWay,
}

/// Whether a light was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightWay {
    /// By this ray, as an index into [`SampleTree::rays`]. It counts with its weight.
    Ray(usize),
    /// No: the light does not shine there.
    OutOfReach,
    /// No: the light is behind the surface.
    Behind,
    /// No: the surface would scatter nothing of it toward the viewer.
    NothingScattered,
    /// No: too little of it would arrive at the pixel.
    Unimportant,
}

/// What light loses on the way behind a surface: Beer's law, see
/// [`Material::left_after`](ombra_scene::Material::left_after).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Absorbed {
    /// The length of the way, in units of the scene.
    pub way: f32,
    /// The share that is left at its end, per colour, 0 to 1.
    pub left: Rgb,
}

/// How a transparent surface divides what arrives at it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// The index of refraction on the side of the viewer over that on the other one.
    pub eta: f32,
    /// The share of the transparent part that is mirrored, 0 to 1.
    pub mirrored: f32,
    /// Whether nothing can go through: total internal reflection.
    pub total: bool,
}

/// Why the tree goes on or ends at a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum End {
    /// It met a surface, whose colour its parts and children make.
    Surface,
    /// It met a light source, which shows its own light and nothing else.
    LightSource,
    /// It met nothing and sees the background.
    Background,
    /// It was not sent, because light had bounced as often as is allowed.
    MaxDepth,
    /// It was not sent, because too little of its light would arrive at the pixel.
    Unimportant,
    /// A shadow ray: something opaque is in the way.
    Blocked,
    /// A shadow ray: nothing opaque is in the way.
    Free,
}

impl End {
    /// What people call it, as one word or two.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Surface => "surface",
            Self::LightSource => "light source",
            Self::Background => "background",
            Self::MaxDepth => "maximum depth",
            Self::Unimportant => "unimportant",
            Self::Blocked => "blocked",
            Self::Free => "free",
        }
    }
}

impl SampleTree {
    /// The rays that a ray sent, in order.
    pub fn children(&self, ray: usize) -> impl Iterator<Item = usize> {
        let all = self.rays.iter().enumerate().skip(ray + 1);
        all.filter(move |(_, child)| child.parent == Some(ray))
            .map(|(index, _)| index)
    }
}
