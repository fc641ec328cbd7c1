//! The scene once more in bands: recorded once, drawn strip by strip into targets of their own, with depth strips. All
//! strips together show what was drawn in one piece, and that is what the immediate functions draw. Then once more by two forks,
//! as two cores draw it: the input says which of them draws which strip.

use crate::bridge::draw::Shader;
use crate::input::Scene;
use crate::oracle::target::Recorder;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{BinError, BinnedEdges, BinnedFaces, DepthBuffer, ScreenVertex};
use std::collections::BTreeMap;

type Pixels = BTreeMap<(i32, i32), (Shader, u32)>;

fn rows(area: Rectangle, height: u32) -> impl Iterator<Item = Rectangle> {
    (0..area.size.height).step_by(height as usize).map(move |down| {
        let top_left = area.top_left + Point::new(0, down as i32);
        Rectangle::new(top_left, Size::new(area.size.width, height.min(area.size.height - down)))
    })
}

/// A picture drawn in bands by two forks; the lowest bits of `deal` say whose each band is.
fn strips_of_two<F>(
    area: Rectangle,
    height: u32,
    mut deal: u32,
    mut forks: [F; 2],
    draw: impl Fn(&mut F, &mut DepthBuffer<'_>, &mut Recorder<Shader>),
) -> Pixels {
    strips(area, height, |depth, target| {
        let [first, second] = &mut forks;
        draw(if deal & 1 == 0 { first } else { second }, depth, target);
        deal = deal.rotate_right(1);
    })
}

/// A picture drawn in bands.
fn strips(
    area: Rectangle,
    height: u32,
    mut draw: impl FnMut(&mut DepthBuffer<'_>, &mut Recorder<Shader>),
) -> Pixels {
    let mut pixels = Pixels::new();
    for strip in rows(area, height) {
        let mut storage = vec![0; (strip.size.width * strip.size.height) as usize];
        let mut depth = DepthBuffer::new(strip, &mut storage).expect("storage");
        let mut target = Recorder::new(strip);
        draw(&mut depth, &mut target);
        assert_eq!(target.outside, 0);
        pixels.extend(target.pixels);
    }
    pixels
}

/// An error for too little memory names a size that suffices.
fn record<'a, T>(
    bin_storage: &'a mut [u16],
    mut with: impl FnMut(&'a mut [u16]) -> Result<T, BinError>,
) -> T {
    match with(&mut []) {
        Ok(recorded) => recorded,
        Err(BinError::Storage { needed, given: 0 }) => match with(&mut bin_storage[..needed]) {
            Ok(recorded) => recorded,
            Err(error) => panic!("{needed} are not enough: {error}"),
        },
        Err(error) => panic!("{error}"),
    }
}

pub(crate) fn check(scene: &Scene) {
    let area = scene.area();
    if area.width() == 0 || area.height() == 0 {
        return;
    }
    let area = Rectangle::with_corners(
        Point::new(area.left as i32, area.top as i32),
        Point::new(area.right as i32 - 1, area.bottom as i32 - 1),
    );
    let height = scene.cache as u32 % area.size.height + 1;
    // As good as random.
    let deal =
        scene.vertices.iter().flatten().fold(0, |sum: u32, &c| sum.rotate_left(5) ^ u32::from(c as u16));
    let shader = |face: usize| Shader(face as u16);
    let whole = |draw: &mut dyn FnMut(&mut DepthBuffer<'_>, &mut Recorder<Shader>)| {
        strips(area, area.size.height, draw)
    };
    scene.with_instance(&scene.faces, &scene.edges, |instance| {
        let mut corners = vec![ScreenVertex::EMPTY; scene.cache];
        let mut bin_storage = [[0; 64]; 4]; // more than a scene has
        let [first, second, third, fourth] = &mut bin_storage;
        let cache = &mut vec![ScreenVertex::EMPTY; scene.vertices.len()];

        let projected = instance.transform(&mut corners);
        let mut faces: BinnedFaces<'_> = record(first, |bin_storage| projected.bin_faces(bin_storage));
        let mut edges: BinnedEdges<'_> = record(second, |bin_storage| projected.bin_edges(bin_storage));
        let solid = whole(&mut |_, target| instance.solid(shader, cache, target).map(drop).unwrap());
        assert!(solid == strips(area, height, |_, target| faces.solid(shader, target).unwrap()), "{scene:?}");
        let lines = whole(&mut |_, target| instance.wireframe(Shader(7), cache, target).map(drop).unwrap());
        assert!(
            lines == strips(area, height, |_, target| edges.draw(Shader(7), target).unwrap()),
            "{scene:?}"
        );

        let (mut cursor, mut other) = ([0xffff; 4], [0xffff; 4]); // more than a scene needs
        let forks = faces.fork(&mut cursor).expect("a cursor");
        assert!(
            solid
                == strips_of_two(area, height, deal, forks, |faces, _, target| faces
                    .solid(shader, target)
                    .unwrap()),
            "two cores: {scene:?}"
        );
        let forks = edges.fork(&mut other).expect("a cursor");
        assert!(
            lines
                == strips_of_two(area, height, deal, forks, |edges, _, target| edges
                    .draw(Shader(7), target)
                    .unwrap()),
            "two cores: {scene:?}"
        );

        let mut corners = vec![ScreenVertex::EMPTY; scene.cache];
        let mut split = instance.split_transform_depth(&mut corners);
        let [first_half, second_half] = split.halves();
        second_half.transform();
        first_half.transform();
        let projected = split.finish();
        let mut faces: BinnedFaces<'_, i16, true> =
            record(third, |bin_storage| projected.split_bin_faces(bin_storage).finish());
        let mut edges: BinnedEdges<'_, i16, true> =
            record(fourth, |bin_storage| projected.bin_edges(bin_storage));
        let tested = whole(&mut |depth, target| {
            instance.depth_tested(shader, cache, depth, target).map(drop).unwrap()
        });
        let banded = strips(area, height, |depth, target| faces.depth_tested(shader, depth, target).unwrap());
        assert!(tested == banded, "depth: {scene:?}");
        let hidden = whole(&mut |depth, target| {
            instance.depth_only(cache, depth);
            instance.hidden_line(Shader(7), cache, depth, target).unwrap();
        });
        let banded = strips(area, height, |depth, target| {
            faces.depth_only(depth);
            edges.hidden_line(Shader(7), depth, target).unwrap();
        });
        assert!(hidden == banded, "hidden lines: {scene:?}");
        let nearer = whole(&mut |depth, target| {
            instance.depth_only(cache, depth);
            instance.wireframe_depth_tested(Shader(7), cache, depth, target).unwrap();
        });
        let banded = strips(area, height, |depth, target| {
            faces.depth_only(depth);
            edges.depth_tested(Shader(7), depth, target).unwrap();
        });
        assert!(nearer == banded, "nearer lines: {scene:?}");

        let forks = faces.fork(&mut cursor).expect("a cursor");
        let banded = strips_of_two(area, height, deal, forks, |faces, depth, target| {
            faces.depth_tested(shader, depth, target).unwrap();
        });
        assert!(tested == banded, "depth, two cores: {scene:?}");
        let [faces, other_faces] = faces.fork(&mut cursor).expect("a cursor");
        let [edges, other_edges] = edges.fork(&mut other).expect("a cursor");
        let forks = [(faces, edges), (other_faces, other_edges)];
        let banded = strips_of_two(area, height, deal, forks, |(faces, edges), depth, target| {
            faces.depth_only(depth);
            edges.hidden_line(Shader(7), depth, target).unwrap();
        });
        assert!(hidden == banded, "hidden lines, two cores: {scene:?}");
    });
}
