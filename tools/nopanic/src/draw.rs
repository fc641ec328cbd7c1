//! Drawing, into targets in three colours each.

use crate::any;
use crate::inputs::{area, color, levels, pixel, report, rotation, size, wide_color};
use crate::targets::{Least, Wire};
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::Dimensions;
use embedded_graphics_core::pixelcolor::{BinaryColor, Gray4, Gray8, Rgb565};
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::{Drawable, Pixel};
use pinhole::raster::ScreenPoint;
use pinhole::space::{Model, World};
use pinhole::{
    bands::{DirtyRegions, SmoothFrame, Tracked, TransferCost},
    draw::{draw_line, fill_triangle, ActiveFace, ShaderFor, SmoothEdge, StrokeFor},
    mesh::Coordinate,
    prelude::*,
    shading::{AntiAliased, AntiAliasedBy, SpanShader},
    target::LeastRun,
};

/// A scene that is set up elsewhere, so that the compiler knows nothing of it here.
struct Scene<'a, C> {
    camera: Camera,
    model: Affine<Model, World>,
    light: Lambert,
    mesh: Mesh<'a>,
    wide_mesh: Mesh<'a, Scalar>,
    colours: &'a [(C, [i16; 3])],
    corners: &'a mut [ScreenVertex],
    depth: &'a mut [u16],
    bin_storage: &'a mut [u16],
    strip: &'a mut [u8],
    painter: Painter<C, 100, 100>,
}

fn draw<D: DrawTarget<Color: Color>>(scene: &mut Scene<'_, D::Color>, target: &mut D) {
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
    let Ok(viewport) = Viewport::new(pixel(), size()) else { return };
    let viewport = viewport.rotated(rotation());
    let colour = <D::Color as Color>::from_bits(any() as u32);
    let mut upright = viewport.upright(target);
    report(upright.bounding_box());
    report(upright.fill_solid(&area(), colour).ok());
    report(Pixel(pixel(), colour).draw(&mut upright).ok());
}

/// Shaders that vary over a face, in every way to draw faces, in whole frames and in bands.
fn shade<D: DrawTarget<Color: Color>>(scene: &mut Scene<'_, D::Color>, levels: &mut [u16], target: &mut D) {
    let mesh = scene.mesh;
    let instance = scene.camera.place(&mesh, &scene.model);
    scene.light.levels(mesh.vertex_normals(), levels);
    let smooth = |face| Gouraud::lit(wide_color(), mesh.corners_of(face, levels));
    let ends = |_| Dithered(Gouraud::new([wide_color(), wide_color(), wide_color()]));
    let flat = || Flat::lit(wide_color(), any() as u16);
    // One shader per function, so that the calls with one shader can be inlined.
    match any() {
        0 => fill_all(scene, &instance, smooth, target),
        1 => fill_all(scene, &instance, ends, target),
        2 => fill_all(scene, &instance, |_| flat(), target),
        3 => fill_all(scene, &instance, |_| Dithered(flat()), target),
        4 => {
            let table = ShadeTable::new(wide_color());
            fill_all(scene, &instance, |face| table.lit(mesh.corners_of(face, levels)), target);
        }
        _ => draw_edges(scene, &instance, target),
    }
}

/// Faces in a whole frame, culled by area and by planes, without depth and with it.
fn fill<T: Surface, S: ShaderFor<T>, V: Coordinate>(
    instance: &MeshInstance<'_, V>,
    mut shade: impl FnMut(usize) -> S,
    (corners, depth): (&mut [ScreenVertex], &mut [u16]),
    target: &mut T,
) {
    report(instance.faces(&mut shade).cached(corners).draw(target));
    report(instance.faces(&mut shade).culled_by_planes().cached(corners).draw(target));
    let Ok(mut depth) = DepthBuffer::new(area(), depth) else { return };
    let target = &mut target.depth_tested(&mut depth);
    report(instance.faces(&mut shade).cached(corners).draw(target));
    report(instance.faces(&mut shade).culled_by_planes().cached(corners).draw(target));
}

fn fill_all<D: DrawTarget<Color: Color>, I: SpanShader<D::Color, Ink = D::Color>>(
    scene: &mut Scene<'_, D::Color>,
    instance: &MeshInstance<'_>,
    shade: impl Fn(usize) -> I,
    target: &mut D,
) {
    let Scene { colours, corners, depth, bin_storage, strip, .. } = scene;
    let Some(&(background, _)) = colours.first() else { return };
    let area = area();
    fill(instance, &shade, (corners, depth), target);
    let mut painter = Painter::<I, 20, 20>::new();
    report(instance.faces(&shade).sorted(&mut painter));
    let mut frame = Frame::new(area, background);
    let Ok(Some(mut band)) = frame.next_band(strip) else { return };
    report(painter.order().draw(&mut band));
    if let Ok(mut faces) = instance.transform(corners).bin_faces(bin_storage) {
        report(faces.draw(&shade, &mut band));
    }
    let Ok(mut depth) = DepthBuffer::new(band.area(), depth) else { return };
    if let Ok(mut faces) = instance.transform_depth(corners).bin_faces(bin_storage) {
        report(faces.draw(&shade, &mut band.depth_tested(&mut depth)));
        report((faces.bounds(), faces.statistics()));
    }
    let mut list = [ActiveFace::EMPTY; 3];
    if let Ok(faces) = instance.transform_depth(corners).bin_faces(bin_storage) {
        let mut faces = faces.with_active_faces(&mut list);
        report(faces.draw(&shade, &mut target.depth_tested(&mut depth)));
        report(faces.draw(&shade, target));
        report((faces.bounds(), faces.statistics()));
    }
    let mut list = [ActiveFace::EMPTY; 3];
    if let Ok(faces) = instance.transform(corners).bin_faces(bin_storage) {
        let mut faces = faces.with_active_faces(&mut list);
        report(faces.draw(&shade, target));
        report((faces.bounds(), faces.statistics()));
    }
    report(band.send(target));
    match any() {
        0 => report(band.into_bytes()),
        _ => report(band.into_strip()),
    }
}

/// Lines with depth, hidden lines, and edges in a band.
fn draw_edges<D: DrawTarget<Color: Color>>(
    scene: &mut Scene<'_, D::Color>,
    instance: &MeshInstance<'_>,
    target: &mut D,
) {
    let Scene { colours, corners, depth, bin_storage, strip, .. } = scene;
    let Some(&(colour, _)) = colours.first() else { return };
    let area = area();
    let Ok(mut depth) = DepthBuffer::new(area, depth) else { return };
    report(instance.depth_only(corners, &mut depth));
    report(instance.edges(|_| colour).cached(corners).hidden_line(&mut target.depth_tested(&mut depth)));
    report(instance.edges(|_| colour).cached(corners).draw(&mut target.depth_tested(&mut depth)));

    let Ok(Some(mut band)) = Frame::new(area, colour).next_band(strip) else { return };
    if let Ok(mut edges) = instance.transform(corners).bin_edges(bin_storage) {
        report(edges.draw(colour, &mut band));
        report((edges.bounds(), edges.statistics()));
    }
    if let Ok(mut faces) = instance.transform_depth(corners).bin_faces(bin_storage) {
        faces.depth_only(&mut depth);
    }
    report(instance.transform(corners).bin_faces(bin_storage).is_ok());
    let transformed = instance.transform_depth(corners);
    report(transformed.bin_faces(bin_storage).is_ok());
    if let Ok(mut edges) = transformed.bin_edges(bin_storage) {
        report(edges.hidden_line(colour, &mut band.depth_tested(&mut depth)));
        report(edges.draw(colour, &mut band.depth_tested(&mut depth)));
    }
    let colours = || colours.iter().map(|c| c.0);
    report(band.fill_solid(&crate::inputs::area(), colour));
    report(band.fill_contiguous(&crate::inputs::area(), colours()));
    report(band.draw_iter(colours().map(|colour| Pixel(pixel(), colour))));
    report(band.clear(colour));
    report(band.send(target));
}

fn draw_instance<D: DrawTarget<Color: Color>, V: Coordinate>(
    scene: &mut Scene<'_, D::Color>,
    instance: &MeshInstance<'_, V>,
    target: &mut D,
) {
    let Scene { light, colours, corners, depth, painter, .. } = scene;
    let Some(&(wire, _)) = colours.first() else { return };
    let mut shade = |face: usize| {
        let (colour, normal) = colours.get(face).copied().unwrap_or((wire, [0; 3]));
        colour.dim(light.level(normal))
    };
    report(instance.project(any() as usize));
    report(instance.project_unsnapped(any() as usize));
    report(instance.edges(|_| wire).cached(corners).draw(target));
    fill(instance, &mut shade, (corners, depth), target);
    report(instance.faces(&mut shade).sorted(painter));
    report(instance.points(wire, target));
    let Ok(mut depth) = DepthBuffer::new(area(), depth) else { return };
    report(depth.at(pixel()));
    depth.clear();
    report(instance.points(wire, &mut target.depth_tested(&mut depth)));
}

/// Pixels in memory, of a picture and of a band: one colour per face, and shaders that vary.
fn draw_pixels<T: Surface<Color = Rgb565>>(
    scene: &mut Scene<'_, Rgb565>,
    instance: &MeshInstance<'_>,
    target: &mut T,
) {
    let Scene { light, corners, depth, .. } = scene;
    let shade = |face: usize| Rgb565::new(face as u8, 0, 0).dim(light.level([any() as i16, 0, 0]));
    let smooth = |_| Gouraud::new([wide_color(); 3]);
    let table = ShadeTable::new(wide_color());
    let shaded = |_| table.lit(levels());
    report(instance.edges(|_| color()).cached(corners).draw(target));
    fill(instance, shade, (corners, depth), target);
    fill(instance, smooth, (corners, depth), target);
    fill(instance, shaded, (corners, depth), target);
    if let Some(corner) = ScreenPoint::from_subpixels(any(), any()) {
        report(fill_triangle([corner, ScreenPoint::default(), corner], shade(any() as usize), target));
    }
    let ends = [(); 2].map(|()| pixel());
    report(draw_line(ends[0], ends[1], shade(1), target));
    let pixels = ends.map(|end| Pixel(end, shade(1)));
    report(target.draw_pixels(pixels.into_iter()));
    let Ok(mut depth) = DepthBuffer::new(area(), depth) else { return };
    report(instance.edges(|_| color()).cached(corners).hidden_line(&mut target.depth_tested(&mut depth)));
}

/// Anti-aliased lines, in every way to draw lines.
fn draw_anti_aliased<T: Surface<Color = Rgb565>>(
    scene: &mut Scene<'_, Rgb565>,
    instance: &MeshInstance<'_>,
    stroke: impl StrokeFor<T>,
    target: &mut T,
) {
    let Scene { corners, depth, bin_storage, .. } = scene;
    report(draw_line(pixel(), pixel(), stroke, target));
    report(instance.edges(|_| stroke).cached(corners).draw(target));
    let Ok(mut depth) = DepthBuffer::new(area(), depth) else { return };
    report(instance.edges(|_| stroke).cached(corners).draw(&mut target.depth_tested(&mut depth)));
    report(instance.edges(|_| stroke).cached(corners).hidden_line(&mut target.depth_tested(&mut depth)));
    if let Ok(mut edges) = instance.transform_depth(corners).bin_edges(bin_storage) {
        report(edges.draw(stroke, target));
        report(edges.draw(stroke, &mut target.depth_tested(&mut depth)));
        report(edges.hidden_line(stroke, &mut target.depth_tested(&mut depth)));
    }
}

fn picture(scene: &mut Scene<'_, Rgb565>, mesh: &Mesh<'_>, memory: &mut [Rgb565]) {
    let Ok(mut picture) = Picture::new(memory, size()) else { return };
    draw(scene, &mut picture);
    report(picture.fill_solid(&picture.bounding_box(), color()));
    report(picture.clear(color()));
    let instance = scene.camera.place(mesh, &scene.model);
    draw_pixels(scene, &instance, &mut picture.pixels());
    draw_anti_aliased(scene, &instance, AntiAliased(color()), &mut picture.pixels());
    draw_anti_aliased(scene, &instance, AntiAliased(color()).by_table(), &mut picture.pixels());
    let half = |color: Rgb565, below, coverage| color.over(below, coverage / 2);
    draw_anti_aliased(scene, &instance, AntiAliasedBy::new(color(), half), &mut picture.pixels());
    draw_pixels(scene, &instance, &mut LeastRun::<_, 3>(&mut Wire(color())));
    report(picture.colors());
}

fn band(scene: &mut Scene<'_, Rgb565>, mesh: &Mesh<'_>, strip: &mut [u8]) {
    let Ok(Some(mut band)) = Frame::new(area(), color()).next_band(strip) else { return };
    let instance = scene.camera.place(mesh, &scene.model);
    draw_pixels(scene, &instance, &mut band.pixels());
    draw_anti_aliased(scene, &instance, AntiAliased(color()), &mut band.pixels());
    draw_anti_aliased(scene, &instance, AntiAliased(color()).by_table(), &mut band.pixels());
}

/// Smoothed edges, in a picture and in bands.
fn smooth(
    scene: &mut Scene<'_, Rgb565>,
    mesh: &Mesh<'_>,
    memory: &mut [Rgb565],
    kept: &mut [u8],
    list: &mut [SmoothEdge],
) {
    let Scene { camera, model, corners, depth, bin_storage, strip, .. } = scene;
    let instance = camera.place(mesh, model);
    let transformed = instance.transform_depth(corners);
    let Ok(mut edges) = transformed.bin_smooth_edges(|_| any() == 0, bin_storage) else { return };
    edges.keep_in(list);
    report(edges.bounds(area()));
    if let (Ok(mut picture), Ok(mut depth)) = (Picture::new(memory, size()), DepthBuffer::new(area(), depth))
    {
        picture.pixels().depth_tested(&mut depth).smooth(|pass| edges.draw(pass));
    }
    // Pixels that are packed.
    if let Ok(mut frame) = SmoothFrame::new(area(), Gray4::new(any() as u8), kept, depth) {
        if let Ok(Some(band)) = frame.next_band(strip) {
            report(band.smooth(|pass| edges.draw(pass)).bytes());
        }
    }
    let Ok(mut frame) = SmoothFrame::new(area(), color(), kept, depth) else { return };
    let band = match any() {
        0 => frame.next_band(strip),
        _ => frame.nth_band(any() as u32, strip),
    };
    let Ok(Some(mut band)) = band else { return };
    report(band.area());
    let (mut pixels, mut depth) = band.new_rows();
    report(instance.faces(|_| color()).draw(&mut pixels.depth_tested(&mut depth)));
    report(band.smooth(|pass| edges.draw(pass)).bytes());
}

fn pick(camera: &Camera, instance: &MeshInstance<'_>, cache: &mut [ScreenVertex]) {
    let faces = || instance.faces(|_| ScreenDoor::new(color(), any() as u8));
    report(faces().culled_by_planes().cached(cache).pick(pixel()));
    report(faces().culled_by_clusters().cached(cache).pick(pixel()));
    let picked = faces().cached(cache).pick(pixel());
    report(picked.and_then(|picked| camera.unproject(picked.at, picked.depth)));
}

fn change<'m>(
    scene: &mut pinhole::draw::Scene<'m, Rgb565, 5>,
    mesh: &'m Mesh<'m>,
    model: &Affine<Model, World>,
) {
    let mut object = Object::new(mesh, *model, color());
    object.cull = Cull::None;
    match any() {
        0 => report(scene.add(object)),
        1 => scene.clear(),
        2 => *scene = pinhole::draw::Scene::default(),
        _ => scene.iter_mut().for_each(|object| object.model = *model),
    }
    report((scene.len(), scene.bounding_sphere()));
}

/// What a scene is drawn with.
struct Storage<'a> {
    cache: &'a mut [ScreenVertex],
    bins: &'a mut [u16],
    edge_bins: &'a mut [u16],
    list: &'a mut [SmoothEdge],
    memory: &'a mut [Rgb565],
    depth: &'a mut [u16],
    painter: Painter<Rgb565, 100, 100>,
    target: Wire<Rgb565>,
}

fn draw_scene(scene: &pinhole::draw::Scene<'_, Rgb565, 5>, camera: &Camera, storage: &mut Storage<'_>) {
    let Storage { cache, bins, edge_bins, list, memory, depth, painter, target } = storage;
    let placed = scene.place(camera);
    let shade = |index: usize, object: &Object<'_, Rgb565>| {
        let color = object.material;
        move |face: usize| color.dim((face + index) as u16)
    };
    report(placed.iter().count());
    report(placed.iter().map(|(object, _)| object.mesh().faces().len()).sum::<usize>());
    report(placed.pick(shade, cache, pixel()));
    report(placed.sorted(shade, painter));
    let Ok(mut depth) = DepthBuffer::new(area(), depth) else { return };
    report(placed.draw(shade, cache, &mut target.depth_tested(&mut depth)));
    let Ok(mut faces) = placed.bin_faces(cache, bins) else { return };
    faces.depth_only(&mut depth);
    report(faces.draw(shade, &mut target.depth_tested(&mut depth)));
    report((faces.statistics(), faces.bounds().count()));
    if let Ok(mut edges) = faces.bin_smooth_edges(|index, _, edge| index == edge, edge_bins) {
        edges.keep_in(list);
        report(edges.bounds().count());
        if let Ok(mut picture) = Picture::new(memory, size()) {
            picture.pixels().depth_tested(&mut depth).smooth(|pass| edges.draw(pass));
        }
    }
    let mut cursor = [0; 9];
    let Ok([mut ours, mut theirs]) = faces.fork(&mut cursor) else { return };
    report(ours.draw(shade, &mut target.depth_tested(&mut depth)));
    theirs.depth_only(&mut depth);
}

/// What two cores draw with.
struct Cores<'a> {
    instance: MeshInstance<'a>,
    cache: &'a mut [ScreenVertex],
    bins: &'a mut [u16],
    edge_bins: &'a mut [u16],
    cursors: [&'a mut [u16]; 2],
    frame: Frame<Rgb565>,
    strip: &'a mut [u8],
    depth: &'a mut [u16],
}

/// Draws with faces, and with a fork of them.
fn two_cores(cores: &mut Cores<'_>) {
    let Cores { instance, cache, bins, edge_bins, cursors: [cursor, other], frame, strip, .. } = cores;
    let Ok(Some(mut band)) = frame.nth_band(any() as u32, strip) else { return };
    let one = |ours: &mut (dyn FnMut() + Send), theirs: &mut (dyn FnMut() + Send)| match any() {
        0 => ours(),
        _ => theirs(),
    };
    let transformed = instance.split_transform(cache, one);
    let Ok(mut faces) = transformed.split_bin_faces(bins, one) else { return };
    report(faces.draw(|_| color(), &mut band));
    if let Ok([mut ours, mut theirs]) = faces.fork(cursor) {
        report(ours.draw(|_| color(), &mut band));
        report(theirs.draw(|_| color(), &mut band));
    }
    let Ok(mut edges) = transformed.bin_edges(edge_bins) else { return };
    let Ok([mut ours, mut theirs]) = edges.fork(other) else { return };
    report(ours.draw(color(), &mut band));
    report(theirs.draw(color(), &mut band));
}

/// [`two_cores`] with depth.
fn two_cores_with_depth(cores: &mut Cores<'_>) {
    let Cores { instance, cache, bins, cursors: [cursor, _], frame, strip, depth, .. } = cores;
    let none = |_: &mut (dyn FnMut() + Send), _: &mut (dyn FnMut() + Send)| ();
    let Ok(mut faces) = instance.split_transform_depth(cache, none).split_bin_faces(bins, none) else {
        return;
    };
    let Ok([mut ours, mut theirs]) = faces.fork(cursor) else { return };
    let Ok(Some(mut band)) = frame.nth_band(any() as u32, strip) else { return };
    let Ok(mut depth) = DepthBuffer::new(band.area(), depth) else { return };
    report(ours.draw(|_| color(), &mut band.depth_tested(&mut depth)));
    theirs.depth_only(&mut depth);
}

fn track(dirty: &mut DirtyRegions<7>, object: &mut Tracked<i32>) {
    match any() {
        0 => object.hide(dirty),
        1 => *object = Tracked::default(),
        state => object.show(state, area(), dirty),
    }
}

fn mark(dirty: &mut DirtyRegions<7>) {
    match any() {
        0 => dirty.invalidate(),
        1 => report(dirty.take()),
        _ => dirty.mark(area()),
    }
}

entries! {
    entry_wire_rgb565(scene: &mut Scene<'_, Rgb565>, target: &mut Wire<Rgb565>) { draw(scene, target) }
    entry_wire_gray8(scene: &mut Scene<'_, Gray8>, target: &mut Wire<Gray8>) { draw(scene, target) }
    entry_wire_binary(scene: &mut Scene<'_, BinaryColor>, target: &mut Wire<BinaryColor>) { draw(scene, target) }
    entry_least_rgb565(scene: &mut Scene<'_, Rgb565>, target: &mut Least<Rgb565>) { draw(scene, target) }
    entry_least_gray8(scene: &mut Scene<'_, Gray8>, target: &mut Least<Gray8>) { draw(scene, target) }
    entry_least_binary(scene: &mut Scene<'_, BinaryColor>, target: &mut Least<BinaryColor>) { draw(scene, target) }

    entry_shaded_least_rgb565(scene: &mut Scene<'_, Rgb565>, levels: &mut [u16], target: &mut Least<Rgb565>) { shade(scene, levels, target) }
    entry_shaded_least_gray8(scene: &mut Scene<'_, Gray8>, levels: &mut [u16], target: &mut Least<Gray8>) { shade(scene, levels, target) }
    entry_shaded_least_binary(scene: &mut Scene<'_, BinaryColor>, levels: &mut [u16], target: &mut Least<BinaryColor>) { shade(scene, levels, target) }
    entry_shaded_wire_rgb565(scene: &mut Scene<'_, Rgb565>, levels: &mut [u16], target: &mut Wire<Rgb565>) { shade(scene, levels, target) }
    entry_shaded_wire_gray8(scene: &mut Scene<'_, Gray8>, levels: &mut [u16], target: &mut Wire<Gray8>) { shade(scene, levels, target) }
    entry_shaded_wire_binary(scene: &mut Scene<'_, BinaryColor>, levels: &mut [u16], target: &mut Wire<BinaryColor>) { shade(scene, levels, target) }

    entry_pixels_of_picture(scene: &mut Scene<'_, Rgb565>, mesh: &Mesh<'_>, memory: &mut [Rgb565]) { picture(scene, mesh, memory) }
    entry_pixels_of_band(scene: &mut Scene<'_, Rgb565>, mesh: &Mesh<'_>, strip: &mut [u8]) { band(scene, mesh, strip) }
    entry_band_or_strip(frame: &mut Frame<Rgb565>, strip: &mut [u8]) { report(frame.band_or_strip(strip)) }
    entry_pick(camera: &Camera, instance: &MeshInstance<'_>, cache: &mut [ScreenVertex]) { pick(camera, instance, cache) }

    entry_scene<'m>(scene: &mut pinhole::draw::Scene<'m, Rgb565, 5>, mesh: &'m Mesh<'m>, model: &Affine<Model, World>) { change(scene, mesh, model) }
    entry_draw_scene(scene: &pinhole::draw::Scene<'_, Rgb565, 5>, camera: &Camera, storage: &mut Storage<'_>) { draw_scene(scene, camera, storage) }
    entry_two_cores(cores: &mut Cores<'_>) { two_cores(cores) }
    entry_two_cores_with_depth(cores: &mut Cores<'_>) { two_cores_with_depth(cores) }

    entry_smooth(scene: &mut Scene<'_, Rgb565>, mesh: &Mesh<'_>, memory: &mut [Rgb565], kept: &mut [u8], list: &mut [SmoothEdge]) { smooth(scene, mesh, memory, kept, list) }

    entry_raster_screen_point() -> Option<ScreenPoint> { ScreenPoint::from_subpixels(any(), any()) }

    entry_dirty_new(area: Rectangle) -> DirtyRegions<7> { DirtyRegions::new(area, TransferCost::new(any() as u32, any() as u16)).with_steps(any() as u16, any() as u16) }
    entry_dirty(dirty: &mut DirtyRegions<7>) { mark(dirty) }
    entry_tracked(dirty: &mut DirtyRegions<7>, object: &mut Tracked<i32>) { track(dirty, object) }
}
