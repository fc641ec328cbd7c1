// A scope of a live height field: a new row of 32 samples moves the rows before it back. 320 × 240 pixels, coloured by
// height, with hidden lines along the rows, in bands of 8 rows.
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::{prelude::*, primitives::Rectangle};
use pinhole::{math::Sphere, prelude::*, Angle};

const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(320, 240));
const ROWS: usize = 24;
/// Two faces between four samples; an edge from each sample to the next in its row, and the faces beside it.
const GRID: ([[u16; 3]; 62 * (ROWS - 1)], [[[u16; 2]; 31 * ROWS]; 2]) = {
    let (mut faces, mut i) = ([[0; 3]; 62 * (ROWS - 1)], 0);
    let [mut edges, mut beside] = [[[Mesh::<i16>::NO_FACE; 2]; 31 * ROWS]; 2];
    while i < edges.len() {
        let (a, face) = ((i / 31 * 32 + i % 31) as u16, 2 * i as u16);
        edges[i] = [a, a + 1];
        if i < 31 * (ROWS - 1) {
            (faces[2 * i], faces[2 * i + 1]) = ([a, a + 1, a + 33], [a, a + 33, a + 32]);
            beside[i][0] = face;
        }
        beside[i][1] = if i >= 31 { face - 61 } else { Mesh::<i16>::NO_FACE };
        i += 1;
    }
    (faces, [edges, beside])
};
const fn surface(vertices: &[[i16; 3]; 32 * ROWS]) -> Mesh<'_> {
    let Ok(mesh) = Mesh::new(vertices, 0, &GRID.0) else { panic!("faces") };
    let Ok(mesh) = mesh.with_edges(&GRID.1[0]) else { panic!("edges") };
    let Ok(mesh) = mesh.with_edge_faces(&GRID.1[1]) else { panic!("faces beside the edges") };
    mesh
}
pub const AT_REST: Mesh<'static> = surface(&[[0; 3]; 32 * ROWS]);
const CAMERA: Camera = {
    let Ok(viewport) = Viewport::new(SCREEN.top_left, SCREEN.size) else { panic!("the size") };
    let sphere = Sphere { centre: Point3::from_ints(0, 8, 8), radius: Scalar::from_int(52) };
    let (fov, yaw, pitch) = (Angle::degrees(30), Angle::degrees(-28), Angle::degrees(32));
    let Ok(camera) = Camera::framing(&sphere, &viewport, fov, yaw, pitch) else { panic!("the view") };
    camera
};

/// The samples of the last rows, the newest first, and the memory that a frame needs.
pub struct Scope(pub [[u8; 32]; ROWS], MeshBuffers!(faces, edges: AT_REST), StripBuffers!(Rgb565, 320, 8));

impl Scope {
    pub const fn new() -> Self {
        Self([[0; 32]; ROWS], mesh_buffers!(faces, edges: AT_REST), strip_buffers!(Rgb565, 320, 8))
    }

    pub fn push<D: DrawTarget<Color = Rgb565>>(&mut self, row: [u8; 32], to: &mut D) -> Result<(), D::Error> {
        let Self(samples, buffers, strip) = self;
        samples.rotate_right(1);
        samples[0] = row;
        let heights = samples.as_flattened();
        let vertex = |i: usize| [i as i16 % 32 * 4 - 62, i16::from(heights[i]) / 6, 46 - i as i16 / 32 * 4];
        let vertices = core::array::from_fn(vertex);
        let (mesh, model) = (surface(&vertices), Affine::identity());
        let instance = CAMERA.place(&mesh, &model).with_cull(Cull::None); // a steep rise shows its underside
        let transformed = instance.transform_depth(&mut buffers.cache);
        let mut faces = transformed.bin_faces(&mut buffers.bins).expect("room for all faces");
        let mut lines = transformed.bin_edges(&mut buffers.edge_bins).expect("room for all edges");
        // From blue by way of green to red.
        let color = |h: u8| Rgb888::new(h, 207 - h.abs_diff(128), 200u8.saturating_sub(h));

        let mut frame = Frame::new(SCREEN, Rgb565::new(1, 3, 3));
        while let Some(mut band) = frame.next_band(&mut strip.colors).expect("room for a row") {
            let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).expect("room for a row");
            let shade = |face| Gouraud::new(mesh.corners_of(face, heights).map(color));
            let Ok(()) = faces.draw(shade, &mut band.pixels().depth_tested(&mut depth));
            let Ok(()) = lines.hidden_line(Rgb565::BLACK, &mut band.pixels().depth_tested(&mut depth));
            band.send(to)?;
        }
        Ok(())
    }
}
