//! Drawing, into three targets in three colours each.

use crate::any;
use crate::canvas::Canvas;
use crate::targets::{Least, Wire};
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::pixelcolor::{BinaryColor, Gray8, Rgb565, Rgb888};
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;
use pinhole::raster::{self, Scissor, ScreenPoint, Span};
use pinhole::space::{Model, World};
use pinhole::{
    draw_line, fill_triangle, Affine, AntiAliased, Blend, Camera, Channels, Coordinate, Cull, DepthBuffer,
    Dim, DirtyRegions, FacePlanes, Flat, Frame, Gouraud, Lambert, LeastRun, Mesh, MeshInstance, Object,
    Painter, Picture, Scalar, ScreenDoor, ScreenVertex, ShadeTable, SpanShader, Stroke, Target, Tracked,
    TransferCost, WithPlanes,
};

/// A scene that is set up elsewhere, so that the compiler knows nothing of it here.
struct Scene<'a, C> {
    camera: Camera,
    model: Affine<Model, World>,
    light: Lambert,
    mesh: Mesh<'a, i16, WithPlanes>,
    wide_mesh: Mesh<'a, Scalar, WithPlanes>,
    colours: &'a [(C, [i16; 3])],
    corners: &'a mut [ScreenVertex],
    depth: &'a mut [u16],
    bin_storage: &'a mut [u16],
    strip: &'a mut [u8],
    painter: Painter<C, 100, 100>,
}

fn draw<D: DrawTarget<Color: Dim>>(scene: &mut Scene<'_, D::Color>, target: &mut D) {
    let cull = match any() {
        0 => Cull::None,
        1 => Cull::Front,
        _ => Cull::Back,
    };
    let (mesh, wide_mesh) = (scene.mesh, scene.wide_mesh);
    let instance = scene.camera.place(&mesh, &scene.model).with_cull(cull);
    draw_instance(scene, &instance, target);
    draw_instance(scene, &instance.without_clipping(), target);
    let instance = scene.camera.place(&wide_mesh, &scene.model).with_cull(cull);
    draw_instance(scene, &instance, target);
    match any() {
        0 => scene.painter.clear(),
        _ => report(scene.painter.draw(target)),
    }
}

/// Shaders that vary over a face, in every way to draw faces, in whole frames and in bands.
fn shade<D: DrawTarget<Color: Dim + Channels + pinhole::PixelFormat>>(
    scene: &mut Scene<'_, D::Color>,
    levels: &mut [u16],
    target: &mut D,
) {
    let mesh = scene.mesh;
    let instance = scene.camera.place(&mesh, &scene.model);
    scene.light.levels(scene.mesh.vertex_normals(), levels);
    let (mesh, colour) = (scene.mesh, || Rgb888::new(any() as u8, any() as u8, any() as u8));
    let smooth = |face| Gouraud::lit(colour(), mesh.corners_of(face, levels));
    let ends = || Gouraud::new([colour(), colour(), colour()]);
    let flat = || Flat::lit(colour(), any() as u16);
    // One shader per function, so that the calls with one shader can be inlined.
    match any() {
        0 => fill_all(scene, &instance, smooth, target),
        1 => fill_all(scene, &instance, |_| ends().dithered(), target),
        2 => fill_all(scene, &instance, |_| flat(), target),
        3 => fill_all(scene, &instance, |_| flat().dithered(), target),
        4 => {
            let table = ShadeTable::new(colour());
            fill_all(scene, &instance, |face| table.lit(mesh.corners_of(face, levels)), target);
        }
        _ => draw_edges(scene, &instance, target),
    }
}

fn fill_all<D: DrawTarget<Color: pinhole::PixelFormat>, I: SpanShader<D::Color>>(
    scene: &mut Scene<'_, D::Color>,
    by_planes: &MeshInstance<'_, i16, WithPlanes>,
    shade: impl Fn(usize) -> I,
    target: &mut D,
) {
    let instance = by_planes.without_planes();
    let Scene { colours, corners, depth, bin_storage, strip, .. } = scene;
    let Some(&(background, _)) = colours.first() else { return };
    let area = Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32));
    report(instance.solid(&shade, corners, target));
    report(by_planes.solid(&shade, corners, target));
    if let Ok(mut depth) = DepthBuffer::new(area, depth) {
        report(instance.depth_tested(&shade, corners, &mut depth, target));
        report(by_planes.depth_tested(&shade, corners, &mut depth, target));
    }
    let mut painter = Painter::<I, 20, 20>::new();
    report(painter.add(&instance, &shade));
    let mut frame = Frame::new(area, background);
    let order = painter.order();
    match frame.next_band(strip) {
        Ok(Some(mut band)) => {
            report(order.draw(&mut band));
            let projected = instance.transform(corners);
            match projected.bin_faces(bin_storage) {
                Ok(mut faces) => report(faces.solid(&shade, &mut band)),
                error => report(error.map(|_| ())),
            }
            match by_planes.bin_faces(corners, bin_storage) {
                Ok(mut faces) => report(faces.solid(&shade, &mut band)),
                error => report(error.map(|_| ())),
            }
            match (by_planes.bin_faces_with_depth(corners, bin_storage), DepthBuffer::new(band.area(), depth))
            {
                (Ok(mut faces), Ok(mut depth)) => report(faces.depth_tested(&shade, &mut depth, &mut band)),
                _ => drop(black_box(Some(0))),
            }
            let projected = instance.transform_depth(corners);
            match (projected.bin_faces(bin_storage), DepthBuffer::new(band.area(), depth)) {
                (Ok(mut faces), Ok(mut depth)) => {
                    report(faces.depth_tested(&shade, &mut depth, &mut band));
                    black_box((faces.bounds(), faces.statistics()));
                }
                _ => drop(black_box(Some(0))),
            }
            report(band.send(target));
            match any() {
                0 => drop(black_box(band.into_bytes())),
                _ => drop(black_box(band.into_strip())),
            }
        }
        error => report(error.map(|_| ())),
    }
}

/// Lines with depth, hidden lines, and edges in a band.
fn draw_edges<D: DrawTarget<Color: pinhole::PixelFormat>>(
    scene: &mut Scene<'_, D::Color>,
    by_planes: &MeshInstance<'_, i16, WithPlanes>,
    target: &mut D,
) {
    let instance = by_planes.without_planes();
    let Scene { colours, corners, depth, bin_storage, strip, .. } = scene;
    let Some(&(colour, _)) = colours.first() else { return };
    let area = Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32));
    if let Ok(mut depth) = DepthBuffer::new(area, depth) {
        black_box(instance.depth_only(corners, &mut depth));
        report(instance.hidden_line(colour, corners, &mut depth, target));
        report(instance.wireframe_depth_tested(colour, corners, &mut depth, target));
    }
    let Ok(Some(mut band)) = Frame::new(area, colour).next_band(strip) else { return };
    let projected = instance.transform(corners);
    match projected.bin_edges(bin_storage) {
        Ok(mut edges) => {
            report(edges.draw(colour, &mut band));
            black_box((edges.bounds(), edges.statistics()));
        }
        error => report(error.map(|_| ())),
    }
    let projected = instance.transform_depth(corners);
    if let (Ok(mut faces), Ok(mut depth)) = (projected.bin_faces(bin_storage), DepthBuffer::new(area, depth))
    {
        faces.depth_only(&mut depth);
    }
    black_box(instance.bin_faces(corners, bin_storage).is_ok());
    black_box(by_planes.transform(corners).bin_faces(bin_storage).is_ok());
    let projected = by_planes.transform_depth(corners);
    black_box(projected.bin_faces(bin_storage).is_ok());
    match (projected.bin_edges(bin_storage), DepthBuffer::new(band.area(), depth)) {
        (Ok(mut edges), Ok(mut depth)) => {
            report(edges.hidden_line(colour, &mut depth, &mut band));
            report(edges.depth_tested(colour, &mut depth, &mut band));
        }
        _ => drop(black_box(Some(0))),
    }
    let other = Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32));
    report(band.fill_solid(&other, colour));
    report(band.fill_contiguous(&other, colours.iter().map(|c| c.0)));
    report(band.draw_iter(colours.iter().map(|c| Pixel(Point::new(any(), any()), c.0))));
    report(band.clear(colour));
    report(band.send(target));
}

fn draw_instance<D: DrawTarget<Color: Dim>, V: Coordinate>(
    scene: &mut Scene<'_, D::Color>,
    by_planes: &MeshInstance<'_, V, WithPlanes>,
    target: &mut D,
) {
    let instance = by_planes.without_planes();
    let Scene { light, colours, corners, depth, painter, .. } = scene;
    let Some(&(wire, _)) = colours.first() else { return };
    let mut shade = |face: usize| {
        let (colour, normal) = colours.get(face).copied().unwrap_or((wire, [0; 3]));
        colour.dim(light.level(normal))
    };
    report(instance.project(any() as usize));
    report(instance.wireframe(wire, corners, target));
    report(instance.solid(&mut shade, corners, target));
    report(by_planes.solid(&mut shade, corners, target));
    report(painter.add(&instance, &mut shade));
    let area = Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32));
    match DepthBuffer::new(area, depth) {
        Ok(mut depth) => {
            report(instance.depth_tested(&mut shade, corners, &mut depth, target));
            report(by_planes.depth_tested(&mut shade, corners, &mut depth, target));
            report(depth.at(Point::new(any(), any())).ok_or(()));
            depth.clear();
        }
        error => report(error.map(|_| ())),
    }
    report(instance.project_unsnapped(any() as usize).ok_or(()));
    report(instance.points(wire, target));
    report(instance.polyline(wire, target));
}

/// Uses a result, because otherwise the compiler might leave its computation out.
fn report<T, E>(result: Result<T, E>) {
    match result {
        Ok(value) => drop(black_box(Some(value))),
        Err(error) => drop(black_box(Some(error))),
    }
}

macro_rules! entries {
    ($($name:ident: $target:ty, $colour:ty;)*) => {$(
        #[unsafe(no_mangle)]
        fn $name(scene: &mut Scene<'_, $colour>, target: &mut $target) {
            draw(scene, target);
        }
    )*};
}

macro_rules! shaded {
    ($($name:ident: $target:ty, $colour:ty;)*) => {$(
        #[unsafe(no_mangle)]
        fn $name(scene: &mut Scene<'_, $colour>, levels: &mut [u16], target: &mut $target) {
            shade(scene, levels, target);
        }
    )*};
}

shaded! {
    entry_shaded_canvas_rgb565: Canvas<'_, Rgb565>, Rgb565;
    entry_shaded_canvas_gray8: Canvas<'_, Gray8>, Gray8;
    entry_shaded_canvas_binary: Canvas<'_, BinaryColor>, BinaryColor;
    entry_shaded_wire_rgb565: Wire<Rgb565>, Rgb565;
    entry_shaded_wire_gray8: Wire<Gray8>, Gray8;
    entry_shaded_wire_binary: Wire<BinaryColor>, BinaryColor;
}

entries! {
    entry_canvas_rgb565: Canvas<'_, Rgb565>, Rgb565;
    entry_canvas_gray8: Canvas<'_, Gray8>, Gray8;
    entry_canvas_binary: Canvas<'_, BinaryColor>, BinaryColor;
    entry_wire_rgb565: Wire<Rgb565>, Rgb565;
    entry_wire_gray8: Wire<Gray8>, Gray8;
    entry_wire_binary: Wire<BinaryColor>, BinaryColor;
    entry_least_rgb565: Least<Rgb565>, Rgb565;
    entry_least_gray8: Least<Gray8>, Gray8;
    entry_least_binary: Least<BinaryColor>, BinaryColor;
}

/// Pixels in memory, of a picture and of a band: one colour per face, and shaders that vary.
fn draw_pixels<T: Target<Color = Rgb565>>(
    scene: &mut Scene<'_, Rgb565>,
    by_planes: &MeshInstance<'_, i16, WithPlanes>,
    target: &mut T,
) {
    let instance = by_planes.without_planes();
    let Scene { light, corners, depth, .. } = scene;
    let shade = |face: usize| Rgb565::new(face as u8, 0, 0).dim(light.level([any() as i16, 0, 0]));
    let smooth = |_| Gouraud::new([Rgb888::new(any() as u8, 0, 0); 3]);
    let table = ShadeTable::new(Rgb888::new(any() as u8, 0, 0));
    let shaded = |_| table.lit([any() as u16, any() as u16, any() as u16]);
    report(instance.wireframe(Rgb565::new(1, 2, 3), corners, target));
    report(instance.solid(shade, corners, target));
    report(instance.solid(smooth, corners, target));
    report(instance.solid(shaded, corners, target));
    report(by_planes.solid(shade, corners, target));
    let area = Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32));
    if let Ok(mut depth) = DepthBuffer::new(area, depth) {
        report(instance.depth_tested(shade, corners, &mut depth, target));
        report(instance.depth_tested(smooth, corners, &mut depth, target));
        report(instance.depth_tested(shaded, corners, &mut depth, target));
        report(by_planes.depth_tested(smooth, corners, &mut depth, target));
        report(instance.hidden_line(Rgb565::new(3, 2, 1), corners, &mut depth, target));
    }
    if let Some(corner) = ScreenPoint::from_subpixels(any(), any()) {
        report(fill_triangle([corner, ScreenPoint::default(), corner], shade(any() as usize), target));
    }
    let ends = [0; 2].map(|_| raster::Pixel { x: any() as i16, y: any() as i16 });
    let [from, to] = ends;
    report(draw_line(from, to, shade(1), target));
    let pixels = ends.map(|raster::Pixel { x, y }| Pixel(Point::new(x.into(), y.into()), shade(1)));
    report(target.draw_pixels(pixels.into_iter()));
}

/// Anti-aliased lines, in every way to draw lines.
fn draw_anti_aliased<T: Target<Color = Rgb565>>(
    scene: &mut Scene<'_, Rgb565>,
    by_planes: &MeshInstance<'_, i16, WithPlanes>,
    target: &mut T,
) {
    let instance = by_planes.without_planes();
    let Scene { corners, depth, bin_storage, .. } = scene;
    let stroke = AntiAliased(Rgb565::new(any() as u8, any() as u8, any() as u8));
    let mixed = stroke.color().over(Rgb565::new(any() as u8, any() as u8, any() as u8), any() as u16);
    black_box((mixed, stroke.covering(mixed, any() as u16)));
    let [from, to] = [0; 2].map(|_| raster::Pixel { x: any() as i16, y: any() as i16 });
    report(draw_line(from, to, stroke, target));
    report(instance.wireframe(stroke, corners, target));
    report(instance.polyline(stroke, target));
    let area = Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32));
    let Ok(mut depth) = DepthBuffer::new(area, depth) else { return };
    report(instance.wireframe_depth_tested(stroke, corners, &mut depth, target));
    report(instance.hidden_line(stroke, corners, &mut depth, target));
    if let Ok(mut edges) = instance.transform_depth(corners).bin_edges(bin_storage) {
        report(edges.draw(stroke, target));
        report(edges.depth_tested(stroke, &mut depth, target));
        report(edges.hidden_line(stroke, &mut depth, target));
    }
}

#[unsafe(no_mangle)]
fn entry_pixels_of_picture(
    scene: &mut Scene<'_, Rgb565>,
    mesh: &Mesh<'_, i16, WithPlanes>,
    memory: &mut [Rgb565],
) {
    match Picture::new(memory, Size::new(any() as u32, any() as u32)) {
        Ok(mut picture) => {
            draw(scene, &mut picture);
            report(picture.fill_solid(&picture.bounding_box(), Rgb565::new(1, 1, 1)));
            report(picture.clear(Rgb565::new(1, 1, 1)));
            let instance = scene.camera.place(mesh, &scene.model);
            draw_pixels(scene, &instance, &mut picture.pixels());
            draw_anti_aliased(scene, &instance, &mut picture.pixels());
            draw_pixels(scene, &instance, &mut LeastRun::<_, 3>(&mut Wire(Rgb565::new(1, 1, 1))));
            black_box(picture.colors());
        }
        error => report(error.map(|_| ())),
    }
}

#[unsafe(no_mangle)]
fn entry_pixels_of_band(scene: &mut Scene<'_, Rgb565>, mesh: &Mesh<'_, i16, WithPlanes>, strip: &mut [u8]) {
    let area = Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32));
    let Ok(Some(mut band)) = Frame::new(area, Rgb565::new(0, 1, 0)).next_band(strip) else { return };
    let instance = scene.camera.place(mesh, &scene.model);
    draw_pixels(scene, &instance, &mut band.pixels());
    draw_anti_aliased(scene, &instance, &mut band.pixels());
}

#[unsafe(no_mangle)]
fn entry_pick(
    camera: &Camera,
    model: &Affine<Model, World>,
    mesh: &Mesh<'_, i16, WithPlanes>,
    cache: &mut [ScreenVertex],
) {
    let instance = camera.place(mesh, model);
    pick(camera, &instance, cache);
    pick(camera, &instance.without_planes(), cache);
}

fn pick<P: FacePlanes>(camera: &Camera, instance: &MeshInstance<'_, i16, P>, cache: &mut [ScreenVertex]) {
    let door = |_| ScreenDoor::new(Rgb565::new(0, 1, 0), any() as u8);
    let picked = instance.pick(Point::new(any(), any()), door, cache);
    report(picked.and_then(|picked| picked.point(camera)).ok_or(()));
    report(
        instance.transform_depth(cache).pick(Point::new(any(), any()), |_| Rgb565::new(0, 1, 0)).ok_or(()),
    );
}

#[unsafe(no_mangle)]
fn entry_scene<'m>(
    scene: &mut pinhole::Scene<'m, Rgb565, 5>,
    mesh: &'m Mesh<'m>,
    model: &Affine<Model, World>,
) {
    change(scene, mesh, model);
}

#[unsafe(no_mangle)]
fn entry_scene_with_planes<'m>(
    scene: &mut pinhole::Scene<'m, Rgb565, 5, WithPlanes>,
    mesh: &'m Mesh<'m, i16, WithPlanes>,
    model: &Affine<Model, World>,
) {
    change(scene, mesh, model);
}

fn change<'m, P: FacePlanes>(
    scene: &mut pinhole::Scene<'m, Rgb565, 5, P>,
    mesh: &'m Mesh<'m, i16, P>,
    model: &Affine<Model, World>,
) {
    let object = Object::new(mesh, *model, Rgb565::new(any() as u8, 0, 0)).with_cull(Cull::None);
    match any() {
        0 => report(scene.add(object)),
        1 => scene.clear(),
        2 => *scene = pinhole::Scene::default(),
        _ => scene.objects_mut().iter_mut().for_each(|object| object.model = *model),
    }
    black_box((scene.objects(), scene.bounding_sphere()));
}

type SceneStorage<'s> = (&'s mut [ScreenVertex], &'s mut [u16], &'s mut [u16]);

#[unsafe(no_mangle)]
fn entry_draw_scene(
    scene: &pinhole::Scene<'_, Rgb565, 5>,
    camera: &Camera,
    storage: SceneStorage<'_>,
    painter: &mut Painter<Rgb565, 100, 100>,
    target: &mut Wire<Rgb565>,
) {
    draw_scene(scene, camera, storage, painter, target);
}

#[unsafe(no_mangle)]
fn entry_draw_scene_with_planes(
    scene: &pinhole::Scene<'_, Rgb565, 5, WithPlanes>,
    camera: &Camera,
    storage: SceneStorage<'_>,
    painter: &mut Painter<Rgb565, 100, 100>,
    target: &mut Wire<Rgb565>,
) {
    draw_scene(scene, camera, storage, painter, target);
}

fn draw_scene<P: FacePlanes>(
    scene: &pinhole::Scene<'_, Rgb565, 5, P>,
    camera: &Camera,
    (cache, bins, depth): SceneStorage<'_>,
    painter: &mut Painter<Rgb565, 100, 100>,
    target: &mut Wire<Rgb565>,
) {
    let placed = scene.place(camera);
    let shade = |index: usize, object: &Object<'_, Rgb565, P>| {
        let color = object.material;
        move |face: usize| color.dim((face + index) as u16)
    };
    black_box((
        placed.len(),
        placed.is_empty(),
        placed.cache_len(),
        placed.face_bins_len(),
        placed.iter().count(),
    ));
    report(placed.pick(Point::new(any(), any()), shade, cache).ok_or(()));
    report(placed.paint(shade, painter));
    let area = Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32));
    let Ok(mut depth) = DepthBuffer::new(area, depth) else { return };
    report(placed.depth_tested(shade, cache, &mut depth, target));
    match placed.bin_faces(cache, bins) {
        Ok(mut faces) => {
            faces.depth_only(&mut depth);
            report(faces.depth_tested(shade, &mut depth, target));
            black_box((faces.statistics(), faces.iter().count()));
            let mut cursor = [0; 9];
            match faces.fork(&mut cursor) {
                Ok([mut ours, mut theirs]) => {
                    report(ours.depth_tested(shade, &mut depth, target));
                    theirs.depth_only(&mut depth);
                }
                error => report(error.map(|_| ())),
            };
        }
        error => report(error.map(|_| ())),
    };
}

fn span(span: Span) -> Result<(), i32> {
    black_box(span);
    match any() {
        0 => Ok(()),
        error => Err(error),
    }
}

fn scissor() -> Scissor {
    Scissor::new(any(), any(), any(), any())
}

#[unsafe(no_mangle)]
fn entry_raster_triangle(corners: [ScreenPoint; 3]) -> Result<i64, i32> {
    raster::triangle(corners, &scissor(), span)?;
    Ok(raster::area(&corners))
}

#[unsafe(no_mangle)]
fn entry_raster_line(from: raster::Pixel, to: raster::Pixel) -> Result<(), i32> {
    raster::line(from, to, &scissor(), span)
}

#[unsafe(no_mangle)]
fn entry_raster_pixel(point: ScreenPoint) -> raster::Pixel {
    point.pixel()
}

#[unsafe(no_mangle)]
fn entry_raster_screen_point() -> Option<ScreenPoint> {
    ScreenPoint::from_subpixels(any(), any())
}

#[unsafe(no_mangle)]
fn entry_band_or_strip(frame: &mut Frame<Rgb565>, strip: &mut [u8]) {
    report(frame.band_or_strip(strip));
}

/// Draws with faces, and with a fork of them.
#[unsafe(no_mangle)]
fn entry_two_cores(
    instance: &MeshInstance<'_>,
    (cache, bins, edge_bins): (&mut [ScreenVertex], &mut [u16], &mut [u16]),
    (cursor, other): (&mut [u16], &mut [u16]),
    (frame, strip): (&Frame<Rgb565>, &mut [u8]),
) {
    let Ok(Some(mut band)) = frame.nth_band(any() as u32, strip) else { return };
    let mut split = instance.split_transform(cache);
    let [ours, theirs] = split.halves();
    match any() {
        0 => ours.transform(),
        _ => theirs.transform(),
    }
    let transformed = split.finish();
    let mut split = transformed.split_bin_faces(bins);
    let [ours, theirs] = split.halves();
    match any() {
        0 => ours.count(),
        _ => theirs.count(),
    }
    let Ok(mut faces) = split.finish() else { return };
    let shade = |face: usize| Rgb565::new(face as u8, 0, 0);
    match faces.fork(cursor) {
        Ok([mut ours, mut theirs]) => {
            report(ours.solid(shade, &mut band));
            report(theirs.solid(shade, &mut band));
        }
        error => report(error.map(|_| ())),
    }
    report(faces.solid(shade, &mut band));
    let Ok(mut edges) = transformed.bin_edges(edge_bins) else { return };
    match edges.fork(other) {
        Ok([mut ours, mut theirs]) => {
            report(ours.draw(Rgb565::new(1, 2, 3), &mut band));
            report(theirs.draw(Rgb565::new(1, 2, 3), &mut band));
        }
        error => report(error.map(|_| ())),
    }
}

/// [`entry_two_cores`] with depth.
#[unsafe(no_mangle)]
fn entry_two_cores_with_depth(
    instance: &MeshInstance<'_>,
    (cache, bins, cursor): (&mut [ScreenVertex], &mut [u16], &mut [u16]),
    (frame, strip, depth): (&Frame<Rgb565>, &mut [u8], &mut [u16]),
) {
    let mut split = instance.split_transform_depth(cache);
    let [ours, theirs] = split.halves();
    ours.transform();
    theirs.transform();
    let Ok(mut faces) = split.finish().split_bin_faces(bins).finish() else { return };
    let Ok([mut ours, mut theirs]) = faces.fork(cursor) else { return };
    let Ok(Some(mut band)) = frame.nth_band(any() as u32, strip) else { return };
    let Ok(mut depth) = DepthBuffer::new(band.area(), depth) else { return };
    report(ours.depth_tested(|face| Rgb565::new(face as u8, 0, 0), &mut depth, &mut band));
    theirs.depth_only(&mut depth);
}

#[unsafe(no_mangle)]
fn entry_tracked(dirty: &mut DirtyRegions<7>, object: &mut Tracked<i32>, rectangle: Rectangle) {
    match any() {
        0 => object.hide(dirty),
        1 => *object = Tracked::default(),
        state => object.show(state, rectangle, dirty),
    }
}

#[unsafe(no_mangle)]
fn entry_dirty_new(area: Rectangle) -> DirtyRegions<7> {
    DirtyRegions::new(area, TransferCost::new(any() as u32, any() as u16))
        .with_steps(any() as u16, any() as u16)
}

#[unsafe(no_mangle)]
fn entry_dirty(dirty: &mut DirtyRegions<7>, rectangle: Rectangle) {
    match any() {
        0 => dirty.invalidate(),
        1 => drop(black_box(dirty.take())),
        2 => dirty.mark_changed(rectangle),
        _ => dirty.mark(rectangle),
    }
}
