//! Reads a ray tree as `ombra explain --diff` does, and compares it with itself. The command line is no
//! library, so its files are taken in by their paths.

#![no_main]
#![expect(dead_code, reason = "writing is not fuzzed")]

#[path = "../../crates/cli/src/commands/explain"]
mod explain {
    pub(crate) mod document;
    pub(crate) mod number;
    pub(crate) mod part;
    pub(crate) mod reading;
    pub(crate) mod text;
}

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    match explain::reading::parsed("tree.json", text) {
        Ok(document) => {
            for sample in &document.samples {
                let parting = explain::part::parting(sample, sample).expect("it is what was read");
                assert!(parting.is_none(), "a tree differs from itself");
            }
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1, "{error}"),
    }
});
