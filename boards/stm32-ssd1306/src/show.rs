//! The loop: what has changed is drawn band by band into the buffer of the display's driver, which sends it.

use crate::input;
use crate::picture::{self, Picture, PIXELS, SCREEN, STEPS};
use core::convert::Infallible;
use display_interface::AsyncWriteOnlyDataCommand;
use embassy_time::{Instant, Timer};
use pinhole::bands::{DirtyRegions, Tracked, TransferCost};
use ssd1306::mode::{BufferedGraphicsModeAsync, DisplayConfigAsync};
use ssd1306::size::DisplaySize128x64;
use ssd1306::Ssd1306Async;

/// Before each rectangle: two commands of three bytes, each with an address and a control byte, and those of the pixels.
const WINDOW_BYTES: u16 = 12;

type Display<Bus> = Ssd1306Async<Bus, DisplaySize128x64, BufferedGraphicsModeAsync<DisplaySize128x64>>;

/// Shows the model at step 0, and from then on as the encoder and the button say. An error of the bus is logged, the display is
/// set up again, and everything is sent. It returns only errors that every frame would repeat, such as a strip without room
/// for a row.
pub async fn show<Bus: AsyncWriteOnlyDataCommand>(
    display: &mut Display<Bus>,
    picture: &mut Picture<'_>,
) -> Result<Infallible, &'static str> {
    // At most four rectangles: those of the model and of the text, before and now. A byte is a column of eight pixels.
    let mut dirty = DirtyRegions::<4>::new(SCREEN, TransferCost::new(1, WINDOW_BYTES)).with_steps(1, 8);
    let mut shown = [Tracked::new(); 2];
    let mut strip = [0; PIXELS / 8];
    let (mut step, mut clicks, mut number) = (0, 0, 0_u32);
    let mut ready = false;
    loop {
        let begin = Instant::now();
        while !ready {
            ready = display.init().await.is_ok();
            if !ready {
                defmt::error!("no display answers on the bus: see SDA, SCL, their pull-ups and the power");
                Timer::after_secs(1).await;
            }
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
                    let band = turned.next_band(&mut frame, &mut strip)?;
                    rows = rows.saturating_sub(band.area().size.height);
                    // Into the driver's buffer, which does not fail.
                    band.send(display).map_err(|_| "the display's buffer cannot be written")?;
                }
                bytes += u32::from(WINDOW_BYTES) + area.size.width * area.size.height / 8;
                // What has been written into the buffer since it was sent last: this rectangle.
                if ready && display.flush().await.is_err() {
                    defmt::error!("the bus of the display fails: the display is set up again");
                    ready = false;
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
