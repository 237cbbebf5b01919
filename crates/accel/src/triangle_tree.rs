//! A structure out of a file.
#![expect(
    unsafe_code,
    reason = "to trace a file where it lies takes a promise that it stays as it is"
)]

use std::path::Path;

use ombra_geometry::{Aabb, EdgeRule, Hit, Ray};

use crate::bvh8::file::read::Loaded;
use crate::bvh8::file::{OtherMesh, StructureFileError};
use crate::bvh8::places::Places;
use crate::{
    Accel, AnyHit, AnyStructure, Candidate, Level, Mesh, Primitives as _, Statistics, Traversable,
};

/// A wide tree of triangles that was built and [saved](Accel::save) before: it gives the very
/// answers of the one that was saved, and needs no mesh for them.
///
/// A file comes from anywhere. It is found to be whole before anything is traced, so that whatever
/// it holds, nothing is read outside of it; and it has checksums against damage.
/// `docs/structure-file.md` says what each byte means.
#[derive(Clone, Debug)]
pub struct TriangleTree(Accel<Places>);

impl TriangleTree {
    /// Loads a file into memory. What happens to the file afterwards does not matter.
    ///
    /// # Errors
    /// When the file cannot be read, or is not one that [`Accel::save`] could have written.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, StructureFileError> {
        Loaded::read(path.as_ref()).map(Self::of)
    }

    /// The same from a file that is in memory already; errors call it by the name.
    ///
    /// # Errors
    /// Those of [`load`](Self::load).
    pub fn read_bytes(name: &str, bytes: &[u8]) -> Result<Self, StructureFileError> {
        Loaded::from_bytes(name.as_ref(), bytes).map(Self::of)
    }

    /// Maps a file and traces it where it lies: quicker than [`load`](Self::load), and programs
    /// that map the same file share its memory.
    ///
    /// # Errors
    /// Those of [`load`](Self::load).
    ///
    /// # Safety
    /// - Nobody changes the file, nor makes it shorter, while this or a clone of it lives: it is
    ///   checked once, and traced without a check. To save in its place is no change: that puts a new
    ///   file there and leaves the old one as it is.
    pub unsafe fn map(path: impl AsRef<Path>) -> Result<Self, StructureFileError> {
        // SAFETY: the caller's promise.
        unsafe { Loaded::map(path.as_ref()) }.map(Self::of)
    }

    fn of(loaded: Loaded) -> Self {
        let Loaded {
            structure,
            places,
            reach,
            bounds,
        } = loaded;
        let structure = AnyStructure::Bvh8(structure);
        Self(Accel::of_parts(places, structure, reach, bounds))
    }

    /// Saves it again, byte for byte.
    ///
    /// # Errors
    /// When the file cannot be written; what was there before is still there then.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), StructureFileError> {
        self.0.save(path)
    }

    /// The structure over its mesh, as if it had just been built: to be placed by instances, asked for
    /// distances, [refitted](Accel::refit). It calls itself a `bvh8`, whichever kind was saved.
    ///
    /// Each triangle is looked at, which takes longer than to load the file.
    ///
    /// # Errors
    /// When the mesh is another one.
    pub fn with_mesh(self, mesh: Mesh) -> Result<Accel<Mesh>, OtherMesh> {
        let Accel {
            primitives: places,
            mut structure,
            reach,
            bounds,
            ..
        } = self.0;
        let triangles = mesh.watertight().ok_or(OtherMesh::Test)?;
        if mesh.len() != places.len() {
            let (mesh, structure) = (mesh.len(), places.len());
            return Err(OtherMesh::Count { mesh, structure });
        }
        if let Some(tree) = structure.wide_mut() {
            tree.over(triangles, &places)?;
        }
        drop(places);
        Ok(Accel::of_parts(mesh, structure, reach, bounds))
    }

    /// How many triangles the mesh had: the number of every hit is below this.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.0.primitives().len()
    }

    /// See [`Accel::at_level`].
    ///
    /// # Panics
    /// When this machine does not have the level.
    #[must_use]
    pub fn at_level(self, level: Level) -> Self {
        Self(self.0.at_level(level))
    }
}

impl Traversable for TriangleTree {
    fn search(
        &self,
        ray: &Ray<f64>,
        rule: EdgeRule,
        statistics: Option<&mut Statistics>,
        any_hit: &mut dyn FnMut(&Candidate) -> AnyHit,
    ) -> Option<Candidate> {
        self.0.search(ray, rule, statistics, any_hit)
    }

    fn intersect(&self, ray: &Ray) -> Option<Hit> {
        self.0.intersect(ray)
    }

    fn occluded(&self, ray: &Ray) -> bool {
        self.0.occluded(ray)
    }

    fn intersect_many(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        self.0.intersect_many(rays, hits);
    }

    fn occluded_many(&self, rays: &[Ray], occluded: &mut [bool]) {
        self.0.occluded_many(rays, occluded);
    }

    fn bounds(&self) -> Aabb {
        self.0.bounds()
    }

    /// What is mapped counts as if it were on the heap.
    fn bytes(&self) -> usize {
        self.0.bytes()
    }
}
