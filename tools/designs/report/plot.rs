//! The plot: a panel for each core.

use crate::about::Family;
use crate::speed::CORES;
use crate::{Measured, Result};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

const SIZE: (u32, u32) = (1120, 1060);
const FONT: &str = "sans-serif";
/// The ranges of the axes: instructions a vertex, and pixels.
const X: Range<f64> = 20.0..6000.0;
const Y: Range<f64> = 3e-7..1e3;
const TICKS: [f64; 8] = [20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0];
/// The error of the snap to 1/256 px alone.
const SNAP: f64 = 1.0 / 512.0;
/// Dots of one family nearer than this share a label: as factors of instructions and error.
const NEAR: (f64, f64) = (1.5, 2.0);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<
    'a,
    SVGBackend<'b>,
    Cartesian2d<plotters::coord::combinators::LogCoord<f64>, plotters::coord::combinators::LogCoord<f64>>,
>;

fn colour(family: Family) -> RGBColor {
    match family {
        Family::Default => RGBColor(200, 20, 30),
        Family::Float => RGBColor(30, 90, 200),
        Family::Sixteen => RGBColor(110, 110, 110),
        Family::Short => RGBColor(20, 130, 60),
        Family::Thirty => RGBColor(215, 110, 0),
        Family::World => RGBColor(140, 50, 170),
        Family::Scaled => RGBColor(0, 140, 150),
    }
}

/// Instructions a vertex to the right, the largest error before the snap upwards.
pub(crate) fn svg(measured: &[Measured]) -> Result<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        for (core, panel) in root.split_evenly((2, 2)).iter().enumerate() {
            draw(panel, core, measured)?;
        }
        root.present()?;
    }
    text.push('\n');
    Ok(text)
}

fn draw(panel: &Area<'_>, core: usize, measured: &[Measured]) -> Result<()> {
    let mut chart: Chart<'_, '_> = ChartBuilder::on(panel)
        .caption(CORES[core].0, (FONT, 18))
        .margin(10)
        .x_label_area_size(46)
        .y_label_area_size(64)
        .build_cartesian_2d(X.log_scale(), Y.log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(RGBColor(246, 246, 246))
        .bold_line_style(RGBColor(225, 225, 225))
        .disable_x_mesh()
        .x_labels(1)
        .x_label_formatter(&|_| String::new())
        .x_desc("instructions a vertex")
        .y_desc("largest error, px")
        .y_label_formatter(&|v| format!("{v:.0e}"))
        .label_style((FONT, 13))
        .draw()?;
    for tick in TICKS {
        let line = PathElement::new([(tick, Y.start), (tick, Y.end)], RGBColor(225, 225, 225));
        chart.draw_series([line])?;
        let style = (FONT, 13).into_font().color(&BLACK).pos(Pos::new(HPos::Center, VPos::Top));
        chart
            .draw_series([EmptyElement::at((tick, Y.start)) + Text::new(format!("{tick}"), (0, 6), style)])?;
    }
    let grey = BLACK.mix(0.5);
    chart.draw_series([PathElement::new([(X.start, SNAP), (X.end, SNAP)], grey.stroke_width(1))])?;
    let style = (FONT, 12).into_font().color(&grey).pos(Pos::new(HPos::Right, VPos::Bottom));
    chart.draw_series([Text::new("the snap to 1/256 px", (X.end * 0.97, SNAP * 1.15), style)])?;
    // A design that differs from another one only in its snap has no dot of its own.
    let shown: Vec<_> = measured.iter().enumerate().filter(|(_, one)| one.about.id != "i16-4bits").collect();
    let front = front(shown.iter().map(|(_, one)| *one), core);
    chart.draw_series([PathElement::new(front, colour(Family::Thirty).mix(0.4).stroke_width(2))])?;
    let mut labels: Vec<(Family, (f64, f64), String)> = Vec::new();
    for (number, one) in shown {
        let (family, at) = (one.about.family, point(one, core));
        let ink = colour(family);
        let (size, style) = match family {
            Family::Default => (6, ink.filled()),
            Family::Scaled => (4, ink.stroke_width(2)),
            _ => (4, ink.filled()),
        };
        chart.draw_series([Circle::new(at, size, style)])?;
        let apart = |a: f64, b: f64, factor: f64| (a / b).ln().abs() > factor.ln();
        let beside = labels.iter_mut().find(|(other, (x, y), _)| {
            *other == family && !apart(*x, at.0, NEAR.0) && !apart(*y, at.1, NEAR.1)
        });
        match beside {
            // Beside all dots of its family: to the left of them, or to the right.
            Some((_, (x, _), text)) => {
                *x = match family {
                    Family::Thirty | Family::Scaled => x.min(at.0),
                    _ => x.max(at.0),
                };
                text.push_str(&format!(", {}", number + 1));
            }
            None => labels.push((family, at, (number + 1).to_string())),
        }
    }
    for (family, at, text) in labels {
        let (side, height, away) = match family {
            Family::Thirty | Family::Scaled => (HPos::Right, VPos::Center, (-9, 0)),
            Family::Short => (HPos::Left, VPos::Center, (8, 8)),
            _ => (HPos::Left, VPos::Center, (9, 0)),
        };
        let style = (FONT, 13).into_font().color(&colour(family)).pos(Pos::new(side, height));
        chart.draw_series([EmptyElement::at(at) + Text::new(text, away, style)])?;
    }
    Ok(())
}

fn point(one: &Measured, core: usize) -> (f64, f64) {
    (one.speed[core], one.errors.worst().before.largest)
}

/// Down and to the right along the integer designs for all objects that none beats in both.
fn front<'m>(measured: impl Iterator<Item = &'m Measured>, core: usize) -> Vec<(f64, f64)> {
    let takes_part = |one: &&Measured| one.about.competes() || one.about.family == Family::Default;
    let mut points: Vec<_> = measured.filter(takes_part).map(|one| point(one, core)).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut front: Vec<(f64, f64)> = Vec::new();
    for (x, y) in points {
        let above = front.last().map_or(Y.end, |&(_, above)| above);
        if y < above {
            front.extend([(x, above), (x, y)]);
        }
    }
    let last = front.last().map(|&(_, least)| (X.end, least));
    front.extend(last);
    front
}
