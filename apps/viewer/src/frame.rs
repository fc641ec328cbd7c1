//! From a state to the pixels of a display, as firmware sends them.

use crate::overlay;
use crate::source::Source;
use crate::state::State;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{
    bands::{DirtyRegions, TransferCost},
    draw::Statistics,
};
use pinhole_apps_support::canvas::Canvas;
use pinhole_render::bands::Report;
use pinhole_render::fog::FogStyle;
use pinhole_render::paint::{paint, Subject};
use pinhole_render::quantised::Quantised;
use pinhole_render::style::{Mode, Style};

/// Statistics of the last frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown {
    /// Statistics of faces, or of edges where the mode draws edges.
    pub statistics: Statistics,
    /// Statistics of sprites.
    pub sprites: Statistics,
    /// Bands sent.
    pub bands: usize,
    /// Pixels sent.
    pub pixels: usize,
    /// Bytes sent: pixels, and the commands that set windows.
    pub bytes: usize,
    /// The rectangles sent.
    pub areas: Vec<Rectangle>,
}

/// A display with its pixels, and the state that they show.
pub struct Viewer {
    source: Source,
    display: Canvas<Rgb888>,
    dirty: DirtyRegions<4>,
    drawn: Option<State>,
    subject: Option<((Mode, bool), Subject)>,
    shown: Shown,
    /// Why a file that was dropped, or has changed, is not shown.
    notice: Option<String>,
}

impl Viewer {
    /// A display with unknown contents.
    pub fn new(source: Source, size: Size) -> Self {
        let area = Rectangle::new(Point::zero(), size);
        Self {
            source,
            display: Canvas::new(size, Rgb888::BLACK),
            dirty: DirtyRegions::new(area, TransferCost::new(16, TransferCost::MIPI_DCS)),
            drawn: None,
            subject: None,
            shown: Shown::default(),
            notice: None,
        }
    }

    /// The mesh that is shown.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// The size of the display.
    pub fn size(&self) -> Size {
        self.display.size()
    }

    /// Reads the files again if they have changed and nobody has written them since the last call; a file that cannot be read
    /// leaves what is shown, with a notice. Returns whether the window has anything new to show.
    pub fn reload(&mut self) -> bool {
        let Some(read) = self.source.changed() else { return false };
        match read {
            Ok(source) => *self = Self::new(source, self.size()),
            Err(problem) => self.notice = Some(problem),
        }
        true
    }

    /// Shows why another file is not shown.
    pub fn set_notice(&mut self, problem: String) {
        self.notice = Some(problem);
    }

    /// Brings the display to a state: sends the areas that changed, band by band. The error names the scene's file and says why it
    /// cannot be drawn.
    pub fn draw(&mut self, state: &State) -> Result<&Shown, String> {
        if !self.drawn.is_some_and(|drawn| drawn.draws_as(state)) {
            self.shown = self.model(state).map_err(|e| self.source.named(&e))?;
            self.drawn = Some(*state);
        }
        Ok(&self.shown)
    }

    /// The display's pixels, row by row.
    pub fn pixels(&self) -> &[Rgb888] {
        self.display.pixels()
    }

    /// The pixels of the display with the overlays of the state. `time` is the duration of a frame.
    pub fn picture(&self, state: &State, time: Option<std::time::Duration>) -> Vec<Rgb888> {
        let mut picture = Canvas::new(self.size(), Rgb888::BLACK);
        let all = picture.bounding_box();
        let Ok(()) = picture.fill_contiguous(&all, self.pixels().iter().copied());
        let Ok(()) = overlay::draw(state, &self.shown, time, self.notice.as_deref(), &mut picture);
        picture.pixels().to_vec()
    }

    fn model(&mut self, state: &State) -> Result<Shown, String> {
        let size = self.display.size();
        let scene = self.source.scene(state, size)?;
        let (quantised, used) = Quantised::settle(&scene)?;
        let style = Style {
            lit_texture: state.lit_texture,
            fog: state.fog.then_some(FogStyle::AUTO),
            translucency: state.translucency,
            smooth_lines: state.smooth,
            smooth_faces: state.smooth,
            ..Style::chosen(state.mode, state.format, None, None, state.dither)
        };
        let needs = (state.mode, state.smooth);
        if self.subject.as_ref().is_none_or(|(kind, _)| *kind != needs) {
            self.subject = Some((needs, Subject::new(&used, &style)));
        }
        let Some((_, subject)) = &self.subject else { return Ok(Shown::default()) };
        let like = |drawn: State| {
            (drawn.mode, drawn.format, drawn.smooth) == (state.mode, state.format, state.smooth)
        };
        let Self { display, dirty, .. } = self;
        if !self.drawn.is_some_and(like) {
            // With another format or background the contents are unknown. Areas start and end at whole bytes.
            let bits = state.format.bits();
            let steps = (8 / bits.clamp(1, 8)) as u16;
            let cost = TransferCost::new(bits, TransferCost::MIPI_DCS);
            *dirty = DirtyRegions::new(dirty.area(), cost).with_steps(steps, 1);
        }
        let mut areas = Vec::new();
        let mut plan = |bounds| {
            dirty.mark(bounds);
            areas = dirty.take().to_vec();
            areas.clone()
        };
        let rows = state.rows.unwrap_or(size.height);
        let mut send = |area: Rectangle, colours: &mut dyn Iterator<Item = Rgb888>| {
            let Ok(()) = display.fill_contiguous(&area, colours);
        };
        let scene = (&used, &quantised);
        let report = paint(subject, scene, &style, state.format, rows, &mut plan, &mut send)?;
        let Report { statistics, sprites, bands, bytes, pixels } = report;
        let bytes = bytes + bands * usize::from(TransferCost::MIPI_DCS);
        Ok(Shown { statistics, sprites, bands, pixels, bytes, areas })
    }
}
