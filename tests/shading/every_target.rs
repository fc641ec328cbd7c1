//! A scene on every kind of target: pixels in memory, other targets, in one piece and in bands, with a depth buffer and without.
//! Vertices are transformed with depth for bands, as some shaders need it. Shaders come from `dyn Fn`, because each type of a closure would
//! instantiate every draw call again, and the compiler would take most of the time of these tests.

use crate::textures::{Display, Scene, SIDE};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{PointsIter, Rectangle};
use pinhole::space::{Model, World};
use pinhole::{
    Affine, Cull, DepthBuffer, Frame, Mesh, MeshInstance, Picture, ScreenVertex, SpanShader, Target,
};

pub(crate) const SKY: Rgb888 = Rgb888::new(1, 2, 3);

/// The pictures of a scene without depth and with depth, and the depth buffer.
pub(crate) struct Drawn {
    pub(crate) solid: Vec<Rgb888>,
    pub(crate) deep: Vec<Rgb888>,
    pub(crate) depths: Vec<u16>,
}

const SIZE: Size = Size::new(SIDE, SIDE);

fn area() -> Rectangle {
    Rectangle::new(Point::zero(), SIZE)
}

fn sky() -> Vec<Rgb888> {
    vec![SKY; (SIDE * SIDE) as usize]
}

fn with_instance(scene: &Scene, draw: &mut dyn FnMut(&MeshInstance<'_>)) {
    let mesh = Mesh::new(&scene.vertices, scene.exponent, &scene.faces).unwrap();
    let camera = Scene::camera();
    draw(&camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(Cull::None))
}

fn solid<S: SpanShader<Rgb888>, T: Target<Color = Rgb888>>(
    scene: &Scene,
    shade: &dyn Fn(usize) -> S,
    target: &mut T,
) {
    let mut cache = vec![ScreenVertex::EMPTY; scene.vertices.len()];
    with_instance(scene, &mut |instance| {
        assert!(instance.solid(shade, &mut cache, target).is_ok());
    });
}

/// Draws with a depth buffer of `area`, and returns the depths of the picture.
fn deep<S: SpanShader<Rgb888>, T: Target<Color = Rgb888>>(
    scene: &Scene,
    shade: &dyn Fn(usize) -> S,
    depth_area: Rectangle,
    target: &mut T,
) -> Vec<u16> {
    let mut cache = vec![ScreenVertex::EMPTY; scene.vertices.len()];
    let mut storage = vec![0; (depth_area.size.width * depth_area.size.height) as usize];
    let mut depth = DepthBuffer::new(depth_area, &mut storage).unwrap();
    with_instance(scene, &mut |instance| {
        assert!(instance.depth_tested(shade, &mut cache, &mut depth, target).is_ok());
    });
    area().points().map(|p| depth.at(p).unwrap()).collect()
}

/// In bands of 7 rows of a region of odd width: calls `draw` for each band, and compares with a picture in one piece.
fn in_bands(picture: &[Rgb888], draw: &mut dyn FnMut(&mut pinhole::Band<'_, Rgb888>)) {
    let region = Rectangle::new(Point::new(37, 11), Size::new(119, 205));
    let mut strip = vec![0u8; 119 * 7 * 3];
    let (mut frame, mut banded) = (Frame::new(region, SKY), Display(sky()));
    while let Some(mut band) = frame.next_band(&mut strip).unwrap() {
        draw(&mut band);
        let Ok(()) = band.send(&mut banded);
    }
    for p @ Point { x, y } in region.points() {
        let at = (y as u32 * SIDE + x as u32) as usize;
        assert_eq!(banded.0[at], picture[at], "{p}");
    }
}

/// Draws in memory: in one piece, with a depth buffer of another layout, and in bands. All pictures are equal.
pub(crate) fn in_memory<S: SpanShader<Rgb888>>(scene: &Scene, shade: &dyn Fn(usize) -> S) -> Drawn {
    let mut drawn = Drawn { solid: sky(), deep: sky(), depths: Vec::new() };
    solid(scene, shade, &mut Picture::new(&mut drawn.solid, SIZE).unwrap().pixels());
    drawn.depths = deep(scene, shade, area(), &mut Picture::new(&mut drawn.deep, SIZE).unwrap().pixels());

    let wider = Rectangle::new(Point::new(-3, -1), SIZE + Size::new(5, 2));
    let mut other = sky();
    let depths = deep(scene, shade, wider, &mut Picture::new(&mut other, SIZE).unwrap().pixels());
    assert!(other == drawn.deep && depths == drawn.depths);

    with_instance(scene, &mut |instance| {
        let mut cache = vec![ScreenVertex::EMPTY; scene.vertices.len()];
        let mut bin_storage = vec![0u16; 4096];
        let mut faces = instance.transform_depth(&mut cache).bin_faces(&mut bin_storage).unwrap();
        in_bands(&drawn.solid, &mut |band| faces.solid(shade, &mut band.pixels()).unwrap());
        let mut storage = vec![0; 119 * 7];
        let mut faces = instance.transform_depth(&mut cache).bin_faces(&mut bin_storage).unwrap();
        in_bands(&drawn.deep, &mut |band| {
            let mut depth = DepthBuffer::new(band.area(), &mut storage).unwrap();
            faces.depth_tested(shade, &mut depth, &mut band.pixels()).unwrap();
        });
    });
    drawn
}

/// One pixel in so many is picked: the columns of successive rows differ.
const PICKED: usize = 247;

/// Draws into memory and into a DrawTarget that is not the library's, in one piece and in bands. All pictures are equal, and picking
/// finds the depths that are stored.
pub(crate) fn on_every_target<S: SpanShader<Rgb888>>(scene: &Scene, shade: &dyn Fn(usize) -> S) -> Drawn {
    let drawn = in_memory(scene, shade);
    let mut display = Display(sky());
    solid(scene, shade, &mut display);
    assert!(display.0 == drawn.solid);
    let mut display = Display(sky());
    let depths = deep(scene, shade, area(), &mut display);
    assert!(display.0 == drawn.deep && depths == drawn.depths);
    with_instance(scene, &mut |instance| {
        let mut cache = vec![ScreenVertex::EMPTY; scene.vertices.len()];
        let mut bin_storage = vec![0u16; 4096];
        let mut faces = instance.transform_depth(&mut cache).bin_faces(&mut bin_storage).unwrap();
        in_bands(&drawn.solid, &mut |band| faces.solid(shade, band).unwrap());
        if S::WRITES_DEPTH {
            let transformed = instance.transform_depth(&mut cache);
            for (pixel, &depth) in area().points().zip(&drawn.depths).step_by(PICKED) {
                let picked = transformed.pick(pixel, shade);
                assert_eq!(picked.map_or(DepthBuffer::NOTHING, |picked| picked.depth), depth, "{pixel}");
            }
        }
    });
    drawn
}
