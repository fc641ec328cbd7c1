//! Scenes of many objects, against the objects placed and drawn by hand, one after the other: equal pixel by pixel, in bands, in
//! one piece and in painter's order. And picking, against the pictures of faces that a depth-tested drawing gives.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{raw::RawU16, Rgb565};
use embedded_graphics_core::prelude::*;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::space::{Model, World};
use pinhole::{
    camera::Visibility, draw::Picked, prelude::*, shading::SpanShader, target::BufferError, texture::Texture,
    Angle,
};
use support::bridge::draw::{CUBE, CUBE_FACES};
use support::bridge::rectangle;
use support::bridge::ways::{bands, memory, memory_with};
use support::oracle::rng::Rng;
use support::oracle::target::{area, Recorder};
use support::solids::Solid;

const WIDTH: u32 = 56;
const HEIGHT: u32 = 41;
const AREA: Rectangle = Rectangle::new(Point::zero(), Size::new(WIDTH, HEIGHT));
const OBJECTS: usize = 24;

/// A tetrahedron and a cube; the cube's faces are those of a closed mesh.
const TETRAHEDRON: [[i16; 3]; 4] = [[9, 9, 9], [9, -9, -9], [-9, 9, -9], [-9, -9, 9]];
const TETRAHEDRON_FACES: [[u16; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];

/// A stripe.
static TEXELS: [[Rgb565; 8]; 8] = {
    let mut texels = [[Rgb565::RED; 8]; 8];
    texels[3] = [Rgb565::BLUE; 8];
    texels
};

/// A mesh with planes, and one without.
type Meshes = (Mesh<'static>, Mesh<'static>);

fn meshes() -> Meshes {
    let cube = Mesh::new(&CUBE, 0, &CUBE_FACES).expect("a cube");
    let normals = Solid::new(CUBE.to_vec(), 0, CUBE_FACES.to_vec()).normals();
    let cube = cube.with_normals(normals.leak()).expect("normals");
    let planes: [i16; 12] = cube.face_planes();
    let tetrahedron = Mesh::new(&TETRAHEDRON, -3, &TETRAHEDRON_FACES).expect("a tetrahedron");
    (cube.with_planes(planes.to_vec().leak()).expect("planes"), tetrahedron)
}

/// The number of a face of an object, as a colour. Black, 0, is the background.
fn number(object: usize, face: usize) -> Rgb565 {
    Rgb565::from(RawU16::new((object * 12 + face + 1) as u16))
}

/// The cull mode of an object, by a rule that shares no code with the library.
fn cull(object: usize) -> Cull {
    match object % 4 {
        1 => Cull::None,
        3 => Cull::Front,
        _ => Cull::Back,
    }
}

/// Objects around the camera: before and behind it, near, far and beside it, some of them through others.
fn random<'m>(rng: &mut Rng, meshes: &'m Meshes) -> Scene<'m, usize, OBJECTS> {
    let mut scene = Scene::new();
    for index in 0..OBJECTS {
        let turned = Affine::<Model, World>::identity()
            .rotate_x(Angle::from_bits(rng.bits()))
            .rotate_y(Angle::from_bits(rng.bits()))
            .then(&Affine::scale(Scalar::try_from(rng.log(0.3, 2.0)).expect("in range")));
        let [x, y, z] = [rng.real(-9.0, 9.0), rng.real(-6.0, 6.0), rng.real(-14.0, 6.0)]
            .map(|v| Scalar::try_from(v).expect("in range"));
        let model = turned.translate(Vector3::new(x, y, z));
        let mut object = match rng.below(2) {
            0 => Object::new(&meshes.0, model, index),
            _ => Object::new(&meshes.1, model, index),
        };
        object.cull = cull(index);
        assert_eq!(scene.add(object), Ok(index));
    }
    scene
}

fn camera(rng: &mut Rng) -> Camera {
    // The viewport need not be that of the picture.
    let viewport = Viewport::new(Point::new(3, -2), Size::new(WIDTH - 5, HEIGHT)).expect("a viewport");
    let (yaw, pitch) = (Angle::from_bits(rng.bits() >> 4), Angle::from_bits(rng.bits() >> 5));
    let centre = Point3::from_ints(0, 0, -4);
    let view =
        ViewTransform::orbit(centre, Scalar::try_from(rng.real(2.0, 9.0)).expect("in range"), yaw, pitch);
    let [near, far] = [1, 14].map(Scalar::from_int);
    let lens = Projection::perspective(Angle::degrees(65), viewport.size(), near, far).expect("a lens");
    Camera::new(&view, &lens, &viewport)
}

/// The sum of a length over the meshes of all visible objects.
fn sum<M>(
    placed: &pinhole::draw::PlacedScene<'_, '_, M, OBJECTS>,
    length: impl Fn(&Mesh<'_>) -> usize,
) -> usize {
    placed.iter().map(|(object, _)| length(object.mesh())).sum()
}

/// All objects of a scene, placed and drawn one by one, without culling of objects or by planes: the faces as numbers, and their
/// depths. `shader` makes the shader of a face from its number.
fn by_hand<S: SpanShader<Rgb565>>(
    scene: &Scene<'_, usize, OBJECTS>,
    camera: &Camera,
    shader: impl Fn(Rgb565) -> S,
) -> (Vec<Rgb565>, Vec<u16>) {
    memory_with(AREA, AREA, Rgb565::BLACK, &mut |target, depth| {
        for (index, object) in scene.iter().enumerate() {
            let instance = camera.place(object.mesh(), &object.model).with_cull(cull(index));
            let Ok(_) =
                instance.faces(|face| shader(number(index, face))).draw(&mut target.depth_tested(depth));
        }
    })
}

fn in_bands<S: SpanShader<Rgb565>>(
    scene: &Scene<'_, usize, OBJECTS>,
    camera: &Camera,
    (rows, cache): (u32, usize),
    shader: impl Fn(Rgb565) -> S + Copy,
) -> (Vec<Rgb565>, Statistics) {
    let placed = scene.place(camera);
    let mut cache = vec![ScreenVertex::EMPTY; cache.min(sum(&placed, |mesh| mesh.vertices().len()))];
    let mut bins = vec![0; sum(&placed, |mesh| mesh.face_bins_len())];
    let mut faces = placed.bin_faces(&mut cache, &mut bins).expect("room for all faces");
    let pixels = bands(AREA, Rgb565::BLACK, rows, &mut |band, depth| {
        let shade = |index: usize, object: &Object<'_, usize>| {
            assert_eq!(index, object.material);
            move |face| shader(number(index, face))
        };
        let Ok(()) = faces.draw(shade, &mut band.pixels().depth_tested(depth));
    });
    (pixels, faces.statistics())
}

#[test]
fn a_scene_is_its_objects_drawn_by_hand() {
    let meshes = &meshes();
    let mut rng = Rng::new(0xe1);
    let (mut culled, mut drawn, mut clipped) = (0, 0, 0);
    for _ in 0..60 {
        let (scene, camera) = (random(&mut rng, meshes), camera(&mut rng));
        let (wanted, _) = by_hand(&scene, &camera, |number| number);
        for (rows, cache) in [(1, usize::MAX), (7, 30), (HEIGHT, 0)] {
            let (found, statistics) = in_bands(&scene, &camera, (rows, cache), |number| number);
            assert!(found == wanted, "{rows} rows");
            clipped += statistics.clipped;
        }
        // Textures also need w of the corners, which no cache holds.
        let textured = |_| Texture::new(&TEXELS).at([[0, 128], [128, 128], [128, 0]]);
        let (wanted_texture, _) = by_hand(&scene, &camera, textured);
        assert!(in_bands(&scene, &camera, (7, usize::MAX), textured).0 == wanted_texture);

        // In one piece, and which objects are asked for their shaders.
        let placed = scene.place(&camera);
        let (mut asked, mut statistics) = (Vec::new(), None);
        let pixels = memory(AREA, Rgb565::BLACK, &mut |target, depth| {
            let shade = |index: usize, object: &Object<'_, usize>| {
                assert_eq!(index, object.material);
                asked.push(index);
                move |face| number(index, face)
            };
            let Ok(counted) =
                placed.draw(shade, &mut [ScreenVertex::EMPTY; 8], &mut target.depth_tested(depth));
            statistics = Some(counted);
        });
        let statistics = statistics.expect("drawn");
        assert!(pixels == wanted);
        let visible: Vec<usize> = (0..OBJECTS)
            .filter(|&index| {
                let object = &scene[index];
                camera.frustum().visibility(&object.sphere, &object.model) != Visibility::Outside
            })
            .collect();
        assert_eq!(asked, visible, "an object out of view costs the test of its sphere only");
        assert_eq!(placed.iter().count(), visible.len());
        let faces: usize = visible.iter().map(|&index| scene[index].mesh().faces().len()).sum();
        let sum = |s: &Statistics| (s.drawn + s.culled + s.outside + s.degenerate) as usize;
        let (_, banded) = in_bands(&scene, &camera, (8, 0), |number| number);
        // In one piece, planes also cull faces that are out of view or degenerate.
        assert!(banded.culled <= statistics.culled, "{banded:?} {statistics:?}");
        assert_eq!([sum(&statistics), sum(&banded)], [faces; 2]);
        let d = statistics.drawn;
        assert_eq!((d, statistics.clipped), (banded.drawn, banded.clipped));
        (culled, drawn) = (culled + OBJECTS - visible.len(), drawn + d);
    }
    assert!(culled > 300 && drawn > 2000 && clipped > 300, "{culled} {drawn} {clipped}");
}

/// A binned scene is drawn onto targets of any bounds, and a band once more after its target failed.
#[test]
fn a_binned_scene_is_drawn_onto_targets_of_any_size_and_after_they_failed() {
    let (mut rng, meshes) = (Rng::new(0xe7), meshes());
    let shade = |index: usize, _: &Object<'_, usize>| move |face| number(index, face);
    for _ in 0..20 {
        let (scene, camera) = (random(&mut rng, &meshes), camera(&mut rng));
        let placed = scene.place(&camera);
        let mut cache = vec![ScreenVertex::EMPTY; sum(&placed, |mesh| mesh.vertices().len())];
        let mut bins = vec![0; sum(&placed, |mesh| mesh.face_bins_len())];
        let mut faces = placed.bin_faces(&mut cache, &mut bins).expect("room for all faces");
        let mut whole = Recorder::new(rectangle(-100, -100, 300, 300));
        faces.draw(shade, &mut whole).expect("no error");
        let is_part = |target: &Recorder<_>| {
            let bounds = area(target.bounding_box());
            let inside = whole.pixels.iter().filter(|((x, y), _)| bounds.contains((*x).into(), (*y).into()));
            target.outside == 0 && target.pixels.iter().eq(inside)
        };
        const MOST: u32 = u32::MAX;
        for (x, y, width, height) in [
            (0, 0, 1 << 31, 64),
            (1, 1, MOST >> 1, 64),
            (-1000, -1000, MOST, MOST),
            (i32::MIN, i32::MIN, MOST, MOST),
        ] {
            let mut target = Recorder::new(rectangle(x, y, width, height));
            faces.draw(shade, &mut target).expect("no error");
            assert!(is_part(&target), "{x} {y} {width} {height}");
        }
        for top in (0..HEIGHT as i32).step_by(7) {
            let mut after = 0;
            let drawn = loop {
                let mut target = Recorder::new(rectangle(0, top, WIDTH, 7));
                target.fails_at = Some(after);
                if faces.draw(shade, &mut target).is_ok() {
                    break target;
                }
                after = 2 * after + 1;
            };
            assert!(is_part(&drawn), "row {top}");
        }
    }
}

/// Of a binned scene, the shaders of an object are asked for in the bands that its faces meet, and in no others.
#[test]
fn a_band_asks_for_the_shaders_of_its_objects() {
    let (mut rng, meshes) = (Rng::new(0xe5), meshes());
    let (mut asked, mut not_asked) = (0, 0);
    for _ in 0..20 {
        let (scene, camera) = (random(&mut rng, &meshes), camera(&mut rng));
        // The rows of each object's pixels, drawn alone.
        let rows_of = |object: &Object<'_, usize>| {
            let mesh = object.mesh();
            let instance = camera.place(mesh, &object.model).with_cull(cull(object.material));
            let pixels = memory(AREA, Rgb565::BLACK, &mut |target, depth| {
                let Ok(_) = instance.faces(|face| number(0, face)).draw(&mut target.depth_tested(depth));
            });
            let drawn = |row: &i32| {
                let row = *row as usize * WIDTH as usize;
                pixels[row..row + WIDTH as usize].iter().any(|&pixel| pixel != Rgb565::BLACK)
            };
            let rows: Vec<i32> = (0..HEIGHT as i32).filter(drawn).collect();
            rows.first().map(|&first| [first, rows[rows.len() - 1]])
        };
        // The rows of its vertices, among which its faces are, if none is clipped.
        let box_of = |object: &Object<'_, usize>| {
            let mesh = object.mesh();
            let instance = camera.place(mesh, &object.model);
            let row = |vertex| instance.project(vertex).map(|seen| Point::from(seen).y);
            let rows = (0..mesh.vertices().len()).map(row).collect::<Result<Vec<i32>, _>>().ok()?;
            Some([*rows.iter().min()?, *rows.iter().max()?])
        };
        let rows: Vec<_> = scene.iter().map(|object| [rows_of(object), box_of(object)]).collect();
        let placed = scene.place(&camera);
        let mut bins = vec![0; sum(&placed, |mesh| mesh.face_bins_len())];
        let mut faces = placed.bin_faces(&mut [], &mut bins).expect("room for all faces");
        bands(AREA, Rgb565::BLACK, 3, &mut |band, depth| {
            let (area, mut found) = (band.area(), [false; OBJECTS]);
            let shade = |index: usize, _: &Object<'_, usize>| {
                found[index] = true;
                move |face| number(index, face)
            };
            let Ok(()) = faces.draw(shade, &mut band.pixels().depth_tested(depth));
            let [first, last] = [area.top_left.y, area.top_left.y + area.size.height as i32 - 1];
            for (&[drawn, vertices], is_asked) in rows.iter().zip(found) {
                let meets = |[top, bottom]: [i32; 2]| top <= last && bottom >= first;
                if drawn.is_some_and(meets) {
                    assert!(is_asked, "{drawn:?} in {area:?}");
                    asked += 1;
                } else if vertices.is_some_and(|rows| !meets(rows)) {
                    assert!(!is_asked, "{vertices:?} in {area:?}");
                    not_asked += 1;
                }
            }
        });
    }
    assert!(asked > 300 && not_asked > 1000, "{asked} {not_asked}");
}

#[test]
fn a_scene_in_painters_order_is_its_objects_in_a_painter() {
    let meshes = &meshes();
    let (mut rng, mut colored) = (Rng::new(0xe2), 0);
    for _ in 0..30 {
        // Painters draw beyond a far plane that does not clip; scenes cull there.
        let (scene, camera) = (random(&mut rng, meshes), camera(&mut rng).with_far_clip(true));
        let draw = |painter: &mut Painter<Rgb565, 600, 600>| {
            memory(AREA, Rgb565::BLACK, &mut |target, _| {
                let Ok(_) = painter.draw(target);
            })
        };
        let (mut painter, mut hands) = (Box::new(Painter::new()), Box::new(Painter::new()));
        let shade = |index: usize, object: &Object<'_, usize>| {
            assert_eq!(index, object.material);
            move |face| number(index, face)
        };
        scene.place(&camera).sorted(shade, &mut painter).expect("room for all faces");
        for object in scene.iter() {
            let instance = camera.place(object.mesh(), &object.model).with_cull(cull(object.material));
            let faces = instance.faces(|face| number(object.material, face)).culled_by_planes();
            faces.sorted(&mut hands).expect("room for all faces");
        }
        let pixels = draw(&mut painter);
        assert!(pixels == draw(&mut hands));
        colored += pixels.iter().filter(|&&color| color != Rgb565::BLACK).count();
    }
    assert!(colored > 10_000, "{colored}");
}

/// Every pixel of random scenes, culled and clipped faces and the borders of the viewport included: what is picked is what a
/// depth-tested drawing shows; of two objects in one place, it is the first.
#[test]
fn picking_finds_the_face_that_is_drawn() {
    picked_scenes(&meshes(), |number| number);
}

#[test]
fn picking_finds_the_face_that_is_seen_through_screen_doors() {
    let door = |number| ScreenDoor::new(number, (RawU16::from(number).into_inner() * 7 % 65) as u8);
    picked_scenes(&meshes(), door);
}

fn picked_scenes<S: SpanShader<Rgb565>>(meshes: &Meshes, shader: impl Fn(Rgb565) -> S + Copy) {
    let mut rng = Rng::new(0xe3);
    let (mut hits, mut misses, mut points, mut firsts) = (0, 0, 0, 0);
    for _ in 0..12 {
        let (mut scene, camera) = (random(&mut rng, meshes), camera(&mut rng));
        let objects = &mut scene;
        for [first, second] in [[2, 4], [6, 20]] {
            objects[second] = objects[first];
            objects[second].material = second;
        }
        let (picture, depths) = by_hand(&scene, &camera, shader);
        let placed = scene.place(&camera);
        let mut cache = [ScreenVertex::EMPTY; 8];
        let shade = |index: usize, object: &Object<'_, usize>| {
            assert_eq!(index, object.material);
            move |face| shader(number(index, face))
        };
        for (at, (&color, &depth)) in AREA.points().zip(picture.iter().zip(&depths)) {
            match placed.pick(shade, &mut cache, at) {
                None => {
                    assert_eq!(color, Rgb565::BLACK, "{at}");
                    misses += 1;
                }
                Some(picked) => {
                    assert_eq!((number(picked.object, picked.face), picked.depth), (color, depth), "{at}");
                    assert_eq!((picked.at.x(), picked.at.y()), (at.x * 256 + 128, at.y * 256 + 128));
                    // The point under the pixel projects to the pixel.
                    if let Some(point) = camera.unproject(picked.at, picked.depth) {
                        let seen = camera.project(point).map(|seen| Point::from(seen.point));
                        assert_eq!(seen, Ok(at));
                        points += 1;
                    }
                    firsts += usize::from([2, 6].contains(&picked.object));
                    hits += 1;
                }
            }
        }
    }
    assert!(
        hits > 3000 && misses > 3000 && points > 3000 && firsts > 100,
        "{hits} {misses} {points} {firsts}"
    );
}

/// One instance, with vertices cached, cached in part, and not at all; and beyond its viewport.
#[test]
fn picking_an_instance_needs_no_cache() {
    let (mut rng, meshes) = (Rng::new(0xe4), meshes());
    let opaque = |_face| Rgb565::BLACK;
    for _ in 0..10 {
        let camera = camera(&mut rng);
        let model = Affine::<Model, World>::rotation_y(Angle::from_bits(rng.bits()))
            .translate(Vector3::from_ints(0, 0, -4));
        let instance = camera.place(&meshes.0, &model);
        for at in rectangle(-4, -4, WIDTH + 8, HEIGHT + 8).points() {
            let picked: Option<Picked> =
                instance.faces(opaque).cached(&mut [ScreenVertex::EMPTY; 8]).pick(at);
            assert_eq!(picked, instance.faces(opaque).pick(at));
            assert_eq!(picked, instance.faces(opaque).cached(&mut [ScreenVertex::EMPTY; 3]).pick(at));
            assert!(picked.is_none_or(|picked| picked.object == 0));
            let in_viewport = rectangle(3, -2, WIDTH - 5, HEIGHT).contains(at);
            assert!(in_viewport || picked.is_none());
        }
        for far_off in [Point::new(9000, 0), Point::new(0, i32::MIN), Point::new(i32::MAX, i32::MAX)] {
            assert_eq!(instance.faces(opaque).pick(far_off), None);
        }
    }
}

#[test]
fn a_scene_without_room_says_what_it_needs() {
    let meshes = meshes();
    let mut scene = Scene::<u8, 2>::default();
    let object = Object::new(&meshes.0, Affine::identity(), 7);
    assert_eq!([scene.add(object), scene.add(object)], [Ok(0), Ok(1)]);
    let full = scene.add(object);
    assert_eq!(full, Err(BufferError::Full { parameter: "OBJECTS", needed: 3, capacity: 2 }));
    assert!(full.expect_err("full").to_string().contains("room for 2: raise OBJECTS"));
    scene[1].model = Affine::identity().translate(Vector3::from_ints(0, 0, -9));
    let viewport = Viewport::new(Point::zero(), Size::new(40, 40)).expect("a viewport");
    let sphere = meshes.0.bounding_sphere();
    let camera =
        Camera::framing(&sphere, &viewport, Angle::degrees(50), Angle::ZERO, Angle::ZERO).expect("a camera");
    // The second lies beyond the far plane, which is just behind the first.
    let placed = scene.place(&camera);
    assert_eq!(placed.iter().count(), 1);
    assert_eq!(placed.iter().map(|(object, _)| object.material).collect::<Vec<_>>(), [7]);
    let short = placed.bin_faces(&mut [], &mut [0; 16]).err();
    assert_eq!(short, Some(BufferError::Bins { needed: 17, given: 16 }));
    scene.clear();
    assert!(scene.place(&camera).iter().next().is_none() && scene.is_empty());
}
