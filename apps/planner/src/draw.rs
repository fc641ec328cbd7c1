//! A frame as firmware draws it: in bands, with depth, as the templates' `picture.rs` does.

use crate::choice::{Choice, Style};
use crate::display::{Format, Shown, Tricolor};
use crate::lens::Lens;
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::pixelcolor::{BinaryColor, Gray4, Rgb565, Rgb888, RgbColor};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    Affine, Band, BinnedEdges, BinnedFaces, DepthBuffer, Dim, FaceColors, Flat, Frame, Gouraud, Lambert, Lit,
    Mesh, ScreenVertex, SpanShader, Statistics, Vector3,
};
use pinhole_import::ImportedMesh;

/// A frame, and what it was.
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
    HiddenLines(&'b mut BinnedFaces<'a, i16, true>, &'b mut BinnedEdges<'a, i16, true>),
    Faces(&'b mut BinnedFaces<'a, i16, true>, &'b Shades<'b>),
}

/// Draws a model by a choice.
pub(crate) fn draw(model: &ImportedMesh, choice: &Choice) -> Result<Drawn, String> {
    let mesh = model.mesh().map_err(|e| e.to_string())?;
    let colors = model.colors().map_err(|e| e.to_string())?;
    let sphere = mesh.bounding_sphere();
    let camera = Lens::new(choice, &sphere).camera(choice, &sphere)?;
    let turned = Affine::rotation_y(choice.turn());
    let instance = camera.place(&mesh, &turned);
    let mut cache = vec![ScreenVertex::EMPTY; mesh.cache_len()];
    let mut face_bins = vec![0; mesh.face_bins_len()];
    let mut edge_bins = vec![0; mesh.edge_bins_len()];
    if choice.style == Style::Wireframe {
        // Lines without depth test: no far plane may clip them.
        let mut edges =
            instance.transform(&mut cache).bin_edges(&mut edge_bins).map_err(|e| e.to_string())?;
        return picture(choice, Job::Lines(&mut edges));
    }
    let transformed = instance.transform_depth(&mut cache);
    let mut faces = transformed.bin_faces(&mut face_bins).map_err(|e| e.to_string())?;
    if choice.style == Style::HiddenLine {
        let mut edges = transformed.bin_edges(&mut edge_bins).map_err(|e| e.to_string())?;
        return picture(choice, Job::HiddenLines(&mut faces, &mut edges));
    }
    let [x, y, z] = choice.light;
    let light =
        Lambert::new(&turned, Vector3::from_ints(x, y, z), choice.ambient).map_err(|e| e.to_string())?;
    picture(choice, Job::Faces(&mut faces, &Shades { mesh: &mesh, colors, light, choice }))
}

fn picture(choice: &Choice, job: Job<'_, '_>) -> Result<Drawn, String> {
    match choice.format {
        Format::Rgb565 => Canvas::<Rgb565>::new(choice).plain(choice, job),
        Format::Mono => Canvas::<BinaryColor>::new(choice).draw(choice, job),
        Format::Gray4 => Canvas::<Gray4>::new(choice).plain(choice, job),
        Format::Tricolor => Canvas::<Tricolor>::new(choice).draw(choice, job),
    }
}

/// The colours of faces.
struct Shades<'a> {
    mesh: &'a Mesh<'a>,
    colors: Option<FaceColors<'a>>,
    light: Lambert,
    choice: &'a Choice,
}

impl Shades<'_> {
    /// The colour of a face in full light: that of its material, if it has one.
    fn color<C: From<Rgb888>>(&self, face: usize) -> C {
        self.colors.map_or_else(|| self.choice.color.into(), |colors| colors.color(face))
    }

    /// As firmware hands it to shaders: from 16 bits.
    fn color888(&self, face: usize) -> Rgb888 {
        self.color::<Rgb565>(face).into()
    }

    fn level(&self, face: usize) -> u16 {
        self.mesh.normals().get(face).map_or(256, |&normal| self.light.level(normal))
    }

    fn flat(&self, face: usize) -> Flat {
        Flat::lit(self.color888(face), self.level(face))
    }

    fn gouraud(&self, face: usize) -> Lit {
        let normals = self.mesh.corners_of(face, self.mesh.vertex_normals());
        Gouraud::lit(self.color888(face), normals.map(|normal| self.light.level(normal)))
    }
}

/// A display in memory, that bands are sent to.
struct Canvas<C> {
    frame: Frame<C>,
    rows: u32,
    drawn: Drawn,
}

impl<C: Shown> Canvas<C> {
    fn new(choice: &Choice) -> Self {
        let area = Rectangle::new(Point::zero(), choice.size);
        let pixels = Vec::with_capacity(4 * choice.size.width as usize * choice.size.height as usize);
        let drawn = Drawn { pixels, statistics: Statistics::default(), bytes: 0 };
        Self { frame: Frame::new(area, C::from(choice.background)), rows: choice.rows, drawn }
    }

    /// Draws all bands; faces dithered or not, as the choice says.
    fn plain(mut self, choice: &Choice, job: Job<'_, '_>) -> Result<Drawn, String>
    where
        C: Dim,
    {
        match job {
            Job::Faces(faces, shades) if !choice.dither => {
                match choice.style {
                    Style::Gouraud => self.faces(faces, |face| shades.gouraud(face)),
                    _ => self.faces(faces, |face| shades.color::<C>(face).dim(shades.level(face))),
                }?;
                Ok(self.drawn(faces.statistics()))
            }
            job => self.draw(choice, job),
        }
    }

    /// Draws all bands; faces dithered.
    fn draw(mut self, choice: &Choice, job: Job<'_, '_>) -> Result<Drawn, String> {
        let color = C::from(choice.color);
        match job {
            Job::Lines(edges) => {
                self.bands(|band, _| {
                    let Ok(()) = edges.draw(color, band);
                })?;
                Ok(self.drawn(edges.statistics()))
            }
            Job::HiddenLines(faces, edges) => {
                self.bands(|band, depth| {
                    faces.depth_only(depth);
                    let Ok(()) = edges.hidden_line(color, depth, band);
                })?;
                Ok(self.drawn(edges.statistics()))
            }
            Job::Faces(faces, shades) => {
                match choice.style {
                    Style::Gouraud => self.faces(faces, |face| shades.gouraud(face).dithered()),
                    _ => self.faces(faces, |face| shades.flat(face).dithered()),
                }?;
                Ok(self.drawn(faces.statistics()))
            }
        }
    }

    fn bands(&mut self, mut draw: impl FnMut(&mut Band<'_, C>, &mut DepthBuffer<'_>)) -> Result<(), String> {
        let width = self.frame.area().size.width;
        let mut strip = vec![0; Frame::<C>::strip_bytes(width, self.rows)];
        // A strip may hold more pixels than these, where the last byte of a row has room for some.
        let mut depths = vec![0; (width as usize + 7) * self.rows as usize];
        while let Some(mut band) = self.frame.next_band(&mut strip).map_err(|e| e.to_string())? {
            let mut depth = DepthBuffer::new(band.area(), &mut depths).map_err(|e| e.to_string())?;
            draw(&mut band, &mut depth);
            self.drawn.bytes += band.bytes().len();
            for color in band.colors() {
                let color: Rgb888 = color.into();
                self.drawn.pixels.extend([color.r(), color.g(), color.b(), 255]);
            }
        }
        Ok(())
    }

    fn faces<S: SpanShader<C>>(
        &mut self,
        faces: &mut BinnedFaces<'_, i16, true>,
        shader: impl Fn(usize) -> S,
    ) -> Result<(), String> {
        self.bands(|band, depth| {
            let Ok(()) = faces.depth_tested(&shader, depth, band);
        })
    }

    fn drawn(self, statistics: Statistics) -> Drawn {
        Drawn { statistics, ..self.drawn }
    }
}
