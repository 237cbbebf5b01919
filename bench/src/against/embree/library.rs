//! Where the shared library of Embree is.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};

/// The wheel that carries it.
pub(super) const WHEEL: &str = "embreex 4.4.0.post1";

/// Names the library, or the folder that holds it.
pub(super) const VARIABLE: &str = "OMBRA_EMBREE";

/// Where `cargo xtask bench --setup` puts it, below the checkout.
const SETUP: &str = "target/peers/embreex.libs";

/// The library: the one that was named, otherwise that of the environment variable, otherwise the one
/// that was set up.
///
/// # Errors
/// When there is none. The message says how to get it.
pub(super) fn find(named: Option<&Path>) -> anyhow::Result<PathBuf> {
    let variable = std::env::var_os(VARIABLE).map(PathBuf::from);
    if let Some(path) = named.map(Path::to_owned).or(variable) {
        return within(&path)
            .with_context(|| format!("no Embree in {}; {}", path.display(), advice()));
    }
    let found = crate::place::upward(SETUP).and_then(|folder| within(&folder));
    found.with_context(|| format!("no Embree here; {}", advice()))
}

fn advice() -> String {
    format!(
        "`cargo xtask bench --setup` fetches it ({WHEEL} of PyPI, for Linux on x86-64), or say \
         where it is with --embree or {VARIABLE}: the file libembree4….so or its folder"
    )
}

/// A file itself; of a folder the library in it.
fn within(path: &Path) -> Option<PathBuf> {
    if path.is_file() {
        return Some(path.to_owned());
    }
    let entries = path.read_dir().ok()?.flatten().map(|entry| entry.path());
    let mut libraries: Vec<_> = entries.filter(|path| is_embree(path)).collect();
    libraries.sort();
    libraries.into_iter().next()
}

/// libembree4.so, with whatever a distribution or a wheel adds to it.
fn is_embree(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with("libembree4") && name.contains(".so")
}

/// Whether this program could call it: the layouts are those of x86-64.
pub(super) fn check_machine() -> anyhow::Result<()> {
    if cfg!(all(target_arch = "x86_64", target_os = "linux")) {
        return Ok(());
    }
    bail!("Embree is called on Linux on x86-64 only")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_stands_for_the_library_in_it() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(within(folder.path()), None);
        for name in ["libtbb.so.12", "libembree4-4aef3270.so.4", "embree4.txt"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        let library = folder.path().join("libembree4-4aef3270.so.4");
        assert_eq!(within(folder.path()), Some(library.clone()));
        assert_eq!(find(Some(&library)).unwrap(), library);
    }

    #[test]
    fn where_there_is_none_the_error_says_how_to_get_it() {
        let folder = tempfile::tempdir().unwrap();
        let error = find(Some(folder.path())).unwrap_err().to_string();
        for part in ["cargo xtask bench --setup", "--embree", VARIABLE] {
            assert!(error.contains(part), "{error}");
        }
        assert_eq!(error.lines().count(), 1);
    }
}
