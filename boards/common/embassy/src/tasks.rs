//! Drawing and sending: while one strip is sent, the next bands are drawn into the others. Only the rectangles that have changed
//! are drawn.

use crate::chip::{Input, Output, Spi};
use crate::panel::{self, Panel, Problem, WAKING};
use crate::picture::{self, Picture, ROWS, SCREEN, STEPS};
use crate::{input, stack, stop::stop};
use core::convert::Infallible;
use core::sync::atomic::{AtomicBool, Ordering::Relaxed};
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::zerocopy_channel::{Channel, Receiver, Sender};
use embassy_time::{with_deadline, with_timeout, Delay, Duration, Instant, Timer};
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::primitives::Rectangle;
use pinhole::{
    bands::{DirtyRegions, Frame, Tracked, TransferCost},
    color::Color,
};

/// Memory for a band, and the band that is in it.
pub struct Strip {
    bytes: [u8; Frame::<Rgb565>::strip_bytes(SCREEN.size.width, ROWS)],
    area: Rectangle,
    /// How many of the bytes the band has.
    len: usize,
    /// Whether it is the first one of a frame.
    is_first: bool,
}

impl Strip {
    pub const EMPTY: Self = Self {
        bytes: [0; Frame::<Rgb565>::strip_bytes(SCREEN.size.width, ROWS)],
        area: Rectangle::new(Point::zero(), Size::zero()),
        len: 0,
        is_first: false,
    };
}

pub type Strips = Channel<'static, CriticalSectionRawMutex, Strip>;

/// From one writing of the panel's registers to the next, with all pixels in the frame after it.
const REFRESH: Duration = Duration::from_millis(500);
/// The longest time from one refresh of the panel to the next, and how long it reads a row, in µs: an ST7789 at its 60 Hz.
const PERIOD: Duration = Duration::from_millis(30);
const ROW: u64 = 49;
/// The longest time in which nothing changes before the watchdog is fed again.
const REST: Duration = Duration::from_millis(500);
/// The longest time that a strip may take. One of 32 rows takes 4 ms at 32 MHz.
const PATIENCE: Duration = Duration::from_millis(20);
/// Commands and their arguments before the pixels of a window, in bytes.
const WINDOW_BYTES: u16 = TransferCost::MIPI_DCS;
/// Whether the next frame is drawn and sent whole: a band has not reached the display, or the display may have lost its pixels.
static WHOLE: AtomicBool = AtomicBool::new(false);

/// Draws the model at step 0, and from then on as the encoder and the button say. `color` gives the colour of each face. The
/// watchdog is fed once a frame. It returns only errors that every frame would repeat, such as a strip without room for a row.
pub async fn draw(
    picture: &mut Picture<'_>,
    color: impl Fn(usize, u16) -> Rgb565,
    mut strips: Sender<'_, CriticalSectionRawMutex, Strip>,
    mut feed_watchdog: impl FnMut(),
) -> Result<Infallible, &'static str> {
    // At most four rectangles: those of the model and of the text, before and now.
    let mut dirty = DirtyRegions::<4>::new(SCREEN, TransferCost::new(Rgb565::FORMAT.bits(), WINDOW_BYTES));
    let mut shown = [Tracked::new(); 2];
    let (mut step, mut clicks, mut number) = (0, 0, 0_u32);
    loop {
        feed_watchdog();
        let begin = Instant::now();
        if WHOLE.load(Relaxed) {
            WHOLE.store(false, Relaxed);
            dirty.invalidate();
        }
        let mut turned = picture.turned(step)?;
        for (shown, bounds) in shown.iter_mut().zip(turned.bounds()) {
            shown.show(step, bounds, &mut dirty);
        }
        let areas = dirty.take();
        if areas.is_empty() {
            with_timeout(REST, input::changed()).await.ok();
        } else {
            let mut bytes = 0;
            for area in areas {
                let (mut frame, mut rows) = (picture::frame(area), area.size.height);
                while rows > 0 {
                    let strip = strips.send().await;
                    let band = turned.next_band(&color, &mut frame, &mut strip.bytes)?;
                    (strip.area, strip.len, strip.is_first) = (band.area(), band.bytes().len(), bytes == 0);
                    rows = rows.saturating_sub(strip.area.size.height);
                    bytes += u32::from(WINDOW_BYTES) + strip.len as u32; // of all bands, less than 2¹⁷
                    strips.send_done();
                }
            }
            defmt::info!(
                "frame {=u32}: {=u64} us, {=u32} bytes, the encoder was read up to {=u32} us late, {}",
                number,
                begin.elapsed().as_micros(),
                bytes,
                input::late(),
                turned.statistics()
            );
            number = number.wrapping_add(1);
            if number % STEPS as u32 == 0 {
                stack::log();
            }
        }
        let turned = input::clicks().wrapping_sub(clicks);
        clicks = clicks.wrapping_add(turned);
        step = (step + (turned + i32::from(input::running())) % STEPS + STEPS) % STEPS;
        // 0 to 119
    }
}

/// Sends the bands that are drawn, and writes the panel's registers at an interval. After an error of the bus, the panel is reset and
/// drawn whole. If the panel's pin TE is connected, the first band waits until the panel begins to read its memory, and each
/// band until the panel has read its rows: then no refresh shows two frames.
pub async fn send(
    panel: &mut Panel<Bus, Output<'static>>,
    mut strips: Receiver<'_, CriticalSectionRawMutex, Strip>,
    tearing: &mut Input<'static>,
) -> Infallible {
    let mut due = Instant::now() + REFRESH;
    let (mut has_te, mut begins) = (None, None);
    loop {
        let is_due = Instant::now() >= due;
        let shown = if is_due {
            due += REFRESH;
            panel.refresh()
        } else {
            let Ok(strip) = with_deadline(due, strips.receive()).await else { continue };
            if strip.is_first && has_te != Some(false) {
                let falls = with_timeout(PERIOD, tearing.wait_for_falling_edge()).await.is_ok();
                has_te = has_te.or(Some(falls));
                begins = falls.then(Instant::now);
            }
            if let Some(begins) = begins {
                let rows = strip.area.top_left.y as u64 + u64::from(strip.area.size.height); // from 0 to 240
                Timer::at(begins + Duration::from_micros(ROW * rows)).await;
            }
            let pixels = strip.bytes.get(..strip.len).unwrap_or(&[]);
            let shown = match panel.window(&strip.area) {
                Ok(Bus(spi)) => match with_timeout(PATIENCE, spi.write(pixels)).await {
                    Ok(Ok(())) => panel.finish(),
                    Ok(Err(_)) => Err("the bus has an error"),
                    Err(_) => Err("the bus does not go on"),
                },
                Err(problem) => Err(problem),
            };
            strips.receive_done();
            shown
        };
        if let Err(problem) = shown {
            defmt::error!("{=str}", problem);
            panel.start(&mut Delay).unwrap_or_else(|problem| stop(problem));
        }
        if is_due || shown.is_err() {
            Timer::after_millis(WAKING.into()).await;
            WHOLE.store(true, Relaxed);
        }
    }
}

/// The display's bus, which is blocking for the few bytes of commands, and awaited for pixels.
pub struct Bus(pub Spi);

impl panel::Bus for Bus {
    fn write(&mut self, bytes: &[u8]) -> Result<(), Problem> {
        self.0.blocking_write(bytes).map_err(|_| "the bus has an error")
    }

    fn finish(&mut self) -> Result<(), Problem> {
        Ok(())
    }
}
