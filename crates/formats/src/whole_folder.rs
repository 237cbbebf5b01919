//! Folders of our own making that are either whole or as they were.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::error::{Fault, FormatError};
use crate::image::write_error;

/// A folder that is being filled beside its place, under another name, and takes it when it is whole; dropped before, nothing
/// is left behind.
#[derive(Debug)]
pub(crate) struct WholeFolder {
    path: PathBuf,
    beside: TempDir,
}

/// What may lie in a folder that is replaced.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kind {
    /// What is in it, for people: "tiles".
    pub(crate) what: &'static str,
    /// The file that all such folders have, JSON with a member `generator` that begins with "ombra".
    pub(crate) marker: &'static str,
    /// Whether another entry of this name is ours.
    pub(crate) is_own: fn(&str) -> bool,
}

impl WholeFolder {
    /// Beside `path`, where there is nothing, an empty folder, or one of this kind that ombra has written.
    pub(crate) fn create(path: &Path, kind: Kind) -> Result<Self, FormatError> {
        // Without a dot or a slash at its end, which say where the folder is and not what it is called.
        let path: &Path = &path.components().collect::<PathBuf>();
        can_replace(path, kind).map_err(|error| error.in_file(path))?;
        let folder = parent(path);
        if !folder.is_dir() {
            let folder = folder.to_owned();
            return Err(FormatError::file(Fault::FolderMissing { folder }).in_file(path));
        }
        let beside = tempfile::Builder::new()
            .prefix(".ombra-")
            .tempdir_in(folder);
        let beside = beside.map_err(|error| write_error(error).in_file(path))?;
        let created = fs::create_dir(beside.path().join(NEW));
        created.map_err(|error| write_error(error).in_file(path))?;
        Ok(Self {
            path: path.to_owned(),
            beside,
        })
    }

    /// Where files are written.
    pub(crate) fn path(&self) -> PathBuf {
        self.beside.path().join(NEW)
    }

    /// Takes the place.
    pub(crate) fn finish(self) -> Result<(), FormatError> {
        let Self { path, beside } = self;
        let (new, old) = (beside.path().join(NEW), beside.path().join("old"));
        let replace = || {
            let was_there = path.is_dir();
            if was_there {
                fs::rename(&path, &old)?;
            }
            fs::rename(&new, &path).inspect_err(|_| {
                if was_there {
                    // The other error is told; this one could only say the same.
                    let _ = fs::rename(&old, &path);
                }
            })
        };
        replace().map_err(|error| write_error(error).in_file(&path))
    }
}

/// The name of what is being written; a folder of its own has the permissions of any new folder.
const NEW: &str = "new";

fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Whether there is a name to take, and nothing of others' is lost.
fn can_replace(path: &Path, kind: Kind) -> Result<(), FormatError> {
    if path.file_name().is_none() {
        // Such as `.`: what is there could not give way.
        let text = format!(
            "a folder of {} has a name of its own: name one, such as ./{}",
            kind.what, kind.what
        );
        return Err(FormatError::file(Fault::Description(text)));
    }
    let entries = match fs::read_dir(path) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(write_error(error)),
    };
    let mut names = Vec::new();
    for entry in entries {
        let name = entry.map_err(write_error)?.file_name();
        names.push(name.to_string_lossy().into_owned());
    }
    names.sort_unstable();
    let is_foreign = |name: &&String| **name != kind.marker && !(kind.is_own)(name);
    let foreign = names.iter().find(is_foreign);
    let is_marked = fs::read(path.join(kind.marker)).is_ok_and(|text| is_ours(&text));
    match (foreign.or(names.first().filter(|_| !is_marked)), kind.what) {
        (None, _) => Ok(()),
        (Some(name), what) => Err(FormatError::file(Fault::FolderTaken {
            what,
            name: name.clone(),
        })),
    }
}

fn is_ours(text: &[u8]) -> bool {
    let marker = serde_json::from_slice::<serde_json::Value>(text);
    marker.is_ok_and(|marker| {
        let generator = marker["generator"].as_str();
        generator.is_some_and(|generator| generator.starts_with("ombra"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const KIND: Kind = Kind {
        what: "numbers",
        marker: "numbers.json",
        is_own: |name| name.parse::<u32>().is_ok(),
    };

    fn fill(path: &Path, name: &str) -> Result<(), FormatError> {
        let folder = WholeFolder::create(path, KIND)?;
        fs::write(
            folder.path().join("numbers.json"),
            r#"{"generator": "ombra 0"}"#,
        )
        .unwrap();
        fs::write(folder.path().join(name), "").unwrap();
        folder.finish()
    }

    fn names(path: &Path) -> Vec<String> {
        let entries = fs::read_dir(path).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn our_own_folder_is_replaced_and_no_other() {
        let base = tempfile::tempdir().unwrap();
        let path = base.path().join("out");
        fill(&path, "1").unwrap();
        fill(&path, "2").unwrap();
        assert_eq!(names(&path), ["2", "numbers.json"]);
        assert_eq!(names(base.path()), ["out"], "nothing is left behind");

        fs::write(path.join("notes.txt"), "mine").unwrap();
        let error = fill(&path, "3").unwrap_err().to_string();
        assert!(error.contains("notes.txt"), "{error}");
        assert_eq!(names(&path), ["2", "notes.txt", "numbers.json"]);

        let other = base.path().join("other");
        fs::create_dir(&other).unwrap();
        fill(&other, "1").unwrap();
        fs::write(other.join("numbers.json"), "{}").unwrap();
        assert!(fill(&other, "2").is_err(), "not marked as ours");
        assert_eq!(names(&other), ["1", "numbers.json"]);
        fs::write(base.path().join("file"), "").unwrap();
        assert!(fill(&base.path().join("file"), "1").is_err());
        let error = fill(&base.path().join("no/such"), "1")
            .unwrap_err()
            .to_string();
        assert!(error.contains("does not exist"), "{error}");
        assert_eq!(names(base.path()), ["file", "other", "out"]);

        fill(&base.path().join("dots/."), "1").unwrap();
        assert_eq!(names(&base.path().join("dots")), ["1", "numbers.json"]);
        for path in [".", "..", "/", ""] {
            let error = fill(Path::new(path), "1").unwrap_err().to_string();
            assert!(error.contains("name one, such as ./numbers"), "{error}");
        }
    }
}
