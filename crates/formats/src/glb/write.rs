//! The bytes of a binary glTF file: glTF 2.0 specification (ISO/IEC 12113:2022), section 4.4.

use std::path::Path;

use png::ColorType;
use serde_json::{Value, json};

use super::{GlbMesh, GlbModel, GlbTexture};
use crate::error::{Fault, FormatError};
use crate::image::png_bytes;
use crate::write_whole;

const MAGIC: &[u8; 4] = b"glTF";
const VERSION: u32 = 2;
const JSON_CHUNK: &[u8; 4] = b"JSON";
const BINARY_CHUNK: &[u8; 4] = b"BIN\0";

// The numbers by which glTF calls types and uses of data.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const NEAREST: u32 = 9728;
const CLAMP_TO_EDGE: u32 = 33071;

/// Khronos' extension for colours that no light changes.
const UNLIT: &str = "KHR_materials_unlit";

impl GlbModel {
    /// The model as a file. Meshes without triangles are left out, since glTF has none such.
    ///
    /// # Errors
    /// When a triangle names a vertex or a mesh a material that is not there, a vertex is not finite,
    /// or there is more than four gigabytes.
    pub fn to_bytes(&self) -> Result<Vec<u8>, FormatError> {
        let mut binary = Vec::new();
        let mut parts = Parts::default();
        for mesh in self.meshes.iter().filter(|mesh| !mesh.triangles.is_empty()) {
            self.check(mesh)?;
            parts.add(mesh, &mut binary);
        }
        for texture in self
            .materials
            .iter()
            .filter_map(|material| material.texture.as_ref())
        {
            parts.add_image(texture, &mut binary)?;
        }
        let mut text = self.json(&parts, binary.len()).to_string().into_bytes();
        // Chunks are filled up to four bytes: text by spaces, data by zeros (both are so already).
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut chunks = vec![(JSON_CHUNK, text)];
        if !binary.is_empty() {
            chunks.push((BINARY_CHUNK, binary));
        }
        let length = 12 + chunks.iter().map(|(_, data)| 8 + data.len()).sum::<usize>();
        let length = u32::try_from(length).map_err(|_| {
            FormatError::file(Fault::TooLarge {
                what: "model",
                limit: u32::MAX.into(),
            })
        })?;
        let mut bytes = Vec::with_capacity(length as usize);
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        bytes.extend_from_slice(&length.to_le_bytes());
        for (name, data) in chunks {
            bytes.extend_from_slice(&(data.len() as u32).to_le_bytes());
            bytes.extend_from_slice(name);
            bytes.extend_from_slice(&data);
        }
        Ok(bytes)
    }

    /// Writes the model.
    ///
    /// # Errors
    /// As [`to_bytes`](Self::to_bytes) and [`write_whole`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), FormatError> {
        let path = path.as_ref();
        let bytes = self.to_bytes().map_err(|error| error.in_file(path))?;
        write_whole(path, &bytes)
    }

    fn check(&self, mesh: &GlbMesh) -> Result<(), FormatError> {
        let wrong = |what: String| {
            let name = &mesh.name;
            FormatError::file(Fault::Description(format!("mesh \"{name}\": {what}")))
        };
        let vertices = mesh.positions.len();
        if let Some(index) = mesh
            .triangles
            .iter()
            .flatten()
            .find(|&&i| i as usize >= vertices)
        {
            return Err(wrong(format!("no vertex {index}, there are {vertices}")));
        }
        if mesh.positions.iter().flatten().any(|x| !x.is_finite()) {
            return Err(wrong("a vertex is not finite".to_owned()));
        }
        let coordinates = mesh.texcoords.len();
        if coordinates != 0 && coordinates != vertices {
            return Err(wrong(format!(
                "{coordinates} texture coordinates for {vertices} vertices"
            )));
        }
        if mesh.texcoords.iter().flatten().any(|x| !x.is_finite()) {
            return Err(wrong("a texture coordinate is not finite".to_owned()));
        }
        if mesh.material >= self.materials.len() {
            let (material, count) = (mesh.material, self.materials.len());
            return Err(wrong(format!("no material {material}, there are {count}")));
        }
        Ok(())
    }

    fn json(&self, parts: &Parts, bytes: usize) -> Value {
        let mut images = 0..parts.images.len();
        let materials: Vec<_> = self
            .materials
            .iter()
            .map(|material| {
                let colour = material.colour.map(clipped);
                let mut value = json!({
                    "name": material.name,
                    "pbrMetallicRoughness": {
                        "baseColorFactor": colour,
                        "metallicFactor": 0.0,
                        "roughnessFactor": 0.9,
                    },
                    "emissiveFactor": material.emission.map(clipped),
                    "alphaMode": if colour[3] < 1.0 { "BLEND" } else { "OPAQUE" },
                    "doubleSided": true,
                });
                if material.texture.is_some() {
                    let index = images.next();
                    value["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": index });
                }
                if material.is_unlit {
                    value["extensions"] = json!({ UNLIT: {} });
                }
                value
            })
            .collect();
        let mut root = json!({
            "asset": { "version": "2.0", "generator": concat!("ombra ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
        });
        let mut put = |name: &str, value: Vec<Value>| {
            // An array without entries is not allowed.
            if !value.is_empty() {
                root[name] = Value::Array(value);
            }
        };
        if self.materials.iter().any(|material| material.is_unlit) {
            put("extensionsUsed", vec![json!(UNLIT)]);
        }
        if !parts.images.is_empty() {
            let nearest = json!({
                "magFilter": NEAREST,
                "minFilter": NEAREST,
                "wrapS": CLAMP_TO_EDGE,
                "wrapT": CLAMP_TO_EDGE,
            });
            put("samplers", vec![nearest]);
            let textures = 0..parts.images.len();
            let textures = textures.map(|image| json!({ "sampler": 0, "source": image }));
            put("textures", textures.collect());
            put("images", parts.images.clone());
        }
        let count = parts.nodes.len();
        let mut nodes = parts.nodes.clone();
        let mut scene = json!({ "name": "ombra" });
        if count > 0 {
            let mut above = json!({
                "name": "upright",
                "children": (0..count).collect::<Vec<_>>(),
            });
            if let Some(rotation) = self.up.and_then(upright) {
                above["rotation"] = json!(rotation);
            }
            nodes.push(above);
            scene["nodes"] = json!([count]);
        }
        if bytes > 0 {
            put("buffers", vec![json!({ "byteLength": bytes })]);
        }
        put("scenes", vec![scene]);
        put("nodes", nodes);
        put("meshes", parts.meshes.clone());
        put("materials", materials);
        put("accessors", parts.accessors.clone());
        put("bufferViews", parts.views.clone());
        root
    }
}

/// The lists of a glTF file.
#[derive(Default)]
struct Parts {
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    accessors: Vec<Value>,
    views: Vec<Value>,
    images: Vec<Value>,
}

impl Parts {
    fn add(&mut self, mesh: &GlbMesh, binary: &mut Vec<u8>) {
        let [low, high] = extent(&mesh.positions);
        let place = binary.len();
        for x in mesh.positions.iter().flatten() {
            binary.extend_from_slice(&x.to_le_bytes());
        }
        self.view(place, binary.len(), ARRAY_BUFFER);
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1,
            "componentType": FLOAT,
            "count": mesh.positions.len(),
            "type": "VEC3",
            "min": low,
            "max": high,
        }));
        let place = binary.len();
        for index in mesh.triangles.iter().flatten() {
            binary.extend_from_slice(&index.to_le_bytes());
        }
        self.view(place, binary.len(), ELEMENT_ARRAY_BUFFER);
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1,
            "componentType": UNSIGNED_INT,
            "count": mesh.triangles.len() * 3,
            "type": "SCALAR",
        }));
        let last = self.accessors.len();
        let mut attributes = json!({ "POSITION": last - 2 });
        if !mesh.texcoords.is_empty() {
            let place = binary.len();
            for x in mesh.texcoords.iter().flatten() {
                binary.extend_from_slice(&x.to_le_bytes());
            }
            self.view(place, binary.len(), ARRAY_BUFFER);
            self.accessors.push(json!({
                "bufferView": self.views.len() - 1,
                "componentType": FLOAT,
                "count": mesh.texcoords.len(),
                "type": "VEC2",
            }));
            attributes["TEXCOORD_0"] = json!(last);
        }
        self.nodes
            .push(json!({ "name": mesh.name, "mesh": self.meshes.len() }));
        self.meshes.push(json!({
            "name": mesh.name,
            "primitives": [{
                "attributes": attributes,
                "indices": last - 1,
                "material": mesh.material,
            }],
        }));
    }

    /// As PNG. What follows begins at a multiple of four bytes all the same.
    fn add_image(&mut self, texture: &GlbTexture, binary: &mut Vec<u8>) -> Result<(), FormatError> {
        let height = texture.pixels.len() / (texture.width as usize).max(1);
        let size = [texture.width, height as u32];
        let file = png_bytes(size, ColorType::Rgb, texture.pixels.as_flattened())?;
        let place = binary.len();
        binary.extend_from_slice(&file);
        self.views.push(json!({
            "buffer": 0,
            "byteOffset": place,
            "byteLength": file.len(),
        }));
        self.images.push(json!({
            "bufferView": self.views.len() - 1,
            "mimeType": "image/png",
        }));
        binary.resize(binary.len().next_multiple_of(4), 0);
        Ok(())
    }

    fn view(&mut self, from: usize, to: usize, target: u32) {
        self.views.push(json!({
            "buffer": 0,
            "byteOffset": from,
            "byteLength": to - from,
            "target": target,
        }));
    }
}

fn extent(positions: &[[f32; 3]]) -> [[f32; 3]; 2] {
    let mut extent = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    for position in positions {
        for (axis, &x) in position.iter().enumerate() {
            extent[0][axis] = extent[0][axis].min(x);
            extent[1][axis] = extent[1][axis].max(x);
        }
    }
    extent
}

/// In `[0, 1]`; NaN is 0.
const fn clipped(x: f32) -> f32 {
    if x > 1.0 {
        1.0
    } else if x > 0.0 {
        x
    } else {
        0.0
    }
}

/// The shortest rotation that turns a direction to +y, as a quaternion x, y, z, w; none if it is no
/// direction or +y already.
fn upright(up: [f32; 3]) -> Option<[f32; 4]> {
    let [x, y, z] = up.map(f64::from);
    let length = (x * x + y * y + z * z).sqrt();
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let (x, y, z) = (x / length, y / length, z / length);
    if y > 1.0 - 1e-9 {
        return None;
    }
    if y < -1.0 + 1e-9 {
        return Some([1.0, 0.0, 0.0, 0.0]);
    }
    // The axis is up × y, and w one more than the cosine.
    let (a, b, w) = (-z, x, 1.0 + y);
    let norm = (a * a + b * b + w * w).sqrt();
    Some([a / norm, 0.0, b / norm, w / norm].map(|x| x as f32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra_geometry::triangle::TriangleTest;

    use crate::{GlbMaterial, GlbMesh};

    fn model() -> GlbModel {
        GlbModel {
            materials: vec![GlbMaterial {
                name: "red \"paint\"".to_owned(),
                colour: [2.0, 0.0, f32::NAN, 0.5],
                ..GlbMaterial::default()
            }],
            meshes: vec![
                GlbMesh {
                    name: "triangle".to_owned(),
                    positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, -1.0]],
                    triangles: vec![[0, 1, 2]],
                    ..GlbMesh::default()
                },
                GlbMesh::default(),
            ],
            up: Some([0.0, 0.0, 3.0]),
        }
    }

    fn number(bytes: &[u8], at: usize) -> usize {
        u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
    }

    #[test]
    fn the_file_has_its_length_its_text_and_its_data() {
        let bytes = model().to_bytes().unwrap();
        assert_eq!(&bytes[..4], b"glTF");
        assert_eq!((number(&bytes, 4), number(&bytes, 8)), (2, bytes.len()));
        let text = number(&bytes, 12);
        assert_eq!((text % 4, &bytes[16..20]), (0, &b"JSON"[..]));
        let root: Value = serde_json::from_slice(&bytes[20..20 + text]).unwrap();
        assert_eq!(
            root["meshes"].as_array().unwrap().len(),
            1,
            "empty meshes are left out"
        );
        assert_eq!(root["accessors"][0]["max"], json!([1.0, 2.0, 0.0]));
        let colour = &root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"];
        assert_eq!(*colour, json!([1.0, 0.0, 0.0, 0.5]));
        let data = 20 + text;
        assert_eq!(&bytes[data + 4..data + 8], b"BIN\0");
        assert_eq!(number(&bytes, data), 36 + 12);
        assert_eq!(root["buffers"][0]["byteLength"], 48);
        let last_position = data + 8 + 8 * 4;
        assert_eq!(
            bytes[last_position..last_position + 4],
            (-1.0_f32).to_le_bytes()
        );
    }

    #[test]
    fn nothing_is_a_model_too() {
        let bytes = GlbModel::default().to_bytes().unwrap();
        assert_eq!(number(&bytes, 8), bytes.len());
        assert!(serde_json::from_slice::<Value>(&bytes[20..]).is_ok());
    }

    #[test]
    fn what_does_not_hold_together_is_refused() {
        let broken: [fn(&mut GlbMesh); 3] = [
            |mesh| mesh.triangles[0][1] = 3,
            |mesh| mesh.positions[0][0] = f32::NAN,
            |mesh| mesh.material = 1,
        ];
        for break_it in broken {
            let mut model = model();
            break_it(&mut model.meshes[0]);
            let error = model.to_bytes().unwrap_err().to_string();
            assert!(error.contains("mesh \"triangle\""), "{error}");
        }
    }

    #[test]
    fn a_texture_is_read_back_with_its_colours_and_stays_unlit() {
        let mut model = model();
        model.materials[0] = GlbMaterial {
            name: "minutes".to_owned(),
            colour: [1.0; 4],
            texture: Some(GlbTexture {
                width: 2,
                pixels: vec![[255, 0, 0], [0, 255, 0], [0, 0, 255], [9, 99, 199]],
            }),
            is_unlit: true,
            ..GlbMaterial::default()
        };
        model.meshes[0].texcoords = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let bytes = model.to_bytes().unwrap();
        let text = number(&bytes, 12);
        let root: Value = serde_json::from_slice(&bytes[20..20 + text]).unwrap();
        assert_eq!(root["extensionsUsed"], json!(["KHR_materials_unlit"]));
        assert_eq!(root["samplers"][0]["magFilter"], NEAREST);
        let view = &root["bufferViews"][root["images"][0]["bufferView"].as_u64().unwrap() as usize];
        let [from, length] =
            ["byteOffset", "byteLength"].map(|name| view[name].as_u64().unwrap() as usize);
        let png = &bytes[28 + text + from..][..length];
        let picture = image::load_from_memory(png).unwrap().to_rgb8();
        assert_eq!(picture.get_pixel(1, 1).0, [9, 99, 199]);
        let file =
            crate::parse_gltf(&bytes, TriangleTest::default(), &crate::Limits::default()).unwrap();
        assert!(file.findings.is_empty(), "{:?}", file.findings);

        model.meshes[0].texcoords.pop();
        assert!(
            model
                .to_bytes()
                .unwrap_err()
                .to_string()
                .contains("2 texture coordinates")
        );
    }

    #[test]
    fn z_up_is_turned_to_y_up() {
        let [x, y, z, w] = upright([0.0, 0.0, 1.0]).unwrap();
        let half = std::f32::consts::FRAC_1_SQRT_2;
        assert!((x + half).abs() < 1e-6 && (w - half).abs() < 1e-6);
        assert_eq!((y, z), (0.0, 0.0));
        assert_eq!(upright([0.0, 7.0, 0.0]), None);
        assert_eq!(upright([0.0; 3]), None);
        assert!(upright([0.0, -1.0, 0.0]).is_some());
    }
}
