//! The plot: a panel for each core.

use crate::about::Family;
use crate::speed::CORES;
use crate::{Measured, Result};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

const SIZE: (u32, u32) = (1120, 1000);
const FONT: &str = "sans-serif";
/// What the snap to 1/256 px alone costs.
const SNAP: f64 = 1.0 / 512.0;

fn colour(family: Family) -> RGBColor {
    match family {
        Family::Default => RGBColor(200, 20, 30),
        Family::Float => RGBColor(30, 90, 200),
        Family::Sixteen => RGBColor(120, 120, 120),
        Family::Short => RGBColor(20, 140, 60),
        Family::Thirty => RGBColor(225, 120, 0),
        Family::World => RGBColor(140, 50, 170),
        Family::Scaled => RGBColor(0, 150, 160),
    }
}

/// Instructions a vertex to the right, the largest error before the snap upwards.
pub(crate) fn svg(measured: &[Measured]) -> Result<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE).map_err(described)?;
        for (core, panel) in root.split_evenly((2, 2)).iter().enumerate() {
            draw(panel, core, measured).map_err(described)?;
        }
        root.present().map_err(described)?;
    }
    text.push('\n');
    Ok(text)
}

fn described(error: impl std::fmt::Display) -> String {
    error.to_string()
}

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type Drawn<'a> = std::result::Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

fn draw<'a>(panel: &Area<'a>, core: usize, measured: &[Measured]) -> Drawn<'a> {
    let (from, to) = (50.0, 5000.0);
    let mut chart = ChartBuilder::on(panel)
        .caption(format!("{}: largest error in px against instructions a vertex", CORES[core].0), (FONT, 17))
        .margin(10)
        .x_label_area_size(32)
        .y_label_area_size(52)
        .build_cartesian_2d((20.0..to).log_scale(), (3e-6..3e2).log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(RGBColor(244, 244, 244))
        .bold_line_style(RGBColor(225, 225, 225))
        .x_label_formatter(&|v| format!("{v:.0}"))
        .y_label_formatter(&|v| format!("{v:.0e}"))
        .label_style((FONT, 13))
        .draw()?;
    chart.draw_series([PathElement::new([(20.0, SNAP), (to, SNAP)], BLACK.mix(0.45).stroke_width(1))])?;
    let small = |text: &str| (text.to_string(), (FONT, 12));
    let (note, font) = small("the snap to 1/256 px");
    chart.draw_series([Text::new(note, (to * 0.3, SNAP * 1.7), font.into_font().color(&BLACK.mix(0.6)))])?;
    // Down and to the right along the integer designs that none beats in both.
    let point = |one: &Measured| (one.speed[core], one.errors.worst().before.largest);
    let mut best: Vec<(f64, f64)> =
        measured.iter().filter(|one| one.about.competes() || one.about.id == "default").map(point).collect();
    best.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut front: Vec<(f64, f64)> = Vec::new();
    for (x, y) in best {
        match front.last() {
            Some(&(_, least)) if y >= least => {}
            last => {
                let step = last.map(|&(_, above)| (x, above));
                front.extend(step);
                front.push((x, y));
            }
        }
    }
    if let (Some(&(first, _)), Some(&(_, last))) = (front.first(), front.last()) {
        front.insert(0, (first, 300.0));
        front.push((to, last));
    }
    chart.draw_series([PathElement::new(front, RGBColor(225, 120, 0).mix(0.35).stroke_width(2))])?;
    let mut labels: Vec<(f64, f64)> = Vec::new();
    for (number, one) in measured.iter().enumerate() {
        // Its snap alone is another.
        if one.about.id == "i16-4bits" {
            continue;
        }
        let (x, y) = point(one);
        let ink = colour(one.about.family);
        let size = if one.about.family == Family::Default { 6 } else { 4 };
        let dot = match one.about.family {
            Family::Scaled => ink.stroke_width(2),
            _ => ink.filled(),
        };
        chart.draw_series([Circle::new((x, y), size, dot)])?;
        // Beside the dot; one line lower for each that is there already.
        let near = |at: &&(f64, f64)| (at.0 / x).ln().abs() < 0.13 && (at.1 / y).ln().abs() < 0.9;
        let lower = labels.iter().filter(near).count() as f64;
        labels.push((x, y));
        let style = (FONT, 13).into_font().color(&ink).pos(Pos::new(HPos::Left, VPos::Center));
        let at = (x * 1.045, y * (-0.75 * lower).exp());
        chart.draw_series([Text::new(format!("{}", number + 1), at, style)])?;
    }
    let _ = from;
    Ok(())
}
