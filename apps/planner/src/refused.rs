//! Errors of the library, as the page says them. The importer and the page keep nearly all of them out: a sentence for those that
//! are left is enough, where the library's own sentences would take 8 KB of the page.

use pinhole::{
    camera::CameraError, light::LightError, mesh::MeshError, target::BufferError, texture::TextureError,
};

/// The importer's meshes can be wrong in the unit of their vertices alone.
pub(crate) fn mesh(_: MeshError) -> String {
    "the model is too large or too small for a mesh: choose another unit".into()
}

/// The page gives buffers of the lengths that are asked for.
pub(crate) fn buffer(error: BufferError) -> String {
    match error {
        BufferError::TooManyItems { items } => {
            format!("{items} faces or edges, but bins hold 65535: choose fewer faces")
        }
        _ => "the picture is too large: choose a smaller display".into(),
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

/// A camera that frames a model depends on the model's size, another projection on its own numbers too.
pub(crate) fn camera(error: CameraError) -> String {
    match error {
        CameraError::NoRadius => "the model is a point: it needs two different vertices",
        CameraError::OutOfRange => {
            "the model is too large for its unit: choose a larger unit, or a wider field of view"
        }
        CameraError::TooNear => {
            "the model would touch the eye: choose a smaller unit, or a narrower field of view"
        }
        _ => "the projection cannot show the model: choose another, or another field of view",
    }
    .into()
}

/// The film is written into memory, which takes all.
pub(crate) fn film<E>(_: E) -> String {
    "the film cannot be written: choose fewer frames".into()
}
