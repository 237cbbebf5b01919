//! glTF and GLB.

mod broken;
mod geometry;
mod hostile;
mod materials;
mod placing;
mod shining;

use std::fmt::Write as _;

use base64::Engine as _;
use ombra_accel::Geometry;
use ombra_formats::{GltfFile, Limits, parse_gltf};
use ombra_geometry::TriangleMesh;
use ombra_geometry::triangle::TriangleTest;

/// A document under construction: one buffer, a view for each blob, and the rest as JSON.
#[derive(Default)]
pub(super) struct Doc {
    buffer: Vec<u8>,
    views: Vec<String>,
    accessors: Vec<String>,
    rest: String,
}

impl Doc {
    /// A document with other properties, such as `"nodes": [...]`.
    pub(super) fn new(rest: &str) -> Self {
        Self {
            rest: rest.to_owned(),
            ..Self::default()
        }
    }

    /// One triangle in the xy plane as accessors 0 (positions) and 1 (indices), mesh 0 of `primitive`
    /// and node 0 that places it. `primitive` is what a primitive has besides.
    pub(super) fn triangle(primitive: &str, rest: &str) -> Self {
        let mut doc = Self::new(&format!(
            r#""nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [{{"attributes":
               {{"POSITION": 0}}, "indices": 1{primitive}}}]}}]{rest}"#
        ));
        doc.floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0], "VEC3");
        doc.accessor(
            &[0, 1, 2],
            r#""componentType": 5121, "count": 3, "type": "SCALAR""#,
        );
        doc
    }

    /// Another view of these bytes; its number.
    pub(super) fn view(&mut self, bytes: &[u8], more: &str) -> usize {
        self.buffer.resize(self.buffer.len().next_multiple_of(4), 0);
        self.views.push(format!(
            r#"{{"buffer": 0, "byteOffset": {}, "byteLength": {}{more}}}"#,
            self.buffer.len(),
            bytes.len()
        ));
        self.buffer.extend(bytes);
        self.views.len() - 1
    }

    /// Another accessor; its number.
    pub(super) fn accessor(&mut self, bytes: &[u8], json: &str) -> usize {
        let view = self.view(bytes, "");
        self.raw_accessor(&format!(r#""bufferView": {view}, {json}"#))
    }

    pub(super) fn raw_accessor(&mut self, json: &str) -> usize {
        self.accessors.push(format!("{{{json}}}"));
        self.accessors.len() - 1
    }

    pub(super) fn floats(&mut self, numbers: &[f32], kind: &str) -> usize {
        let width = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let count = numbers.len() / width;
        let json = format!(r#""componentType": 5126, "count": {count}, "type": "{kind}""#);
        self.accessor(&bytes(numbers), &json)
    }

    fn json(&self, uri: Option<&str>) -> String {
        let mut json = r#"{"asset": {"version": "2.0"}"#.to_owned();
        if !self.buffer.is_empty() {
            let length = self.buffer.len();
            let uri = uri.map_or(String::new(), |uri| format!(r#", "uri": "{uri}""#));
            let _ = write!(json, r#", "buffers": [{{"byteLength": {length}{uri}}}]"#);
        }
        let _ = write!(json, r#", "bufferViews": [{}]"#, self.views.join(","));
        let _ = write!(json, r#", "accessors": [{}]"#, self.accessors.join(","));
        if !self.rest.is_empty() {
            let _ = write!(json, ", {}", self.rest);
        }
        json + "}"
    }

    /// As the text of a glTF file with its buffer in it.
    pub(super) fn gltf(&self) -> String {
        let data = base64::engine::general_purpose::STANDARD.encode(&self.buffer);
        self.json(Some(&format!(
            "data:application/octet-stream;base64,{data}"
        )))
    }

    /// As the text of a glTF file, and the content of the file that its buffer is in.
    pub(super) fn gltf_beside(&self, uri: &str) -> (String, &[u8]) {
        (self.json(Some(uri)), &self.buffer)
    }

    /// As the bytes of a GLB file.
    pub(super) fn glb(&self) -> Vec<u8> {
        glb(self.json(None).as_bytes(), &self.buffer)
    }

    pub(super) fn read(&self) -> GltfFile {
        self.try_read().unwrap_or_else(|error| panic!("{error}"))
    }

    /// Both ways to write it come to the same.
    pub(super) fn try_read(&self) -> Result<GltfFile, String> {
        let text = parse(self.gltf().as_bytes());
        let packed = parse(&self.glb());
        let seen = |read: &Result<GltfFile, String>| match read {
            Ok(file) => format!("{:?}", file.scene),
            Err(error) => error.clone(),
        };
        assert_eq!(seen(&text), seen(&packed));
        packed
    }

    pub(super) fn error(&self) -> String {
        match self.try_read() {
            Ok(_) => panic!("no error"),
            Err(error) => error,
        }
    }
}

pub(super) fn glb(json: &[u8], binary: &[u8]) -> Vec<u8> {
    let mut chunks = Vec::new();
    for (kind, content, filler) in [(b"JSON", json, b' '), (b"BIN\0", binary, 0)] {
        let mut content = content.to_vec();
        content.resize(content.len().next_multiple_of(4), filler);
        chunks.extend((content.len() as u32).to_le_bytes());
        chunks.extend(kind);
        chunks.extend(content);
    }
    let mut bytes = b"glTF".to_vec();
    bytes.extend(2_u32.to_le_bytes());
    bytes.extend((chunks.len() as u32 + 12).to_le_bytes());
    bytes.extend(chunks);
    bytes
}

pub(super) fn bytes(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn parse(bytes: &[u8]) -> Result<GltfFile, String> {
    parse_gltf(bytes, TriangleTest::default(), &Limits::default()).map_err(|error| {
        let text = error.to_string();
        assert!(!text.contains('\n'), "an error is one line: {text}");
        text
    })
}

fn mesh(file: &GltfFile, geometry: usize) -> &TriangleMesh {
    match &file.scene.geometries[geometry] {
        Geometry::Mesh(mesh) => mesh.mesh(),
        Geometry::Shapes(_) => panic!("no mesh"),
    }
}

fn findings(file: &GltfFile) -> Vec<String> {
    file.findings.iter().map(ToString::to_string).collect()
}
