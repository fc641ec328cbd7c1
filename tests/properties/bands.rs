//! Bands of any kind add up to the picture that the immediate functions draw at once.

use crate::cases;
use crate::strategies::{scene, Scene, EXPONENT, HEIGHT, WIDTH};
use embedded_graphics_core::pixelcolor::{Gray4, Gray8, GrayColor};
use embedded_graphics_core::prelude::*;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    Band, BinError, BinnedEdges, BinnedFaces, Cull, DepthBuffer, Frame, Mesh, MeshInstance, Painter,
    PaintersOrder, PixelFormat, ScreenVertex, Statistics, TransformedMesh,
};
use proptest::prelude::*;
use support::bridge;
use support::oracle::target::Recorder;

#[derive(Clone, Copy, Debug)]
pub(crate) enum Way {
    Solid(Cull),
    Depth(Cull),
    Wireframe,
    /// Lines that are tested against the depth of the faces.
    DepthLines,
    HiddenLines,
    Painter,
}

pub(crate) const WAYS: [Way; 8] = [
    Way::Solid(Cull::Back),
    Way::Solid(Cull::None),
    Way::Depth(Cull::Back),
    Way::Depth(Cull::None),
    Way::Wireframe,
    Way::DepthLines,
    Way::HiddenLines,
    Way::Painter,
];

pub(crate) const BACKGROUND: Gray8 = Gray8::new(200);
const LINE: Gray8 = Gray8::new(77);

pub(crate) fn colour(face: usize) -> Gray8 {
    Gray8::new(face as u8)
}

/// Edge k is a side of face k, as the strategy makes them.
const BESIDE: [[u16; 2]; 8] = [[0, 1], [1, 1], [2, 0], [3, 3], [4, 65_535], [5, 5], [6, 7], [7, 6]];

pub(crate) fn mesh(scene: &Scene) -> Mesh<'_> {
    Mesh::new(&scene.vertices, EXPONENT, &scene.faces)
        .and_then(|m| m.with_edges(&scene.edges))
        .and_then(|m| m.with_edge_faces(&BESIDE))
        .expect("a mesh")
}

/// Draws a scene in one piece, with a vertex cache of so many entries, onto a target that is not the library's.
pub(crate) fn draw(scene: &Scene, way: Way, cache: usize, target: &mut Recorder<Gray8>) -> Statistics {
    let (camera, model, mesh) = (scene.camera.library(), scene.model.library(), mesh(scene));
    let instance = camera.place(&mesh, &model);
    let mut corners = vec![ScreenVertex::EMPTY; cache];
    let area = target.bounding_box();
    let mut storage = vec![0; (area.size.width * area.size.height) as usize];
    let mut depth = DepthBuffer::new(area, &mut storage).expect("storage");
    let statistics = match way {
        Way::Solid(cull) => instance.with_cull(cull).solid(colour, &mut corners, target),
        Way::Depth(cull) => instance.with_cull(cull).depth_tested(colour, &mut corners, &mut depth, target),
        Way::Wireframe => instance.wireframe(LINE, &mut corners, target),
        Way::DepthLines | Way::HiddenLines => {
            instance.depth_only(&mut corners, &mut depth);
            if matches!(way, Way::HiddenLines) {
                instance.hidden_line(LINE, &mut corners, &mut depth, target)
            } else {
                instance.wireframe_depth_tested(LINE, &mut corners, &mut depth, target)
            }
        }
        Way::Painter => {
            let mut painter = Painter::<Gray8, 128, 64>::new();
            painter.add(&instance, colour).expect("room");
            painter.draw(target)
        }
    };
    statistics.expect("no error")
}

/// A scene drawn in one piece; what is not drawn is background.
pub(crate) fn reference(scene: &Scene, way: Way, area: Rectangle) -> (Vec<u8>, Statistics) {
    let mut target = Recorder::new(area);
    let statistics = draw(scene, way, 16, &mut target);
    let pixels = area.points().map(|at| target.colour(at.x, at.y).unwrap_or(BACKGROUND).luma());
    (pixels.collect(), statistics)
}

/// The bin storage that one frame needs.
pub(crate) enum Recorded<'a> {
    Solid(BinnedFaces<'a>),
    Depth(BinnedFaces<'a, i16, true>),
    Wireframe(BinnedEdges<'a>),
    /// Whether hidden lines are removed.
    Lines(Box<(BinnedFaces<'a, i16, true>, BinnedEdges<'a, i16, true>, bool)>),
    Painter(Box<Painter<Gray8, 128, 64>>),
    Order(PaintersOrder<'a, Gray8>),
}

impl Recorded<'_> {
    /// For two cores: `cursors` are the second one's storage.
    pub(crate) fn fork<'b>(&'b mut self, cursors: &'b mut [[u16; 1]; 2]) -> [Recorded<'b>; 2] {
        let [cursor, other] = cursors;
        match self {
            Self::Solid(faces) => faces.fork(cursor).expect("room").map(Recorded::Solid),
            Self::Depth(faces) => faces.fork(cursor).expect("room").map(Recorded::Depth),
            Self::Wireframe(edges) => edges.fork(cursor).expect("room").map(Recorded::Wireframe),
            Self::Lines(lines) => {
                let (faces, edges, hidden) = &mut **lines;
                let [first, second] = faces.fork(cursor).expect("room");
                let [first_edges, second_edges] = edges.fork(other).expect("room");
                [(first, first_edges, *hidden), (second, second_edges, *hidden)]
                    .map(|lines| Recorded::Lines(Box::new(lines)))
            }
            Self::Painter(painter) => [painter.order(); 2].map(Recorded::Order),
            Self::Order(order) => [*order; 2].map(Recorded::Order),
        }
    }

    pub(crate) fn draw(&mut self, band: &mut Band<'_, Gray8>) {
        let Ok(()) = match self {
            Self::Solid(faces) => faces.solid(colour, band),
            Self::Depth(faces) => {
                let mut storage = vec![0; (band.area().size.width * band.area().size.height) as usize];
                let mut depth = DepthBuffer::new(band.area(), &mut storage).expect("storage");
                faces.depth_tested(colour, &mut depth, band)
            }
            Self::Wireframe(edges) => edges.draw(LINE, band),
            Self::Lines(lines) => {
                let (faces, edges, hidden) = &mut **lines;
                let mut storage = vec![0; (band.area().size.width * band.area().size.height) as usize];
                let mut depth = DepthBuffer::new(band.area(), &mut storage).expect("storage");
                faces.depth_only(&mut depth);
                if *hidden {
                    edges.hidden_line(LINE, &mut depth, band)
                } else {
                    edges.depth_tested(LINE, &mut depth, band)
                }
            }
            Self::Painter(painter) => painter.order().draw(band),
            Self::Order(order) => order.draw(band),
        };
    }

    pub(crate) fn statistics(&mut self) -> Statistics {
        match self {
            Self::Solid(faces) => faces.statistics(),
            Self::Depth(faces) => faces.statistics(),
            Self::Wireframe(edges) => edges.statistics(),
            Self::Lines(lines) => lines.1.statistics(),
            Self::Painter(painter) => painter.order().statistics(),
            Self::Order(order) => order.statistics(),
        }
    }

    fn bounds(&self) -> Option<Rectangle> {
        match self {
            Self::Solid(faces) => Some(faces.bounds()),
            Self::Depth(faces) => Some(faces.bounds()),
            Self::Wireframe(edges) => Some(edges.bounds()),
            Self::Lines(lines) => Some(lines.1.bounds()),
            Self::Painter(_) | Self::Order(_) => None,
        }
    }
}

/// The stages before bands are drawn: on one core, or on several.
pub(crate) trait Stages {
    fn transform<'a>(instance: &'a MeshInstance<'_>, cache: &'a mut [ScreenVertex]) -> TransformedMesh<'a>;
    fn transform_depth<'a>(
        instance: &'a MeshInstance<'_>,
        cache: &'a mut [ScreenVertex],
    ) -> TransformedMesh<'a, i16, true>;
    fn bin_faces<'a, const DEPTH: bool>(
        mesh: TransformedMesh<'a, i16, DEPTH>,
        bin_storage: &'a mut [u16],
    ) -> Result<BinnedFaces<'a, i16, DEPTH>, BinError>;
}

struct OneCore;

impl Stages for OneCore {
    fn transform<'a>(instance: &'a MeshInstance<'_>, cache: &'a mut [ScreenVertex]) -> TransformedMesh<'a> {
        instance.transform(cache)
    }

    fn transform_depth<'a>(
        instance: &'a MeshInstance<'_>,
        cache: &'a mut [ScreenVertex],
    ) -> TransformedMesh<'a, i16, true> {
        instance.transform_depth(cache)
    }

    fn bin_faces<'a, const DEPTH: bool>(
        mesh: TransformedMesh<'a, i16, DEPTH>,
        bin_storage: &'a mut [u16],
    ) -> Result<BinnedFaces<'a, i16, DEPTH>, BinError> {
        mesh.bin_faces(bin_storage)
    }
}

fn record<R>(
    scene: &Scene,
    way: Way,
    corners: &mut [ScreenVertex],
    then: impl FnOnce(&mut Recorded<'_>) -> R,
) -> R {
    record_by::<OneCore, R>(scene, way, corners, then)
}

pub(crate) fn record_by<S: Stages, R>(
    scene: &Scene,
    way: Way,
    corners: &mut [ScreenVertex],
    then: impl FnOnce(&mut Recorded<'_>) -> R,
) -> R {
    let (camera, model, mesh) = (scene.camera.library(), scene.model.library(), mesh(scene));
    let (instance, mut bin_storage, mut more) = (camera.place(&mesh, &model), [0; 9], [0; 9]);
    let instance = match way {
        Way::Solid(cull) | Way::Depth(cull) => instance.with_cull(cull),
        _ => instance,
    };
    let mut recorded = match way {
        Way::Solid(_) => {
            Recorded::Solid(S::bin_faces(S::transform(&instance, corners), &mut bin_storage).expect("room"))
        }
        Way::Depth(_) => Recorded::Depth(
            S::bin_faces(S::transform_depth(&instance, corners), &mut bin_storage).expect("room"),
        ),
        Way::Wireframe => {
            Recorded::Wireframe(S::transform(&instance, corners).bin_edges(&mut bin_storage).expect("room"))
        }
        Way::DepthLines | Way::HiddenLines => {
            let projected = S::transform_depth(&instance, corners);
            let faces = S::bin_faces(projected, &mut bin_storage).expect("room");
            let edges = projected.bin_edges(&mut more).expect("room");
            Recorded::Lines(Box::new((faces, edges, matches!(way, Way::HiddenLines))))
        }
        Way::Painter => {
            let mut painter = Box::new(Painter::new());
            painter.add(&instance, colour).expect("room");
            Recorded::Painter(painter)
        }
    };
    then(&mut recorded)
}

pub(crate) fn banded(recorded: &mut Recorded<'_>, area: Rectangle, heights: &[u32]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut frame = Frame::new(area, BACKGROUND);
    for &height in heights.iter().cycle() {
        let mut strip = vec![0xaa; Frame::<Gray8>::strip_bytes(area.size.width, height)];
        let Some(mut band) = frame.next_band(&mut strip).expect("a row at least") else { break };
        recorded.draw(&mut band);
        bytes.extend(band.bytes());
    }
    bytes
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn bands_of_every_height_add_up_to_the_full_picture(scene in scene(), length in prop_oneof![Just(16usize), 0usize..9]) {
        let area = bridge::rectangle(0, 0, WIDTH, HEIGHT);
        for way in WAYS {
            let (whole, statistics) = reference(&scene, way, area);
            let mut corners = vec![ScreenVertex::EMPTY; length];
            record(&scene, way, &mut corners, |recorded| -> Result<(), TestCaseError> {
                prop_assert_eq!(recorded.statistics(), statistics);
                for height in 1..=HEIGHT {
                    prop_assert!(banded(recorded, area, &[height]) == whole, "{way:?}, {height} rows");
                }
                Ok(())
            })?;
        }
    }

    /// Band heights that change within a frame, and frames of any part of the display, also outside the viewport.
    #[test]
    fn any_rectangle_in_any_bands_shows_a_crop(
        scene in scene(),
        heights in prop::collection::vec(1u32..9, 1..5),
        areas in prop::collection::vec((-40i32..60, -40i32..60, 0u32..60, 0u32..60), 3),
    ) {
        for way in WAYS {
            let mut corners = vec![ScreenVertex::EMPTY; 16];
            record(&scene, way, &mut corners, |recorded| -> Result<(), TestCaseError> {
                for &(x, y, width, height) in &areas {
                    let area = bridge::rectangle(x, y, width, height);
                    let whole = reference(&scene, way, area).0;
                    prop_assert!(banded(recorded, area, &heights) == whole, "{way:?} {area:?}");
                }
                Ok(())
            })?;
        }
    }

    /// Nothing is drawn outside the bounds, which lie in the picture.
    #[test]
    fn bounds_contain_every_drawn_pixel(scene in scene()) {
        let area = bridge::rectangle(0, 0, WIDTH, HEIGHT);
        for way in WAYS {
            let whole = reference(&scene, way, area).0;
            let mut corners = vec![ScreenVertex::EMPTY; 16];
            let bounds = record(&scene, way, &mut corners, |recorded| recorded.bounds());
            let Some(bounds) = bounds else { continue };
            prop_assert_eq!(bounds.intersection(&area), bounds);
            for (at, _) in whole.iter().enumerate().filter(|(_, pixel)| **pixel != BACKGROUND.luma()) {
                let pixel = Point::new((at % WIDTH as usize) as i32, (at / WIDTH as usize) as i32);
                prop_assert!(bounds.contains(pixel), "{way:?} {pixel}");
            }
        }
    }

    /// Over capacity nothing is drawn, and the error names what is enough; one number less is not.
    #[test]
    fn bin_storage_that_is_too_small_names_the_size_it_needs(scene in scene(), given in 0usize..10) {
        let (camera, model, mesh) = (scene.camera.library(), scene.model.library(), mesh(&scene));
        let (instance, mut corners) = (camera.place(&mesh, &model), [ScreenVertex::EMPTY; 16]);
        let transformed = instance.transform(&mut corners);
        let mut bin_storage = vec![0; given];
        let (faces, edges) = (transformed.bin_faces(&mut bin_storage).map(|_| ()), transformed.bin_edges(&mut vec![0; given]).map(|_| ()));
        for error in [faces, edges].into_iter().filter_map(Result::err) {
            let BinError::Storage { needed, given: said } = error else { panic!("{error}") };
            prop_assert!(said == given && needed > given && needed <= 9, "{error}");
        }
        if let Err(BinError::Storage { needed, .. }) = faces {
            prop_assert!(transformed.bin_faces(&mut vec![0; needed]).is_ok());
            prop_assert!(transformed.bin_faces(&mut vec![0; needed - 1]).is_err());
        }
    }

    /// Colours as the wire has them, sent on with one call a band.
    #[test]
    fn a_band_sends_what_it_holds(scene in scene(), height in 1u32..9) {
        let area = bridge::rectangle(0, 0, WIDTH - 1, HEIGHT);
        let gray = |face: usize| Gray4::new(face as u8 + 1);
        let (camera, model, mesh) = (scene.camera.library(), scene.model.library(), mesh(&scene));
        let mut corners = [ScreenVertex::EMPTY; 16];
        let mut whole = Recorder::new(area);
        camera.place(&mesh, &model).solid(gray, &mut corners, &mut whole).expect("no error");
        let (mut bin_storage, mut display) = ([0; 9], Recorder::new(area));
        let instance = camera.place(&mesh, &model);
        let projected = instance.transform(&mut corners);
        let mut faces = projected.bin_faces(&mut bin_storage).expect("room");
        let mut frame = Frame::new(area, Gray4::BLACK);
        let mut strip = vec![0; Frame::<Gray4>::strip_bytes(WIDTH - 1, height)];
        while let Some(mut band) = frame.next_band(&mut strip).expect("a row") {
            let Ok(()) = faces.solid(gray, &mut band);
            let bytes: Vec<u8> = band.colors().collect::<Vec<_>>().chunks(WIDTH as usize - 1).flat_map(|row| {
                row.chunks(2).map(|p| (p[0].luma() << 4) | p.get(1).map_or(0, |c| c.luma()))
            }).collect();
            prop_assert_eq!(band.bytes(), bytes);
            band.send(&mut display).expect("no error");
        }
        prop_assert_eq!(display.calls.len() as u32, HEIGHT.div_ceil(height));
        for pixel in area.points() {
            let wanted = whole.colour(pixel.x, pixel.y).unwrap_or(Gray4::BLACK);
            prop_assert_eq!(display.colour(pixel.x, pixel.y), Some(wanted));
            prop_assert_eq!(display.count(pixel.x, pixel.y), 1);
            prop_assert_eq!(Gray4::decode(wanted.encode()), wanted);
        }
    }
}
