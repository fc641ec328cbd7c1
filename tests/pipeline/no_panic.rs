//! No input panics: all arguments extreme at once, drawn by every call in a solid colour, with overflow checks (other
//! shaders: `shading`, `properties` and the fuzz targets). No scene writes outside viewport ∩ target.

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::raster::{Pixel, ScreenPoint};
use pinhole::{
    draw_line, fill_triangle, Camera, Coordinate, Cull, DepthBuffer, Mesh, MeshInstance, Painter,
    ScreenVertex, Viewport, WithPlanes,
};
use std::convert::Infallible;
use support::bridge;
use support::bridge::draw::Shader;
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

fn wild(rng: &mut Rng) -> i32 {
    match rng.below(7) {
        0 => [0, 1, -1, i32::MAX, i32::MIN, ONE, -ONE][rng.below(7)],
        1 | 2 => (rng.bits() as i32) >> rng.below(32),
        3 => i32::MAX - rng.int(0, 3) as i32,
        4 => i32::MIN + rng.int(0, 3) as i32,
        5 => rng.int(-9, 9) as i32 * ONE,
        _ => rng.bits() as i32,
    }
}

fn wild16(rng: &mut Rng) -> i16 {
    match rng.below(5) {
        0 => [0, 1, -1, i16::MAX, i16::MIN][rng.below(5)],
        1 => (rng.bits() as i16) >> rng.below(16),
        _ => rng.bits() as i16,
    }
}

fn wild3(rng: &mut Rng) -> [i32; 3] {
    [0; 3].map(|_| wild(rng))
}

fn wild_camera(rng: &mut Rng) -> Option<(Camera, CameraBits)> {
    let (a, b, c) = (wild3(rng), wild3(rng), wild3(rng));
    let view = match rng.below(3) {
        0 => ViewBits::LookAt(a, b, c),
        1 => ViewBits::LookAlong(a, b, c),
        _ => ViewBits::Reference(a, b, c),
    };
    let (n, f) = (wild(rng), wild(rng));
    let w = [0; 4].map(|_| wild(rng));
    let projection = match rng.below(3) {
        0 => ProjectionBits::Perspective(
            rng.bits() >> 1,
            (rng.bits() >> rng.below(32), rng.bits() >> rng.below(32)),
            n,
            f,
        ),
        1 => ProjectionBits::Frustum(w, n, f),
        _ => ProjectionBits::Orthographic(w, n, f),
    };
    let viewport = if rng.one_in(2) {
        (rng.int(-30, 30) as i32, rng.int(-30, 30) as i32, rng.int(1, 60) as u32, rng.int(1, 60) as u32)
    } else {
        (
            rng.int(-8192, 8192) as i32,
            rng.int(-8192, 8192) as i32,
            rng.int(1, 16384) as u32,
            rng.int(1, 16384) as u32,
        )
    };
    let (x, y, width, height) = viewport;
    let ours = Viewport::new(Point::new(x, y), Size::new(width, height)).ok()?;
    let camera = Camera::new(&view.library().ok()?, &projection.library().ok()?, &ours);
    Some((camera.with_far_clip(rng.one_in(2)), CameraBits { view, projection, viewport }))
}

fn wild_model(rng: &mut Rng) -> ModelBits {
    let mut steps = Vec::new();
    for _ in 0..rng.below(5) {
        steps.push(match rng.below(6) {
            0 => Step::X(rng.bits()),
            1 => Step::Y(rng.bits()),
            2 => Step::Z(rng.bits()),
            3 => Step::Scale([wild(rng); 3]),
            4 => Step::Scale(wild3(rng)),
            _ => Step::Move(wild3(rng)),
        });
    }
    ModelBits(steps)
}

fn draw_every_way<V: Coordinate>(
    rng: &mut Rng,
    instance: MeshInstance<'_, V, WithPlanes>,
    viewport: (i32, i32, u32, u32),
) -> u32 {
    let by_planes = instance.with_cull([Cull::Back, Cull::None][rng.below(2)]);
    let instance = by_planes.without_planes();
    for v in 0..7 {
        let _ = instance.project(v);
    }
    let mut target = Recorder::sized(20, 15);
    let mut cache = [ScreenVertex::default(); 6];
    let cache = &mut cache[..rng.below(7)];
    instance.solid(|face| Shader(face as u16), cache, &mut target).expect("no error");
    by_planes.solid(|face| Shader(face as u16), cache, &mut target).expect("no error");
    let mut depths = [0; 20 * 15];
    let mut depth = DepthBuffer::new(target.bounding_box(), &mut depths).expect("as large as the target");
    by_planes.depth_tested(|face| Shader(face as u16), cache, &mut depth, &mut target).expect("no error");
    by_planes.depth_only(cache, &mut depth);
    by_planes.pick(Point::new(9, 7), |face| Shader(face as u16), cache);
    instance.depth_tested(|face| Shader(face as u16), cache, &mut depth, &mut target).expect("no error");
    instance.depth_only(cache, &mut depth);
    instance.wireframe(Shader(1), cache, &mut target).expect("no error");
    instance.wireframe_depth_tested(Shader(1), cache, &mut depth, &mut target).expect("no error");
    instance.hidden_line(Shader(1), cache, &mut depth, &mut target).expect("no error");
    instance.points(Shader(1), &mut target).expect("no error");
    instance.polyline(Shader(1), &mut target).expect("no error");
    let (mut bin_storage, mut more) = ([0; 6], [0; 6]); // of five, and one for every 16
    let mut faces = by_planes.bin_faces_with_depth(cache, &mut bin_storage).expect("room");
    faces.depth_tested(|face| Shader(face as u16), &mut depth, &mut target).expect("no error");
    let mut faces = by_planes.bin_faces(cache, &mut bin_storage).expect("room");
    faces.solid(|face| Shader(face as u16), &mut target).expect("no error");
    let transformed = instance.transform_depth(cache);
    let mut faces = transformed.bin_faces(&mut bin_storage).expect("room");
    let mut edges = transformed.bin_edges(&mut more).expect("room");
    faces.solid(|face| Shader(face as u16), &mut target).expect("no error");
    faces.depth_tested(|face| Shader(face as u16), &mut depth, &mut target).expect("no error");
    edges.draw(Shader(1), &mut target).expect("no error");
    edges.depth_tested(Shader(1), &mut depth, &mut target).expect("no error");
    edges.hidden_line(Shader(1), &mut depth, &mut target).expect("no error");
    let mut painter = Painter::<Shader, 30, 16>::new();
    let _ = painter.add(&instance, |_| Shader(2));
    let _ = painter.add(&by_planes, |_| Shader(3));
    painter.draw(&mut target).expect("no error");
    assert_eq!(target.outside, 0);
    let (x, y, width, height) = viewport;
    for &(px, py) in target.pixels.keys() {
        let inside = px >= x && py >= y && px - x < width as i32 && py - y < height as i32;
        assert!(inside, "({px}, {py}) is outside {viewport:?}");
    }
    u32::from(!target.pixels.is_empty())
}

#[test]
fn extreme_scenes_do_not_panic() {
    let mut rng = Rng::new(0x111);
    let ordinary = CameraBits {
        view: ViewBits::LookAt([0, 0, 5 * ONE], [0; 3], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 30, (4, 3), ONE / 4, 100 * ONE),
        viewport: (0, 0, 20, 15),
    };
    let (mut scenes, mut visible) = (0, 0);
    while scenes < 60_000 {
        // Extreme objects before an ordinary camera, too.
        let camera = match rng.one_in(3) {
            true => Some((ordinary.library(), ordinary)),
            false => wild_camera(&mut rng),
        };
        let Some((camera, bits)) = camera else { continue };
        scenes += 1;
        let model = wild_model(&mut rng).library();
        let faces = [(); 5].map(|()| [0; 3].map(|_| rng.below(6) as u16));
        let edges = [(); 5].map(|()| [0; 2].map(|_| rng.below(6) as u16));
        let normals = [(); 5].map(|()| [0; 3].map(|_| wild16(&mut rng)));
        let wild = [(); 5].map(|()| wild16(&mut rng));
        macro_rules! draw {
            ($mesh:expr) => {{
                let mesh = $mesh.and_then(|m| m.with_edges(&edges)).expect("a mesh");
                let mesh = mesh.with_normals(&normals).expect("as many as faces");
                let planes = if rng.one_in(2) { wild } else { mesh.face_planes() };
                let mesh = match rng.one_in(3) {
                    true => mesh.with_planes_if_any(),
                    false => mesh.with_planes(&planes).expect("as many as faces"),
                };
                visible += draw_every_way(&mut rng, camera.place(&mesh, &model), bits.viewport);
            }};
        }
        if rng.one_in(2) {
            let vertices = [(); 6].map(|()| [0; 3].map(|_| wild16(&mut rng)));
            draw!(Mesh::new(&vertices, rng.int(-32, 15) as i8, &faces));
        } else {
            let vertices = [(); 6].map(|()| wild3(&mut rng).map(bridge::scalar));
            draw!(Mesh::from_fixed(&vertices, &faces));
        }
    }
    println!("{visible} of {scenes} scenes show something");
    assert!(visible > 2000, "{visible}");
}

/// A target of the largest size that `embedded-graphics` can express, at any position.
struct Endless {
    area: Rectangle,
    runs: u32,
}

impl Dimensions for Endless {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl DrawTarget for Endless {
    type Color = Gray8;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = embedded_graphics_core::Pixel<Gray8>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        self.runs += u32::from(pixels.into_iter().count() > 0);
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, _: Gray8) -> Result<(), Infallible> {
        let Rectangle { top_left: Point { x, y }, size } = *area;
        assert!(x >= self.area.top_left.x && y >= self.area.top_left.y && size.width * size.height > 0);
        self.runs += 1;
        Ok(())
    }
}

/// 2D calls have no viewport: only the bounds of the target clip them.
#[test]
fn targets_of_the_largest_size_do_not_panic() {
    let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(256 * x, 256 * y).unwrap();
    let triangles = [[(0, 0), (4, 0), (0, 4)], [(-8192, -8192), (8192, -8192), (-8192, 8192)]];
    // The slanted edges pass through centres, and are right edges: of the first one rows 0 to 2 are covered. Of the second
    // pixels x ≤ −y − 2: rows −8192 to 8190, from (−9, −9) on rows −9 to 7.
    for (from, rows) in [(i32::MIN, [3, 16_383]), (0, [3, 0]), (-9, [3, 17]), (i32::MAX, [0, 0])] {
        let area = Rectangle::new(Point::new(from, from), Size::new(u32::MAX, u32::MAX));
        for (triangle, rows) in triangles.iter().zip(rows) {
            let mut target = Endless { area, runs: 0 };
            let Ok(()) = fill_triangle(triangle.map(|(x, y)| corner(x, y)), Gray8::WHITE, &mut target);
            assert_eq!(target.runs, rows, "from {from}");
        }
        let mut target = Endless { area, runs: 0 };
        let ends = [-9, i16::MAX].map(|x| Pixel { x, y: 3 });
        let Ok(()) = draw_line(ends[0], ends[1], Gray8::WHITE, &mut target);
        assert_eq!(target.runs, u32::from(from < i32::MAX), "from {from}");
    }
}
