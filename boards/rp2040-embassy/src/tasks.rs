//! Drawing and sending: while one strip is sent, the next bands are drawn into the others. Only the rectangles that have changed
//! are drawn.

use crate::input;
use crate::panel::{Panel, WINDOW_BYTES};
use crate::picture::{self, Picture, ROWS, SCREEN, STEPS};
use core::convert::Infallible;
use core::sync::atomic::{AtomicBool, Ordering::Relaxed};
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::zerocopy_channel::{Channel, Receiver, Sender};
use embassy_time::Instant;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::primitives::Rectangle;
use embedded_hal::digital::OutputPin;
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
}

impl Strip {
    pub const EMPTY: Self = Self {
        bytes: [0; Frame::<Rgb565>::strip_bytes(SCREEN.size.width, ROWS)],
        area: Rectangle::new(Point::zero(), Size::zero()),
        len: 0,
    };
}

pub type Strips = Channel<'static, CriticalSectionRawMutex, Strip>;

/// Whether a band has not reached the display since the last frame began.
static FAILED: AtomicBool = AtomicBool::new(false);

/// Draws the model at step 0, and from then on as the encoder and the button say. `color` gives the colour of each face. It
/// returns only errors that every frame would repeat, such as a strip without room for a row.
pub async fn draw(
    picture: &mut Picture<'_>,
    color: impl Fn(usize, u16) -> Rgb565,
    mut strips: Sender<'_, CriticalSectionRawMutex, Strip>,
) -> Result<Infallible, &'static str> {
    // At most four rectangles: those of the model and of the text, before and now.
    let mut dirty = DirtyRegions::<4>::new(SCREEN, TransferCost::new(Rgb565::FORMAT.bits(), WINDOW_BYTES));
    let mut shown = [Tracked::new(); 2];
    let (mut step, mut clicks, mut number) = (0, 0, 0_u32);
    loop {
        let begin = Instant::now();
        if FAILED.load(Relaxed) {
            FAILED.store(false, Relaxed);
            dirty.invalidate();
        }
        let mut turned = picture.turned(step)?;
        for (shown, bounds) in shown.iter_mut().zip(turned.bounds()) {
            shown.show(step, bounds, &mut dirty);
        }
        let areas = dirty.take();
        if areas.is_empty() {
            input::changed().await;
        } else {
            let mut bytes = 0;
            for area in areas {
                let (mut frame, mut rows) = (picture::frame(area), area.size.height);
                while rows > 0 {
                    let strip = strips.send().await;
                    let band = turned.next_band(&color, &mut frame, &mut strip.bytes)?;
                    (strip.area, strip.len) = (band.area(), band.bytes().len());
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
        }
        let turned = input::clicks().wrapping_sub(clicks);
        clicks = clicks.wrapping_add(turned);
        step = (step + (turned + i32::from(input::running())) % STEPS + STEPS) % STEPS;
        // 0 to 119
    }
}

/// Sends the bands that are drawn. An error of the bus is logged, and the next frame is sent as a whole.
pub async fn send<Bus, Pin>(
    panel: &mut Panel<Bus, Pin>,
    mut strips: Receiver<'_, CriticalSectionRawMutex, Strip>,
) -> Infallible
where
    Bus: embedded_hal::spi::SpiBus + embedded_hal_async::spi::SpiBus,
    Pin: OutputPin,
{
    loop {
        let strip = strips.receive().await;
        if let Err(problem) = panel.send(&strip.area, strip.bytes.get(..strip.len).unwrap_or(&[])).await {
            defmt::error!("{=str}", problem);
            FAILED.store(true, Relaxed);
        }
        strips.receive_done();
    }
}
