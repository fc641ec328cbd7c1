//! Draws a scene for people: lit, in any pixel format of a display, and in bands as firmware draws.

use crate::brush::Brush;
use crate::fog::FogStyle;
use crate::json::Names;
use crate::light::{self, Light};
use crate::parts::{parts, Part};
use crate::picture::{by_format, luma, Format};
use crate::quantised::Quantised;
use crate::scene::Scene;
use crate::sprite_paint::Sprites;
use embedded_graphics::pixelcolor::{BinaryColor, Gray2, Gray4, Gray8, Rgb565, Rgb666, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{
    color::{Alpha, Half},
    draw::{BinnedEdges, ShaderFor, SmoothEdges, TransformedMesh},
    fog::FogTable,
    prelude::*,
    shading::{AntiAliased, Dithered, SpanShader, Translucent},
    target::Pixels,
    texture::TexelSlice,
};
use std::convert::Infallible;

/// The colour type of a pixel format.
pub(crate) trait Colour: Color + From<Rgb888> + Into<Rgb888> + 'static {
    /// Smooths the edges of faces that are drawn. Without effect in two colours, which have no mean.
    fn smooth(
        pixels: &mut Pixels<'_, Self>,
        depth: &mut DepthBuffer<'_>,
        edges: &mut [SmoothEdges<'_, Scalar>],
    );
}

macro_rules! smoothed_colours {
    ($($type:ty)*) => {$(
        impl Colour for $type {
            fn smooth(
                pixels: &mut Pixels<'_, Self>,
                depth: &mut DepthBuffer<'_>,
                edges: &mut [SmoothEdges<'_, Scalar>],
            ) {
                pixels.depth_tested(depth).smooth(|pass| edges.iter_mut().for_each(|edges| edges.draw(pass)));
            }
        }
    )*};
}
smoothed_colours!(Rgb888 Rgb666 Rgb565 Gray8 Gray4 Gray2);

impl Colour for BinaryColor {
    fn smooth(_: &mut Pixels<'_, Self>, _: &mut DepthBuffer<'_>, _: &mut [SmoothEdges<'_, Scalar>]) {}
}

/// Chooses the areas to send, given the area that will be drawn.
pub type Plan<'a> = &'a mut dyn FnMut(Rectangle) -> Vec<Rectangle>;

/// Takes the area of a band that is drawn, and the colours in it, row by row.
pub type Send<'a> = &'a mut dyn FnMut(Rectangle, &mut dyn Iterator<Item = Rgb888>);

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    /// Smooth shading, except over sharp edges.
    Solid,
    /// One colour per face.
    Flat,
    /// Smooth shading over all edges.
    Gouraud,
    Wireframe,
    HiddenLine,
}

impl Mode {
    pub const ALL: [(&'static str, Self); 5] = [
        ("solid", Self::Solid),
        ("flat", Self::Flat),
        ("gouraud", Self::Gouraud),
        ("wireframe", Self::Wireframe),
        ("hidden-line", Self::HiddenLine),
    ];

    /// Whether the mode draws edges instead of faces.
    pub const fn of_lines(self) -> bool {
        matches!(self, Self::Wireframe | Self::HiddenLine)
    }

    /// The degrees by which the surface turns at an edge that is drawn, at least; `None` draws all edges. Where hidden lines are
    /// left out, the diagonals of flat faces are, too: they are edges of the triangles, not of the model.
    pub const fn least_turn(self) -> Option<f64> {
        match self {
            Self::HiddenLine => Some(1.0),
            _ => None,
        }
    }

    /// The crease angle in degrees, up to which shading is smooth.
    fn crease(self) -> f64 {
        match self {
            Self::Solid => 50.0,
            Self::Gouraud => 180.0,
            Self::Flat | Self::Wireframe | Self::HiddenLine => 0.0,
        }
    }
}

impl Names for Mode {
    fn names() -> impl Iterator<Item = (&'static str, Self)> {
        Self::ALL.into_iter()
    }
}

/// How much of what is behind a face is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Translucency {
    #[default]
    Opaque,
    /// The pixels that are drawn of each 64.
    Door(u8),
    /// The mean of the face and what is behind it.
    Half,
    /// The face's part, in 32nds.
    Alpha(u8),
}

impl Translucency {
    /// Whether faces are mixed with what is behind them, so that farther ones must be drawn first.
    pub const fn blends(self) -> bool {
        matches!(self, Self::Half | Self::Alpha(_))
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    pub mode: Mode,
    /// Colour of faces in full light, or of edges.
    pub colour: Rgb888,
    /// Whether faces have the colours of the scene instead, if it has any.
    pub own_colours: bool,
    pub background: Rgb888,
    pub dither: bool,
    /// Whether a texture is lit as a face without one is.
    pub lit_texture: bool,
    pub translucency: Translucency,
    /// Whether lines are anti-aliased.
    pub smooth_lines: bool,
    /// Whether the edges of opaque faces are anti-aliased.
    pub smooth_faces: bool,
    /// Fog on faces, instead of the scene's.
    pub fog: Option<FogStyle>,
}

const PAPER: Rgb888 = Rgb888::new(236, 235, 230);
const CLAY: Rgb888 = Rgb888::new(240, 160, 98);
const INK: Rgb888 = Rgb888::new(34, 48, 72);
const CHALK: Rgb888 = Rgb888::new(214, 240, 250);

impl Style {
    /// The chosen style of opaque faces, unlit textures and plain lines, with defaults that are visible in the format. A chosen
    /// colour replaces the model's own.
    pub fn chosen(
        mode: Mode,
        format: Format,
        colour: Option<Rgb888>,
        background: Option<Rgb888>,
        dither: bool,
    ) -> Self {
        let background = background.unwrap_or(if format.is_grey() { Rgb888::BLACK } else { PAPER });
        let usual = match (mode.of_lines(), luma(background) > 127) {
            (true, true) => INK,
            (true, false) => CHALK,
            (false, _) if format.is_grey() => Rgb888::WHITE,
            (false, _) => CLAY,
        };
        let own_colours = colour.is_none();
        Self {
            mode,
            colour: colour.unwrap_or(usual),
            own_colours,
            background,
            dither,
            lit_texture: false,
            translucency: Translucency::Opaque,
            smooth_lines: false,
            smooth_faces: false,
            fog: None,
        }
    }
}

/// Data of a mesh that do not depend on the camera.
pub struct Subject {
    pub parts: Vec<Part>,
    /// Normals at the corners of the triangles.
    normals: Vec<[[i16; 3]; 3]>,
}

impl Subject {
    /// The data that a style needs, with the edges that are usual in its mode.
    pub fn new(scene: &Scene, style: &Style) -> Self {
        Self::with_edges(scene, style, style.mode.least_turn())
    }

    /// As [`Subject::new`], in modes of lines with the edges at which the surface turns by more than some degrees, or ends, or with all.
    pub fn with_edges(scene: &Scene, style: &Style, degrees: Option<f64>) -> Self {
        let mut parts = parts(&scene.vertices, &scene.triangles);
        let (mut normals, crease) = (Vec::new(), style.mode.crease());
        let find = |part: &mut Part, degrees| part.find_edges(&scene.vertices, degrees);
        if style.mode.of_lines() {
            parts.iter_mut().for_each(|part| find(part, degrees));
        } else {
            normals = light::normals(&scene.vertices, &scene.triangles, crease);
            if style.smooth_faces {
                parts.iter_mut().for_each(|part| find(part, Some(crease)));
            }
        }
        Self { parts, normals }
    }
}

/// Statistics of a frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct Report {
    /// Statistics of faces, or of edges where the mode draws edges.
    pub statistics: Statistics,
    /// Statistics of the scene's sprites.
    pub sprites: Statistics,
    pub bands: usize,
    /// Bytes of the pixels in the display's format.
    pub bytes: usize,
    pub pixels: usize,
}

/// Draws a frame in bands, through a strip with room for `rows` rows of the picture. `plan` gets the area that will be drawn and
/// chooses the areas to send; `send` gets every band.
pub fn paint(
    subject: &Subject,
    scene: (&Scene, &Quantised),
    style: &Style,
    format: Format,
    rows: u32,
    plan: Plan<'_>,
    send: Send<'_>,
) -> Result<Report, String> {
    by_format!(format, C => paint_in::<C>(subject, scene, style, rows, plan, send))
}

/// [`paint`] in colours of this type.
fn paint_in<C: Colour>(
    subject: &Subject,
    (scene, quantised): (&Scene, &Quantised),
    style: &Style,
    rows: u32,
    plan: Plan<'_>,
    send: Send<'_>,
) -> Result<Report, String> {
    let camera = quantised.camera();
    let cull = if scene.cull { Cull::Back } else { Cull::None };
    // Faces that are mixed with what is behind them are drawn from far to near.
    let sorted = (style.translucency.blends() && !style.mode.of_lines()).then(|| Sorted::new(scene));
    let all_parts = sorted.as_ref().map_or(&subject.parts, |sorted| &sorted.parts);
    let number = |part: &Part, face: usize| {
        let at = part.first + face;
        sorted.as_ref().map_or(at, |sorted| sorted.order.get(at).copied().unwrap_or(at))
    };
    let vertices: Vec<_> = all_parts.iter().map(|part| part.vertices(&quantised.vertices)).collect();
    // A wireframe shows the mesh itself; hidden lines show a body, with its outline.
    let facings = (style.mode == Mode::HiddenLine).then(|| scene.facings());
    let is_smooth =
        style.smooth_faces && style.translucency == Translucency::Opaque && !style.mode.of_lines();
    let edges_of = |part: &Part| match is_smooth {
        true => part.all_edges(),
        false => part.drawn_edges(facings.as_deref()),
    };
    let edges_drawn: Vec<_> = all_parts.iter().map(edges_of).collect();
    let meshes = all_parts
        .iter()
        .zip(&vertices)
        .zip(&edges_drawn)
        .map(|((part, vertices), (edges, beside))| {
            Mesh::from_fixed(vertices, &part.faces)?.with_edges(edges)?.with_edge_faces(beside)
        })
        .collect::<Result<Vec<_>, _>>()
        .map_err(|e| e.to_string())?;
    let instances: Vec<MeshInstance<'_, Scalar>> =
        meshes.iter().map(|mesh| camera.place(mesh, &quantised.model).with_cull(cull)).collect();
    let mut corners: Vec<_> = vertices.iter().map(|v| vec![ScreenVertex::EMPTY; v.len()]).collect();
    let mut face_bin_storage: Vec<_> = meshes.iter().map(|mesh| vec![0; mesh.face_bins_len()]).collect();
    let mut edge_bin_storage: Vec<_> = meshes.iter().map(|mesh| vec![0; mesh.edge_bins_len()]).collect();
    let size = Size::new(scene.width, scene.height);
    // Lines are not in fog.
    let fog = style.fog.or(scene.fog).filter(|_| !style.mode.of_lines() || !scene.sprites.is_empty());
    let fog = fog.map(|fog| fog.table(scene, quantised, C::from(style.background))).transpose()?;
    let fog = fog.as_ref();
    let sprites = Sprites::new(scene, quantised, fog)?;
    let sprites_reach = sprites.bounds;
    let with_sprites = |drawn: Rectangle| around([drawn, sprites_reach].into_iter());
    let out = Out { size, style, rows, send, sprites };
    // Anti-aliased lines reach one pixel beyond the edges, smooth faces one pixel beyond the faces.
    let with_border = |drawn: Rectangle| match drawn.is_zero_sized() {
        true => drawn,
        false => Rectangle::new(drawn.top_left - Point::new_equal(1), drawn.size + Size::new_equal(2))
            .intersection(&Rectangle::new(Point::zero(), size)),
    };
    let reached = |edges: Rectangle| if style.smooth_lines { with_border(edges) } else { edges };

    let colour = C::from(style.colour);
    if style.mode == Mode::Wireframe {
        // Lines without depth test: no far plane may clip them.
        let transformed: Vec<_> = instances.iter().zip(&mut corners).map(|(p, c)| p.transform(c)).collect();
        let (mut edges, statistics, bounds) = edges(&transformed, &mut edge_bin_storage)?;
        return out.bands(statistics, &plan(with_sprites(reached(bounds))), |band, _| {
            in_memory(band, |pixels| {
                for edges in &mut edges {
                    let Ok(()) = match style.smooth_lines {
                        false => edges.draw(colour, pixels),
                        true => edges.draw(AntiAliased(colour), pixels),
                    };
                }
            });
        });
    }

    let transformed: Vec<_> = instances.iter().zip(&mut corners).map(|(p, c)| p.transform_depth(c)).collect();
    let mut faces = transformed
        .iter()
        .zip(&mut face_bin_storage)
        .map(|(transformed, bin_storage)| transformed.bin_faces(bin_storage))
        .collect::<Result<Vec<_>, _>>()
        .map_err(|e| e.to_string())?;
    if style.mode == Mode::HiddenLine {
        let (mut edges, statistics, bounds) = edges(&transformed, &mut edge_bin_storage)?;
        return out.bands(statistics, &plan(with_sprites(reached(bounds))), |band, depth| {
            // Any part may hide any other.
            faces.iter_mut().for_each(|faces| faces.depth_only(depth));
            in_memory(band, |pixels| {
                let mut target = pixels.depth_tested(depth);
                for edges in &mut edges {
                    let Ok(()) = match style.smooth_lines {
                        false => edges.hidden_line(colour, &mut target),
                        true => edges.hidden_line(AntiAliased(colour), &mut target),
                    };
                }
            });
        });
    }

    let statistics =
        faces.iter().map(BinnedFaces::statistics).fold(Statistics::default(), core::ops::Add::add);
    let bounds = around(faces.iter().map(BinnedFaces::bounds));
    let areas = plan(with_sprites(if is_smooth { with_border(bounds) } else { bounds }));
    // A surface that is shaded smoothly has creases where it is not, or where its colour changes, or the texture ends.
    let own_colour = |face: Option<usize>| scene.colors.faces.get(face?).filter(|_| style.own_colours);
    let is_bare = |face: usize| scene.texture.as_ref().is_some_and(|it| it.bare.get(face) == Some(&true));
    let is_crease = |part: &Part, edge: usize| {
        let of_face = |face: Option<usize>| (own_colour(face), face.is_some_and(is_bare));
        let [one, other] = part.triangles_beside(edge).map(of_face);
        part.is_feature(edge) || one != other
    };
    let mut edge_bin_storage: Vec<_> = meshes.iter().map(|mesh| vec![0; mesh.smooth_bins_len()]).collect();
    let parts = all_parts.iter().zip(&transformed).zip(&mut edge_bin_storage).filter(|_| is_smooth);
    let mut edges = parts
        .map(|((part, transformed), storage)| {
            transformed.bin_smooth_edges(|edge| is_crease(part, edge), storage)
        })
        .collect::<Result<Vec<_>, _>>()
        .map_err(|e| e.to_string())?;
    let light = Light::new(scene, quantised);
    let levels = |part: &Part, face: usize| light.corners(number(part, face), &subject.normals);
    let colour = |part: &Part, face: usize| {
        let own = scene.colors.faces.get(number(part, face)).filter(|_| style.own_colours);
        own.map_or(style.colour, |&[r, g, b]| Rgb888::new(r, g, b))
    };
    let emission = |part: &Part, face: usize| {
        let own = scene.colors.emission.get(number(part, face)).filter(|_| style.own_colours);
        own.map_or(Rgb888::BLACK, |&[r, g, b]| Rgb888::new(r, g, b))
    };
    let flat = |part: &Part, face| {
        Flat::lit(colour(part, face), levels(part, face)[0]).emitting(emission(part, face))
    };
    let smooth = |part: &Part, face| Gouraud::lit(colour(part, face), levels(part, face));
    let glowing = |part: &Part, face| smooth(part, face).emitting(emission(part, face));
    let emits = style.own_colours && !scene.colors.emission.is_empty();
    let plain = |part: &Part, face: usize| match (style.mode == Mode::Flat, emits, style.dither) {
        (true, _, false) => Brush::Flat(flat(part, face)),
        (true, _, true) => Brush::FlatDithered(Dithered(flat(part, face))),
        (false, false, false) => Brush::Smooth(smooth(part, face)),
        (false, false, true) => Brush::SmoothDithered(Dithered(smooth(part, face))),
        (false, true, false) => Brush::Glowing(glowing(part, face)),
        (false, true, true) => Brush::GlowingDithered(Dithered(glowing(part, face))),
    };
    let all =
        Faces { out, statistics, areas: &areas, parts: all_parts, faces: &mut faces, edges: &mut edges };
    let picture = scene.texture.as_ref().zip(quantised.texture.as_ref());
    if let Some((colours, (texture, coords))) =
        picture.and_then(|picture| Some((picture.0.colours::<C>()?, picture))).filter(|_| style.own_colours)
    {
        let ([width, height], clamped) = (texture.size, texture.clamped);
        let texels = TexelSlice::new(&colours, width, height).map_err(|e| e.to_string())?;
        let texture = Texture::new(texels).with_exponent(coords.exponent).map_err(|e| e.to_string())?;
        let uv = |part: &Part, face: usize| coords.uv[number(part, face)];
        return all.draw(fog, &|part, face| match (clamped, style.lit_texture) {
            _ if is_bare(number(part, face)) => plain(part, face),
            (false, false) => Brush::Texture(texture.at(uv(part, face))),
            (true, false) => Brush::ClampedTexture(texture.clamped_at(uv(part, face))),
            (false, true) => Brush::LitTexture(texture.at(uv(part, face)).lit(levels(part, face))),
            (true, true) => {
                Brush::LitClampedTexture(texture.clamped_at(uv(part, face)).lit(levels(part, face)))
            }
        });
    }
    all.draw(fog, &plain)
}

/// The triangles of a scene from far to near, by the mean depth of their corners, as [`pinhole::draw::Painter`] sorts them.
struct Sorted {
    parts: Vec<Part>,
    /// The number that each triangle has in the scene.
    order: Vec<usize>,
}

impl Sorted {
    fn new(scene: &Scene) -> Self {
        let depths: Vec<f64> =
            scene.vertices.iter().map(|&vertex| crate::scene::depth(scene.clip(vertex))).collect();
        let depth =
            |triangle: usize| -> f64 { scene.triangles[triangle].iter().map(|&vertex| depths[vertex]).sum() };
        let mut order: Vec<usize> = (0..scene.triangles.len()).collect();
        order.sort_by(|&a, &b| depth(b).total_cmp(&depth(a)));
        let triangles: Vec<_> = order.iter().map(|&triangle| scene.triangles[triangle]).collect();
        Self { parts: parts(&scene.vertices, &triangles), order }
    }
}

/// Draws a band's pixels in memory, which shaders and lines can read, whatever the format.
pub(crate) fn in_memory<C: Colour>(band: &mut Band<'_, C>, draw: impl FnOnce(&mut Pixels<'_, C>)) {
    let area = band.area();
    let mut cells: Vec<C> = band.colors().collect();
    if let Ok(mut pixels) = Pixels::new(&mut cells, area) {
        draw(&mut pixels);
    }
    let _ = band.fill_contiguous(&area, cells); // a band takes all
}

/// The faces of a frame, in parts, and where they are drawn.
struct Faces<'a, 'f, C> {
    out: Out<'a, C>,
    statistics: Statistics,
    areas: &'a [Rectangle],
    parts: &'a [Part],
    faces: &'a mut [BinnedFaces<'f, Scalar, true>],
    /// The edges to smooth.
    edges: &'a mut [SmoothEdges<'f, Scalar>],
}

/// The shader of a face, given its part and its number there. Behind a pointer, so that the code that draws is one for all shaders.
type FaceBrush<'a, 't, C> = &'a dyn Fn(&Part, usize) -> Brush<'t, C>;

impl<C: Colour> Faces<'_, '_, C> {
    fn draw(self, fog: Option<&FogTable<C>>, brush: FaceBrush<'_, '_, C>) -> Result<Report, String> {
        match fog {
            None => self.draw_through(brush),
            Some(fog) => self.draw_through(|part, face| Fogged::new(brush(part, face), fog)),
        }
    }

    fn draw_through<I: SpanShader<C, Ink = C>>(
        self,
        shader: impl Fn(&Part, usize) -> I,
    ) -> Result<Report, String> {
        let Self { out, statistics, areas, parts, faces, edges } = self;
        let translucency = out.style.translucency;
        if !edges.is_empty() {
            // Smoothed in one piece, which bands equal in every format.
            let picture = out.in_one_piece(|band, depth| {
                solid(parts, faces, &shader, depth, band);
                in_memory(band, |pixels| C::smooth(pixels, depth, edges));
            })?;
            let width = out.size.width as usize;
            return out.bands(statistics, areas, |band, depth| {
                // For sprites.
                faces.iter_mut().for_each(|faces| faces.depth_only(depth));
                let area = band.area();
                let (left, columns) = (area.top_left.x as usize, area.size.width as usize); // in the picture
                let rows = picture.chunks(width.max(1)).skip(area.top_left.y as usize);
                let _ = band.fill_contiguous(&area, rows.flat_map(|row| &row[left..left + columns]).copied());
            });
        }
        out.bands(statistics, areas, |band, depth| match translucency {
            Translucency::Opaque => solid(parts, faces, &shader, depth, band),
            Translucency::Door(of_64) => {
                let shader = |part: &Part, face| ScreenDoor::new(shader(part, face), of_64);
                solid(parts, faces, shader, depth, band);
            }
            Translucency::Half => in_memory(band, |pixels| {
                solid(parts, faces, |part, face| Translucent::new(shader(part, face), Half), depth, pixels);
            }),
            Translucency::Alpha(of_32) => in_memory(band, |pixels| {
                solid(
                    parts,
                    faces,
                    |part, face| Translucent::new(shader(part, face), Alpha::new(of_32)),
                    depth,
                    pixels,
                );
            }),
        })
    }
}

/// Draws the faces of all parts.
fn solid<T: Surface<Error = Infallible>, I: ShaderFor<T>>(
    parts: &[Part],
    faces: &mut [BinnedFaces<'_, Scalar, true>],
    shader: impl Fn(&Part, usize) -> I,
    depth: &mut DepthBuffer<'_>,
    target: &mut T,
) {
    for (part, faces) in parts.iter().zip(faces) {
        let Ok(()) = faces.draw(|face| shader(part, face), &mut target.depth_tested(depth));
    }
}

/// Draws the edges of all parts. Their visibility is decided once for all bands. Returns statistics and the area drawn.
fn edges<'a, const DEPTH: bool>(
    transformed: &[TransformedMesh<'a, Scalar, DEPTH>],
    bin_storage: &'a mut [Vec<u16>],
) -> Result<(Vec<BinnedEdges<'a, Scalar, DEPTH>>, Statistics, Rectangle), String> {
    let edges = transformed
        .iter()
        .zip(bin_storage)
        .map(|(transformed, bin_storage)| transformed.bin_edges(bin_storage));
    let edges = edges.collect::<Result<Vec<_>, _>>().map_err(|e| e.to_string())?;
    let statistics =
        edges.iter().map(BinnedEdges::statistics).fold(Statistics::default(), core::ops::Add::add);
    let bounds = around(edges.iter().map(BinnedEdges::bounds));
    Ok((edges, statistics, bounds))
}

/// The destination of bands.
struct Out<'a, C> {
    size: Size,
    style: &'a Style,
    rows: u32,
    send: Send<'a>,
    /// The sprites, drawn after faces or edges.
    sprites: Sprites<'a, C>,
}

impl<C: Colour> Out<'_, C> {
    /// Draws the picture in one band, which is not sent, and returns its pixels.
    fn in_one_piece(
        &self,
        draw: impl FnOnce(&mut Band<'_, C>, &mut DepthBuffer<'_>),
    ) -> Result<Vec<C>, String> {
        let (Size { width, height }, area) = (self.size, Rectangle::new(Point::zero(), self.size));
        let mut strip = vec![0; Frame::<C>::strip_bytes(width, height)];
        let mut depths = vec![0; width as usize * height as usize];
        let mut frame = Frame::new(area, C::from(self.style.background));
        let mut depth = DepthBuffer::new(area, &mut depths).map_err(|e| e.to_string())?;
        let Some(mut band) = frame.next_band(&mut strip).map_err(|e| e.to_string())? else {
            return Ok(Vec::new());
        };
        draw(&mut band, &mut depth);
        Ok(band.colors().collect())
    }

    fn bands(
        self,
        statistics: Statistics,
        areas: &[Rectangle],
        mut draw: impl FnMut(&mut Band<'_, C>, &mut DepthBuffer<'_>),
    ) -> Result<Report, String> {
        let mut report = Report { statistics, sprites: self.sprites.statistics, ..Report::default() };
        let mut strip = vec![0; Frame::<C>::strip_bytes(self.size.width, self.rows)];
        // A strip holds more rows of a narrower area; a row may take up to seven pixels more.
        let mut depths = vec![0; (self.size.width as usize + 7) * self.rows as usize];
        for area in areas {
            let mut frame = Frame::new(*area, C::from(self.style.background));
            while let Some(mut band) = frame.next_band(&mut strip).map_err(|e| e.to_string())? {
                let mut depth = DepthBuffer::new(band.area(), &mut depths).map_err(|e| e.to_string())?;
                draw(&mut band, &mut depth);
                self.sprites.draw(&mut band, &mut depth);
                report.bands += 1;
                report.bytes += band.bytes().len();
                report.pixels += (band.area().size.width * band.area().size.height) as usize;
                (self.send)(band.area(), &mut band.colors().map(Into::into));
            }
        }
        Ok(report)
    }
}

/// The bounding rectangle of all rectangles.
pub(crate) fn around(areas: impl Iterator<Item = Rectangle>) -> Rectangle {
    let both = |a: Rectangle, b: Rectangle| {
        let corners = a.bottom_right().zip(b.bottom_right());
        corners.map_or(a, |(c, d)| {
            Rectangle::with_corners(a.top_left.component_min(b.top_left), c.component_max(d))
        })
    };
    areas.filter(|area| !area.is_zero_sized()).reduce(both).unwrap_or_default()
}
