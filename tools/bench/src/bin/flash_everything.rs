//! All ways to draw, in bands; a camera made at run time; dirty rectangles. `everything_inside` draws without clipping.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;
use heapless::Vec;

/// Faces of the cube, and of the triangles that clipping makes of them.
const FACES: usize = 12;
type Order = Painter<Rgb565, { 4 * CORNERS }, { 2 * FACES }>;

/// Whether this is the image that links no clipping.
const INSIDE: bool = is_equal(env!("CARGO_BIN_NAME"), "flash_everything_inside");

/// An object with its light, which live as long as the frame.
struct Object {
    instance: MeshInstance<'static>,
    light: Lambert,
}

/// Buffers that the caller provides for a frame.
type Buffers =
    (MeshBuffers<CORNERS, BIN_STORAGE, { BIN_STORAGE + 8 }>, StripBuffers<{ bytes(ROWS) }, { pixels(ROWS) }>);

/// Places the cube before a camera made at run time. Each step is a function of its own, so that its stack is free again
/// when it returns.
#[inline(never)]
fn place(cube: &'static Model, objects: &mut Vec<Object, 1>) -> Option<()> {
    let camera = cube.camera();
    objects.clear();
    let instance = camera.as_ref()?.place(&cube.mesh, &cube.turned());
    objects.push(Object { instance, light: Turntable::turned().light()? }).ok()
}

/// Records the cube for painter's order, before another camera.
#[inline(never)]
fn record(cube: &'static Model, light: &Lambert, painter: &mut Order) -> Option<()> {
    painter.clear();
    let (instance, shade) =
        (Turntable::turned().place(cube), scene::flat(&cube.mesh, |normal| light.level(normal)));
    match INSIDE {
        true => instance.without_clipping().faces(shade).sorted(painter).ok(),
        false => instance.faces(shade).sorted(painter).ok(),
    }
}

/// Draws dithered faces with hidden lines, then in all other ways.
#[inline(never)]
fn draw<V: Coordinate<Stored = i16>>(
    cube: &'static Model,
    instance: &MeshInstance<'static, V>,
    light: &Lambert,
    painter: &mut Order,
    dirty: &mut DirtyRegions<2>,
    (MeshBuffers { cache, bins, edge_bins }, StripBuffers { colors, depths, .. }): &mut Buffers,
) -> Option<()> {
    let projected = instance.transform_depth(cache);
    let mut faces = projected.bin_faces(bins);
    let mut edges = projected.bin_edges(edge_bins);
    let (faces, edges) = (faces.as_mut().ok()?, edges.as_mut().ok()?);
    let (mesh, order) = (&cube.mesh, painter.order());
    dirty.mark(faces.bounds());
    for &area in &dirty.take() {
        let mut frame = Frame::new(area, scene::BACKGROUND);
        while let Some(mut band) = frame.next_band(colors).ok()? {
            let mut depth = DepthBuffer::new(band.area(), depths).ok()?;
            faces
                .draw(|face| Dithered(scene::smooth(mesh, light)(face)), &mut band.depth_tested(&mut depth))
                .ok()?;
            faces.draw(scene::flat(mesh, |normal| light.level(normal)), &mut band).ok()?;
            edges.hidden_line(scene::LINE, &mut band.depth_tested(&mut depth)).ok()?;
            edges.draw(scene::LINE, &mut band.depth_tested(&mut depth)).ok()?;
            edges.draw(scene::LINE, &mut band).ok()?;
            order.draw(&mut band).ok()?;
            band.send(&mut Sink).ok()?;
        }
    }
    instance.points(scene::LINE, &mut Sink).ok()?;
    Some(())
}

image!(
    cube,
    objects: Vec<Object, 1> = Vec::new(),
    painter: Order = Order::new(),
    dirty: DirtyRegions<2> = DirtyRegions::new(scene::area(), TransferCost::new(11, 2)),
    buffers: Buffers = (MeshBuffers::new(), StripBuffers::new()),
    {
        place(cube, objects)?;
        let object = objects.first()?;
        record(cube, &object.light, painter)?;
        let Object { instance, light } = object;
        match INSIDE {
            true => draw(cube, &instance.without_clipping(), light, painter, dirty, buffers),
            false => draw(cube, instance, light, painter, dirty, buffers),
        }
    }
);
