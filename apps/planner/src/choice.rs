//! What the user chose, and its form as text.

use crate::chip;
use crate::display::{Format, DISPLAYS};
use crate::lens;
use crate::projections::Named;
use crate::ready;
use crate::texture::Pattern;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use pinhole::Angle;
use pinhole_import::{number, Axis, Edges, ImportedMesh, Options};

/// How the model is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// All edges.
    Wireframe,
    /// The edges at which the surface turns, without those that faces hide.
    HiddenLine,
    /// One colour a face.
    Flat,
    /// Light interpolated over each face.
    Gouraud,
    /// A texture on the faces.
    Textured,
}

impl Style {
    /// The styles by their names.
    pub const ALL: [(&'static str, Self); 5] = [
        ("wireframe", Self::Wireframe),
        ("hidden-line", Self::HiddenLine),
        ("flat", Self::Flat),
        ("gouraud", Self::Gouraud),
        ("textured", Self::Textured),
    ];

    /// Whether this style draws edges instead of faces.
    pub const fn is_of_lines(self) -> bool {
        matches!(self, Self::Wireframe | Self::HiddenLine)
    }
}

/// What decides which of several faces a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    /// A depth for each pixel.
    Depth,
    /// Faces are drawn from the farthest to the nearest.
    Painter,
    /// Faces are drawn in the order of the mesh.
    Mesh,
}

impl Order {
    /// The orders by their names.
    pub(crate) const ALL: [(&'static str, Self); 3] =
        [("depth", Self::Depth), ("painter", Self::Painter), ("mesh", Self::Mesh)];
}

/// Everything that the user chose.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The name of a ready mesh, or `file` for the file that was loaded.
    pub mesh: String,
    /// The display's pixels.
    pub size: Size,
    /// The format of the display's pixels.
    pub format: Format,
    /// How the model is drawn.
    pub style: Style,
    /// Whether faces are dithered.
    pub dither: bool,
    /// Whether the edges of faces are smoothed, if the style has faces and the format mixes colours.
    pub(crate) smooth_edges: bool,
    /// What decides which face a pixel shows, if the style is one colour a face.
    pub(crate) order: Order,
    /// Whether the picture is drawn in one piece, if the style is one colour a face, or all edges.
    pub(crate) whole: bool,
    /// The projection.
    pub(crate) projection: Named,
    /// Angles of the eye in hundredths of a degree.
    pub(crate) yaw: i32,
    pub(crate) pitch: i32,
    /// The magnification in percent.
    pub(crate) zoom: i32,
    /// How far the picture is moved, in thousandths of the narrower half side, to the right and up.
    pub(crate) pan: [i32; 2],
    /// The step of a turn about the upright axis, of `TURNS`.
    pub(crate) turn: i32,
    pub(crate) color: Rgb888,
    pub(crate) background: Rgb888,
    /// The direction to the lamp.
    pub(crate) light: [i16; 3],
    /// Ambient light, 0 … 256: the light on faces that are turned away from the lamp.
    pub(crate) ambient: u16,
    /// What textured faces show.
    pub(crate) texture: Pattern,
    /// Lines are drawn where the surface turns by more than so many degrees; at 0 all edges of a wireframe are, and all hidden
    /// lines but the diagonals of flat faces.
    pub(crate) edges: u32,
    pub(crate) up: Option<Axis>,
    pub(crate) flip: bool,
    pub(crate) fix_winding: bool,
    pub(crate) two_sided: bool,
    /// The number of faces to decimate the mesh to, or 0 for all faces.
    pub(crate) decimate: u32,
    /// Rows of a band, if the display has as many.
    pub(crate) rows: u32,
    /// The microcontroller whose costs are shown.
    pub(crate) chip: &'static str,
    /// The index of an own chip's core in [`chip::CORES`], and its clock in MHz, RAM and flash in KB.
    pub(crate) core: usize,
    pub(crate) own: [u32; 3],
    /// Bits of a pixel on the bus, or 0 for those of the format.
    pub(crate) wire: u32,
    /// The most MHz of its SPI that the display takes, or 0 for the fastest of the microcontroller.
    pub(crate) spi: u32,
}

/// Steps of a turn.
pub(crate) const TURNS: u32 = 120;
/// The most faces that decimation can be asked for, far more than a display has pixels.
const MOST_FACES: u32 = 1_000_000;
/// MHz that no display's SPI exceeds.
const FASTEST: u32 = 200;
/// MHz that no microcontroller's core exceeds.
const FASTEST_CORE: u32 = 1000;
/// KB of a microcontroller's RAM or flash, at most.
const MOST_MEMORY: u32 = 65_536;
/// The longest side of a display, in pixels.
const LONGEST: u32 = 1024;

impl Default for Choice {
    fn default() -> Self {
        let [projection, ..] = Named::ALL;
        let (size, format) = DISPLAYS[0].parts();
        Self {
            mesh: ready::READY[0].0.into(),
            size,
            format,
            style: Style::Flat,
            dither: false,
            smooth_edges: false,
            order: Order::Depth,
            whole: false,
            projection,
            yaw: hundredths(projection.yaw),
            pitch: hundredths(projection.pitch),
            zoom: 100,
            pan: [0; 2],
            turn: 0,
            color: Rgb888::new(255, 215, 0), // gold, as in the templates
            background: Rgb888::BLACK,
            light: [2, 3, 4],
            ambient: 48,
            texture: Pattern::Checker,
            edges: 0,
            up: None,
            flip: false,
            fix_winding: false,
            two_sided: false,
            decimate: 0,
            rows: 8,
            chip: chip::CHIPS[0].key,
            core: 2,
            own: [100, 128, 512],
            wire: 0,
            spi: 0,
        }
    }
}

impl Choice {
    /// The choice that a text such as `mesh=torus&style=gouraud&width=240` describes. Parts that the text does not name have
    /// their defaults. The error names the part that is not understood, and the values that it can have.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut choice = Self::default();
        let pairs = || text.split('&').filter(|pair| !pair.is_empty()).map(|pair| pair.split_once('='));
        // The projection comes first, because it sets directions, which later parts may change.
        for (_, value) in pairs().flatten().filter(|(key, _)| *key == "projection") {
            let projection = lens::named(value)?;
            choice.projection = projection;
            (choice.yaw, choice.pitch) = (hundredths(projection.yaw), hundredths(projection.pitch));
        }
        for pair in pairs() {
            let (key, value) = pair.ok_or("a part without `=`: write name=value")?;
            choice.set(key, value).map_err(|problem| format!("{key}={value}: {problem}"))?;
        }
        Ok(choice)
    }

    fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
        match key {
            "projection" => {}
            "mesh" => self.mesh = ready::named(value)?.into(),
            "width" => self.size.width = within(value, 1, LONGEST)?,
            "height" => self.size.height = within(value, 1, LONGEST)?,
            "format" => self.format = of(&Format::ALL, value)?,
            "style" => self.style = of(&Style::ALL, value)?,
            "dither" => self.dither = switch(value)?,
            "smooth-edges" => self.smooth_edges = switch(value)?,
            "order" => self.order = of(&Order::ALL, value)?,
            "whole" => self.whole = switch(value)?,
            "yaw" => self.yaw = hundredths(degrees(value, 360.0)?),
            "pitch" => self.pitch = hundredths(degrees(value, 90.0)?),
            "zoom" => self.zoom = within(value, 20, 2000)?,
            "x" => self.pan[0] = within(value, -4000, 4000)?,
            "y" => self.pan[1] = within(value, -4000, 4000)?,
            "turn" => self.turn = within(value, 0, TURNS as i32 - 1)?,
            "color" => self.color = color(value)?,
            "background" => self.background = color(value)?,
            "light" => self.light = light(value)?,
            "ambient" => self.ambient = within(value, 0, 256)?,
            "texture" => self.texture = of(&Pattern::ALL, value)?,
            "edges" => self.edges = within(value, 0, 180)?,
            "decimate" => self.decimate = within(value, 0, MOST_FACES)?,
            "up" => self.up = if value == "auto" { None } else { Some(of(&Axis::ALL, value)?) },
            "flip" => self.flip = switch(value)?,
            "fix-winding" => self.fix_winding = switch(value)?,
            "two-sided" => self.two_sided = switch(value)?,
            "rows" => self.rows = within(value, 1, LONGEST)?,
            "chip" => self.chip = chip::named(value)?,
            "core" => self.core = place(&chip::CORES.map(|(name, _)| name), value)?,
            "mhz" => self.own[0] = within(value, 1, FASTEST_CORE)?,
            "ram" => self.own[1] = within(value, 1, MOST_MEMORY)?,
            "flash" => self.own[2] = within(value, 1, MOST_MEMORY)?,
            "wire" => self.wire = within(value, 0, 32)?,
            "spi" => self.spi = within(value, 0, FASTEST)?,
            _ => return Err("no such part".into()),
        }
        Ok(())
    }

    /// The importer's options: those of the templates' build scripts, with edges or normals if the style needs them.
    pub(crate) fn options(&self) -> Options {
        Options {
            fit: Some(2.0),
            up: self.up.or(ready::up(&self.mesh)),
            flip: self.flip,
            fix_winding: self.fix_winding,
            two_sided: self.two_sided,
            decimate: (self.decimate > 0).then_some(self.decimate as usize),
            edges: match self.style {
                Style::Wireframe if self.edges == 0 => Edges::All,
                Style::Wireframe | Style::HiddenLine => {
                    Edges::Feature { degrees: f64::from(self.edges.max(1)) }
                }
                _ if self.smooths() => Edges::CreasesFirst { degrees: 0.0 },
                Style::Flat | Style::Gouraud | Style::Textured => Edges::None,
            },
            edge_faces: self.style == Style::HiddenLine || self.smooths(),
            vertex_normals: self.style == Style::Gouraud,
            ..Options::default()
        }
    }

    /// Rows of a band. With the two that wait, smooth edges need six.
    pub(crate) fn rows(&self) -> u32 {
        self.rows.max(if self.smooths() { 4 } else { 1 }).min(self.size.height)
    }

    /// Whether faces are dithered.
    pub(crate) const fn dithers(&self) -> bool {
        self.dither || self.format.always_dithers()
    }

    /// Whether edges of faces are smoothed.
    pub(crate) const fn smooths(&self) -> bool {
        self.smooth_edges && self.format.mixes() && !self.style.is_of_lines()
    }

    /// Whether pixels of less than a byte are packed when their edges are smoothed.
    pub(crate) fn packs(&self) -> bool {
        self.smooths() && self.format != Format::Rgb565
    }

    /// Whether drawing into the picture in one piece or without depth is compared: for faces of one colour, and in one piece for lines, in
    /// 16-bit colour.
    pub(crate) fn has_more_ways(&self) -> bool {
        self.format == Format::Rgb565
            && match self.style {
                Style::Flat => !self.dithers() && !self.smooths(),
                style => style == Style::Wireframe,
            }
    }

    /// What decides which face a pixel shows.
    pub(crate) fn order(&self) -> Order {
        if self.has_more_ways() {
            self.order
        } else {
            Order::Depth
        }
    }

    /// Rows of a band; `None` if the picture is drawn in one piece.
    pub(crate) fn bands(&self) -> Option<u32> {
        (!self.whole || !self.has_more_ways()).then_some(self.rows())
    }

    /// How many of a model's edges are creases: none of a surface that is lit smoothly.
    pub(crate) fn creases(&self, model: &ImportedMesh) -> usize {
        model.creases.filter(|_| self.style != Style::Gouraud).unwrap_or(0)
    }

    /// The angle of the turn.
    pub(crate) fn turn(&self) -> Angle {
        Angle::turns(self.turn, TURNS)
    }
}

/// Degrees in hundredths: at most 36 000.
fn hundredths(degrees: f64) -> i32 {
    (degrees * 100.0).round() as i32
}

fn degrees(value: &str, largest: f64) -> Result<f64, String> {
    let problem = || format!("not a number of degrees from -{largest} to {largest}");
    let degrees = number(value).ok_or_else(problem)?;
    if degrees.abs() <= largest {
        Ok(degrees)
    } else {
        Err(problem())
    }
}

fn within<T: PartialOrd + Copy + std::str::FromStr + std::fmt::Display>(
    value: &str,
    least: T,
    most: T,
) -> Result<T, String> {
    let number = value.parse().ok().filter(|number| (least..=most).contains(number));
    number.ok_or_else(|| format!("not a whole number from {least} to {most}"))
}

fn switch(value: &str) -> Result<bool, String> {
    match value {
        "0" => Ok(false),
        "1" => Ok(true),
        _ => Err("not 0 or 1".into()),
    }
}

/// The place of a name. The error has all names.
pub(crate) fn place(names: &[&str], name: &str) -> Result<usize, String> {
    names.iter().position(|other| *other == name).ok_or_else(|| format!("none of {}", names.join(", ")))
}

/// What a name stands for.
fn of<T: Copy>(all: &[(&str, T)], name: &str) -> Result<T, String> {
    let names: Vec<_> = all.iter().map(|(name, _)| *name).collect();
    Ok(all[place(&names, name)?].1)
}

fn color(value: &str) -> Result<Rgb888, String> {
    let is_hexadecimal = value.len() == 6 && value.chars().all(|c| c.is_ascii_hexdigit());
    let number = u32::from_str_radix(value, 16).ok().filter(|_| is_hexadecimal);
    let [_, r, g, b] = number.ok_or("not a colour: six hexadecimal digits")?.to_be_bytes();
    Ok(Rgb888::new(r, g, b))
}

fn light(value: &str) -> Result<[i16; 3], String> {
    let parts: Vec<i16> = value.split(',').filter_map(|part| within(part, -99, 99).ok()).collect();
    match parts[..] {
        [x, y, z] if [x, y, z] != [0; 3] => Ok([x, y, z]),
        _ => Err("not a direction: three whole numbers from -99 to 99, not all 0, such as 2,3,4".into()),
    }
}
