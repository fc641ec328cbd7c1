//! The cases as frames whose work is counted, on the host.

use super::texture::{coordinates, TEXELS_OF_UNIT};
use super::{Case, Kind, Way, PAINTED_CORNERS, SMALL};
use embedded_graphics_core::geometry::Size;
use pinhole::camera::Projected;
use pinhole_apps_support::work::{reach, Frame, Work};

impl Case {
    /// The work of a frame that is drawn in a way. `None` if it cannot be drawn.
    pub fn work(&self, way: Way) -> Option<Work> {
        let mesh = self.mesh(way.kind)?;
        let scene = self.scene_of(mesh)?;
        let is_linear = |face: usize, corners: [Projected; 3]| {
            let normal = mesh.normals().get(face).copied().unwrap_or_default();
            let [a, b, c] = corners.map(distance);
            let (near, far) = (a.min(b).min(c), a.max(b).max(c));
            let uv = coordinates(&mesh, face, normal);
            // A quarter of a texel is what a texture's coordinates may be off.
            (0..2).all(|axis| {
                let [least, most] = reach(uv.map(|uv| uv[axis].into()));
                let texels = f64::from(most - least) * TEXELS_OF_UNIT;
                texels * (far - near) / (4.0 * near) < 0.25
            })
        };
        let [width, height] = self.size;
        let frame = Frame::new(
            &mesh,
            Size::new(width, height),
            &|mesh| scene.camera.place(mesh, &scene.model).with_cull(self.cull_of(way.kind)),
            &is_linear,
            if way.kind == Kind::Creases { usize::MAX } else { 0 },
        );
        let mut work = frame.work(way.rows);
        work.room = if self.is_small() { SMALL } else { PAINTED_CORNERS } as u32;
        Some(work)
    }
}

/// The distance of a vertex along the direction of view, by its depth between the near and the far plane of the scenes' camera.
fn distance(seen: Projected) -> f64 {
    let [near, far] = [0.5, 20.0];
    far * near / (far - (far - near) * f64::from(seen.depth) / 65535.0)
}
