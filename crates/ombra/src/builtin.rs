//! The scenes that come with ombra, by name: the files of the folder `scenes`.

/// A scene that comes with ombra.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Builtin {
    /// The name that a person types.
    pub name: &'static str,
    /// What there is to see, in one line.
    pub line: &'static str,
    /// The scene file.
    pub text: &'static str,
}

macro_rules! scene {
    ($name:literal, $line:literal) => {
        Builtin {
            name: $name,
            line: $line,
            text: include_str!(concat!("../../../scenes/", $name, ".toml")),
        }
    };
}

/// The scene that is rendered when nobody names one.
pub const DEFAULT: &str = "whitted";

/// All of them, the default first.
pub const ALL: &[Builtin] = &[
    scene!("whitted", "glass and mirror balls over a checkered floor"),
    scene!(
        "cornell",
        "the Cornell box with a mirror ball and a glass ball"
    ),
    scene!("shapes", "every shape there is, one of each"),
    scene!("teapot", "a triangle mesh: Newell's teapot on a table"),
    scene!(
        "card",
        "Kensler's business card: mirror balls that spell his initials"
    ),
];

/// Files that built-in scenes refer to.
pub(crate) const ASSETS: &[(&str, &[u8])] =
    &[("teapot.obj", include_bytes!("../../../scenes/teapot.obj"))];

/// The scene of that name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Builtin> {
    ALL.iter().find(|scene| scene.name == name)
}
