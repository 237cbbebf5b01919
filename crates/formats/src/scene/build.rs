//! From the words of a scene file to a scene.

use std::collections::{BTreeMap, HashMap};
use std::fmt::Display;
use std::path::Path;

use ombra_accel::{Geometry, Mesh, Shapes};
use ombra_geometry::triangle::TriangleTest;
use ombra_geometry::{Angle, GeometryId, InstanceId, Object, Point3, Transform, Vector3, World};
use ombra_scene::camera::{
    Aperture, Orthographic, Panorama, Perspective, Pose, Projection, ThinLens,
};
use ombra_scene::light::Falloff;
use ombra_scene::{Background, Camera, Cutoff, Light, Material, MaterialId, Rgb, Scene, Texture};
use toml::Spanned;

use super::assets::Loader;
use super::description::{
    ApertureSpec, BackgroundSpec, CameraSpec, ColourSpec, CutoffSpec, Description, FalloffSpec,
    LightSpec, MaterialSpec, ObjectSpec, ProjectionSpec, TextureSpec,
};
use super::picture::picture;
use super::placement::placement;
use super::shapes::ShapeSpec;
use super::{Assets, SceneFile, line_of};
use crate::error::{Fault, FormatError};
use crate::finding::Finding;
use crate::gltf;
use crate::limits::Limits;
use crate::mesh::with_normals;

/// A model whose geometries are in the scene, wherever objects place them.
struct LoadedModel {
    parts: Vec<LoadedPart>,
    materials: Vec<Material>,
    /// Where in the scene its own materials begin, once an object needs them.
    first_material: Option<usize>,
}

/// A part of a model: what it is called, its geometry and which of the model's materials it has, and
/// where it stands within the model.
struct LoadedPart {
    name: String,
    geometry: GeometryId,
    material: usize,
    model_from_part: Option<Transform<Object, World>>,
}

/// What everything else is built with.
struct Builder<'a> {
    text: &'a str,
    loader: Loader<'a>,
    test: TriangleTest,
    scene: Scene,
    named: BTreeMap<String, MaterialId>,
    /// Models that are in the scene already, by their names.
    models: HashMap<String, LoadedModel>,
    findings: Vec<Finding>,
}

pub(super) fn build(
    description: Description,
    text: &str,
    assets: &Assets<'_>,
    test: TriangleTest,
    limits: &Limits,
) -> Result<SceneFile, FormatError> {
    let mut builder = Builder {
        text,
        loader: Loader::new(text, assets, limits),
        test,
        scene: Scene::default(),
        named: BTreeMap::new(),
        models: HashMap::new(),
        findings: Vec::new(),
    };
    builder.scene.background = background(description.background)?;
    builder.scene.cutoff = description.cutoff.into();
    builder.scene.t_min = at_least_zero("t_min", description.t_min)?;
    builder.scene.ambient = colour("ambient", description.ambient)?;
    for (name, spec) in description.materials {
        builder.at(&spec, |b, spec| b.material(name, spec))?;
    }
    for (index, spec) in description.objects.iter().enumerate() {
        builder.at(spec, |b, spec| b.object(index, spec))?;
    }
    // After the objects, which some lights belong to.
    for spec in &description.lights {
        builder.at(spec, Builder::light)?;
    }
    if let Some(spec) = &description.camera {
        builder.at(spec, Builder::camera)?;
    }
    Ok(SceneFile {
        scene: builder.scene,
        picture: picture(&description.picture, description.film.as_ref(), text)?,
        findings: builder.findings,
        hash: builder.loader.hash(),
    })
}

impl Builder<'_> {
    /// Builds what a part of the file describes; an error without a place gets that part's line.
    fn at<T>(
        &mut self,
        spec: &Spanned<T>,
        build: impl FnOnce(&mut Self, &T) -> Result<(), FormatError>,
    ) -> Result<(), FormatError> {
        let place = line_of(self.text.as_bytes(), spec.span().start);
        build(self, spec.get_ref()).map_err(|error| error.at(place))
    }

    fn material(&mut self, name: String, spec: &MaterialSpec) -> Result<(), FormatError> {
        let default = Material::default();
        let emission = colour("emission", spec.emission)?;
        let material = Material {
            diffuse: match &spec.diffuse {
                // What has light of its own is a lamp, unless it says otherwise.
                None if !emission.is_black() => Rgb::BLACK.into(),
                None => default.diffuse.clone(),
                Some(texture) => self.texture(texture)?,
            },
            specular: colour("specular", spec.specular)?,
            shininess: above_zero("shininess", spec.shininess.unwrap_or(default.shininess))?,
            reflection: colour("reflection", spec.reflection)?,
            transmission: colour("transmission", spec.transmission)?,
            index_of_refraction: above_zero(
                "index_of_refraction",
                spec.index_of_refraction
                    .unwrap_or(default.index_of_refraction),
            )?,
            fresnel: spec.fresnel,
            internal_reflection: spec
                .internal_reflection
                .unwrap_or(default.internal_reflection),
            emission,
            one_sided: spec.one_sided,
            name: name.clone(),
            ..default
        };
        self.named
            .insert(name, MaterialId(self.scene.materials.len() as u32));
        self.scene.materials.push(material);
        Ok(())
    }

    fn texture(&mut self, spec: &TextureSpec) -> Result<Texture, FormatError> {
        match spec {
            TextureSpec::Constant(constant) => Ok(colour("diffuse", *constant)?.into()),
            TextureSpec::Checker(spec) => {
                let [a, b] = spec.checker;
                Ok(Texture::Checker {
                    colours: [colour("checker", a)?, colour("checker", b)?],
                    size: above_zero("size", spec.size)?,
                })
            }
            TextureSpec::Image(spec) => Ok(self.loader.image(&spec.image)?.into()),
        }
    }

    fn light(&mut self, spec: &LightSpec) -> Result<(), FormatError> {
        let light = match spec {
            LightSpec::Point(spec) => Light::Point {
                position: point("position", spec.position)?,
                intensity: colour("intensity", spec.intensity)?,
                falloff: spec.falloff.into(),
            },
            LightSpec::Directional(spec) => Light::Directional {
                direction: direction("direction", spec.direction)?,
                intensity: colour("intensity", spec.intensity)?,
            },
            LightSpec::Spot(spec) => {
                if !(0.0 <= spec.inner && spec.inner <= spec.outer && spec.outer <= 180.0) {
                    return Err(wrong(format!(
                        "inner is {} and outer {}; degrees with 0 <= inner <= outer <= 180 are \
                         needed",
                        spec.inner, spec.outer
                    )));
                }
                Light::Spot {
                    position: point("position", spec.position)?,
                    direction: direction("direction", spec.direction)?,
                    inner: Angle::from_degrees(spec.inner),
                    outer: Angle::from_degrees(spec.outer),
                    intensity: colour("intensity", spec.intensity)?,
                    falloff: spec.falloff.into(),
                }
            }
            LightSpec::Area(spec) => Light::Area {
                corner: point("corner", spec.corner)?,
                edge_u: vector("edge_u", spec.edge_u)?,
                edge_v: vector("edge_v", spec.edge_v)?,
                intensity: colour("intensity", spec.intensity)?,
                falloff: spec.falloff.into(),
            },
            LightSpec::Luminous(spec) => Light::Luminous {
                object: self.object_named(&spec.object)?,
                position: point("position", spec.position)?,
                intensity: colour("intensity", spec.intensity)?,
                falloff: spec.falloff.into(),
            },
        };
        self.scene.lights.push(light);
        Ok(())
    }

    fn object(&mut self, index: usize, spec: &ObjectSpec) -> Result<(), FormatError> {
        let name = spec
            .name
            .clone()
            .unwrap_or_else(|| format!("object {index}"));
        let placed = placement(&spec.transform)?;
        let material = spec
            .material
            .as_deref()
            .map(|m| self.material_named(m))
            .transpose()?;
        let shapes: Vec<_> = spec.shape.iter().chain(&spec.shapes).collect();
        let one_word = [
            spec.shape.is_some(),
            !spec.shapes.is_empty(),
            spec.mesh.is_some(),
        ];
        if one_word.into_iter().filter(|&is| is).count() != 1 {
            return Err(wrong(format!(
                "{name} needs one of these: a shape, shapes, a mesh"
            )));
        }
        match &spec.mesh {
            None => {
                let shapes = shapes.into_iter().map(ShapeSpec::build);
                let geometry = Geometry::Shapes(Shapes(shapes.collect::<Result<_, _>>()?));
                let material = match material {
                    Some(material) => material,
                    None => self.default_material(),
                };
                self.scene.place(name, geometry, material, placed);
                Ok(())
            }
            Some(mesh) => self.model(&name, &mesh.file, material, placed),
        }
    }

    fn model(
        &mut self,
        name: &str,
        file: &str,
        material: Option<MaterialId>,
        placed: Transform<Object, World>,
    ) -> Result<(), FormatError> {
        let mut loaded = match self.models.remove(file) {
            Some(loaded) => loaded,
            None => self.load(file)?,
        };
        let first = match (material, loaded.first_material) {
            (None, None) => {
                let first = self.scene.materials.len();
                self.scene.materials.append(&mut loaded.materials);
                *loaded.first_material.insert(first)
            }
            (_, first) => first.unwrap_or_default(),
        };
        for part in &loaded.parts {
            let material = material.unwrap_or(MaterialId((first + part.material) as u32));
            let name = format!("{name}, {}", part.name);
            let placed = match &part.model_from_part {
                None => placed,
                Some(within) => nested(within, &placed)?,
            };
            self.scene
                .place_again(name, part.geometry, material, placed);
        }
        self.models.insert(file.to_owned(), loaded);
        Ok(())
    }

    fn load(&mut self, file: &str) -> Result<LoadedModel, FormatError> {
        if gltf::is_named(Path::new(file)) {
            return self.load_gltf(file);
        }
        let model = self.loader.model(file)?;
        let findings = model.findings.into_iter().map(Box::new);
        self.findings.extend(findings.map(|about| {
            let file = file.to_owned();
            Finding::InModel { file, about }
        }));
        let mut parts = Vec::with_capacity(model.parts.len());
        for part in model.parts {
            let mesh = Mesh::with_test(with_normals(part.mesh)?, self.test);
            let geometry = self.scene.add_geometry(Geometry::Mesh(mesh));
            parts.push(LoadedPart {
                name: part.name,
                geometry,
                material: part.material,
                model_from_part: None,
            });
        }
        Ok(LoadedModel {
            parts,
            materials: model.materials,
            first_material: None,
        })
    }

    /// The objects of a glTF file; its cameras and lights are not taken.
    fn load_gltf(&mut self, file: &str) -> Result<LoadedModel, FormatError> {
        let loaded = self.loader.gltf(file, self.test)?;
        self.findings
            .extend(loaded.findings.into_iter().map(|about| {
                let (file, about) = (file.to_owned(), Box::new(about));
                Finding::InModel { file, about }
            }));
        let first = self.scene.geometries.len() as u32;
        self.scene.geometries.extend(loaded.scene.geometries);
        let parts = loaded.scene.objects.into_iter().map(|object| LoadedPart {
            name: object.name,
            geometry: GeometryId(first + object.geometry.0),
            material: object.material.index(),
            model_from_part: Some(object.world_from_object),
        });
        Ok(LoadedModel {
            parts: parts.collect(),
            materials: loaded.scene.materials,
            first_material: None,
        })
    }

    fn camera(&mut self, spec: &CameraSpec) -> Result<(), FormatError> {
        let position = point("position", spec.position)?;
        let up = direction("up", spec.up.unwrap_or([0.0, 1.0, 0.0]))?;
        let toward = match (spec.look_at, spec.direction) {
            (Some(target), None) => point("look_at", target)? - position,
            (None, Some(toward)) => direction("direction", toward)?,
            (Some(_), Some(_)) => {
                let message = "the camera has look_at and direction; one of them is needed";
                return Err(wrong(message.to_owned()));
            }
            (None, None) => {
                let message = "the camera has neither look_at nor direction; one is needed";
                return Err(wrong(message.to_owned()));
            }
        };
        let pose = Pose::new(position, toward, up).map_err(|e| wrong(e.to_string()))?;
        let projection = match &spec.projection {
            ProjectionSpec::Perspective(spec) => Projection::Perspective(Perspective {
                fov: fov(spec.fov)?,
                shift: finite("shift", spec.shift)?,
            }),
            ProjectionSpec::ThinLens(spec) => {
                let lens_radius = at_least_zero("lens_radius", spec.lens_radius)?;
                Projection::ThinLens(ThinLens {
                    fov: fov(spec.fov)?,
                    lens_radius,
                    focus_distance: above_zero("focus_distance", spec.focus_distance)?,
                    aperture: spec.aperture.into(),
                    shift: finite("shift", spec.shift)?,
                })
            }
            ProjectionSpec::Orthographic(spec) => Projection::Orthographic(Orthographic {
                height: above_zero("height", spec.height)?,
            }),
            ProjectionSpec::Panorama(_) => Projection::Panorama(Panorama),
        };
        self.scene.up = up;
        self.scene.camera = Some(Camera { pose, projection });
        Ok(())
    }

    fn material_named(&self, name: &str) -> Result<MaterialId, FormatError> {
        self.named.get(name).copied().ok_or_else(|| {
            let known: Vec<_> = self.named.keys().map(String::as_str).collect();
            let known = if known.is_empty() {
                "none".to_owned()
            } else {
                known.join(", ")
            };
            wrong(format!(
                "material \"{name}\" is not defined; defined are: {known}"
            ))
        })
    }

    fn object_named(&self, name: &str) -> Result<InstanceId, FormatError> {
        let mut named = (0..)
            .zip(&self.scene.objects)
            .filter(|(_, o)| o.name == name);
        match (named.next(), named.next()) {
            (Some((index, _)), None) => Ok(InstanceId(index)),
            (None, _) => Err(wrong(format!(
                "no object is named \"{name}\"; a luminous light needs the name of one"
            ))),
            (Some(_), Some(_)) => Err(wrong(format!(
                "several objects are named \"{name}\"; a luminous light needs the name of one"
            ))),
        }
    }

    fn default_material(&mut self) -> MaterialId {
        self.scene.materials.push(Material::default());
        MaterialId(self.scene.materials.len() as u32 - 1)
    }
}

/// Where a part of a model stands whose model is placed.
fn nested(
    within: &Transform<Object, World>,
    placed: &Transform<Object, World>,
) -> Result<Transform<Object, World>, FormatError> {
    let within = Transform::<Object, Object>::from_rows(*within.rows());
    let nested = within.and_then(|within| Transform::from_rows(*within.then(placed).rows()));
    nested.map_err(|e| wrong(format!("transform: {e}")))
}

impl From<CutoffSpec> for Cutoff {
    fn from(spec: CutoffSpec) -> Self {
        match spec {
            CutoffSpec::Background => Self::Background,
            CutoffSpec::Black => Self::Black,
        }
    }
}

impl From<ApertureSpec> for Aperture {
    fn from(spec: ApertureSpec) -> Self {
        match spec {
            ApertureSpec::Disk => Self::Disk,
            ApertureSpec::Square => Self::Square,
        }
    }
}

impl From<FalloffSpec> for Falloff {
    fn from(spec: FalloffSpec) -> Self {
        match spec {
            FalloffSpec::None => Self::None,
            FalloffSpec::InverseSquare => Self::InverseSquare,
        }
    }
}

pub(super) fn wrong(message: String) -> FormatError {
    FormatError::file(Fault::Description(message))
}

fn background(spec: BackgroundSpec) -> Result<Background, FormatError> {
    match spec {
        BackgroundSpec::Constant(constant) => Ok(colour("background", constant)?.into()),
        BackgroundSpec::Sky(spec) => {
            let up = direction("up", spec.up.unwrap_or([0.0, 1.0, 0.0]))?;
            Ok(Background::Sky {
                zenith: colour("zenith", spec.zenith)?,
                horizon: colour("horizon", spec.horizon)?,
                up: up.normalized().unwrap_or(up),
                exponent: above_zero("exponent", spec.exponent.unwrap_or(1.0))?,
            })
        }
    }
}

fn colour(what: impl Display, spec: ColourSpec) -> Result<Rgb, FormatError> {
    let components = match spec {
        ColourSpec::Grey(grey) => [grey; 3],
        ColourSpec::Rgb(components) => components,
    };
    if components.iter().all(|c| (0.0..=f32::MAX).contains(c)) {
        Ok(components.into())
    } else {
        Err(wrong(format!(
            "{what} is {components:?}; colours are finite and not below 0"
        )))
    }
}

pub(super) fn point(what: impl Display, p: [f32; 3]) -> Result<Point3, FormatError> {
    finite(what, p).map(Point3::from)
}

pub(super) fn vector(what: impl Display, v: [f32; 3]) -> Result<Vector3, FormatError> {
    finite(what, v).map(Vector3::from)
}

pub(super) fn direction(what: impl Display, v: [f32; 3]) -> Result<Vector3, FormatError> {
    if v == [0.0; 3] {
        return Err(wrong(format!("{what} is zero; it needs a length")));
    }
    vector(what, v)
}

fn finite<const N: usize>(what: impl Display, numbers: [f32; N]) -> Result<[f32; N], FormatError> {
    if numbers.iter().all(|x| x.is_finite()) {
        Ok(numbers)
    } else {
        Err(wrong(format!(
            "{what} is {numbers:?}; finite numbers are needed"
        )))
    }
}

pub(super) fn at_least_zero(what: impl Display, number: f32) -> Result<f32, FormatError> {
    if (0.0..=f32::MAX).contains(&number) {
        Ok(number)
    } else {
        Err(wrong(format!("{what} is {number}; 0 or more is needed")))
    }
}

pub(super) fn above_zero(what: impl Display, number: f32) -> Result<f32, FormatError> {
    if number > 0.0 && number.is_finite() {
        Ok(number)
    } else {
        Err(wrong(format!(
            "{what} is {number}; a finite number above 0 is needed"
        )))
    }
}

fn fov(degrees: f32) -> Result<Angle, FormatError> {
    if degrees > 0.0 && degrees < 180.0 {
        Ok(Angle::from_degrees(degrees))
    } else {
        Err(wrong(format!(
            "fov is {degrees}; degrees between 0 and 180 are needed"
        )))
    }
}
