//! The words of a scene file, as types: what may be written follows from these.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::shapes::ShapeSpec;

/// A scene file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Description {
    #[serde(default)]
    pub(super) picture: PictureSpec,
    pub(super) film: Option<Spanned<FilmSpec>>,
    pub(super) camera: Option<Spanned<CameraSpec>>,
    #[serde(default)]
    pub(super) background: BackgroundSpec,
    #[serde(default)]
    pub(super) cutoff: CutoffSpec,
    #[serde(default)]
    pub(super) ambient: ColourSpec,
    #[serde(default)]
    pub(super) materials: BTreeMap<String, Spanned<MaterialSpec>>,
    #[serde(default)]
    pub(super) lights: Vec<Spanned<LightSpec>>,
    #[serde(default)]
    pub(super) objects: Vec<Spanned<ObjectSpec>>,
}

/// What the scene wants to be rendered like, unless the command says otherwise.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PictureSpec {
    pub(super) size: Option<Spanned<[u32; 2]>>,
    pub(super) spp: Option<Spanned<u32>>,
    pub(super) max_depth: Option<Spanned<u32>>,
    pub(super) least_importance: Option<Spanned<f32>>,
    pub(super) sampler: Option<SamplerSpec>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum SamplerSpec {
    Sobol,
    Independent,
}

/// How the film answers to light.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FilmSpec {
    pub(super) sensitivity: Option<f32>,
    pub(super) fog: Option<f32>,
    pub(super) white: Option<f32>,
    #[serde(default)]
    pub(super) transfer: TransferSpec,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum TransferSpec {
    #[default]
    Srgb,
    Linear,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum CutoffSpec {
    #[default]
    Background,
    Black,
}

/// A colour, or a sky.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(
    untagged,
    expecting = "a background is a colour or { zenith = colour, horizon = colour, up = [x, y, z], \
                 exponent = number }"
)]
pub(super) enum BackgroundSpec {
    Constant(ColourSpec),
    Sky(SkySpec),
}

impl Default for BackgroundSpec {
    fn default() -> Self {
        Self::Constant(ColourSpec::default())
    }
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SkySpec {
    pub(super) zenith: ColourSpec,
    pub(super) horizon: ColourSpec,
    pub(super) up: Option<[f32; 3]>,
    pub(super) exponent: Option<f32>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraSpec {
    pub(super) position: [f32; 3],
    pub(super) look_at: Option<[f32; 3]>,
    pub(super) direction: Option<[f32; 3]>,
    pub(super) up: Option<[f32; 3]>,
    #[serde(default)]
    pub(super) projection: ProjectionSpec,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum ProjectionSpec {
    Perspective(PerspectiveSpec),
    ThinLens(ThinLensSpec),
    Orthographic(OrthographicSpec),
    Panorama(PanoramaSpec),
}

impl Default for ProjectionSpec {
    fn default() -> Self {
        Self::Perspective(PerspectiveSpec {
            fov: 45.0,
            shift: [0.0; 2],
        })
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PerspectiveSpec {
    /// Degrees from the top to the bottom of the picture.
    pub(super) fov: f32,
    #[serde(default)]
    pub(super) shift: [f32; 2],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ThinLensSpec {
    pub(super) fov: f32,
    pub(super) lens_radius: f32,
    pub(super) focus_distance: f32,
    #[serde(default)]
    pub(super) aperture: ApertureSpec,
    #[serde(default)]
    pub(super) shift: [f32; 2],
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum ApertureSpec {
    #[default]
    Disk,
    Square,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OrthographicSpec {
    pub(super) height: f32,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PanoramaSpec {}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialSpec {
    pub(super) diffuse: Option<TextureSpec>,
    #[serde(default)]
    pub(super) specular: ColourSpec,
    pub(super) shininess: Option<f32>,
    #[serde(default)]
    pub(super) reflection: ColourSpec,
    #[serde(default)]
    pub(super) transmission: ColourSpec,
    pub(super) index_of_refraction: Option<f32>,
    #[serde(default)]
    pub(super) fresnel: bool,
    pub(super) internal_reflection: Option<bool>,
    #[serde(default)]
    pub(super) emission: ColourSpec,
}

/// Three numbers, or one for a grey.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(
    untagged,
    expecting = "a colour is one number or three, such as 0.5 or [0.8, 0.2, 0.1]"
)]
pub(super) enum ColourSpec {
    Grey(f32),
    Rgb([f32; 3]),
}

impl Default for ColourSpec {
    fn default() -> Self {
        Self::Grey(0.0)
    }
}

#[derive(Debug, Deserialize)]
#[serde(
    untagged,
    expecting = "a texture is a colour, { checker = [colour, colour], size = length } or \
                 { image = \"file\" }"
)]
pub(super) enum TextureSpec {
    Constant(ColourSpec),
    Checker(CheckerSpec),
    Image(ImageSpec),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CheckerSpec {
    pub(super) checker: [ColourSpec; 2],
    pub(super) size: f32,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ImageSpec {
    pub(super) image: String,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum LightSpec {
    Point(PointLightSpec),
    Directional(DirectionalLightSpec),
    Spot(SpotLightSpec),
    Area(AreaLightSpec),
    Luminous(LuminousLightSpec),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PointLightSpec {
    pub(super) position: [f32; 3],
    pub(super) intensity: ColourSpec,
    #[serde(default)]
    pub(super) falloff: FalloffSpec,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DirectionalLightSpec {
    pub(super) direction: [f32; 3],
    pub(super) intensity: ColourSpec,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SpotLightSpec {
    pub(super) position: [f32; 3],
    pub(super) direction: [f32; 3],
    /// Half the opening angle of the part that is fully lit, degrees.
    pub(super) inner: f32,
    /// Half the opening angle of the whole cone, degrees.
    pub(super) outer: f32,
    pub(super) intensity: ColourSpec,
    #[serde(default)]
    pub(super) falloff: FalloffSpec,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AreaLightSpec {
    pub(super) corner: [f32; 3],
    pub(super) edge_u: [f32; 3],
    pub(super) edge_v: [f32; 3],
    pub(super) intensity: ColourSpec,
    #[serde(default)]
    pub(super) falloff: FalloffSpec,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LuminousLightSpec {
    /// The name of an object.
    pub(super) object: String,
    pub(super) position: [f32; 3],
    pub(super) intensity: ColourSpec,
    #[serde(default)]
    pub(super) falloff: FalloffSpec,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum FalloffSpec {
    #[default]
    None,
    InverseSquare,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectSpec {
    pub(super) name: Option<String>,
    pub(super) shape: Option<ShapeSpec>,
    /// Several shapes of one material, in place of one.
    #[serde(default)]
    pub(super) shapes: Vec<ShapeSpec>,
    pub(super) mesh: Option<MeshSpec>,
    /// A name from `materials`; without one, a model keeps its own and a shape is light grey.
    pub(super) material: Option<String>,
    #[serde(default)]
    pub(super) transform: Vec<TransformSpec>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshSpec {
    pub(super) file: String,
}

/// One step of a placement; steps are taken in the order in which they are written.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum TransformSpec {
    Translate([f64; 3]),
    Scale(ScaleSpec),
    Rotate(RotateSpec),
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged, expecting = "a scale is one number or three, none of them 0")]
pub(super) enum ScaleSpec {
    Uniform(f64),
    Axes([f64; 3]),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RotateSpec {
    pub(super) axis: [f64; 3],
    pub(super) degrees: f64,
}
