//! Turned and jittered viewports: points lie where the definition puts them once their picture is turned or moved, text and sprites are
//! turned with it, and spheres are in view where they were.

use embedded_graphics::geometry::AnchorPoint;
use embedded_graphics::pixelcolor::Gray8;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::camera::{Rotation, Visibility};
use pinhole::math::Sphere;
use pinhole::prelude::*;
use pinhole::Angle;
use support::bridge::pair::{bits, random_view, ProjectionBits, ONE};
use support::bridge::point;
use support::oracle::chain::{fx3, V3};
use support::oracle::rng::Rng;

const ROTATIONS: [Rotation; 4] = [Rotation::Deg0, Rotation::Deg90, Rotation::Deg180, Rotation::Deg270];

/// A place in a picture of w × h pixels turned by a number of quarters, one after the other.
fn turned_place(mut at: (f64, f64), mut size: (f64, f64), quarters: usize) -> (f64, f64) {
    for _ in 0..quarters {
        at = (size.1 - at.1, at.0);
        size = (size.1, size.0);
    }
    at
}

fn lenses(size: (u32, u32)) -> [ProjectionBits; 3] {
    let (w, h) = (size.0 as i32 * 400, size.1 as i32 * 400);
    let window = [-w, 2 * w, -h, h];
    [
        ProjectionBits::Perspective(1 << 29, size, ONE, 900 * ONE),
        ProjectionBits::Orthographic(window, ONE, 900 * ONE),
        ProjectionBits::Oblique(window, ONE, 900 * ONE, 1 << 28, ONE / 2),
    ]
}

#[test]
fn points_lie_where_the_turned_picture_has_them() {
    let mut rng = Rng::new(0x90);
    let (corner, size) = (Point::new(7, -20), (240, 135)); // the picture's
    for (quarters, rotation) in ROTATIONS.into_iter().enumerate() {
        let mut compared = 0;
        while compared < 4000 {
            let family = lenses(size)[rng.below(3)];
            let view_bits = random_view(&mut rng);
            let (view, picture) = (view_bits.exact(), family.picture());
            let n = picture.front + (picture.back - picture.front) * rng.real(0.001, 0.999);
            let at = picture.back_to([rng.real(-1.0, 1.0), rng.real(-1.0, 1.0)], n);
            let Some(world) = bits(view.back(at)) else { continue };
            let at: V3 = view.apply(fx3(world));
            let area = rotated_size(rotation, Size::new(size.0, size.1));
            let viewport = Viewport::new(corner, area).expect("a viewport");
            let viewport = viewport.rotated(rotation);
            assert_eq!(viewport.size(), Size::new(size.0, size.1));
            let (view, lens) = (view_bits.library().expect("a view"), family.library().expect("a lens"));
            let found = Camera::new(&view, &lens, &viewport).project(point(world)).expect("in view").point;
            let ndc = picture.ndc(at);
            let (w, h) = (f64::from(size.0), f64::from(size.1));
            let upright = ((ndc[0] + 1.0) * w / 2.0, (1.0 - ndc[1]) * h / 2.0);
            let (x, y) = turned_place(upright, (w, h), quarters);
            let exact = [x + f64::from(corner.x), y + f64::from(corner.y)];
            for (found, exact) in [found.x(), found.y()].into_iter().zip(exact) {
                assert!(
                    (f64::from(found) - exact * 256.0).abs() <= 1.0,
                    "{rotation:?} {family:?}: {found} for {exact}"
                );
            }
            compared += 1;
        }
    }
}

#[test]
fn every_point_moves_by_the_jitter() {
    let mut rng = Rng::new(0x91);
    let size = (240, 135);
    let viewport = Viewport::new(Point::new(7, -20), Size::new(size.0, size.1)).expect("a viewport");
    for (jitter, moved) in
        [([0, 0], [0, 0]), ([1, -1], [1, -1]), ([-128, 127], [-127, 127]), ([90, 31], [90, 31])]
    {
        let jittered = viewport.jittered(jitter);
        assert_eq!((jittered.area(), jittered.size()), (viewport.area(), viewport.size()));
        for family in lenses(size) {
            let view_bits = random_view(&mut rng);
            let (view, picture) = (view_bits.exact(), family.picture());
            let (library_view, lens) =
                (view_bits.library().expect("a view"), family.library().expect("a lens"));
            let [still, camera] =
                [viewport, jittered].map(|viewport| Camera::new(&library_view, &lens, &viewport));
            let mut compared = 0;
            while compared < 500 {
                let n = picture.front + (picture.back - picture.front) * rng.real(0.001, 0.999);
                let at = picture.back_to([rng.real(-1.0, 1.0), rng.real(-1.0, 1.0)], n);
                let Some(world) = bits(view.back(at)) else { continue };
                let [from, to] =
                    [still, camera].map(|camera| camera.project(point(world)).expect("in view").point);
                assert_eq!([to.x() - from.x(), to.y() - from.y()], moved, "{family:?}");
                compared += 1;
            }
        }
    }
}

/// Objects at the borders, which a scene leaves out if they are out of view, show the pixels that they have without a scene. A jitter is
/// less than half a pixel, so what lies beyond a border covers no pixel before it.
#[test]
fn a_jittered_scene_leaves_nothing_out() {
    let mut rng = Rng::new(0x92);
    let size = Size::new(24, 16);
    let window = [-12 * ONE, 12 * ONE, -8 * ONE, 8 * ONE]; // a unit is a pixel
    let lens = ProjectionBits::Orthographic(window, ONE, 900 * ONE).library().expect("a lens");
    let eye = Point3::from_ints(0, 0, 100);
    let view =
        ViewTransform::look_at(eye, Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0)).expect("a view");
    const SQUARE: [[i16; 3]; 4] = [[-256, -256, 0], [256, -256, 0], [256, 256, 0], [-256, 256, 0]];
    let mesh = Mesh::new(&SQUARE, -8, &[[0, 1, 2], [0, 2, 3]]).expect("a mesh"); // 2 pixels wide
    let mut shown = 0;
    for _ in 0..2000 {
        let jitter = [0; 2].map(|_| rng.int(-127, 127) as i8);
        let viewport = Viewport::new(Point::zero(), size).expect("a viewport").jittered(jitter);
        let camera = Camera::new(&view, &lens, &viewport);
        // Its centre lies within a pixel of where it goes out of the picture.
        let [x, y] = [13, 9].map(|out| {
            let at = out * 65_536 + rng.int(-65_536, 65_536) as i32;
            if rng.below(2) == 0 {
                at
            } else {
                -at
            }
        });
        let [x, y] = if rng.below(2) == 0 { [x, 0] } else { [0, y] }.map(Scalar::from_bits);
        let model = Affine::translation(Vector3::new(x, y, Scalar::ZERO));
        let mut drawn = [[Gray8::BLACK; 24 * 16]; 2];
        let [alone, of_scene] = &mut drawn;
        let mut picture = Picture::new(alone, size).expect("a picture");
        let Ok(_) = camera.place(&mesh, &model).faces(|_| Gray8::WHITE).draw(&mut picture.pixels());
        let mut scene = Scene::<(), 1>::new();
        scene.add(Object::new(&mesh, model, ())).expect("room");
        let mut cache = [ScreenVertex::EMPTY; 4];
        let mut picture = Picture::new(of_scene, size).expect("a picture");
        let placed = scene.place(&camera);
        let Ok(_) = placed.draw(|_, _| |_| Gray8::WHITE, &mut cache, &mut picture.pixels());
        assert!(drawn[0] == drawn[1], "{jitter:?} {x:?} {y:?}");
        shown += usize::from(drawn[0].contains(&Gray8::WHITE));
    }
    assert!((500..1500).contains(&shown), "{shown}");
}

const PANEL: Size = Size::new(24, 16);

/// The pixel of the panel that shows a pixel of the picture.
fn on_panel(at: Point, viewport: &Viewport, quarters: usize) -> Point {
    let Size { width, height } = viewport.size();
    let centre = (f64::from(at.x) + 0.5, f64::from(at.y) + 0.5);
    let (x, y) = turned_place(centre, (width.into(), height.into()), quarters);
    viewport.area().top_left + Point::new(x.floor() as i32, y.floor() as i32)
}

#[test]
fn what_is_drawn_upright_is_turned_with_the_picture() {
    let mut rng = Rng::new(3);
    let inside = Rectangle::new(Point::zero(), PANEL);
    for (quarters, rotation) in ROTATIONS.into_iter().enumerate() {
        for _ in 0..300 {
            // A viewport, a rectangle and pixels anywhere, some outside.
            let mut within = |low: i32, extent: usize| low + rng.below(extent) as i32;
            let corner = Point::new(within(-8, 30), within(-6, 20));
            let size = Size::new(within(1, 20) as u32, within(1, 14) as u32);
            let viewport = Viewport::new(corner, size).expect("a viewport").rotated(rotation);
            let size = Size::new(within(0, 9) as u32, within(0, 9) as u32);
            let block = Rectangle::new(Point::new(within(-4, 20), within(-4, 20)), size);
            let dots = [0; 20].map(|_| Point::new(within(-2, 24), within(-2, 24)));

            let mut pixels = [Gray8::BLACK; 24 * 16];
            let mut picture = Picture::new(&mut pixels, PANEL).expect("room");
            let mut upright = viewport.upright(&mut picture);
            let bounds = upright.bounding_box();
            upright.fill_solid(&block, Gray8::new(50)).expect("infallible");
            upright.draw_iter(dots.map(|at| Pixel(at, Gray8::WHITE))).expect("infallible");

            let mut expected = [Gray8::BLACK; 24 * 16];
            let mut put = |at, color| {
                let Point { x, y } = on_panel(at, &viewport, quarters);
                if inside.contains(Point::new(x, y)) {
                    expected[(y * 24 + x) as usize] = color;
                }
            };
            block.points().for_each(|at| put(at, Gray8::new(50)));
            dots.into_iter().for_each(|at| put(at, Gray8::WHITE));
            assert_eq!(pixels, expected, "{viewport:?} {block:?}");
            let whole = Rectangle::new(Point::zero(), viewport.size());
            for at in whole.points() {
                let is_shown = inside.contains(on_panel(at, &viewport, quarters));
                assert_eq!(bounds.contains(at), is_shown, "{viewport:?} {at}");
            }
            assert_eq!(bounds.intersection(&whole), bounds);
        }
    }
}

/// A sprite on a turned panel shows the texels of the sprite in the upright picture, at the same pixels, where it is turned by the viewport's
/// rotation. Its point lies between pixels, so that no border goes through their centres.
#[test]
fn turned_sprites_are_upright_for_the_viewer() {
    const TEXELS: [[Gray8; 8]; 16] = {
        let mut texels = [[Gray8::BLACK; 8]; 16];
        let mut at = 0;
        while at < 128 {
            texels[at / 8][at % 8] = Gray8::new(at as u8 + 1);
            at += 1;
        }
        texels
    };
    use AnchorPoint::*;
    let anchors = [
        TopLeft,
        TopCenter,
        TopRight,
        CenterLeft,
        Center,
        CenterRight,
        BottomLeft,
        BottomCenter,
        BottomRight,
    ];
    let sprite = Sprite::new(&TEXELS);
    let half = |texels: i16| Scalar::from_ratio(i32::from(texels), 16);
    let sprites = anchors.into_iter().flat_map(|anchor| {
        let sized = sprite.with_size(half(5), half(9)).with_anchor(anchor);
        [sprite.with_anchor(anchor), sprite.magnified(2).with_anchor(anchor), sized]
    });
    let sprites = sprites.chain([
        sprite.with_anchor_at(2, 5),
        sprite.with_anchor_at(8, 16),
        sprite.with_anchor_at(90, 70),
    ]);
    let size = Size::new(62, 46); // even numbers: the middle is a corner of pixels
    let sphere = Sphere { centre: Point3::from_ints(0, 0, 0), radius: Scalar::from_int(1) };
    for sprite in sprites {
        let draw = |area: Size, rotation| {
            let viewport = Viewport::new(Point::zero(), area).expect("a viewport").rotated(rotation);
            let camera = Camera::framing(&sphere, &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO);
            let placed = camera.expect("a camera").place_sprite(Point3::from_ints(0, 0, 0));
            let mut pixels = [Gray8::BLACK; 62 * 46];
            let mut picture = Picture::new(&mut pixels, area).expect("room");
            let turned = sprite.rotated(rotation);
            placed.draw(|_| turned, &mut picture.pixels()).expect("infallible");
            (pixels, viewport)
        };
        let (upright, _) = draw(size, Rotation::Deg0);
        assert!(upright.iter().any(|color| *color != Gray8::BLACK));
        for (quarters, rotation) in ROTATIONS.into_iter().enumerate() {
            let area = rotated_size(rotation, size);
            let (found, viewport) = draw(area, rotation);
            for at in Rectangle::new(Point::zero(), size).points() {
                let Point { x, y } = on_panel(at, &viewport, quarters);
                let (own, there) = (at.y * 62 + at.x, y * area.width as i32 + x);
                assert_eq!(
                    found[there as usize],
                    upright[own as usize],
                    "{rotation:?} {:?} {at}",
                    format!("{sprite:?}").split("size:").last()
                );
            }
        }
    }
}

#[test]
fn spheres_are_in_view_where_they_were() {
    let mut rng = Rng::new(8);
    let sphere = Sphere { centre: Point3::from_ints(0, 0, 0), radius: Scalar::from_int(1) };
    let all = Sphere { radius: Scalar::from_int(8), ..sphere };
    let mut seen = [0; 3];
    for _ in 0..3000 {
        let at = [(); 3].map(|()| rng.int(-12, 12) as i16);
        let model = Affine::translation(Vector3::from_ints(at[0], at[1], at[2]));
        let found = ROTATIONS.map(|rotation| {
            let size = rotated_size(rotation, Size::new(320, 120));
            let viewport = Viewport::new(Point::zero(), size).expect("a viewport").rotated(rotation);
            let camera = Camera::framing(&all, &viewport, Angle::degrees(50), Angle::ZERO, Angle::ZERO);
            camera.expect("a camera").frustum().visibility(&sphere, &model)
        });
        assert!(found.iter().all(|one| *one == found[0]), "{at:?}: {found:?}");
        let kinds = [Visibility::Outside, Visibility::Partly, Visibility::Inside];
        seen[kinds.iter().position(|kind| *kind == found[0]).expect("a kind")] += 1;
    }
    assert!(seen.iter().all(|count| *count > 0), "{seen:?}");
}

fn rotated_size(rotation: Rotation, size: Size) -> Size {
    match rotation {
        Rotation::Deg0 | Rotation::Deg180 => size,
        Rotation::Deg90 | Rotation::Deg270 => Size::new(size.height, size.width),
    }
}
