//! All ways to draw, in bands; a camera made at run time; dirty rectangles.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::{bytes, pixels};
use bench::image::{Sink, Turntable, CORNERS, RECORDS, ROWS};
use bench::{image, scene};
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::{Corner, DepthBuffer, Dirty, Frame, Painter, WindowCost};

/// The cube's, and those that cuts make.
const FACES: usize = 12;
type Order = Painter<Rgb565, { 4 * CORNERS }, { 2 * FACES }>;

image!(
    cube,
    corners: [Corner; CORNERS] = [Corner::EMPTY; CORNERS],
    edge_corners: [Corner; CORNERS] = [Corner::EMPTY; CORNERS],
    records: [u16; RECORDS] = [0; RECORDS],
    edge_records: [u16; RECORDS + 8] = [0; RECORDS + 8],
    strip: [u8; bytes(ROWS)] = [0; bytes(ROWS)],
    storage: [u16; pixels(ROWS)] = [0; pixels(ROWS)],
    painter: Order = Order::new(),
    {
        // A dithered solid in hidden lines, before it one in painter's order, from two cameras.
        let (camera, model, other) = (cube.camera(), cube.turned(), Turntable::new());
        let (placed, light) = (camera.as_ref()?.place(&cube.mesh, &model), other.light()?);
        painter.clear();
        painter.add(&other.place(cube), scene::flat(&cube.mesh, &light)).ok()?;
        let order = painter.order();
        let (projected, lines) = (placed.transform_depth(corners), placed.transform_depth(edge_corners));
        let (mut faces, mut edges) = (projected.faces(records).ok()?, lines.edges(edge_records).ok()?);
        let mut dirty = Dirty::<4>::new(scene::area(), WindowCost::new(11, 2));
        dirty.mark(faces.bounds());
        for area in dirty.take() {
            let mut frame = Frame::new(area, scene::BACKGROUND);
            while let Some(mut band) = frame.next_band(strip).ok()? {
                let mut depth = DepthBuffer::new(band.area(), storage).ok()?;
                faces
                    .depth_tested(|face| scene::smooth(placed.mesh(), &light)(face).dithered(), &mut depth, &mut band)
                    .ok()?;
                faces.solid(scene::flat(&cube.mesh, &light), &mut band).ok()?;
                edges.hidden_line(scene::LINE, &mut depth, &mut band).ok()?;
                edges.depth_tested(scene::LINE, &mut depth, &mut band).ok()?;
                edges.draw(scene::LINE, &mut band).ok()?;
                order.draw(&mut band).ok()?;
                band.send(&mut Sink).ok()?;
            }
        }
        placed.points(scene::LINE, &mut Sink).ok()?;
        Some(())
    }
);
