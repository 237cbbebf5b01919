//! How a picture came about, written into its file.

/// What is written beside the pixels, as far as it is known.
///
/// PNG files hold it as text chunks, EXR files as attributes, PPM files as comments; PFM files have
/// no place for it. The names are those of [`entries`](Self::entries), in EXR files with "ombra."
/// before them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metadata {
    /// The command that made it.
    pub command: Option<String>,
    /// The program and its version.
    pub version: Option<String>,
    /// A hash of the scene's description.
    pub scene_hash: Option<String>,
    /// The seed of the samples.
    pub seed: Option<u64>,
    /// How long it took, in seconds. Leave it out where the same picture should be the same bytes.
    pub seconds: Option<f64>,
}

impl Metadata {
    /// Names and values of what is known, in a fixed order: `command`, `version`, `scene-hash`,
    /// `seed`, `seconds`.
    #[must_use]
    pub fn entries(&self) -> Vec<(&'static str, String)> {
        let entries = [
            ("command", self.command.clone()),
            ("version", self.version.clone()),
            ("scene-hash", self.scene_hash.clone()),
            ("seed", self.seed.map(|seed| seed.to_string())),
            ("seconds", self.seconds.map(|s| format!("{s:.3}"))),
        ];
        let known = entries.into_iter();
        known
            .filter_map(|(name, value)| Some((name, value?)))
            .collect()
    }
}
