//! Which extensions are read.

use super::document::Document;
use super::notes::Notes;
use super::wrong;
use crate::error::FormatError;

/// Those that are read, in whole or in part.
const READ: &[&str] = &[
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// Refuses a document that cannot be shown without an extension that is not read here; others that
/// are not are noted.
pub(super) fn check(document: &Document, notes: &mut Notes) -> Result<(), FormatError> {
    let unknown = |names: &[String]| -> Vec<String> {
        let names = names.iter().filter(|name| !READ.contains(&name.as_str()));
        names.map(|name| format!("{name:?}")).collect()
    };
    let required = unknown(&document.extensions_required);
    if !required.is_empty() {
        let message = format!(
            "needs {}, which is not read here; what is: {}",
            required.join(", "),
            READ.join(", ")
        );
        return Err(wrong("extensionsRequired", message));
    }
    for name in unknown(&document.extensions_used) {
        notes.add("extensionsUsed", format!("{name} is not read"));
    }
    Ok(())
}
