//! Errors of the library, as the page says them. The importer and the page keep nearly all of them out: a sentence for those that
//! are left is enough, where the library's own sentences would take 4 KB of the page.

use pinhole::{BufferError, LightError, MeshError, TextureError};

/// The importer's meshes can be wrong in the unit of their vertices alone.
pub(crate) fn mesh(_: MeshError) -> String {
    "the model is too large or too small for a mesh: choose another unit".into()
}

/// The page gives buffers of the lengths that are asked for.
pub(crate) fn buffer(error: BufferError) -> String {
    match error {
        BufferError::TooManyItems { items } => {
            format!("{items} faces or edges, but bins hold at most 65535: choose fewer faces")
        }
        _ => "the picture is too large for its buffers: choose a smaller display".into(),
    }
}

/// The importer and the page check textures and their coordinates.
pub(crate) fn texture(_: TextureError) -> String {
    "the texture cannot be drawn: choose another".into()
}

/// A light can be without a direction alone.
pub(crate) fn light(_: LightError) -> String {
    "the light has no direction: move it".into()
}
