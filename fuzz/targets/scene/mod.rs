//! Whole scenes: a few vertices, faces and edges before any camera, through every drawing entry, onto a
//! small target that records.
//!
//! - Nothing is drawn outside viewport ∩ target, and nothing one pixel at a time.
//! - Each primitive is counted once; the length of the cache changes nothing.
//! - Bands of any height show the same as one piece.
//! - With a depth buffer, each pixel shows the nearest face, at the depth of its plane.
//! - A whole face is the exact coverage of its projected corners, a whole edge the exact line.
//! - By planes the same is drawn, less faces turned away that rounding turns to the front.
//! - What is cut is what one ray a pixel meets, where no ray nearby tells otherwise.

mod cut;
mod depth;
mod facing;
pub(super) mod input;
mod whole;

use super::place::Place;
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor};
use input::Scene;
use pinhole::{mesh::Coordinate, prelude::*};
use support::bridge::draw::Shader;
use support::bridge::scalar;
use support::oracle::target::{Call, Recorder, Refused};

/// Everything recorded so far.
struct Drawing {
    target: Recorder<Shader>,
    statistics: Statistics,
}

fn draw(scene: &Scene, with: impl FnOnce(&mut Recorder<Shader>) -> Result<Statistics, Refused>) -> Drawing {
    let mut target = Recorder::new(scene.bounds);
    let statistics = with(&mut target).expect("this target refuses nothing");
    assert_eq!(target.outside, 0, "outside the target: {scene:?}");
    let area = scene.area();
    for &(x, y) in target.pixels.keys() {
        assert!(area.contains(x.into(), y.into()), "({x}, {y}) outside the viewport: {scene:?}");
    }
    assert!(target.calls.iter().all(|c| matches!(c, Call::Solid(..))), "{scene:?}");
    Drawing { target, statistics }
}

fn sums_up(s: Statistics, handed_in: usize) {
    assert_eq!((s.drawn + s.culled + s.outside + s.degenerate) as usize, handed_in, "{s:?}");
    assert!(s.clipped <= s.drawn, "{s:?}");
}

fn calls(scene: &Scene, instance: &MeshInstance<'_>) {
    // Another scene's corners in the cache do no harm.
    let stale = {
        let mut corners = vec![ScreenVertex::default(); scene.vertices.len() + 1];
        let _ = instance.faces(|_| Shader(0)).cached(&mut corners).draw(&mut Recorder::sized(1, 1));
        corners
    };
    let mut asked = 0;
    let solid = |length: usize, asked: &mut u32| {
        let mut cache = stale.clone();
        cache.truncate(length);
        draw(scene, |target| {
            let shade = |face| {
                *asked += 1;
                Shader(face as u16)
            };
            instance.faces(shade).cached(&mut cache).draw(target)
        })
    };
    let faces = solid(scene.cache, &mut asked);
    sums_up(faces.statistics, scene.faces.len());
    assert_eq!(asked, faces.statistics.drawn, "shade is asked once for each face drawn");
    let uncached = solid(0, &mut 0);
    assert_eq!(uncached.statistics, faces.statistics);
    assert!(uncached.target.calls == faces.target.calls, "the cache's length shows: {scene:?}");

    let wireframe = |length: usize| {
        let mut cache = stale.clone();
        cache.truncate(length);
        draw(scene, |target| instance.edges(|_| Shader(7)).cached(&mut cache).draw(target))
    };
    let edges = wireframe(scene.cache);
    sums_up(edges.statistics, scene.edges.len());
    assert_eq!((edges.statistics.culled, edges.statistics.degenerate), (0, 0));
    let uncached = wireframe(0);
    assert_eq!(uncached.statistics, edges.statistics);
    assert!(uncached.target.calls == edges.target.calls, "the cache's length shows: {scene:?}");

    // The painter draws the same faces, in its own order: each pixel as often.
    let painted = draw(scene, |target| {
        let mut painter = Painter::<Shader, 100, 40>::new();
        instance.faces(|face| Shader(face as u16)).sorted(&mut painter).expect("enough room");
        painter.draw(target)
    });
    assert_eq!(painted.statistics, faces.statistics);
    let count = |d: &Drawing| d.target.pixels.iter().map(|(&p, &(_, n))| (p, n)).collect::<Vec<_>>();
    assert_eq!(count(&painted), count(&faces), "painter and mesh order cover differently: {scene:?}");

    let points = draw(scene, |target| instance.points(Shader(3), target));
    sums_up(points.statistics, scene.vertices.len());
    whole::points(scene, instance, &points.target);
}

/// All calls that draw or pick, of a mesh with normals and planes of any other.
fn extremes<V: Coordinate<Stored = V>>(scene: &Scene, mesh: Mesh<'_, V>) {
    let normals = &scene.vertices[..scene.faces.len()];
    let mut planes: Vec<i16> = normals.iter().map(|normal| normal[0] ^ normal[1]).collect();
    let cluster = normals.as_flattened().iter().cycle().take(8 * planes.len().div_ceil(32));
    planes.extend(cluster);
    let mesh = mesh.with_edges(&scene.edges).and_then(|mesh| mesh.with_normals(normals));
    let mesh = mesh.and_then(|mesh| mesh.with_planes(&planes)).expect("as many as faces");
    let (camera, model) = (scene.camera.library().with_far_clip(scene.far_clip), scene.model.library());
    let instance = camera.place(&mesh, &model).with_cull(scene.cull);
    let mut cache = vec![ScreenVertex::EMPTY; scene.cache];
    let cache = &mut cache[..];
    let mut storage = vec![0; (scene.bounds.size.width * scene.bounds.size.height) as usize];
    let mut depth = DepthBuffer::new(scene.bounds, &mut storage).expect("storage for all pixels");
    let (mut bins, mut more) = ([0; 5], [0; 5]); // of three, one for every 16, and one bin
    let shade = |face| Shader(face as u16);
    draw(scene, |target| {
        instance.faces(shade).cached(cache).draw(target)?;
        instance.faces(shade).culled_by_planes().cached(cache).draw(target)?;
        instance.faces(shade).culled_by_planes().cached(cache).draw(&mut target.depth_tested(&mut depth))?;
        instance.faces(shade).culled_by_planes().cached(cache).pick(scene.bounds.center());
        instance
            .faces(shade)
            .culled_by_clusters()
            .cached(cache)
            .draw(&mut target.depth_tested(&mut depth))?;
        instance.faces(shade).cached(cache).draw(&mut target.depth_tested(&mut depth))?;
        instance.depth_only(cache, &mut depth);
        instance.edges(|_| Shader(1)).cached(cache).draw(target)?;
        instance.edges(|_| Shader(1)).cached(cache).draw(&mut target.depth_tested(&mut depth))?;
        instance.edges(|_| Shader(1)).cached(cache).hidden_line(&mut target.depth_tested(&mut depth))?;
        instance.points(Shader(1), target)?;
        instance.transform(cache).bin_faces(&mut bins).expect("room").draw(shade, target)?;
        let transformed = instance.transform_depth(cache);
        let mut faces = transformed.bin_faces(&mut bins).expect("room");
        let mut edges = transformed.bin_edges(&mut more).expect("room");
        faces.draw(shade, target)?;
        faces.draw(shade, &mut target.depth_tested(&mut depth))?;
        edges.draw(Shader(1), target)?;
        edges.draw(Shader(1), &mut target.depth_tested(&mut depth))?;
        edges.hidden_line(Shader(1), &mut target.depth_tested(&mut depth))?;
        let mut painter = Painter::<Shader, 60, 40>::new();
        let _ = instance.faces(shade).sorted(&mut painter);
        let _ = instance.faces(shade).culled_by_planes().sorted(&mut painter);
        painter.draw(target)
    });
}

/// Faces in one piece, in parts and in bands. Edges in bands are target `anti_aliased`'s, and two cores are tests' (`properties`).
fn bands(scene: &Scene) {
    let Some(area) = scene.rectangle() else { return };
    let place = Place { area, sky: Gray8::BLACK, rows: scene.cache as u32 % area.size.height + 1 };
    let shade = |face: usize| Gray8::new(50 * (face as u8 + 1));
    scene.with_instance(&scene.faces, &[], |instance| place.everywhere(instance, &shade));
}

pub(super) fn check(data: &[u8]) {
    let Some(scene) = Scene::read(data) else { return };
    scene.with_instance(&scene.faces, &scene.edges, |instance| calls(&scene, instance));
    depth::check(&scene);
    bands(&scene);
    facing::check(&scene);
    extremes(&scene, Mesh::new(&scene.vertices, scene.exponent, &scene.faces).expect("a mesh"));
    let wide: Vec<_> = scene.vertices.iter().map(|v| v.map(|c| scalar(i32::from(c) * 0xffff))).collect();
    extremes(&scene, Mesh::from_fixed(&wide, &scene.faces).expect("a mesh"));
    for face in &scene.faces {
        whole::face(&scene, *face);
        cut::face(&scene, *face);
    }
    for edge in &scene.edges {
        whole::edge(&scene, *edge);
    }
}
