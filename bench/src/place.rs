//! Where things lie beside the checkout: looked for upward, so that no path of a machine on which
//! the program was built is in it.

use std::path::{Path, PathBuf};

/// The first of `relative` in this folder, in one above it, or in one above the program.
#[must_use]
pub fn upward(relative: impl AsRef<Path>) -> Option<PathBuf> {
    let starts = [std::env::current_dir(), std::env::current_exe()];
    starts.into_iter().flatten().find_map(|start| {
        let all = start.ancestors().map(|folder| folder.join(&relative));
        all.into_iter().find(|path| path.exists())
    })
}

/// The folder of outside data: `OMBRA_TEST_DATA`, otherwise `shared/data` beside the checkout.
#[must_use]
pub fn outside_data() -> Option<PathBuf> {
    match std::env::var_os("OMBRA_TEST_DATA") {
        Some(named) => Some(named.into()).filter(|folder: &PathBuf| folder.is_dir()),
        None => upward("shared/data"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_above_is_found_and_what_is_nowhere_is_not() {
        assert!(upward("Cargo.toml").is_some());
        assert_eq!(upward("no/such/thing"), None);
    }
}
