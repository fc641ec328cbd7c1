//! The figure of the spaces: a camera in the world, its volume in NDC, a viewport's pixels. The library projects, transforms
//! and rasterises everything in it. Lines have the colour of the surrounding text, which suits dark pages too.

use embedded_graphics::geometry::{Point, Size};
use pinhole::raster::{self, Scissor, ScreenPoint};
use pinhole::space::{View, World};
use pinhole::{Angle, Camera, Point3, Projection, Scalar, Vector3, ViewTransform, Viewport};
use std::error::Error;
use std::fmt::Write;

/// The depicted camera: at the origin of its view, looking along −n.
const NEAR: f32 = 2.0;
const FAR: f32 = 6.0;
/// Half the window at distance 1: 4 to 3.
const SLOPE: [f32; 2] = [0.4, 0.3];
/// The box that it looks at: two opposite corners in view coordinates.
const BOX: [[f32; 3]; 2] = [[-0.7, -0.9, -5.0], [0.7, 0.3, -3.4]];

const RED: &str = "#c44";
const GREEN: &str = "#393";
const BLUE: &str = "#46c";

type Result<T> = std::result::Result<T, Box<dyn Error>>;
type Place = [f32; 2];

pub(crate) fn svg() -> std::result::Result<String, String> {
    draw().map_err(|e| e.to_string())
}

fn draw() -> Result<String> {
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 270\" width=\"100%\" font-family=\"sans-serif\" \
         font-size=\"12\" fill=\"currentColor\" stroke-width=\"1.2\" role=\"img\" \
         aria-label=\"A camera's frustum in the world, its volume in NDC, and a viewport's pixels\">\n",
    );
    world(&mut svg)?;
    ndc(&mut svg)?;
    pixels(&mut svg)?;
    svg += "</svg>\n";
    Ok(svg)
}

fn line(svg: &mut String, [from, to]: [Place; 2], colour: &str, more: &str) {
    let ([x1, y1], [x2, y2]) = (from, to);
    let _ = writeln!(
        svg,
        "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{colour}\" {more}/>"
    );
}

fn text(svg: &mut String, [x, y]: Place, anchor: &str, words: &str) {
    let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>");
}

/// Corners and edges of a box. The indices of an edge's corners differ in one bit.
fn corners(low: [f32; 3], high: [f32; 3]) -> [[f32; 3]; 8] {
    std::array::from_fn(|i| {
        std::array::from_fn(|axis| if i >> axis & 1 == 0 { low[axis] } else { high[axis] })
    })
}

fn edges() -> impl Iterator<Item = [usize; 2]> {
    (0..8).flat_map(|from| [1, 2, 4].map(|bit| [from, from | bit])).filter(|[from, to]| from != to)
}

/// Corners of the frustum between two distances.
fn frustum(near: f32, far: f32) -> [[f32; 3]; 8] {
    corners([-1.0, -1.0, 0.0], [1.0, 1.0, 1.0]).map(|[x, y, z]| {
        let distance = near + (far - near) * z;
        [x * SLOPE[0] * distance, y * SLOPE[1] * distance, -distance]
    })
}

/// The depicted camera stands at the world's origin; a second camera looks at it.
fn world(svg: &mut String) -> Result<()> {
    let viewport = Viewport::new(Point::zero(), Size::new(300, 240))?;
    let eye = Point3::from_f32(8.0, 4.5, 4.0)?;
    let viewing =
        ViewTransform::look_at(eye, Point3::from_f32(0.0, -0.3, -2.9)?, Vector3::from_ints(0, 1, 0))?;
    let lens = Projection::perspective(
        Angle::degrees(36),
        viewport.size(),
        Scalar::from_int(1),
        Scalar::from_int(40),
    )?;
    let camera = Camera::new(&viewing, &lens, &viewport);
    let at = |[x, y, z]: [f32; 3]| -> Result<Place> {
        let point = camera
            .project(Point3::<World>::from_f32(x, y, z)?)
            .map_err(|_| "a point out of the figure")?
            .point;
        Ok([point.x(), point.y()].map(|c| c as f32 / 256.0))
    };
    let volume = frustum(NEAR, FAR);
    for [from, to] in edges() {
        line(svg, [at(volume[from])?, at(volume[to])?], "currentColor", "opacity=\"0.6\"");
    }
    for corner in &volume[..4] {
        line(svg, [at([0.0; 3])?, at(*corner)?], "currentColor", "opacity=\"0.35\" stroke-dasharray=\"3 3\"");
    }
    let shown = corners(BOX[0], BOX[1]);
    for [from, to] in edges() {
        line(svg, [at(shown[from])?, at(shown[to])?], "currentColor", "stroke-width=\"2\"");
    }
    for (axis, colour, name) in
        [([1.2, 0.0, 0.0], RED, "u"), ([0.0, 1.2, 0.0], GREEN, "v"), ([0.0, 0.0, 1.2], BLUE, "n")]
    {
        line(svg, [at([0.0; 3])?, at(axis)?], colour, "stroke-width=\"2\"");
        let [x, y] = at(axis.map(|c| c * 1.25))?;
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"{colour}\">{name}</text>",
            y + 4.0
        );
    }
    for (corner, name) in [(volume[1], "near"), (volume[5], "far")] {
        let [x, y] = at(corner)?;
        text(svg, [x, y + 15.0], "middle", name);
    }
    let [x, y] = at([0.0; 3])?;
    text(svg, [x - 2.0, y + 18.0], "end", "eye");
    text(svg, [150.0, 262.0], "middle", "view: world units, along −n");
    Ok(())
}

/// The view volume and the box in NDC, seen from the right: z/w across, y/w up.
fn ndc(svg: &mut String) -> Result<()> {
    let near = Scalar::from_f32(NEAR)?;
    let [half_width, half_height] = [Scalar::from_f32(SLOPE[0] * NEAR)?, Scalar::from_f32(SLOPE[1] * NEAR)?];
    let window =
        pinhole::Window { left: -half_width, right: half_width, bottom: -half_height, top: half_height };
    let lens = Projection::frustum(window, near, Scalar::from_f32(FAR)?)?;
    let (middle, half) = ([410.0, 120.0], 75.0);
    let at = |[x, y, z]: [f32; 3]| -> Result<Place> {
        let ndc = lens.apply(Point3::<View>::from_f32(x, y, z)?).ndc().ok_or("behind the eye")?;
        Ok([middle[0] + half * ndc.z().to_f32(), middle[1] - half * ndc.y().to_f32()])
    };
    let volume = frustum(NEAR, FAR);
    for [from, to] in edges().filter(|[from, to]| from & 1 == 1 && to & 1 == 1) {
        line(svg, [at(volume[from])?, at(volume[to])?], "currentColor", "opacity=\"0.6\"");
    }
    let shown = corners(BOX[0], BOX[1]);
    for [from, to] in edges().filter(|[from, to]| from & 1 == 1 && to & 1 == 1) {
        line(svg, [at(shown[from])?, at(shown[to])?], "currentColor", "stroke-width=\"2\"");
    }
    let [left, top, right, bottom] = [middle[0] - half, middle[1] - half, middle[0] + half, middle[1] + half];
    line(svg, [[left, bottom + 12.0], [right, bottom + 12.0]], BLUE, "stroke-width=\"2\"");
    line(svg, [[left - 12.0, bottom], [left - 12.0, top]], GREEN, "stroke-width=\"2\"");
    text(svg, [left, bottom + 28.0], "middle", "near −1");
    text(svg, [right, bottom + 28.0], "middle", "far +1");
    text(svg, [middle[0], bottom + 28.0], "middle", "z");
    text(svg, [left - 17.0, bottom], "end", "−1");
    text(svg, [left - 17.0, middle[1] + 4.0], "end", "y");
    text(svg, [left - 17.0, top + 8.0], "end", "+1");
    text(svg, [middle[0], 262.0], "middle", "NDC: −1 … 1, from the right");
    Ok(())
}

/// A viewport of 8 × 6 pixels, and the pixels that a triangle covers.
fn pixels(svg: &mut String) -> Result<()> {
    let (corner, side) = ([540.0, 48.0], 24.0);
    let at = |x: f32, y: f32| [corner[0] + side * x, corner[1] + side * y];
    let points = [[1.3, 4.6], [6.4, 5.2], [3.2, 0.7]];
    let triangle =
        points.map(|[x, y]: Place| ScreenPoint::from_subpixels((x * 256.0) as i32, (y * 256.0) as i32));
    let [Some(a), Some(b), Some(c)] = triangle else { return Err("a corner lies outside the figure".into()) };
    raster::triangle([a, b, c], &Scissor::new(0, 0, 8, 6), |span| {
        let [x, y] = at(span.x as f32, span.y as f32);
        let width = side * span.width as f32;
        let _ = writeln!(svg, "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{side}\" fill=\"{BLUE}\" opacity=\"0.35\"/>");
        Ok::<(), Box<dyn Error>>(())
    })?;
    for x in 0..=8 {
        line(svg, [at(x as f32, 0.0), at(x as f32, 6.0)], "currentColor", "opacity=\"0.3\"");
    }
    for y in 0..=6 {
        line(svg, [at(0.0, y as f32), at(8.0, y as f32)], "currentColor", "opacity=\"0.3\"");
    }
    for (x, y) in (0..48).map(|i| (i % 8, i / 8)) {
        let [x, y] = at(x as f32 + 0.5, y as f32 + 0.5);
        let _ = writeln!(svg, "<circle cx=\"{x}\" cy=\"{y}\" r=\"1\" opacity=\"0.5\"/>");
    }
    let outline = points.map(|[x, y]| at(x, y));
    for (from, to) in [(0, 1), (1, 2), (2, 0)] {
        line(svg, [outline[from], outline[to]], "currentColor", "stroke-width=\"2\"");
    }
    line(svg, [at(0.0, -0.4), at(2.0, -0.4)], RED, "stroke-width=\"2\"");
    line(svg, [at(-0.4, 0.0), at(-0.4, 2.0)], GREEN, "stroke-width=\"2\"");
    text(svg, at(2.4, -0.25), "middle", "x");
    text(svg, at(-0.4, 2.6), "middle", "y");
    text(svg, at(0.0, -0.8), "middle", "(0, 0)");
    text(svg, at(0.0, -1.4), "middle", "NDC (−1, +1)");
    text(svg, at(8.0, 6.7), "end", "(8·256, 6·256) in 24.8 · NDC (+1, −1)");
    text(svg, at(4.0, 8.9), "middle", "screen: pixels of 256 × 256 sub-pixels");
    Ok(())
}
