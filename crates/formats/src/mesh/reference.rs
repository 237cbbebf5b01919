//! Names of other files within a model.

use std::path::{Component, Path, PathBuf};

use crate::finding::Finding;

/// The file that a model in `folder` means by `name`, if it is there and within that folder
/// (links followed); otherwise what to tell the user. The path begins with `folder` as it is given,
/// so that messages name files as the user does.
///
/// Both `/` and `\` part the folders of a name. `what` is "materials file" or "texture".
pub(crate) fn resolve(folder: &Path, name: &str, what: &'static str) -> Result<PathBuf, Finding> {
    let outside = || Finding::OutsideFolder {
        what,
        name: name.to_owned(),
    };
    let missing = || Finding::MissingFile {
        what,
        name: name.to_owned(),
    };
    let relative = PathBuf::from(name.replace('\\', "/"));
    let climbs = |c: Component<'_>| !matches!(c, Component::Normal(_) | Component::CurDir);
    // A drive letter is a prefix only on the system that knows it.
    let drive = name.as_bytes().get(1) == Some(&b':');
    if drive || relative.components().any(climbs) {
        return Err(outside());
    }
    let file = folder.join(relative);
    // The model's folder is "" for a bare file name, which no system call takes.
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let real_folder = folder.canonicalize().map_err(|_| missing())?;
    let real_file = file.canonicalize().map_err(|_| missing())?;
    if !real_file.starts_with(&real_folder) {
        return Err(outside());
    }
    if real_file.is_file() {
        Ok(file)
    } else {
        Err(missing())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_within_the_folder_are_found() {
        let outer = tempfile::tempdir().unwrap();
        let folder = outer.path().join("model");
        std::fs::create_dir_all(folder.join("maps")).unwrap();
        std::fs::write(outer.path().join("secret"), "").unwrap();
        std::fs::write(folder.join("maps/wood.png"), "").unwrap();
        let resolve = |name: &str| resolve(&folder, name, "texture");
        assert_eq!(resolve("maps/wood.png"), Ok(folder.join("maps/wood.png")));
        assert!(resolve("maps\\wood.png").is_ok());
        for name in [
            "../secret",
            "maps/../../secret",
            "/etc/passwd",
            "..\\secret",
            "C:\\secret",
        ] {
            let found = resolve(name);
            assert!(
                matches!(found, Err(Finding::OutsideFolder { .. })),
                "{name}"
            );
        }
        for name in ["wood.png", "maps", "", "."] {
            let found = resolve(name);
            assert!(matches!(found, Err(Finding::MissingFile { .. })), "{name}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_out_of_the_folder_are_not_followed() {
        let outer = tempfile::tempdir().unwrap();
        let folder = outer.path().join("model");
        std::fs::create_dir(&folder).unwrap();
        std::fs::write(outer.path().join("secret"), "").unwrap();
        std::os::unix::fs::symlink("../secret", folder.join("wood.png")).unwrap();
        let found = resolve(&folder, "wood.png", "texture");
        assert!(matches!(found, Err(Finding::OutsideFolder { .. })));
    }
}
