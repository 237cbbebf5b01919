//! Reading and writing whole files.

mod broken;
mod fuzzed;
mod gltf;
mod hostile;
mod images;
mod materials;
mod models;
mod real;
mod scenes;

use std::path::{Path, PathBuf};

use ombra_formats::{Limits, Model, read_model};
use tempfile::TempDir;

/// A folder with files of these names and contents.
struct Folder(TempDir);

impl Folder {
    fn with(files: &[(&str, &[u8])]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        for (name, content) in files {
            std::fs::write(folder.path().join(name), content).unwrap();
        }
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }
}

fn read(name: &str, content: impl AsRef<[u8]>) -> Model {
    try_read(name, content).unwrap_or_else(|error| panic!("{error}"))
}

/// The model, or the error's text after the folder.
fn try_read(name: &str, content: impl AsRef<[u8]>) -> Result<Model, String> {
    let folder = Folder::with(&[(name, content.as_ref())]);
    read_in(&folder, name)
}

fn read_in(folder: &Folder, name: &str) -> Result<Model, String> {
    read_model(folder.path(name), &Limits::default()).map_err(|error| {
        let text = error.to_string();
        assert!(!text.contains('\n'), "an error is one line: {text}");
        let prefix = format!("{}/", folder.0.path().display());
        text.strip_prefix(&prefix).unwrap_or(&text).to_owned()
    })
}

fn findings(model: &Model) -> Vec<String> {
    model.findings.iter().map(ToString::to_string).collect()
}

fn gzip(content: &[u8]) -> Vec<u8> {
    use std::io::Write;
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packed.write_all(content).unwrap();
    packed.finish().unwrap()
}

/// Data from outside the project; `None`, and a line that says so, where it is not there.
fn outside_data(name: &str) -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("OMBRA_TEST_DATA").map_or(beside, PathBuf::from);
    let path = folder.join(name);
    if path.exists() {
        return Some(path);
    }
    eprintln!("skipped: {} is not there", path.display());
    None
}
