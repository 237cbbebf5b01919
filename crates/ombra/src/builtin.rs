//! The scenes that come with ombra, by name: the files of the folder `scenes`.

use ombra_formats::FormatError;
use ombra_formats::minray::{Contest, parse_contest};

/// A scene that comes with ombra.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Builtin {
    /// The name that a person types.
    pub name: &'static str,
    /// What there is to see, in one line.
    pub line: &'static str,
    /// The file.
    pub text: &'static str,
    /// What kind of file it is.
    pub kind: BuiltinKind,
}

/// The kinds of files that scenes come in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltinKind {
    /// A scene file.
    Scene,
    /// A `ray.h` of the minimal ray tracing contest.
    Contest,
}

impl Builtin {
    /// The scene of the contest that this is; `None` if it is none.
    ///
    /// # Errors
    /// When its file does not hold one.
    pub fn contest(&self) -> Option<Result<Contest, FormatError>> {
        (self.kind == BuiltinKind::Contest).then(|| parse_contest(self.text.as_bytes()))
    }
}

macro_rules! scene {
    ($name:literal, $line:literal) => {
        Builtin {
            name: $name,
            line: $line,
            text: include_str!(concat!("../../../scenes/", $name, ".toml")),
            kind: BuiltinKind::Scene,
        }
    };
}

macro_rules! contest {
    ($name:literal, $file:literal, $line:literal) => {
        Builtin {
            name: $name,
            line: $line,
            text: include_str!(concat!("../../../scenes/minray/", $file, ".h")),
            kind: BuiltinKind::Contest,
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
    contest!(
        "minray",
        "test1",
        "the minimal ray tracing contest of 1987: a glass ball before two others"
    ),
    contest!(
        "minray:test2",
        "test2",
        "its second scene: through a bubble that shines a little"
    ),
    contest!(
        "minray:test3",
        "test3",
        "its third scene: two rows of balls, and a lamp overhead"
    ),
];

/// Files that built-in scenes refer to.
pub(crate) const ASSETS: &[(&str, &[u8])] =
    &[("teapot.obj", include_bytes!("../../../scenes/teapot.obj"))];

/// The scene of that name. The contest's first scene, `minray`, is `minray:test1` as well.
#[must_use]
pub fn find(name: &str) -> Option<&'static Builtin> {
    let name = if name == "minray:test1" {
        "minray"
    } else {
        name
    };
    ALL.iter().find(|scene| scene.name == name)
}
