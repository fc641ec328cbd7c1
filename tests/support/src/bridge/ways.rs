//! One picture by every way to draw it, each compared with the first: into memory and onto a DrawTarget, in one piece and in bands,
//! with depth buffers of several layouts, by every draw call and from vertex caches of any length.
//!
//! Shaders come from `dyn Fn`: each type of a closure would instantiate every draw call again.

use crate::oracle::target::Screen;
use core::fmt::Debug;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use pinhole::{
    color::{StoredPixel, Unmixed},
    draw::ActiveFace,
    mesh::Coordinate,
    prelude::*,
    shading::{SpanShader, Stroke},
    target::Pixels,
};

/// The pictures of faces without depth and with depth, row by row, and the depth buffer; and from far to near, by [`by_every_call`].
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn<C> {
    pub solid: Vec<C>,
    pub deep: Vec<C>,
    pub depths: Vec<u16>,
    pub painted: Vec<C>,
}

/// Draws into memory.
pub type IntoMemory<'a, C> = dyn FnMut(&mut Pixels<'_, C>, &mut DepthBuffer<'_>) + 'a;

/// Draws onto a DrawTarget that is not the library's.
pub type OntoScreen<'a, C> = dyn FnMut(&mut Screen<C>, &mut DepthBuffer<'_>) + 'a;

/// Draws a band.
pub type IntoBand<'a, C> = dyn FnMut(&mut Band<'_, C>, &mut DepthBuffer<'_>) + 'a;

/// Draws into the memory of a band, and counts.
type CountedBand<'a, C, const N: usize> =
    dyn FnMut(&mut Pixels<'_, C, [u8; N]>, &mut DepthBuffer<'_>) -> Statistics + 'a;

/// `memory_in_rows` with a gap of 5 cells, and without one if the depth buffer has the area of the pixels.
pub fn memory_with<C: PixelColor>(
    area: Rectangle,
    depth_area: Rectangle,
    background: C,
    draw: &mut IntoMemory<'_, C>,
) -> (Vec<C>, Vec<u16>) {
    memory_in_rows(area, depth_area, if depth_area == area { 0 } else { GAP }, background, draw)
}

/// Cells between rows of pixels.
const GAP: usize = 5;

/// What `draw` leaves in memory, and the depths of these pixels in a buffer of `depth_area`. Between rows of pixels lie `gap` cells, which
/// stay as they were.
fn memory_in_rows<C: PixelColor>(
    area: Rectangle,
    depth_area: Rectangle,
    gap: usize,
    background: C,
    draw: &mut IntoMemory<'_, C>,
) -> (Vec<C>, Vec<u16>) {
    let count = |area: Rectangle| (area.size.width * area.size.height) as usize;
    let width = area.size.width as usize;
    let stride = width + gap;
    let mut cells = vec![background; stride * area.size.height as usize];
    let mut depths = vec![0; count(depth_area)];
    let mut depth = DepthBuffer::new(depth_area, &mut depths).expect("a depth for each pixel");
    let pixels = if stride == width {
        Pixels::new(&mut cells, area)
    } else {
        Pixels::with_stride(&mut cells, area, stride)
    };
    draw(&mut pixels.expect("a cell for each pixel"), &mut depth);
    let depths = area.points().map(|at| depth.at(at).expect("the areas overlap")).collect();
    let (cells, gaps): (Vec<_>, Vec<_>) =
        cells.into_iter().enumerate().partition(|(at, _)| at % stride < width);
    assert!(gaps.iter().all(|(_, cell)| *cell == background), "between rows");
    (cells.into_iter().map(|(_, cell)| cell).collect(), depths)
}

/// What `draw` leaves in memory.
pub fn memory<C: PixelColor>(area: Rectangle, background: C, draw: &mut IntoMemory<'_, C>) -> Vec<C> {
    memory_with(area, area, background, draw).0
}

/// What `draw` leaves on a DrawTarget that is not the library's, and its depths.
pub fn screen<C: PixelColor>(area: Rectangle, draw: &mut OntoScreen<'_, C>) -> (Screen<C>, Vec<u16>) {
    let (mut screen, mut depths) =
        (Screen::new(area), vec![0; (area.size.width * area.size.height) as usize]);
    let mut depth = DepthBuffer::new(area, &mut depths).expect("a depth for each pixel");
    draw(&mut screen, &mut depth);
    let depths = depth.values().to_vec();
    (screen, depths)
}

/// What bands of `rows` rows show, one after the other; the last may be lower.
pub fn bands<C: Color>(area: Rectangle, background: C, rows: u32, draw: &mut IntoBand<'_, C>) -> Vec<C> {
    let mut frame = Frame::new(area, background);
    let mut strip = vec![0xaa; Frame::<C>::strip_bytes(area.size.width, rows)];
    let mut depths = vec![0; (area.size.width * rows) as usize];
    let mut colours = Vec::new();
    while let Some(mut band) = frame.next_band(&mut strip).expect("a row at least") {
        let mut depth = DepthBuffer::new(band.area(), &mut depths).expect("a depth for each pixel");
        draw(&mut band, &mut depth);
        colours.extend(band.colors());
    }
    colours
}

/// Parts of an area, of odd width, and of one row to many.
fn parts(area: Rectangle) -> Vec<Rectangle> {
    let Size { width, height } = area.size;
    let (left, mut top, mut all) = (area.top_left.x + width as i32 / 6, height as i32 / 20, Vec::new());
    for rows in [1, 7, 40].into_iter().cycle() {
        if top as u32 + rows > height {
            break;
        }
        let corner = Point::new(left, area.top_left.y + top);
        all.push(Rectangle::new(corner, Size::new((width / 2) | 1, rows)));
        top += rows as i32;
    }
    all
}

/// The rows of a part, of a picture of the area.
fn crop<T: Copy>(picture: &[T], area: Rectangle, part: Rectangle) -> Vec<T> {
    let at =
        |p: Point| (p - area.top_left).y as usize * area.size.width as usize + (p - area.top_left).x as usize;
    part.points().map(|p| picture[at(p)]).collect()
}

/// Into memory: in one piece, in parts, and with depth buffers whose rows are as far apart as those of pixels, farther, or less far.
fn parts_in_memory<C: PixelColor>(
    area: Rectangle,
    background: C,
    solid: &mut IntoMemory<'_, C>,
    deep: &mut IntoMemory<'_, C>,
) -> Drawn<C> {
    let whole = memory(area, background, solid);
    let (pixels, depths) = memory_with(area, area, background, deep);
    let wider =
        |area: Rectangle| Rectangle::new(area.top_left - Point::new(3, 1), area.size + Size::new(5, 2));
    for part in parts(area) {
        let (found, _) = memory_with(part, wider(part), background, solid);
        assert!(found == crop(&whole, area, part), "{part:?}");
        let as_memory = Rectangle::new(part.top_left, part.size + Size::new(GAP as u32, 2));
        for depth_area in [wider(part), part, as_memory] {
            let found = memory_in_rows(part, depth_area, GAP, background, deep);
            let wanted = (crop(&pixels, area, part), crop(&depths, area, part));
            assert!(found == wanted, "{part:?} with the depths of {depth_area:?}");
        }
    }
    Drawn { solid: whole, deep: pixels, depths, painted: Vec::new() }
}

/// Into memory: in one piece, in parts, and with depth buffers that are larger than the picture.
pub fn in_memory<C: PixelColor, S: SpanShader<C>>(
    instance: &MeshInstance<'_>,
    area: Rectangle,
    background: C,
    shade: &dyn Fn(usize) -> S,
) -> Drawn<C> {
    let mut cache = vec![ScreenVertex::EMPTY; instance.mesh().vertices().len()];
    let mut other = cache.clone();
    let solid: &mut IntoMemory<'_, C> = &mut |target, _| {
        let Ok(_) = instance.faces(shade).cached(&mut cache).draw(target);
    };
    parts_in_memory(area, background, solid, &mut |target, depth| {
        let Ok(_) = instance.faces(shade).cached(&mut other).draw(&mut target.depth_tested(depth));
    })
}

/// A DrawTarget that is not the library's, in one piece and in parts, shows what memory does.
fn parts_on_screen<C: PixelColor>(
    drawn: &Drawn<C>,
    area: Rectangle,
    background: C,
    solid: &mut OntoScreen<'_, C>,
    deep: &mut OntoScreen<'_, C>,
) {
    for part in parts(area).into_iter().chain([area]) {
        let (found, _) = screen(part, solid);
        assert!(found.over(background) == crop(&drawn.solid, area, part), "DrawTarget, {part:?}");
        let (found, depths) = screen(part, deep);
        assert!(found.over(background) == crop(&drawn.deep, area, part), "DrawTarget with depth, {part:?}");
        assert!(depths == crop(&drawn.depths, area, part), "depths beside a DrawTarget, {part:?}");
    }
}

/// One pixel in so many is picked: the columns of successive rows differ.
const PICKED: usize = 247;

/// Into memory, and onto a DrawTarget that is not the library's, in one piece and in parts; picking finds the depths that are stored.
pub fn everywhere<C: PixelColor, S: SpanShader<C, Ink: Unmixed<C>>>(
    instance: &MeshInstance<'_>,
    area: Rectangle,
    background: C,
    shade: &dyn Fn(usize) -> S,
) -> Drawn<C> {
    let drawn = in_memory(instance, area, background, shade);
    let mut cache = vec![ScreenVertex::EMPTY; instance.mesh().vertices().len() / 2];
    let mut other = cache.clone();
    let solid: &mut OntoScreen<'_, C> = &mut |target, _| {
        let Ok(_) = instance.faces(shade).cached(&mut cache).draw(target);
    };
    parts_on_screen(&drawn, area, background, solid, &mut |target, depth| {
        let Ok(_) = instance.faces(shade).cached(&mut other).draw(&mut target.depth_tested(depth));
    });
    if S::WRITES_DEPTH {
        for (pixel, &depth) in area.points().zip(&drawn.depths).step_by(PICKED) {
            let picked = instance.faces(shade).cached(&mut other).pick(pixel);
            assert_eq!(picked.map_or(DepthBuffer::NOTHING, |picked| picked.depth), depth, "{pixel}");
        }
    }
    drawn
}

/// By every draw call for faces: at once, binned and from far to near; onto a DrawTarget and into memory, in one piece and in bands of
/// each height; from vertex caches of several lengths that hold the vertices of another picture. Binned faces are drawn onto a
/// DrawTarget without depth, and into memory with depth: `properties` draws both by both.
pub fn by_every_call<const N: usize, C, S, V>(
    instance: &MeshInstance<'_, V>,
    area: Rectangle,
    background: C,
    heights: &[u32],
    shade: &dyn Fn(usize) -> S,
) -> (Drawn<C>, Statistics)
where
    C: Color + StoredPixel<[u8; N]> + Debug,
    S: SpanShader<C, Ink: Unmixed<C>>,
    V: Coordinate,
{
    let mesh = instance.mesh();
    let mut stale = vec![ScreenVertex::EMPTY; mesh.vertices().len() + 3];
    let _ = instance.transform(&mut stale);
    stale.rotate_right(5);
    let [mut cache, mut short] = [stale.len(), stale.len() / 3].map(|length| stale[..length].to_vec());
    let mut bins = vec![0; mesh.face_bins_len()];
    let mut counted = Vec::new();
    let (solid, _) =
        screen(area, &mut |target, _| counted.extend(instance.faces(shade).cached(&mut cache).draw(target)));
    let (deep, depths) = screen(area, &mut |target, depth| {
        counted.extend(instance.faces(shade).cached(&mut short).draw(&mut target.depth_tested(depth)))
    });
    let mut painter = Box::new(Painter::<S, 1500, 1000>::new());
    instance.faces(shade).sorted(&mut painter).expect("room");
    let order = painter.order();
    let (painted, _) = screen(area, &mut |target, _| {
        let Ok(()) = order.draw(target);
    });
    let [solid, deep, painted] = [solid, deep, painted].map(|screen| screen.over(background));

    let check = |wanted: &[C], rows, what, draw: &mut IntoBand<'_, C>| {
        assert!(bands(area, background, rows, draw) == wanted, "{what}, {rows} rows");
    };
    for &rows in heights {
        check(&painted, rows, "painter", &mut |band, _| {
            let Ok(()) = order.draw(&mut band.pixels());
        });
        check(&solid, rows, "at once, in memory", &mut |band, _| {
            let Ok(statistics) = instance.faces(shade).draw(&mut band.pixels());
            counted.push(statistics);
        });
        check(&deep, rows, "at once, with depth, in memory", &mut |band, depth| {
            let Ok(statistics) =
                instance.faces(shade).cached(&mut cache).draw(&mut band.pixels().depth_tested(depth));
            counted.push(statistics);
        });
        let transformed = instance.transform_depth(&mut short);
        let mut binned = transformed.bin_faces(&mut bins).expect("room");
        check(&solid, rows, "binned", &mut |band, _| {
            let Ok(()) = binned.draw(shade, band);
        });
        counted.push(binned.statistics());
        let mut binned = instance.transform_depth(&mut cache).bin_faces(&mut bins).expect("room");
        check(&deep, rows, "binned, with depth, in memory", &mut |band, depth| {
            let Ok(()) = binned.draw(shade, &mut band.pixels().depth_tested(depth));
        });
        counted.push(binned.statistics());
        // Lists of active faces without room, with too little, and with enough.
        let mut list = vec![ActiveFace::EMPTY; [0, 1, 4, 300][(rows + counted[0].drawn) as usize % 4]];
        let transformed = instance.transform_depth(&mut cache);
        let mut active = transformed.bin_faces(&mut bins).expect("room").with_active_faces(&mut list);
        check(&solid, rows, "active", &mut |band, _| {
            let Ok(()) = active.draw(shade, &mut band.pixels());
        });
        check(&deep, rows, "active, with depth", &mut |band, depth| {
            let Ok(()) = active.draw(shade, &mut band.pixels().depth_tested(depth));
        });
        counted.push(active.statistics());
    }
    assert!(counted.iter().all(|statistics| *statistics == counted[0]), "{counted:?}");
    (Drawn { solid, deep, depths, painted }, counted[0])
}

macro_rules! culled_early {
    ($(#[$doc:meta])* $name:ident, $culled_by:ident, $count:expr) => {
        $(#[$doc])*
        pub fn $name<C: Color + Debug, S: SpanShader<C, Ink: Unmixed<C>>, V: Coordinate>(
            instance: &MeshInstance<'_, V>,
            area: Rectangle,
            background: C,
            shade: &dyn Fn(usize) -> S,
        ) -> (Drawn<C>, Statistics) {
            let mut cache = vec![ScreenVertex::EMPTY; instance.mesh().vertices().len() * 2 / 3];
            let mut counted = Vec::new();
            let faces = || instance.faces(shade).$culled_by();
            let (solid, _) =
                screen(area, &mut |target, _| counted.extend(faces().cached(&mut cache).draw(target)));
            let (deep, depths) = screen(area, &mut |target, depth| {
                counted.extend(faces().draw(&mut target.depth_tested(depth)))
            });
            let mut painter = Box::new(Painter::<S, 1500, 1000>::new());
            faces().sorted(&mut painter).expect("room");
            let (painted, _) = screen(area, &mut |target, _| counted.extend(painter.draw(target)));
            let count = $count;
            assert!(counted.iter().all(|each| count(each) == count(&counted[0])), "{counted:?}");
            let [solid, deep, painted] = [solid, deep, painted].map(|screen| screen.over(background));
            (Drawn { solid, deep, depths, painted }, counted[0])
        }
    };
}

culled_early!(
    /// By every draw call that culls by planes: at once, into a DrawTarget without depth and with depth, and from far to near.
    by_planes, culled_by_planes, |each: &Statistics| *each
);
culled_early!(
    /// [`by_planes`] with clusters. Whether a face beside the viewport is drawn or culled depends on the cache.
    by_clusters, culled_by_clusters, |each: &Statistics| (each.drawn + each.culled, each.outside)
);

/// Pictures of edges: all of them, those before the faces, and those that faces do not hide.
#[derive(Clone, Debug, PartialEq)]
pub struct Lines<C> {
    pub all: Vec<C>,
    pub tested: Vec<C>,
    pub hidden: Vec<C>,
}

/// By every draw call for edges, into memory: at once and in bands of each height. `face` colours the faces; without it, their depth is
/// stored alone.
pub fn lines_by_every_call<const N: usize, C, K, V>(
    instance: &MeshInstance<'_, V>,
    area: Rectangle,
    background: C,
    heights: &[u32],
    stroke: K,
    face: Option<C>,
) -> Lines<C>
where
    C: Color + StoredPixel<[u8; N]> + Debug,
    K: Stroke<C>,
    V: Coordinate,
{
    let mesh = instance.mesh();
    let mut cache = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
    let (mut bins, mut edge_bins) = (vec![0; mesh.face_bins_len()], vec![0; mesh.edge_bins_len()]);
    let mut counted = Vec::new();
    let mut at_once = |draw: &mut CountedBand<'_, C, N>| {
        bands(area, background, area.size.height, &mut |band, depth| {
            counted.push(draw(&mut band.pixels(), depth))
        })
    };
    let all = at_once(&mut |target, _| {
        let Ok(statistics) = instance.edges(|_| stroke).draw(target);
        statistics
    });
    let mut over_faces = |is_hidden: bool| {
        at_once(&mut |target, depth| {
            let Ok(_) = match face {
                Some(color) => {
                    instance.faces(|_| color).cached(&mut cache).draw(&mut target.depth_tested(depth))
                }
                None => Ok(instance.depth_only(&mut cache, depth)),
            };
            let Ok(statistics) = match is_hidden {
                false => instance.edges(|_| stroke).cached(&mut cache).draw(&mut target.depth_tested(depth)),
                true => {
                    instance.edges(|_| stroke).cached(&mut cache).hidden_line(&mut target.depth_tested(depth))
                }
            };
            statistics
        })
    };
    let (tested, hidden) = (over_faces(false), over_faces(true));
    let transformed = instance.transform_depth(&mut cache);
    let mut faces = transformed.bin_faces(&mut bins).expect("room");
    let mut edges = transformed.bin_edges(&mut edge_bins).expect("room");
    counted.push(edges.statistics());
    assert!(counted.iter().all(|statistics| *statistics == counted[0]), "{counted:?}");
    for (&rows, (what, wanted)) in heights
        .iter()
        .flat_map(|rows| [("all", &all), ("tested", &tested), ("hidden", &hidden)].map(|way| (rows, way)))
    {
        let banded = bands(area, background, rows, &mut |band, depth| {
            let target = &mut band.pixels();
            let Ok(()) = match (what, face) {
                ("all", _) => Ok(()),
                (_, Some(color)) => faces.draw(|_| color, &mut target.depth_tested(depth)),
                _ => {
                    faces.depth_only(depth);
                    Ok(())
                }
            };
            let Ok(()) = match what {
                "all" => edges.draw(stroke, target),
                "tested" => edges.draw(stroke, &mut target.depth_tested(depth)),
                _ => edges.hidden_line(stroke, &mut target.depth_tested(depth)),
            };
        });
        assert!(banded == *wanted, "{what}, {rows} rows");
    }
    Lines { all, tested, hidden }
}
