//! From a document to a scene.

use std::collections::HashMap;

use ombra_accel::{Geometry, Mesh, Primitives as _};
use ombra_geometry::triangle::TriangleTest;
use ombra_geometry::{Aabb, GeometryId, Object as ObjectSpace, Transform, TransformError, World};
use ombra_scene::{MaterialId, Rgb, Scene, Texture};

use super::budget::Budget;
use super::buffer::{Buffers, no_such};
use super::container::Parts;
use super::document::{Document, NodeSpec};
use super::emitter::{Emitter, emitter, strongest};
use super::material::{Surface, default_surface, surface};
use super::metering::{self, Placement};
use super::node::{Matrix, Placed, placed, product};
use super::notes::Notes;
use super::primitive::{Key, Reader};
use super::texture::Textures;
use super::{Folder, GltfFile, GltfInfo, camera, extension, instancing, light, wrong};
use crate::error::FormatError;
use crate::finding::Finding;
use crate::info::{MaterialInfo, kind};
use crate::limits::Limits;
use crate::mesh::finish::{Mended, finish};
use crate::scene::Picture;

/// Light from everywhere where the file has lights: shadows are not black in a world that scatters
/// light.
const AMBIENT: Rgb = Rgb::grey(0.1);

/// The height of a picture whose camera says how wide it is.
const HEIGHT: f32 = 540.0;

struct Builder<'a> {
    document: &'a Document,
    reader: Reader<'a>,
    textures: Textures<'a>,
    test: TriangleTest,
    scene: Scene,
    picture: Picture,
    notes: Notes,
    objects_left: u64,
    /// The materials that are used, by their number; that of what has none under `None`.
    surfaces: HashMap<Option<usize>, Used>,
    /// Of each material in the scene, whether it shines in one colour if it shines.
    lamps: Vec<bool>,
    /// Geometries that are in the scene; `None` for those without triangles.
    geometries: HashMap<Key, Option<GeometryId>>,
    lights_of_file: u64,
    cameras: u64,
}

/// A material that is in the scene.
#[derive(Clone, Copy)]
struct Used {
    id: MaterialId,
    set: u32,
    hidden: bool,
}

pub(super) fn build(
    document: &Document,
    parts: &Parts<'_>,
    folder: Folder<'_>,
    test: TriangleTest,
    limits: &Limits,
) -> Result<GltfFile, FormatError> {
    let mut notes = Notes::default();
    extension::check(document, &mut notes)?;
    let mut buffers = Buffers::read(document, parts.binary, folder)?;
    let mut files = std::mem::take(&mut buffers.files);
    let budget = Budget::of(parts.json.len() as u64 + buffers.bytes());
    let mut builder = Builder {
        document,
        reader: Reader {
            document,
            buffers: &buffers,
            mended: Mended::default(),
            triangles_left: budget.triangles,
            vertices: 0,
        },
        textures: Textures::new(document, &buffers, folder, limits),
        test,
        scene: Scene::default(),
        picture: Picture::default(),
        notes,
        objects_left: budget.objects,
        surfaces: HashMap::new(),
        lamps: Vec::new(),
        geometries: HashMap::new(),
        lights_of_file: 0,
        cameras: 0,
    };
    for placed in placed(document)? {
        builder.node(&placed)?;
    }
    builder.rest_pose();
    builder.shine()?;
    builder.expose();
    let info = builder.info(parts);
    let mut findings: Vec<Finding> = builder.notes.into_findings().collect();
    findings.append(&mut builder.textures.findings);
    builder.reader.mended.report(&mut findings);
    if info.triangles == 0 {
        findings.push(Finding::NoTriangles);
    }
    files.append(&mut builder.textures.files);
    Ok(GltfFile {
        scene: builder.scene,
        picture: builder.picture,
        findings,
        files,
        info,
    })
}

impl Builder<'_> {
    fn node(&mut self, placed: &Placed) -> Result<(), FormatError> {
        let spec = &self.document.nodes[placed.node];
        let place = format!("nodes[{}]", placed.node);
        if spec.mesh.is_none() && spec.camera.is_none() && spec.extensions.light.is_none() {
            return Ok(());
        }
        if let Some(index) = spec.camera {
            self.camera(index, &placed.matrix, &place)?;
        }
        if let Some(node_light) = &spec.extensions.light {
            self.light(node_light.light, &placed.matrix, &place)?;
        }
        let Some(mesh) = spec.mesh else {
            return Ok(());
        };
        match &spec.extensions.instancing {
            None => self.mesh(mesh, spec, &placed.matrix, &place),
            Some(spread) => {
                let (document, buffers) = (self.document, self.reader.buffers);
                // Before any is made: what each of them will be charged.
                let primitives = document.meshes.get(mesh).map_or(0, |m| m.primitives.len());
                let most = self.objects_left / (1 + primitives as u64);
                let matrices = instancing::placements(document, buffers, spread, most, &place)?;
                for matrix in matrices {
                    let matrix = product(&placed.matrix, &matrix);
                    self.mesh(mesh, spec, &matrix, &place)?;
                }
                Ok(())
            }
        }
    }

    /// Places all primitives of a mesh.
    fn mesh(
        &mut self,
        index: usize,
        node: &NodeSpec,
        matrix: &Matrix,
        place: &str,
    ) -> Result<(), FormatError> {
        let document = self.document;
        self.charge(place)?;
        let mesh = document.meshes.get(index).ok_or_else(|| {
            let count = document.meshes.len();
            wrong(format!("{place}.mesh"), no_such("meshes", index, count))
        })?;
        let Some(world_from_object) = self.transform(matrix, place)? else {
            return Ok(());
        };
        let name = node.name.as_ref().or(mesh.name.as_ref());
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            self.charge(place)?;
            let at = format!("meshes[{index}].primitives[{number}]");
            let called = mesh.name.as_deref();
            let used = self.surface(primitive.material, &at)?;
            if !primitive.targets.is_empty() {
                self.notes.add(&at, "morph targets are not used");
            }
            if used.hidden {
                self.notes
                    .add(&at, "is all clear (alphaMode MASK): left out");
                continue;
            }
            let Some(key) = Key::of(primitive, used.set, &at, &mut self.notes)? else {
                continue;
            };
            let Some(geometry) = self.geometry(key, used, &at, called)? else {
                continue;
            };
            let name = name.cloned().unwrap_or_else(|| at.clone());
            self.scene
                .place_again(name, geometry, used.id, world_from_object);
        }
        Ok(())
    }

    /// Pays for a placement or a primitive of one, whether or not anything comes of it.
    fn charge(&mut self, place: &str) -> Result<(), FormatError> {
        let message = "places more than a file of this size is trusted with";
        let left = self.objects_left.checked_sub(1);
        self.objects_left = left.ok_or_else(|| wrong(place, message))?;
        Ok(())
    }

    /// The placement of a node; `None`, with a note, if it flattens its mesh.
    fn transform(
        &mut self,
        matrix: &Matrix,
        place: &str,
    ) -> Result<Option<Transform<ObjectSpace, World>>, FormatError> {
        match Transform::from_rows(*matrix) {
            Ok(transform) => Ok(Some(transform)),
            Err(TransformError::Singular) => {
                self.notes.add(
                    place,
                    "is flattened by its transform (a scale of 0): left out",
                );
                Ok(None)
            }
            Err(error) => Err(wrong(place, format!("its place in the scene: {error}"))),
        }
    }

    fn geometry(
        &mut self,
        key: Key,
        used: Used,
        place: &str,
        called: Option<&str>,
    ) -> Result<Option<GeometryId>, FormatError> {
        if !key.has_uv() && self.has_picture(used) {
            let message = format!(
                "has no TEXCOORD_{}, by which its material is laid out",
                used.set
            );
            self.notes.add(place, message);
        }
        if let Some(&known) = self.geometries.get(&key) {
            return Ok(known);
        }
        let raw = self.reader.read(&key, place, called, &mut self.notes)?;
        let (mesh, mended) = finish(raw)?;
        self.reader.mended.add(mended);
        let geometry = (!mesh.triangles().is_empty()).then(|| {
            let mesh = Mesh::with_test(mesh, self.test);
            self.scene.add_geometry(Geometry::Mesh(mesh))
        });
        self.geometries.insert(key, geometry);
        Ok(geometry)
    }

    fn has_picture(&self, used: Used) -> bool {
        let material = &self.scene.materials[used.id.index()];
        matches!(material.diffuse, Texture::Picture(_)) || material.emission_picture.is_some()
    }

    /// A material, which comes into the scene when it is first used.
    fn surface(&mut self, index: Option<usize>, user: &str) -> Result<Used, FormatError> {
        if let Some(&known) = self.surfaces.get(&index) {
            return Ok(known);
        }
        let Surface {
            material,
            set,
            hidden,
        } = match index {
            None => default_surface(),
            Some(index) => {
                let specs = &self.document.materials;
                let spec = specs.get(index).ok_or_else(|| {
                    let message = no_such("materials", index, specs.len());
                    wrong(format!("{user}.material"), message)
                })?;
                let place = format!("materials[{index}]");
                surface(spec, &place, &mut self.textures, &mut self.notes)?
            }
        };
        let id = MaterialId(self.scene.materials.len() as u32);
        self.scene.materials.push(material);
        // Unlit ones show their colour and light nothing.
        let spec = index.map(|index| &self.document.materials[index]);
        self.lamps.push(spec.is_some_and(|spec| {
            spec.extensions.unlit.is_none() && spec.emissive_texture.is_none()
        }));
        let used = Used { id, set, hidden };
        self.surfaces.insert(index, used);
        Ok(used)
    }

    /// The first camera is that of the picture.
    fn camera(&mut self, index: usize, matrix: &Matrix, place: &str) -> Result<(), FormatError> {
        let specs = &self.document.cameras;
        let spec = specs.get(index).ok_or_else(|| {
            let message = no_such("cameras", index, specs.len());
            wrong(format!("{place}.camera"), message)
        })?;
        self.cameras += 1;
        if self.cameras > 1 {
            self.notes.add(place, "only the first camera is used");
            return Ok(());
        }
        let (camera, aspect) = camera::camera(spec, matrix, &format!("cameras[{index}]"))?;
        self.scene.camera = Some(camera);
        // Within what anyone would want to look at; other pictures are the command's to ask for.
        self.picture.size = aspect
            .filter(|aspect| (0.1..=10.0).contains(aspect))
            .map(|aspect| [(HEIGHT * aspect).round() as u32, HEIGHT as u32]);
        Ok(())
    }

    fn light(&mut self, index: usize, matrix: &Matrix, place: &str) -> Result<(), FormatError> {
        let lights = self.document.extensions.lights.as_ref();
        let specs = lights.map_or(&[][..], |lights| &lights.lights);
        let spec = specs.get(index).ok_or_else(|| {
            let message = no_such("lights", index, specs.len());
            wrong(
                format!("{place}.extensions.KHR_lights_punctual.light"),
                message,
            )
        })?;
        let at = format!("extensions.KHR_lights_punctual.lights[{index}]");
        let light = light::light(spec, matrix, &at)?;
        self.scene.lights.push(light);
        self.lights_of_file += 1;
        Ok(())
    }

    fn rest_pose(&mut self) {
        for (list, count) in [
            ("animations", self.document.animations.len()),
            ("skins", self.document.skins.len()),
        ] {
            let message = "are not used: everything is shown at rest";
            if count > 0 {
                self.notes.add(list, message);
            }
        }
    }

    /// Without lights, what shines gets some.
    fn shine(&mut self) -> Result<(), FormatError> {
        if !self.scene.lights.is_empty() {
            return Ok(());
        }
        let mut emitters: Vec<Emitter> = Vec::new();
        for (index, object) in self.scene.objects.iter().enumerate() {
            let material = &self.scene.materials[object.material.index()];
            let mesh = mesh(&self.scene, object.geometry);
            if material.emission.is_black() || !self.lamps[object.material.index()] {
                continue;
            }
            let placement = &object.world_from_object;
            let Some(emitter) = mesh.and_then(|m| emitter(index, m, material.emission, placement))
            else {
                continue;
            };
            if !emitter.is_finite {
                let message = format!(
                    "{:?} over the area of \"{}\" is more than a number holds",
                    material.emission.to_array(),
                    object.name
                );
                return Err(wrong(self.place_of(object.material), message));
            }
            emitters.push(emitter);
        }
        let (lights, objects, left_out) = strongest(emitters);
        if lights.is_empty() {
            return Ok(());
        }
        self.notes.add(
            "lights",
            format!("there are none: {} made at what shines", lights.len()),
        );
        self.notes.add_many(
            "lights",
            "surfaces that shine have no light of their own: the strongest do",
            left_out as u64,
        );
        for object in objects {
            // A lamp that was in its own way would light nothing.
            let material = self.scene.objects[object].material.index();
            let material = &mut self.scene.materials[material];
            material.diffuse = Rgb::BLACK.into();
            material.specular = Rgb::BLACK;
            material.reflection = Rgb::BLACK;
            material.transmission = Rgb::BLACK;
        }
        self.scene.lights = lights;
        Ok(())
    }

    /// Where in the document the light of a material is.
    fn place_of(&self, material: MaterialId) -> String {
        let mut used = self.surfaces.iter();
        let index = used.find_map(|(index, used)| index.filter(|_| used.id == material));
        index.map_or_else(
            || "materials".to_owned(),
            |index| format!("materials[{index}].emissiveFactor"),
        )
    }

    fn expose(&mut self) {
        let scene = &mut self.scene;
        if scene.lights.is_empty() {
            return;
        }
        scene.ambient = AMBIENT;
        let placements: Vec<_> = (scene.objects.iter())
            .filter_map(|object| {
                Some(Placement {
                    mesh: match scene.geometries.get(object.geometry.index())? {
                        Geometry::Mesh(mesh) => mesh.mesh(),
                        Geometry::Shapes(_) => return None,
                    },
                    world_from_object: &object.world_from_object,
                })
            })
            .collect();
        if let Some(factor) = metering::factor(&scene.lights, &placements) {
            metering::scale(&mut scene.lights, factor);
            let message = format!("scaled by {factor:.3e}, to be seen in a picture");
            self.notes.add("lights", message);
        }
    }

    fn info(&self, parts: &Parts<'_>) -> GltfInfo {
        let (document, scene) = (self.document, &self.scene);
        let triangles = |id: GeometryId| scene.geometries[id.index()].len() as u64;
        let mut materials: Vec<MaterialInfo> = (scene.materials.iter())
            .map(|material| MaterialInfo {
                name: material.name.clone(),
                kind: kind(material),
                triangles: 0,
            })
            .collect();
        let mut bounds = Aabb::EMPTY;
        for object in &scene.objects {
            materials[object.material.index()].triangles += triangles(object.geometry);
            if let Some(mesh) = mesh(scene, object.geometry) {
                bounds = bounds.union(object.world_from_object.aabb(&mesh.bounds()));
            }
        }
        GltfInfo {
            format: if parts.packed { "GLB" } else { "glTF" },
            version: document.asset.version.clone(),
            generator: document.asset.generator.clone(),
            nodes: document.nodes.len() as u64,
            meshes: document.meshes.len() as u64,
            objects: scene.objects.len() as u64,
            vertices: self.reader.vertices,
            triangles: scene.geometries.iter().map(|g| g.len() as u64).sum(),
            placed_triangles: scene.objects.iter().map(|o| triangles(o.geometry)).sum(),
            materials,
            textures: document.textures.len() as u64,
            images: document.images.len() as u64,
            cameras: self.cameras,
            lights: self.lights_of_file,
            animations: document.animations.len() as u64,
            skins: document.skins.len() as u64,
            bounds: (!bounds.is_empty()).then(|| [bounds.min.to_array(), bounds.max.to_array()]),
            findings: Vec::new(),
        }
    }
}

fn mesh(scene: &Scene, id: GeometryId) -> Option<&ombra_geometry::TriangleMesh> {
    match &scene.geometries[id.index()] {
        Geometry::Mesh(mesh) => Some(mesh.mesh()),
        Geometry::Shapes(_) => None,
    }
}
