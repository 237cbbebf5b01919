//! The words of glTF 2.0, as types: the parts of the JSON that are used (Khronos Group, "glTF 2.0
//! Specification", 2.0.1, 2021, section 5). What is not named here is passed over.

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::surface::MaterialSpec;
use super::wrong;
use crate::error::FormatError;

/// The whole document. Indices are as the file has them: whether they are in range is found out
/// where they are used.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document {
    pub(super) asset: Asset,
    pub(super) scene: Option<usize>,
    #[serde(default)]
    pub(super) scenes: Vec<SceneSpec>,
    #[serde(default)]
    pub(super) nodes: Vec<NodeSpec>,
    #[serde(default)]
    pub(super) meshes: Vec<MeshSpec>,
    #[serde(default)]
    pub(super) accessors: Vec<AccessorSpec>,
    #[serde(default)]
    pub(super) buffer_views: Vec<BufferViewSpec>,
    #[serde(default)]
    pub(super) buffers: Vec<BufferSpec>,
    #[serde(default)]
    pub(super) materials: Vec<MaterialSpec>,
    #[serde(default)]
    pub(super) textures: Vec<TextureSpec>,
    #[serde(default)]
    pub(super) images: Vec<ImageSpec>,
    #[serde(default)]
    pub(super) samplers: Vec<SamplerSpec>,
    #[serde(default)]
    pub(super) cameras: Vec<CameraSpec>,
    #[serde(default)]
    pub(super) animations: Vec<IgnoredAny>,
    #[serde(default)]
    pub(super) skins: Vec<IgnoredAny>,
    #[serde(default)]
    pub(super) extensions_used: Vec<String>,
    #[serde(default)]
    pub(super) extensions_required: Vec<String>,
    #[serde(default)]
    pub(super) extensions: DocumentExtensions,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Asset {
    pub(super) version: String,
    pub(super) min_version: Option<String>,
    pub(super) generator: Option<String>,
}

#[derive(Debug, Default, Deserialize)]
pub(super) struct DocumentExtensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub(super) lights: Option<LightsSpec>,
}

#[derive(Debug, Deserialize)]
pub(super) struct LightsSpec {
    #[serde(default)]
    pub(super) lights: Vec<LightSpec>,
}

/// A light of the extension `KHR_lights_punctual`.
#[derive(Debug, Deserialize)]
pub(super) struct LightSpec {
    #[serde(rename = "type")]
    pub(super) kind: LightKind,
    #[serde(default = "white")]
    pub(super) color: [f32; 3],
    #[serde(default = "one")]
    pub(super) intensity: f32,
    pub(super) range: Option<f32>,
    #[serde(default)]
    pub(super) spot: SpotSpec,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(super) enum LightKind {
    Directional,
    Point,
    Spot,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct SpotSpec {
    pub(super) inner_cone_angle: f32,
    pub(super) outer_cone_angle: f32,
}

impl Default for SpotSpec {
    fn default() -> Self {
        Self {
            inner_cone_angle: 0.0,
            outer_cone_angle: std::f32::consts::FRAC_PI_4,
        }
    }
}

#[derive(Debug, Deserialize)]
pub(super) struct SceneSpec {
    #[serde(default)]
    pub(super) nodes: Vec<usize>,
}

#[derive(Debug, Deserialize)]
pub(super) struct NodeSpec {
    pub(super) name: Option<String>,
    #[serde(default)]
    pub(super) children: Vec<usize>,
    pub(super) matrix: Option<[f64; 16]>,
    pub(super) translation: Option<[f64; 3]>,
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
    pub(super) mesh: Option<usize>,
    pub(super) camera: Option<usize>,
    #[serde(default)]
    pub(super) extensions: NodeExtensions,
}

#[derive(Debug, Default, Deserialize)]
pub(super) struct NodeExtensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub(super) light: Option<NodeLight>,
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub(super) instancing: Option<InstancingSpec>,
}

#[derive(Debug, Deserialize)]
pub(super) struct NodeLight {
    pub(super) light: usize,
}

/// Many placements of a node's mesh, by the extension `EXT_mesh_gpu_instancing`.
#[derive(Debug, Deserialize)]
pub(super) struct InstancingSpec {
    #[serde(default)]
    pub(super) attributes: InstancingAttributes,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub(super) struct InstancingAttributes {
    pub(super) translation: Option<usize>,
    pub(super) rotation: Option<usize>,
    pub(super) scale: Option<usize>,
}

#[derive(Debug, Deserialize)]
pub(super) struct MeshSpec {
    pub(super) name: Option<String>,
    #[serde(default)]
    pub(super) primitives: Vec<PrimitiveSpec>,
}

#[derive(Debug, Deserialize)]
pub(super) struct PrimitiveSpec {
    pub(super) attributes: AttributesSpec,
    pub(super) indices: Option<usize>,
    pub(super) material: Option<usize>,
    #[serde(default = "triangles")]
    pub(super) mode: u32,
    #[serde(default)]
    pub(super) targets: Vec<IgnoredAny>,
}

/// Accessors by the names of attributes, such as `TEXCOORD_1`.
pub(super) type AttributesSpec = std::collections::BTreeMap<String, usize>;

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct AccessorSpec {
    pub(super) buffer_view: Option<usize>,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) component_type: u32,
    #[serde(default)]
    pub(super) normalized: bool,
    pub(super) count: u64,
    #[serde(rename = "type")]
    pub(super) kind: String,
    pub(super) sparse: Option<SparseSpec>,
}

#[derive(Debug, Deserialize)]
pub(super) struct SparseSpec {
    pub(super) count: u64,
    pub(super) indices: SparseIndicesSpec,
    pub(super) values: SparseValuesSpec,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseIndicesSpec {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) component_type: u32,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseValuesSpec {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: u64,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferViewSpec {
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) byte_length: u64,
    pub(super) byte_stride: Option<u64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferSpec {
    pub(super) byte_length: u64,
    pub(super) uri: Option<String>,
}

#[derive(Debug, Deserialize)]
pub(super) struct TextureSpec {
    pub(super) sampler: Option<usize>,
    pub(super) source: Option<usize>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct ImageSpec {
    pub(super) uri: Option<String>,
    pub(super) buffer_view: Option<usize>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SamplerSpec {
    pub(super) mag_filter: Option<u32>,
    pub(super) wrap_s: Option<u32>,
    pub(super) wrap_t: Option<u32>,
}

#[derive(Debug, Deserialize)]
pub(super) struct CameraSpec {
    pub(super) perspective: Option<PerspectiveSpec>,
    pub(super) orthographic: Option<OrthographicSpec>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct PerspectiveSpec {
    pub(super) yfov: f32,
    pub(super) aspect_ratio: Option<f32>,
}

#[derive(Debug, Deserialize)]
pub(super) struct OrthographicSpec {
    pub(super) xmag: f32,
    pub(super) ymag: f32,
}

const fn triangles() -> u32 {
    4
}

pub(super) const fn white() -> [f32; 3] {
    [1.0; 3]
}

pub(super) const fn one() -> f32 {
    1.0
}

/// Reads the JSON of a file. An error says where in the document it is, by name.
pub(super) fn parse(json: &[u8]) -> Result<Document, FormatError> {
    // Some editors put a byte order mark before the text.
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    let mut reader = serde_json::Deserializer::from_slice(json);
    let document: Document = serde_path_to_error::deserialize(&mut reader).map_err(|error| {
        let place = error.path().to_string();
        let place = if place == "." {
            "JSON".to_owned()
        } else {
            place
        };
        wrong(place, error.into_inner().to_string())
    })?;
    reader
        .end()
        .map_err(|error| wrong("JSON", error.to_string()))?;
    check_version(&document.asset)?;
    Ok(document)
}

fn check_version(asset: &Asset) -> Result<(), FormatError> {
    let major = |version: &str| version.split('.').next() == Some("2");
    if !major(&asset.version) {
        let message = format!("{:?}; version 2 is what is read here", asset.version);
        return Err(wrong("asset.version", message));
    }
    match &asset.min_version {
        Some(version) if version != "2.0" => {
            let message = format!("{version:?}; version 2.0 is what is read here");
            Err(wrong("asset.minVersion", message))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(json: &str) -> String {
        parse(json.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn an_error_says_where_in_the_document_it_is() {
        let asset = r#""asset": {"version": "2.0"}"#;
        let error = error(&format!(
            r#"{{{asset}, "accessors": [{{"componentType": 5126, "count": -3, "type": "VEC3"}}]}}"#
        ));
        assert!(
            error.starts_with("accessors[0].count: invalid value: integer `-3`, expected u64"),
            "{error}"
        );
    }

    #[test]
    fn other_versions_are_refused() {
        assert_eq!(
            error(r#"{"asset": {"version": "1.0"}}"#),
            r#"asset.version: "1.0"; version 2 is what is read here"#
        );
        assert!(error(r#"{"asset": {"version": "2.0", "minVersion": "2.1"}}"#).contains("2.1"));
        assert!(error("{}").contains("missing field `asset`"));
        assert!(parse(b"\xef\xbb\xbf{\"asset\": {\"version\": \"2.0\"}}").is_ok());
    }

    #[test]
    fn broken_json_is_named_with_its_line() {
        assert!(error("{\n\"asset\": [").contains("line 2"));
        let asset = r#"{"asset": {"version": "2.0"}}"#;
        assert!(error(&format!("{asset} x")).contains("trailing characters"));
        let deep = "[".repeat(1_000_000);
        assert!(error(&format!(r#"{{"extras": {deep}"#)).contains("EOF while parsing"));
    }
}
