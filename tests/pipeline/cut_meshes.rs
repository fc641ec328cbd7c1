//! Meshes that the near plane and the guard band cut, drawn in every way: solid, with depth, culled by planes, in bands, in
//! painter's order, as wireframes and with hidden lines; into memory and onto a plain DrawTarget; with vertex caches of full
//! length, short and empty. All ways agree pixel by pixel, and faces that are culled before they are cut are those that are
//! drawn only without culling. `Cull::Front` draws what `Cull::Back` draws of the mesh with all faces turned over.

use embedded_graphics_core::pixelcolor::{raw::RawU16, Rgb565, RgbColor};
use embedded_graphics_core::prelude::{Point, Size};
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use pinhole::space::{Model, World};
use pinhole::{
    Affine, Angle, Camera, Coordinate, Cull, Mesh, MeshInstance, Point3, Projection, Scalar, ScreenVertex,
    Statistics, Vector3, ViewTransform, Viewport, WithPlanes,
};
use support::bridge::ways::{bands, by_every_call, lines_by_every_call, memory, screen, Drawn, Lines};
use support::oracle::rng::Rng;
use support::solids;

const SIZE: Size = Size::new(48, 36);
const AREA: Rectangle = Rectangle::new(Point::zero(), SIZE);
const LINE: Rgb565 = Rgb565::WHITE;

/// The number of a face, as a colour; black is none.
fn color(face: usize) -> Rgb565 {
    Rgb565::from(RawU16::new(face as u16 + 1))
}

/// Draws in every way, compares, and returns the statistics of faces, and the pictures of faces and of edges.
fn every_way<V: Coordinate>(
    rng: &mut Rng,
    by_planes: &MeshInstance<'_, V, WithPlanes>,
    turned: &MeshInstance<'_, V>,
) -> (Statistics, Drawn<Rgb565>, Lines<Rgb565>) {
    let instance = by_planes.without_planes();
    let heights = [rng.int(1, 12) as u32, SIZE.height];
    let (drawn, statistics) = by_every_call(&instance, AREA, Rgb565::BLACK, &heights, &color);
    let (planes, _) = by_every_call(by_planes, AREA, Rgb565::BLACK, &heights, &color);
    assert!(planes == drawn, "by planes");
    // Binned without depth, at once and of transformed vertices.
    let mut cache = vec![ScreenVertex::EMPTY; instance.mesh().vertices().len() / 2];
    let mut bins = vec![0; instance.mesh().face_bins_len()];
    for is_transformed in [false, true] {
        let transformed;
        let mut faces = match is_transformed {
            false => by_planes.bin_faces(&mut cache, &mut bins).expect("room"),
            true => {
                transformed = by_planes.transform(&mut cache);
                transformed.bin_faces(&mut bins).expect("room")
            }
        };
        let banded = bands(AREA, Rgb565::BLACK, heights[0], &mut |band, _| {
            let Ok(()) = faces.solid(color, band);
        });
        assert!(banded == drawn.solid, "transformed: {is_transformed}");
    }
    // Culling leaves out the faces that the turned mesh draws: without culling, no side is known before a face is cut.
    let counts = |instance: &MeshInstance<'_, V>| {
        let (screen, _) = screen(AREA, &mut |target, _| {
            let Ok(_) = instance.solid(color, &mut [], target);
        });
        screen.counts
    };
    let (front, behind, both) = (counts(&instance), counts(turned), counts(&instance.with_cull(Cull::None)));
    assert!((0..both.len()).all(|i| both[i] == front[i] + behind[i]));
    // Front faces are culled as back faces of the turned mesh are. Where faces are cut, rounding depends on the order of corners.
    let reversed = instance.with_cull(Cull::Front);
    let [(reversed, counted), (turned, of_turned)] =
        [&reversed, turned].map(|instance| by_every_call(instance, AREA, Rgb565::BLACK, &heights, &color));
    assert_eq!(counted, of_turned);
    assert!(counted.drawn <= statistics.culled && statistics.drawn <= counted.culled);
    let pictures = [reversed, turned].map(|drawn| (drawn.solid, drawn.painted));
    assert!(counted.clipped > 0 || pictures[0] == pictures[1]);
    // The face that is picked in a pixel is the face that is drawn there.
    for (pixel, drawn) in AREA.points().zip(&drawn.deep).skip(rng.below(300)).step_by(401) {
        let picked = [
            instance.pick(pixel, color, &mut cache),
            by_planes.pick(pixel, color, &mut cache),
            by_planes.transform_depth(&mut []).pick(pixel, color),
        ];
        for picked in picked {
            assert_eq!(picked.map_or(Rgb565::BLACK, |picked| color(picked.face)), *drawn, "{pixel}");
        }
    }
    // Lines, and hidden lines with the depths of faces that are culled by planes.
    let lines = lines_by_every_call(&instance, AREA, Rgb565::BLACK, &heights, LINE, None);
    let hidden = memory(AREA, Rgb565::BLACK, &mut |target, depth| {
        by_planes.depth_only(&mut cache, depth);
        let Ok(_) = instance.hidden_line(LINE, &mut [], depth, target);
    });
    let (wire, _) = screen(AREA, &mut |target, _| {
        let Ok(_) = instance.wireframe(LINE, &mut cache, target);
    });
    assert!(hidden == lines.hidden && wire.over(Rgb565::BLACK) == lines.all);
    (statistics, drawn, lines)
}

#[test]
fn meshes_that_are_cut_are_equal_in_every_way_of_drawing() {
    let torus = solids::torus(12, 8);
    let number = |v| Scalar::from_f64(v).expect("in range");
    let mut rng = Rng::new(26);
    let viewport = Viewport::new(Point::zero(), SIZE).unwrap();
    let turned: Vec<[u16; 3]> = torus.faces.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let turned = Mesh::new(&torus.vertices, -14, &turned).unwrap();
    let (normals, beside) = (torus.normals(), torus.edge_faces());
    let mesh = Mesh::new(&torus.vertices, -14, &torus.faces).unwrap().with_normals(&normals).unwrap();
    let planes: [i16; 192] = mesh.face_planes();
    let mesh = mesh.with_planes(&planes).unwrap().with_edges(&torus.edges).unwrap();
    let mesh = mesh.with_edge_faces(&beside).unwrap();
    let (mut clipped, mut outside, mut in_view) = (0, 0, 0);
    for round in 0..150 {
        // Also so near that the guard band cuts, and that positions lie beyond the range of a `ScreenVertex`.
        let (near, angle) = ([0.5, 0.1, 0.004][round % 3], [60, 90, 8][round / 3 % 3]);
        let lens =
            Projection::perspective(Angle::degrees(angle), viewport.size(), number(near), number(20.0));
        let mut coordinate = |reach: i64| number(rng.int(-reach, reach) as f64 / 1000.0);
        let eye = Point3::new(coordinate(1200), coordinate(1200), coordinate(900));
        let gaze = Point3::new(coordinate(1000), coordinate(1000), coordinate(300));
        let Ok(view) = ViewTransform::look_at(eye, gaze, Vector3::from_ints(1, 2, 3)) else { continue };
        let camera = Camera::new(&view, &lens.unwrap(), &viewport).with_far_clip(true);
        let model = Affine::<Model, World>::rotation_y(Angle::degrees(rng.int(0, 359) as i32));
        let (instance, turned) = (camera.place(&mesh, &model), camera.place(&turned, &model));
        let (counted, faces, lines) = every_way(&mut rng, &instance, &turned);
        (clipped, outside) = (clipped + counted.clipped, outside + counted.outside);
        // Without clipping, faces that would be cut are left out and counted.
        let (inside, faces_inside, lines_inside) =
            every_way(&mut rng, &instance.without_clipping(), &turned.without_clipping());
        assert!(inside.clipped == 0 && inside.drawn <= counted.drawn, "{inside:?} {counted:?}");
        assert!(
            inside.outside + inside.culled >= counted.outside + counted.clipped,
            "{inside:?} {counted:?}"
        );
        if counted.clipped + counted.outside == 0 && inside.outside == 0 {
            in_view += 1;
            assert!(inside == counted && faces_inside == faces && lines_inside == lines);
        }
    }
    assert!(clipped > 1000 && outside > 3000 && in_view > 5, "{clipped} {outside} {in_view}");
}
