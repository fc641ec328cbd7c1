//! The loop: what has changed is drawn band by band into the buffer of the display's driver, which sends it.

use crate::picture::{self, Picture, PIXELS, SCREEN, STEPS};
use crate::{input, stack};
use core::convert::Infallible;
use display_interface::{AsyncWriteOnlyDataCommand, DataFormat, DisplayError};
use embassy_time::{with_deadline, with_timeout, Duration, Instant, Timer};
use pinhole::bands::{DirtyRegions, Tracked, TransferCost};
use ssd1306::mode::{BufferedGraphicsModeAsync, DisplayConfigAsync};
use ssd1306::size::DisplaySize128x64;
use ssd1306::Ssd1306Async;

/// Before each rectangle: two commands of three bytes, each with an address and a control byte, and those of the pixels.
const WINDOW_BYTES: u16 = 12;
/// From one set-up of the display to the next, by which one that has lost its state comes back.
const REFRESH: Duration = Duration::from_millis(500);
/// The longest time that a set-up or a rectangle may take. The whole display takes 23 ms.
const PATIENCE: Duration = Duration::from_millis(100);
/// The time between two searches for a display that does not answer.
const REST: Duration = Duration::from_millis(500);

/// The display's bus, but for the command that switches it off, with which the driver's set-up begins: a display that shows a picture
/// is then set up without a sign of it.
pub struct KeptOn<Bus>(pub Bus);

impl<Bus: AsyncWriteOnlyDataCommand> AsyncWriteOnlyDataCommand for KeptOn<Bus> {
    async fn send_commands(&mut self, commands: DataFormat<'_>) -> Result<(), DisplayError> {
        match commands {
            DataFormat::U8([0xae]) => Ok(()),
            commands => self.0.send_commands(commands).await,
        }
    }

    async fn send_data(&mut self, data: DataFormat<'_>) -> Result<(), DisplayError> {
        self.0.send_data(data).await
    }
}

type Display<Bus> = Ssd1306Async<Bus, DisplaySize128x64, BufferedGraphicsModeAsync<DisplaySize128x64>>;

/// Shows the model at step 0, and from then on as the encoder and the button say. An error of the bus is logged, the display is
/// set up again, and everything is sent. The watchdog is fed once a frame. It returns only errors that every frame would repeat,
/// such as a strip without room for a row.
pub async fn show<Bus: AsyncWriteOnlyDataCommand>(
    display: &mut Display<Bus>,
    picture: &mut Picture<'_>,
    mut feed_watchdog: impl FnMut(),
) -> Result<Infallible, &'static str> {
    // At most four rectangles: those of the model and of the text, before and now. A byte is a column of eight pixels.
    let mut dirty = DirtyRegions::<4>::new(SCREEN, TransferCost::new(1, WINDOW_BYTES)).with_steps(1, 8);
    let mut shown = [Tracked::new(); 2];
    let mut strip = [0; PIXELS / 8];
    let (mut step, mut clicks, mut number) = (0, 0, 0_u32);
    let mut due = Instant::MIN;
    loop {
        feed_watchdog();
        let begin = Instant::now();
        if begin >= due {
            if !matches!(with_timeout(PATIENCE, display.init()).await, Ok(Ok(()))) {
                defmt::error!("no display answers on the bus: see SDA, SCL, their pull-ups and the power");
                Timer::after(REST).await;
                continue;
            }
            due = begin + REFRESH;
            dirty.invalidate();
        }
        let mut turned = picture.turned(step)?;
        for (shown, bounds) in shown.iter_mut().zip(turned.bounds()) {
            shown.show(step, bounds, &mut dirty);
        }
        let areas = dirty.take();
        if areas.is_empty() {
            with_deadline(due, input::changed()).await.ok();
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
                if !matches!(with_timeout(PATIENCE, display.flush()).await, Ok(Ok(()))) {
                    defmt::error!("the bus of the display fails: the display is set up again");
                    due = Instant::MIN;
                    break;
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
