//! A frame as firmware draws it: in bands, with depth, as the templates' `picture.rs` does.

use crate::choice::{Choice, Order, Style};
use crate::display::Format;
use crate::lens::Lens;
use crate::paint::{Paint, Picture, Stored};
use crate::refused;
use crate::texture::{Coordinates, TextureImage};
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Rgb565, Rgb888, RgbColor};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::draw::{BinnedEdges, SmoothEdges};
use pinhole::{mesh::FaceColors, prelude::*};
use pinhole_apps_support::work::Place;
use pinhole_import::ImportedMesh;

/// A drawn frame and its statistics.
pub(crate) struct Drawn {
    /// Red, green, blue and opacity of each pixel, row by row.
    pub(crate) pixels: Vec<u8>,
    /// Statistics of faces, or of edges where these are drawn.
    pub(crate) statistics: Statistics,
    /// Bytes of the pixels in the display's format.
    pub(crate) bytes: usize,
}

/// The faces or edges that are drawn into each band.
enum Job<'a, 'b> {
    Lines(&'b mut BinnedEdges<'a, i16, false>),
    HiddenLines(&'b mut BinnedFaces<'a>, &'b mut BinnedEdges<'a>),
    /// With the edges that are smoothed.
    Faces(&'b mut BinnedFaces<'a>, &'b Shades<'b>, Option<&'b mut SmoothEdges<'a>>),
}

/// Draws a model by a choice, textured by an image.
pub(crate) fn draw(model: &ImportedMesh, choice: &Choice, image: &TextureImage) -> Result<Drawn, String> {
    let mesh = model.mesh().map_err(refused::mesh)?;
    let colors = model.colors().map_err(refused::mesh)?;
    let sphere = mesh.bounding_sphere();
    let camera = Lens::new(choice, &sphere).camera(choice, &sphere)?;
    let turned = Affine::rotation_y(choice.turn());
    let instance = camera.place(&mesh, &turned);
    let mut cache = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
    let mut face_bins = vec![0; mesh.face_bins_len()];
    let mut edge_bins = vec![0; mesh.edge_bins_len()];
    if choice.style == Style::Wireframe {
        // Lines without a depth test are not clipped at the far plane.
        let mut edges = instance.transform(&mut cache).bin_edges(&mut edge_bins).map_err(refused::buffer)?;
        return picture(choice, Job::Lines(&mut edges));
    }
    let transformed = instance.transform_depth(&mut cache);
    let mut faces = transformed.bin_faces(&mut face_bins).map_err(refused::buffer)?;
    if choice.style == Style::HiddenLine {
        let mut edges = transformed.bin_edges(&mut edge_bins).map_err(refused::buffer)?;
        return picture(choice, Job::HiddenLines(&mut faces, &mut edges));
    }
    let [x, y, z] = choice.light;
    let light = Lambert::new(&turned, Vector3::from_ints(x, y, z), choice.ambient).map_err(refused::light)?;
    let texture = if choice.style == Style::Textured {
        let coords = Coordinates::of(model, &mesh)?;
        let texture = Texture::new(Picture { texels: image.texels()?, format: choice.format });
        Some((texture.with_exponent(coords.exponent()).map_err(refused::texture)?, coords))
    } else {
        None
    };
    let mut smooth_bins = vec![0; mesh.smooth_bins_len()];
    let mut smooth = if choice.smooths() {
        let creases = choice.creases(model);
        let edges = transformed.bin_smooth_edges(|edge| edge < creases, &mut smooth_bins);
        Some(edges.map_err(refused::buffer)?)
    } else {
        None
    };
    let shades = Shades { mesh: &mesh, colors, light, texture, choice };
    if choice.order() != Order::Depth {
        return in_order(&order(&instance, choice.order()), &shades, &|alone| camera.place(alone, &turned));
    }
    picture(choice, Job::Faces(&mut faces, &shades, smooth.as_mut()))
}

/// The faces in the order in which they are drawn without depth, in the lower 16 bits. In the upper bits is how near they are in painter's order:
/// the mean depth of their corners, as [`Painter`] rounds it.
fn order(instance: &MeshInstance<'_>, order: Order) -> Vec<u32> {
    let faces = instance.mesh().faces().iter().zip(0..);
    let depth = |&vertex: &u16| instance.project(vertex.into()).map_or(0, |seen| u32::from(seen.depth));
    let key = |corners: &[u16; 3]| match order {
        Order::Painter => u32::from(u16::MAX) - ((corners.iter().map(depth).sum::<u32>() * 21_845) >> 16), // of at most 65 534
        _ => 0,
    };
    let mut order: Vec<u32> = faces.map(|(corners, face)| key(corners) << 16 | face).collect();
    order.sort_unstable();
    order
}

/// The colours of faces.
struct Shades<'a> {
    mesh: &'a Mesh<'a>,
    colors: Option<FaceColors<'a>>,
    light: Lambert,
    texture: Option<(Texture<Picture<'a>>, Coordinates<'a>)>,
    choice: &'a Choice,
}

impl<'a> Shades<'a> {
    /// The colour of a face in full light: that of its material, if it has one.
    fn color(&self, face: usize) -> Rgb888 {
        self.colors.map_or(self.choice.color, |colors| colors.color(face))
    }

    /// The colour of a face as firmware passes it to shaders: converted from 16 bits.
    fn of_16_bits(&self, face: usize) -> Rgb888 {
        Rgb565::from(self.color(face)).into()
    }

    fn level(&self, face: usize) -> u16 {
        self.mesh.normals().get(face).map_or(256, |&normal| self.light.level(normal))
    }

    /// Draws faces with depth; `first` is the index of the first one.
    fn draw(
        &self,
        faces: &mut BinnedFaces<'_>,
        first: usize,
        band: &mut Band<'_, Stored>,
        depth: &mut DepthBuffer<'_>,
    ) {
        let Ok(()) = faces.draw(|face| self.paint(first + face), &mut band.depth_tested(depth));
    }

    fn paint(&self, face: usize) -> Paint<'a> {
        let (format, dithers) = (self.choice.format, self.choice.dithers());
        if let Some((texture, coords)) = &self.texture {
            return Paint::Textured(texture.at(coords.corners(face)).lit([self.level(face); 3]));
        }
        if self.choice.style == Style::Gouraud {
            let normals = self.mesh.corners_of(face, self.mesh.vertex_normals());
            let lit = Gouraud::lit(self.of_16_bits(face), normals.map(|normal| self.light.level(normal)));
            return if dithers { Paint::SmoothDithered(format, lit) } else { Paint::Smooth(format, lit) };
        }
        if dithers {
            Paint::Dithered(format, Flat::lit(self.of_16_bits(face), self.level(face)))
        } else {
            Paint::Plain(format.dimmed(self.of_16_bits(face), self.level(face)))
        }
    }
}

/// Draws faces one after the other, each alone, as without depth.
fn in_order(order: &[u32], shades: &Shades<'_>, place: Place<'_>) -> Result<Drawn, String> {
    let (mesh, choice) = (shades.mesh, shades.choice);
    let mut canvas = Canvas::new(choice);
    canvas.rows = choice.size.height;
    let mut depths = vec![0; choice.size.width as usize * choice.size.height as usize];
    let mut statistics = Statistics::default();
    canvas.bands(|band, _| {
        for face in order.iter().map(|&face| face as usize & 0xffff) {
            let corners = mesh.faces().get(face..=face).unwrap_or_default();
            let Ok(alone) = Mesh::new(mesh.vertices(), mesh.exponent(), corners) else { continue };
            let (instance, mut bins) = (place(&alone), vec![0; alone.face_bins_len()]);
            let Ok(mut faces) = instance.transform_depth(&mut []).bin_faces(&mut bins) else { continue };
            statistics = statistics + faces.statistics();
            if let Ok(mut depth) = DepthBuffer::new(faces.bounds(), &mut depths) {
                shades.draw(&mut faces, face, band, &mut depth);
            }
        }
    })?;
    Ok(drawn(canvas, statistics))
}

/// Draws all bands.
fn picture(choice: &Choice, job: Job<'_, '_>) -> Result<Drawn, String> {
    let mut canvas = Canvas::new(choice);
    let color = choice.format.store(choice.color);
    let statistics = match job {
        Job::Lines(edges) => {
            canvas.bands(|band, _| {
                let Ok(()) = edges.draw(color, band);
            })?;
            edges.statistics()
        }
        Job::HiddenLines(faces, edges) => {
            canvas.bands(|band, depth| {
                faces.depth_only(depth);
                let Ok(()) = edges.hidden_line(color, &mut band.depth_tested(depth));
            })?;
            edges.statistics()
        }
        Job::Faces(faces, shades, mut smooth) => {
            if smooth.is_some() {
                canvas.rows = choice.size.height; // smoothing a whole picture equals smoothing in bands
            }
            canvas.bands(|band, depth| {
                shades.draw(faces, 0, band, depth);
                if let Some(edges) = &mut smooth {
                    choice.format.smooth(edges, band, depth);
                }
            })?;
            faces.statistics()
        }
    };
    Ok(drawn(canvas, statistics))
}

fn drawn(canvas: Canvas, statistics: Statistics) -> Drawn {
    let Size { width, height } = canvas.frame.area().size;
    Drawn { pixels: canvas.pixels, statistics, bytes: canvas.format.bytes(width, height) }
}

/// A display in memory, to which bands are sent.
struct Canvas {
    frame: Frame<Stored>,
    rows: u32,
    format: Format,
    pixels: Vec<u8>,
}

impl Canvas {
    fn new(choice: &Choice) -> Self {
        let area = Rectangle::new(Point::zero(), choice.size);
        let pixels = Vec::with_capacity(4 * choice.size.width as usize * choice.size.height as usize);
        let frame = Frame::new(area, choice.format.store(choice.background));
        Self { frame, rows: choice.rows(), format: choice.format, pixels }
    }

    fn bands(
        &mut self,
        mut draw: impl FnMut(&mut Band<'_, Stored>, &mut DepthBuffer<'_>),
    ) -> Result<(), String> {
        let width = self.frame.area().size.width;
        let mut strip = vec![0; Frame::<Stored>::strip_bytes(width, self.rows)];
        let mut depths = vec![0; width as usize * self.rows as usize];
        while let Some(mut band) = self.frame.next_band(&mut strip).map_err(refused::buffer)? {
            let mut depth = DepthBuffer::new(band.area(), &mut depths).map_err(refused::buffer)?;
            draw(&mut band, &mut depth);
            for color in band.colors() {
                let color = self.format.shown(color);
                self.pixels.extend([color.r(), color.g(), color.b(), 255]);
            }
        }
        Ok(())
    }
}
