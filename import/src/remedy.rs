//! What to do about a problem or a doubtful point, as data that each program words in its own way.

use crate::host::shown;
use std::fmt;

/// Something to do about a [`Problem`](crate::Problem) or a [`Warning`](crate::Warning). Its `Display` is an imperative in the words
/// of the command line: "use --flip". A program that offers it in another way gives its own words to
/// [`Warning::worded`](crate::Warning::worded) and [`Problem::worded`](crate::Problem::worded).
///
/// ```
/// use pinhole_import::{read_obj, Remedy};
/// let sheet = read_obj(b"v 0 0 0\nv 3 0 0\nv 3 2 0\nf 1 2 3\n", "sheet.obj".as_ref())?;
/// let warning = &sheet.warnings[0];
/// assert_eq!(warning.remedies(), [Remedy::CloseSurface, Remedy::TwoSided]);
/// let page = warning.worded(|remedy| match remedy {
///     Remedy::TwoSided => "press the button “both sides”".into(),
///     other => other.to_string(),
/// });
/// assert!(page.ends_with("show nothing from behind: close the surface, or press the button “both sides”"), "{page}");
/// # Ok::<(), pinhole_import::ImportError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Remedy {
    /// Set [`Options::two_sided`](crate::Options::two_sided).
    TwoSided,
    /// Set [`Options::fix_winding`](crate::Options::fix_winding).
    FixWinding,
    /// Set [`Options::fix_winding`](crate::Options::fix_winding) and clear [`Options::flip`](crate::Options::flip).
    FixWindingNotFlip,
    /// Set [`Options::flip`](crate::Options::flip).
    Flip,
    /// Clear [`Options::flip`](crate::Options::flip).
    NotFlip,
    /// Set [`Options::edges`](crate::Options::edges) to [`Edges::None`](crate::Edges::None).
    NoEdges,
    /// Clear [`Options::edge_faces`](crate::Options::edge_faces).
    NoEdgeFaces,
    /// Set [`Options::fit`](crate::Options::fit).
    Fit,
    /// Set [`Options::step`](crate::Options::step) to 2 to this power.
    Step(i8),
    /// Set [`Options::centre`](crate::Options::centre) to [`Centre::Box`](crate::Centre::Box).
    CentreBox,
    /// Set [`Options::decimate`](crate::Options::decimate) to at most this number of triangles; needs the feature `decimate`.
    Decimate(usize),
    /// Set [`Options::texture`](crate::Options::texture) to at most this number of colours.
    TextureColors(usize),
    /// Build this crate with the feature of this name.
    Feature(&'static str),
    /// Close the surface in a modelling program.
    CloseSurface,
    /// Separate bodies that touch.
    SeparateBodies,
    /// Split the model into several files.
    SplitModel,
    /// Leave out parts that lie far from the others, so that the grid becomes finer.
    LeaveOutFar,
    /// Reduce the number of faces in a modelling program.
    ReduceModel,
    /// Give the model another unit.
    OtherUnit,
    /// Copy or export the file again: it is incomplete.
    CopyAgain,
    /// Export the model again.
    ExportAgain,
    /// Repair or export the model again.
    Repair,
    /// Export the model in a format that this crate reads.
    ExportFormat,
    /// Export the model as a mesh.
    ExportMesh,
    /// Export triangles instead of polygons.
    ExportTriangles,
    /// Put the file beside the model.
    PutBeside,
    /// Set [`Options::root`](crate::Options::root) to the file's folder.
    Root,
    /// Paint the picture so that the texture repeats less often.
    RepeatLess,
    /// Put the pictures of all materials into one.
    OnePicture,
    /// Make the picture smaller.
    ReducePicture,
    /// Resize the picture in a paint program, where the quality matters.
    ResizePicture,
    /// Draw the faces in their colours.
    DrawColors,
}

impl Remedy {
    /// Whether it is a field of [`Options`](crate::Options).
    fn is_option(self) -> bool {
        self.to_string().contains("--")
    }

    /// The words for the user of a build script, who has fields of [`Options`](crate::Options).
    fn in_script(self) -> String {
        let fixed = match self {
            Self::TwoSided => "use `two_sided: true`",
            Self::FixWinding => "use `fix_winding: true`",
            Self::FixWindingNotFlip => "use `fix_winding: true` instead of `flip: true`",
            Self::Flip => "use `flip: true`",
            Self::NotFlip => "leave out `flip: true`",
            Self::NoEdges => "use `edges: Edges::None`",
            Self::NoEdgeFaces => "leave out `edge_faces`",
            Self::Fit => "use `fit: Some(LENGTH)`",
            Self::Root => "use `root: Some(FOLDER)`",
            Self::CentreBox => "use `centre: Centre::Box`",
            Self::Decimate(_) if cfg!(feature = "decimate") => "use `decimate: Some(N)`",
            Self::Decimate(_) => "use `decimate: Some(N)` with features = [\"decimate\"] of pinhole-import in Cargo.toml and a C++ compiler",
            Self::Step(exponent) => return format!("use `step: Some(2f64.powi({exponent}))`"),
            Self::TextureColors(colors) => {
                return format!(
                    "use `texture: Some(TextureFormat {{ colors: {colors}, ..TextureFormat::default() }})`"
                )
            }
            Self::Feature(name) => return format!("give pinhole-import the feature `{name}` in Cargo.toml"),
            other => return other.to_string(),
        };
        fixed.into()
    }
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::TwoSided => "use --two-sided",
            Self::FixWinding => "use --fix-winding",
            Self::FixWindingNotFlip => "use --fix-winding instead of --flip",
            Self::Flip => "use --flip",
            Self::NotFlip => "leave out --flip",
            Self::NoEdges => "use pinhole-import --edges none",
            Self::NoEdgeFaces => "leave out --edge-faces",
            Self::Fit => "use pinhole-import --fit LENGTH",
            Self::Decimate(_) if cfg!(feature = "decimate") => "use pinhole-import --decimate N",
            Self::Decimate(_) => "use pinhole-import --decimate N of a build with the feature `decimate`",
            Self::Step(exponent) => return write!(f, "use --step 2^{exponent}"),
            Self::CentreBox => "use --centre box",
            Self::TextureColors(colors) => return write!(f, "use --texture {colors}"),
            Self::Feature(name) => return write!(f, "install it with the feature `{name}`"),
            Self::CloseSurface => "close the surface",
            Self::SeparateBodies => "separate the bodies",
            Self::SplitModel => "split the model",
            Self::LeaveOutFar => "leave out parts that lie far from the others",
            Self::ReduceModel => "reduce it in a modelling program",
            Self::OtherUnit => "use another unit",
            Self::CopyAgain => "copy or export it again",
            Self::ExportAgain => "export the model again",
            Self::Repair => "repair or export the model again",
            Self::ExportFormat => "export .obj or .stl",
            Self::ExportMesh => "export the model as a mesh",
            Self::ExportTriangles => "export triangles",
            Self::PutBeside => "put it beside the model",
            Self::Root => "use --root FOLDER",
            Self::RepeatLess => "repeat it less often",
            Self::OnePicture => "put them into one picture",
            Self::ReducePicture => "reduce the picture",
            Self::ResizePicture => "resize the picture if it matters how",
            Self::DrawColors => "draw them in their colours",
        })
    }
}

/// What to do about a grid that is too coarse: the option, if one helps.
pub(crate) fn for_finer_grid(option: Option<Remedy>) -> Vec<Remedy> {
    option.map_or(vec![Remedy::SplitModel, Remedy::LeaveOutFar], |option| vec![option])
}

/// Defines an enum of messages: each variant has its words beside it, as a list of the text and of the remedies that follow it, or as a
/// block that gives a [`Said`].
macro_rules! messages {
    ($(#[$attribute:meta])* pub enum $enum:ident { $(
        $(#[$doc:meta])*
        $name:ident $(($($value:ident: $of:ty),+))? $({ $($field:ident: $type:ty),+ })? => $said:tt
    )+ }) => {
        $(#[$attribute])*
        pub enum $enum {
            $($(#[$doc])* $name $(($($of),+))? $({ $($field: $type),+ })?,)+
        }

        impl $enum {
            /// What to do about it: alternatives.
            pub fn remedies(&self) -> Vec<Remedy> {
                self.said().remedies
            }

            /// The message in one line, with the remedies in a program's own words: imperatives such as "use --flip".
            pub fn worded(&self, words: impl Fn(Remedy) -> String) -> String {
                self.said().worded(words)
            }

            #[allow(unused_variables)] // the words may leave out what the variant holds
            pub(crate) fn said(&self) -> Said {
                use Remedy::*;
                match self {
                    $(Self::$name $(($($value),+))? $({ $($field),+ })? => said!($said),)+
                }
            }
        }

        impl std::fmt::Display for $enum {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(&self.worded(|remedy| remedy.to_string()))
            }
        }
    };
}

/// The words of one variant.
macro_rules! said {
    ([$text:literal $(, $remedy:expr)*]) => { Said::new(format!($text), [$($remedy),*]) };
    ([$what:expr $(, $remedy:expr)*]) => { Said::new($what, [$($remedy),*]) };
    ($said:block) => { $said };
}

pub(crate) use {messages, said};

/// A message with a gap for remedies.
#[derive(Default)]
pub(crate) struct Said {
    /// The fault in words, with the punctuation that remedies follow.
    pub(crate) what: String,
    /// Alternatives.
    pub(crate) remedies: Vec<Remedy>,
    /// What follows the remedies.
    pub(crate) then: &'static str,
}

impl Said {
    pub(crate) fn new(what: impl Into<String>, remedies: impl Into<Vec<Remedy>>) -> Self {
        Self { what: what.into(), remedies: remedies.into(), then: "" }
    }

    /// One line, with the control characters of names escaped.
    pub(crate) fn worded(&self, words: impl Fn(Remedy) -> String) -> String {
        let phrases: Vec<_> = self.remedies.iter().map(|&remedy| words(remedy)).collect();
        let mut line = self.what.clone();
        for (place, phrase) in phrases.iter().enumerate() {
            let before = place.checked_sub(1).map(|place| &phrases[place]);
            // Words that two phrases begin with are said once.
            let said = ["use pinhole-import ", "use "].into_iter().find(|start| {
                phrase.starts_with(start) && before.is_some_and(|before| before.starts_with(start))
            });
            line.push_str(if before.is_some() { ", or " } else { "" });
            line.push_str(&phrase[said.map_or(0, str::len)..]);
        }
        shown(&(line + self.then))
    }

    /// The line for the user of a build script.
    pub(crate) fn in_script(&self) -> String {
        let line = self.worded(Remedy::in_script);
        match self.remedies.iter().any(|remedy| remedy.is_option()) {
            true => line + " (in the `Options` of build.rs)",
            false => line,
        }
    }
}
