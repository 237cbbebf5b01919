//! Both licences are there, whole, and are those that the manifests name.

use std::fs;

use anyhow::{Context, Result, ensure};

use crate::cargo;

/// The expression in the root manifest.
const EXPRESSION: &str = "license = \"MIT OR Apache-2.0\"";

/// The licence files, and a sentence near the end of each: a file cut short is no licence.
const FILES: [(&str, &str, &str); 2] = [
    ("LICENSE-MIT", "MIT License", "DEALINGS IN THE"),
    (
        "LICENSE-APACHE",
        "Apache License",
        "END OF TERMS AND CONDITIONS",
    ),
];

/// Checks the licence files.
///
/// # Errors
/// The first thing that is wrong.
pub(crate) fn run() -> Result<()> {
    let read = |name: &str| {
        fs::read_to_string(cargo::root().join(name)).with_context(|| format!("cannot read {name}"))
    };
    for (name, first, last) in FILES {
        let text = read(name)?;
        ensure!(text.contains(first), "{name} does not hold \"{first}\"");
        ensure!(
            text.contains(last),
            "{name} does not hold \"{last}\": cut short?"
        );
    }
    let manifest = read("Cargo.toml")?;
    ensure!(
        manifest.contains(EXPRESSION),
        "Cargo.toml does not say {EXPRESSION}"
    );
    println!("both licences are there");
    Ok(())
}

#[cfg(test)]
mod tests {
    #[test]
    fn both_licences_are_there() {
        super::run().unwrap();
    }
}
