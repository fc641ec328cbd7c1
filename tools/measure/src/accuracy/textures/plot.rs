//! The plot: a panel for each scene that the benchmark has, instructions to the right and the largest error upwards.

use super::methods::{Method, METHODS};
use super::Measured;
use pinhole::Accuracy;
use std::fmt::Write as _;

/// The size of a panel in pixels, and its margins: left, top, right, bottom.
const PANEL: [f64; 2] = [430.0, 330.0];
const MARGIN: [f64; 4] = [62.0, 34.0, 14.0, 44.0];
/// The ranges of the axes: instructions for each pixel, and texels. Both axes are logarithmic.
const X: [f64; 2] = [7.0, 160.0];
const Y: [f64; 2] = [1e-3, 64.0];
const X_TICKS: [f64; 5] = [10.0, 20.0, 40.0, 80.0, 160.0];
const Y_TICKS: [f64; 5] = [1e-3, 1e-2, 0.1, 1.0, 10.0];

const fn color(method: Method) -> &'static str {
    match method {
        Method::Ours(_) => "#c8141e",
        Method::EveryPixel => "#1e5ac8",
        Method::EverySixteen => "#6e6e6e",
    }
}

const fn label(method: Method) -> &'static str {
    match method {
        Method::Ours(Accuracy::Quarter) => "1/4",
        Method::Ours(Accuracy::Eighth) => "1/8",
        Method::Ours(Accuracy::Sixteenth) => "1/16",
        Method::EveryPixel => "each pixel",
        Method::EverySixteen => "every 16",
    }
}

/// Where a value lies between two others, 0 … 1.
fn share(value: f64, [low, high]: [f64; 2]) -> f64 {
    ((value / low).ln() / (high / low).ln()).clamp(0.0, 1.0)
}

pub(crate) fn svg(measured: &[Measured]) -> String {
    let shown: Vec<_> = measured.iter().filter_map(|one| Some((one, one.scene.cell?))).collect();
    let rows = shown.len().div_ceil(2);
    let [width, height] = [2.0 * PANEL[0], rows as f64 * PANEL[1]];
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
    );
    for (i, (one, cell)) in shown.into_iter().enumerate() {
        panel(&mut text, [(i % 2) as f64 * PANEL[0], (i / 2) as f64 * PANEL[1]], one, cell);
    }
    text += "</svg>\n";
    text
}

fn panel(text: &mut String, [left, top]: [f64; 2], one: &Measured, cell: &str) {
    let [from_left, from_top, from_right, from_bottom] = MARGIN;
    let (x0, x1) = (left + from_left, left + PANEL[0] - from_right);
    let (y0, y1) = (top + PANEL[1] - from_bottom, top + from_top);
    let x = |value: f64| x0 + share(value, X) * (x1 - x0);
    let y = |value: f64| y0 + share(value, Y) * (y1 - y0);
    let middle = f64::midpoint(x0, x1);
    let mut put = |line: std::fmt::Arguments<'_>| {
        let _ = writeln!(text, "{line}"); // a String takes all
    };
    let (name, about) = (one.scene.name, one.scene.about);
    put(format_args!(
        "<text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{cell}, {name}: {about}</text>",
        y1 - 12.0
    ));
    for tick in X_TICKS {
        let at = x(tick);
        put(format_args!("<path d=\"M{at:.1} {y0:.1}V{y1:.1}\" stroke=\"#e1e1e1\"/>"));
        put(format_args!("<text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{tick}</text>", y0 + 16.0));
    }
    for tick in Y_TICKS {
        let (at, least) = (y(tick), if tick > Y[0] { "" } else { "≤ " });
        put(format_args!("<path d=\"M{x0:.1} {at:.1}H{x1:.1}\" stroke=\"#e1e1e1\"/>"));
        put(format_args!(
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{least}{tick}</text>",
            x0 - 5.0,
            at + 4.0
        ));
    }
    put(format_args!(
        "<text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">instructions for each pixel, M3</text>",
        y0 + 34.0
    ));
    let (across, down) = (left + 14.0, f64::midpoint(y0, y1));
    put(format_args!(
        "<text x=\"{across:.1}\" y=\"{down:.1}\" text-anchor=\"middle\" transform=\"rotate(-90 {across:.1} {down:.1})\">largest \
         error, texels</text>"
    ));
    // Methods that draw equal pictures at equal cost share a label.
    let mut labels: Vec<(Method, [f64; 2], String)> = Vec::new();
    for (i, ((method, _), errors)) in METHODS.into_iter().zip(&one.errors).enumerate() {
        let Some(cost) = one.per_pixel(i) else { continue };
        let at = [x(cost), y(errors.largest())];
        put(format_args!(
            "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"5\" fill=\"{}\"/>",
            at[0],
            at[1],
            color(method)
        ));
        let near = |(other, [left, up], _): &&mut (Method, [f64; 2], String)| {
            color(*other) == color(method) && (left - at[0]).hypot(up - at[1]) < 4.0
        };
        match labels.iter_mut().find(near) {
            Some((_, _, text)) => *text += &format!(", {}", label(method)),
            None => labels.push((method, at, label(method).into())),
        }
    }
    for (method, [at, error], name) in labels {
        let (anchor, right, down) = match method {
            Method::Ours(_) if name.contains(',') => ("middle", 0.0, -10.0),
            Method::Ours(_) => ("end", -8.0, 5.0),
            Method::EveryPixel if at + 75.0 > x1 => ("end", -9.0, -7.0),
            Method::EveryPixel => ("start", 9.0, 4.0),
            Method::EverySixteen if at > middle => ("middle", 0.0, 20.0),
            Method::EverySixteen => ("start", 9.0, 4.0),
        };
        put(format_args!(
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\" fill=\"{}\">{name}</text>",
            at + right,
            error + down,
            color(method)
        ));
    }
}
