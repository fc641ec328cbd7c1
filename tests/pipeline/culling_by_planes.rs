//! Culling by clusters draws the picture of culling by face planes, which `fuzz/targets/scene/facing.rs` compares with culling by area.
//! Meshes that the near plane and the guard band cut are equal in every way of drawing: solid, with depth, culled by planes, in bands, in painter's order, as wireframes and with hidden lines; faces that are culled before they are cut are those
//! that are drawn only without culling. `Cull::Front` draws what `Cull::Back` draws of the mesh with all faces turned over.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{raw::RawU16, Rgb565, RgbColor};
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use pinhole::{
    mesh::{Coordinate, MeshError},
    prelude::*,
};
use pinhole_import::{import_bytes, ImportedMesh, Options};
use support::bridge::draw::flat_camera;
use support::bridge::pair::{bits, CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::ways::{
    bands, by_clusters, by_every_call, by_planes, lines_by_every_call, screen, Drawn, Lines,
};
use support::oracle::rng::Rng;
use support::{solids, teapot};

const WIDTH: u32 = 90;
const HEIGHT: u32 = 60;
const AREA: Rectangle = Rectangle::new(Point::zero(), Size::new(WIDTH, HEIGHT));
/// The picture of meshes that are cut.
const CUT: Rectangle = Rectangle::new(Point::zero(), Size::new(48, 36));
const LINE: Rgb565 = Rgb565::WHITE;

/// The number of a face, as a colour; black is none.
fn color(face: usize) -> Rgb565 {
    Rgb565::from(RawU16::new(face as u16 + 1))
}

fn camera(rng: &mut Rng, distance: f64, parallel: bool) -> CameraBits {
    let eye = bits(rng.direction().map(|c| c * distance)).unwrap();
    let about = [0; 3].map(|_| rng.int(-i64::from(ONE) * 8, i64::from(ONE) * 8) as i32);
    let projection = if parallel {
        let w = 20 * ONE;
        ProjectionBits::Orthographic([-w, w, -w * 2 / 3, w * 2 / 3], ONE, 400 * ONE)
    } else {
        ProjectionBits::Perspective((1 << 31) / 3, (WIDTH, HEIGHT), ONE / 2, 1000 * ONE)
    };
    CameraBits {
        view: ViewBits::LookAt(eye, about, [ONE / 3, ONE, ONE / 5]),
        projection,
        viewport: (0, 0, WIDTH, HEIGHT),
    }
}

/// A torus and a teapot in clusters, from within, through the near plane, far away and aside, mirrored, flat and in parallel projections:
/// pictures and picked faces are those of culling by planes, of fewer faces. The faces that are left out have no pixel.
#[test]
fn culling_by_clusters_draws_the_picture_of_culling_by_planes() {
    let torus = solids::torus(24, 16);
    let meshes = [clustered(&torus.vertices, &torus.faces), clustered(&teapot::VERTICES, &teapot::FACES)];
    let mut rng = Rng::new(0xfae);
    let (mut faces, mut vertices, mut clipped) = ([0; 2], [0; 2], 0);
    for i in 0..240 {
        let made = &meshes[i % 2];
        let mesh = made.mesh().unwrap();
        assert_eq!(mesh.clusters().len(), mesh.faces().len().div_ceil(32));
        let camera = camera(&mut rng, [6.0, 14.0, 25.0, 90.0][i / 2 % 4], i % 5 == 0).library();
        let mut model = ModelBits::random_rotation(&mut rng);
        if i % 3 == 0 {
            model.0.insert(0, Step::Scale([-ONE, ONE / [4, 50][i / 3 % 2], ONE]));
        }
        let cull = [Cull::Back, Cull::Back, Cull::Front, Cull::None][i / 8 % 4];
        let instance = camera.place(&mesh, &model.library()).with_cull(cull);
        let (planes, counted) = by_planes(&instance, AREA, Rgb565::BLACK, &color);
        let (clusters, found) = by_clusters(&instance, AREA, Rgb565::BLACK, &color);
        assert!(clusters == planes, "other pixels");
        assert_eq!(found.drawn + found.culled + found.outside + found.degenerate, mesh.faces().len() as u32);
        let unclipped = instance.without_clipping();
        let (planes, _) = by_planes(&unclipped, AREA, Rgb565::BLACK, &color);
        assert!(by_clusters(&unclipped, AREA, Rgb565::BLACK, &color).0 == planes, "not clipped");
        let at = Point::new(rng.int(0, 90) as i32, rng.int(0, 60) as i32);
        let mut cache = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
        let picked = instance.faces(color).culled_by_planes().cached(&mut cache).pick(at);
        assert_eq!(instance.faces(color).culled_by_clusters().cached(&mut cache).pick(at), picked);
        faces = [faces[0] + counted.drawn, faces[1] + found.drawn];
        clipped += found.clipped;
        if i / 2 % 4 < 3 || cull == Cull::None {
            continue;
        }
        // In view and without planes, vertices are left out by clusters alone that are turned away.
        let normals = vec![[0; 3]; mesh.faces().len()];
        let lists = [&normals.as_flattened()[..normals.len()], mesh.clusters().as_flattened()].concat();
        let bare = Mesh::new(mesh.vertices(), mesh.exponent(), mesh.faces()).unwrap();
        let bare = bare.with_normals(&normals).and_then(|bare| bare.with_planes(&lists)).unwrap();
        let bare = camera.place(&bare, &model.library()).with_cull(cull);
        let _ = bare.faces(color).culled_by_clusters().cached(&mut cache).pick(at);
        let touched = cache.iter().filter(|vertex| **vertex != ScreenVertex::EMPTY).count();
        vertices = [vertices[0] + cache.len(), vertices[1] + touched];
    }
    assert!(clipped > 1000, "{clipped}");
    assert!(20 * faces[1] < 19 * faces[0] && 20 * vertices[1] < 19 * vertices[0], "{faces:?} {vertices:?}");
}

/// A face beside the viewport whose corner reaches past the centre of one pixel at the border, by 1/256 to 31/256 pixel, in a cluster of the
/// smallest ball.
#[test]
fn clusters_keep_a_face_that_reaches_the_first_pixel_centre() {
    const SIDE: i16 = 16;
    let area = Rectangle::new(Point::zero(), Size::new_equal(SIDE as u32));
    let camera = flat_camera((SIDE as u32, SIDE as u32), 1, 8).library();
    for (reach, border) in [1, 8, 31].into_iter().flat_map(|reach| (0..4).map(move |border| (reach, border)))
    {
        // In 1/256 pixel: a right angle that points to the right, turned to the border.
        let (tip, middle, radius) = (128 + reach, (SIDE << 7) + 128, 1024);
        let turned = |[x, y]: [i16; 2]| match border {
            0 => [x, y, 0],
            1 => [(SIDE << 8) - x, y, 0],
            2 => [y, x, 0],
            _ => [y, (SIDE << 8) - x, 0],
        };
        let vertices =
            [[tip, middle], [tip - radius, middle + radius], [tip - radius, middle - radius]].map(turned);
        let [x, y, z] = turned([tip - radius, middle]);
        let normals = [[0, 0, i16::MAX]];
        let mesh =
            Mesh::new(&vertices, -8, &[[0, 1, 2]]).and_then(|mesh| mesh.with_normals(&normals)).unwrap();
        let planes = [0, x, y, z, radius, 0, 0, i16::MAX, 0];
        let mesh = mesh.with_planes(&planes).unwrap();
        let instance = camera.place(&mesh, &Affine::identity()).with_cull(Cull::None);
        let (wanted, _) = by_planes(&instance, area, Rgb565::BLACK, &color);
        assert_eq!(wanted.solid.iter().filter(|pixel| **pixel != Rgb565::BLACK).count(), 1);
        let (found, _) = by_clusters(&instance, area, Rgb565::BLACK, &color);
        assert!(found == wanted, "border {border}, {reach}/256 pixel past the centre");
    }
}

/// A mesh by the importer.
fn clustered(vertices: &[[i16; 3]], faces: &[[u16; 3]]) -> ImportedMesh {
    let corners = vertices.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let sides = faces.iter().map(|face| face.map(|v| u32::from(v) + 1));
    let obj = corners.chain(sides.map(|[a, b, c]| format!("f {a} {b} {c}\n"))).collect::<String>();
    let options = Options { clusters: true, reorder: true, fit: Some(24.0), ..Options::default() };
    import_bytes(obj.into(), "mesh.obj".as_ref(), &[], &options).unwrap()
}

#[test]
fn new_normals_remove_planes() {
    let mesh = Mesh::new(&teapot::VERTICES, teapot::EXPONENT, &teapot::FACES).unwrap();
    let mesh = mesh.with_normals(&teapot::NORMALS).unwrap();
    // They belonged to the old normals.
    let zeros = [0; 992];
    let replaced = mesh.with_planes(&zeros).unwrap().with_normals(&teapot::NORMALS).unwrap();
    assert_eq!((mesh.planes(), replaced), (&[][..], mesh));
    assert_eq!(mesh.with_planes(&zeros).unwrap().planes(), zeros);
    // Of vertices of 32 bits, planes are equal: numbers are justified.
    let fixed = teapot::VERTICES.map(|v| v.map(|c| Scalar::from_bits(i32::from(c) << 6)));
    let wide = Mesh::from_fixed(&fixed, &teapot::FACES).unwrap().with_normals(&teapot::NORMALS).unwrap();
    assert_eq!(core::array::from_fn(|face| wide.face_plane(face)), mesh.face_planes::<992>());
}

#[test]
fn a_list_of_planes_of_the_wrong_length_is_refused() {
    let mesh = Mesh::new(&teapot::VERTICES, 0, &teapot::FACES).unwrap();
    assert_eq!(
        mesh.with_planes(&[0; 992]),
        Err(MeshError::ListLength { one: "normal per face", given: 0, needed: 992 })
    );
    let mesh = mesh.with_normals(&teapot::NORMALS).unwrap();
    let error = mesh.with_planes(&[0; 991]).unwrap_err();
    assert_eq!(error, MeshError::ListLength { one: "plane per face", given: 991, needed: 992 });
    assert_eq!(error.to_string(), "a list of 991 entries where 992 are needed: give one plane per face");
    let one = "plane per face and eight numbers per 32 faces";
    for given in [993, 1239, 1241] {
        let error = mesh.with_planes(&[0; 1241][..given]).unwrap_err();
        assert_eq!(error, MeshError::ListLength { one, given, needed: 1240 });
    }
    // Fewer planes and more planes than faces; planes of normals longer than 1.
    assert_eq!(mesh.face_planes::<3>(), mesh.face_planes::<992>()[..3]);
    assert_eq!(mesh.face_planes::<993>()[992], 0);
    let vertices = [[i16::MAX; 3], [i16::MIN; 3], [0, 0, 1]];
    let mesh = Mesh::new(&vertices, 0, &[[0, 1, 2], [1, 2, 0], [2, 1, 0]]).unwrap();
    let normals = [[i16::MAX; 3]; 3];
    assert_eq!(mesh.with_normals(&normals).unwrap().face_planes(), [i16::MAX, i16::MIN, 0]);
}

/// Draws in every way, compares, and returns the statistics of faces, and the pictures of faces and of edges.
fn every_way<V: Coordinate>(
    rng: &mut Rng,
    instance: &MeshInstance<'_, V>,
    turned: &MeshInstance<'_, V>,
) -> (Statistics, Drawn<Rgb565>, Lines<Rgb565>) {
    let heights = [rng.int(1, 12) as u32, CUT.size.height];
    let (drawn, statistics) = by_every_call(instance, CUT, Rgb565::BLACK, &heights, &color);
    let (planes, _) = by_planes(instance, CUT, Rgb565::BLACK, &color);
    assert!(planes == drawn, "by planes");
    // Binned without depth.
    let mut cache = vec![ScreenVertex::EMPTY; instance.mesh().vertices().len() / 2];
    let mut bins = vec![0; instance.mesh().face_bins_len()];
    let mut faces = instance.transform(&mut cache).bin_faces(&mut bins).expect("room");
    let banded = bands(CUT, Rgb565::BLACK, heights[0], &mut |band, _| {
        let Ok(()) = faces.draw(color, band);
    });
    assert!(banded == drawn.solid, "binned");
    // Culling leaves out the faces that the turned mesh draws: without culling, no side is known before a face is cut.
    let counts = |instance: &MeshInstance<'_, V>| {
        let (screen, _) = screen(CUT, &mut |target, _| {
            let Ok(_) = instance.faces(color).draw(target);
        });
        screen.counts
    };
    let (front, behind, both) = (counts(instance), counts(turned), counts(&instance.with_cull(Cull::None)));
    assert!((0..both.len()).all(|i| both[i] == front[i] + behind[i]));
    // Front faces are culled as back faces of the turned mesh are. Where faces are cut, rounding depends on the order of corners.
    let reversed = instance.with_cull(Cull::Front);
    let [(reversed, counted), (turned, of_turned)] =
        [&reversed, turned].map(|instance| by_every_call(instance, CUT, Rgb565::BLACK, &heights, &color));
    assert_eq!(counted, of_turned);
    assert!(
        by_planes(&instance.with_cull(Cull::Front), CUT, Rgb565::BLACK, &color).0 == reversed,
        "by planes"
    );
    assert!(counted.drawn <= statistics.culled && statistics.drawn <= counted.culled);
    let pictures = [reversed, turned].map(|drawn| (drawn.solid, drawn.painted));
    assert!(counted.clipped > 0 || pictures[0] == pictures[1]);
    // The face that is picked in a pixel is the face that is drawn there.
    for (pixel, drawn) in CUT.points().zip(&drawn.deep).skip(rng.below(300)).step_by(401) {
        let picked = [
            instance.faces(color).cached(&mut cache).pick(pixel),
            instance.faces(color).culled_by_planes().cached(&mut cache).pick(pixel),
            instance.faces(color).culled_by_planes().pick(pixel),
        ];
        for picked in picked {
            assert_eq!(picked.map_or(Rgb565::BLACK, |picked| color(picked.face)), *drawn, "{pixel}");
        }
    }
    let lines = lines_by_every_call(instance, CUT, Rgb565::BLACK, &heights, LINE, None);
    let (wire, _) = screen(CUT, &mut |target, _| {
        let Ok(_) = instance.edges(|_| LINE).cached(&mut cache).draw(target);
    });
    assert!(wire.over(Rgb565::BLACK) == lines.all);
    (statistics, drawn, lines)
}

/// Also so near that the guard band cuts, and that positions lie beyond the range of a `ScreenVertex`. Without clipping, faces that would
/// be cut are left out and counted.
#[test]
fn meshes_that_are_cut_are_equal_in_every_way_of_drawing() {
    let torus = solids::torus(12, 8);
    let mut rng = Rng::new(26);
    let turned: Vec<[u16; 3]> = torus.faces.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let turned = Mesh::new(&torus.vertices, -14, &turned).unwrap();
    let (normals, beside) = (torus.normals(), torus.edge_faces());
    let mesh = Mesh::new(&torus.vertices, -14, &torus.faces).unwrap().with_normals(&normals).unwrap();
    let planes: [i16; 192] = mesh.face_planes();
    let mesh = mesh.with_planes(&planes).unwrap().with_edges(&torus.edges).unwrap();
    let mesh = mesh.with_edge_faces(&beside).unwrap();
    let (mut clipped, mut outside, mut in_view) = (0, 0, 0);
    for round in 0..150 {
        let (near, fov) =
            ([ONE / 2, ONE / 10, ONE / 250][round % 3], [1 << 29, 1 << 30, 1 << 27][round / 3 % 3]);
        let mut at = |reach: [i64; 3]| reach.map(|reach| (rng.int(-reach, reach) << 16) as i32 / 1000);
        let camera = CameraBits {
            view: ViewBits::LookAt(at([1200, 1200, 900]), at([1000, 1000, 300]), [ONE, 2 * ONE, 3 * ONE]),
            ..CameraBits::perspective(fov, (CUT.size.width, CUT.size.height), near, 20 * ONE)
        };
        let camera = camera.library().with_far_clip(true);
        let model = ModelBits(vec![Step::Y(rng.bits())]).library();
        let (instance, turned) = (camera.place(&mesh, &model), camera.place(&turned, &model));
        let (counted, faces, lines) = every_way(&mut rng, &instance, &turned);
        (clipped, outside) = (clipped + counted.clipped, outside + counted.outside);
        let (inside, faces_inside, lines_inside) =
            every_way(&mut rng, &instance.without_clipping(), &turned.without_clipping());
        assert!(inside.clipped == 0 && inside.drawn <= counted.drawn, "{inside:?} {counted:?}");
        let left_out = counted.outside + counted.clipped;
        assert!(inside.outside + inside.culled >= left_out, "{inside:?} {counted:?}");
        if counted.clipped + counted.outside == 0 && inside.outside == 0 {
            in_view += 1;
            assert!(inside == counted && faces_inside == faces && lines_inside == lines);
        }
    }
    assert!(clipped > 1000 && outside > 3000 && in_view > 5, "{clipped} {outside} {in_view}");
}
