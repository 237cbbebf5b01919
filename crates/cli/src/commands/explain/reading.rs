//! Reads a tree that was written before. Fuzzed as `explained`.

use std::fs;

use anyhow::{Context as _, bail};
use ombra::render::MAX_DEPTH;

use super::document::{Document, FORMAT};

/// The most bytes of a file with a tree.
const MAX_BYTES: u64 = 1 << 30;

/// A file's tree.
pub(crate) fn read(path: &str) -> anyhow::Result<Document> {
    let bytes = fs::metadata(path).with_context(|| path.to_owned())?.len();
    if bytes > MAX_BYTES {
        bail!("{path}: {bytes} bytes, over the limit of {MAX_BYTES}; write it with --sample K");
    }
    let text = fs::read_to_string(path).with_context(|| format!("{path}: cannot be read"))?;
    parsed(path, &text)
}

/// The tree in a text. What it promises is what the comparison relies on: there is a sample, each has
/// rays, numbered from 0, each after its parent, and nested no deeper than rays of ombra are.
pub(crate) fn parsed(path: &str, text: &str) -> anyhow::Result<Document> {
    let document: Document = serde_json::from_str(text).map_err(|error| {
        anyhow::anyhow!("{path}: not what `ombra explain --json` writes: {error}")
    })?;
    if document.heading.format != FORMAT {
        bail!(
            "{path}: written in format {}, and this version reads format {FORMAT}",
            document.heading.format
        );
    }
    if document.samples.is_empty() {
        bail!(
            "{path}: `samples` is empty, so there is nothing to compare; it has one entry a sample"
        );
    }
    for sample in &document.samples {
        if sample.rays.is_empty() {
            bail!(
                "{path}: sample {}: `rays` is empty; the first is the camera's",
                sample.sample
            );
        }
        let mut nested: Vec<u32> = Vec::with_capacity(sample.rays.len());
        for (index, ray) in sample.rays.iter().enumerate() {
            let above = ray.parent.and_then(|parent| nested.get(parent));
            nested.push(above.map_or(0, |above| above + 1));
            if nested[index] > MAX_DEPTH + 1 {
                bail!(
                    "{path}: sample {}: ray {index} is nested deeper than {MAX_DEPTH} bounces allow",
                    sample.sample
                );
            }
            if ray.ray != index || ray.parent.is_some_and(|parent| parent >= index) {
                bail!(
                    "{path}: sample {}: ray {index} is out of order; rays are numbered from 0, each after its parent",
                    sample.sample
                );
            }
        }
    }
    Ok(document)
}

#[cfg(test)]
mod tests {
    use super::super::part::parting;
    use super::*;

    const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fuzz/corpus/explained");

    fn compared_with_itself(text: &str) -> bool {
        parsed("tree.json", text).is_ok_and(|document| {
            let compared = |sample| parting(sample, sample).is_ok_and(|part| part.is_none());
            document.samples.iter().all(compared)
        })
    }

    #[test]
    fn what_fuzzing_starts_from_is_read_whole_and_refused_cut() {
        let mut files = 0;
        for file in fs::read_dir(CORPUS).unwrap() {
            let path = file.unwrap().path();
            let text = fs::read_to_string(&path).unwrap();
            let text = text.trim_end();
            assert!(compared_with_itself(text), "{path:?}");
            for end in (0..text.len()).filter(|&end| text.is_char_boundary(end)) {
                assert!(!compared_with_itself(&text[..end]), "{path:?} up to {end}");
            }
            files += 1;
        }
        assert!(files > 0, "{CORPUS}");
    }
}
