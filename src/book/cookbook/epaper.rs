// A chess pawn as a drawing of lines, without those that its own faces hide, on e-paper of 200 × 200 pixels. It draws into the
// driver's buffer, whatever its colours are; the depth is that of 20 rows at a time.
use embedded_graphics::mono_font::{ascii::FONT_9X15_BOLD, MonoTextStyle};
use embedded_graphics::primitives::{PrimitiveStyle, Rectangle};
use embedded_graphics::{prelude::*, text::*};
use pinhole::{math::Sphere, mesh::edge_faces, prelude::*, Angle};

const SIZE: Size = Size::new(200, 200);
/// The pawn's radii and heights at its 15 rings of vertices, from the foot to the top.
const RADII: [i32; 15] = [46, 46, 38, 35, 22, 15, 12, 26, 26, 14, 21, 24, 20, 11, 0];
const HEIGHTS: [i16; 15] = [0, 10, 16, 24, 36, 52, 74, 82, 88, 92, 100, 112, 124, 132, 135];
pub const PAWN: Mesh<'static> = {
    const N: usize = 16 * 14; // quads, of two faces each, and one above each vertex but the topmost
    type Parts = ([[i16; 3]; N + 16], [[u16; 3]; 2 * N], [[u16; 2]; 2 * N]);
    const PARTS: Parts = {
        let (mut vertices, mut faces, mut edges, mut i) =
            ([[0; 3]; N + 16], [[0; 3]; 2 * N], [[0; 2]; 2 * N], 0);
        while i < N + 16 {
            let ((sin, cos), r) = (Angle::turns(i as i32, 16).sin_cos(), RADII[i / 16]); // in 2⁻³⁰
            vertices[i] =
                [((r * (sin >> 15)) >> 15) as i16, HEIGHTS[i / 16], ((r * (cos >> 15)) >> 15) as i16];
            if i < N {
                let (a, b) = (i as u16, (i / 16 * 16 + (i + 1) % 16) as u16);
                (faces[2 * i], faces[2 * i + 1]) = ([a, b, b + 16], [a, b + 16, a + 16]);
                (edges[2 * i], edges[2 * i + 1]) = ([a, b], [a, a + 16]);
            }
            i += 1;
        }
        (vertices, faces, edges)
    };
    const BESIDE: [[u16; 2]; 2 * N] = edge_faces(&PARTS.2, &PARTS.1);
    let Ok(mesh) = Mesh::new(&PARTS.0, 0, &PARTS.1) else { panic!("faces") };
    let Ok(mesh) = mesh.with_edges(&PARTS.2) else { panic!("edges") };
    let Ok(mesh) = mesh.with_edge_faces(&BESIDE) else { panic!("faces beside the edges") };
    mesh
};

pub fn draw<D: DrawTarget>(yaw: Angle, [ink, paper]: [D::Color; 2], epd: &mut D) -> Result<(), D::Error> {
    let (mut cache, mut depths) = ([ScreenVertex::EMPTY; PAWN.vertices().len()], [0; 200 * 20]);
    let viewport = Viewport::new(Point::zero(), SIZE).expect("a small display");
    let sphere = Sphere { centre: Point3::from_ints(0, 62, 0), radius: Scalar::from_int(80) };
    let camera =
        Camera::framing(&sphere, &viewport, Angle::degrees(24), yaw, Angle::degrees(25)).expect("a radius");
    let instance = camera.place(&PAWN, &Affine::identity());

    epd.clear(paper)?;
    for top in (0..200).step_by(20) {
        let rows = Rectangle::new(Point::new(0, top), Size::new(200, 20));
        let mut depth = DepthBuffer::new(rows, &mut depths).expect("room for the rows");
        instance.depth_only(&mut cache, &mut depth);
        instance.edges(|_| ink).cached(&mut cache).hidden_line(&mut epd.depth_tested(&mut depth))?;
    }
    let frame = PrimitiveStyle::with_stroke(ink, 2);
    Rectangle::new(Point::zero(), SIZE).into_styled(frame).draw(epd)?;
    Text::new("e4", Point::new(172, 190), MonoTextStyle::new(&FONT_9X15_BOLD, ink)).draw(epd)?;
    Ok(())
}
