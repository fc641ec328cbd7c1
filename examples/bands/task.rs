//! The blocking loop as an async task: other tasks run during transfers. `block_on` and the bus stand for an executor such as
//! embassy's and its SPI, with which the loop works unchanged.

use crate::display::Display;
use crate::scene::{Scene, STRIP};
use embedded_graphics::primitives::Rectangle;
use std::cell::Cell;
use std::error::Error;
use std::future::Future;
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};

/// A bus whose transfers take time.
struct Bus(Display);

impl Bus {
    async fn write(&mut self, area: &Rectangle, bytes: &[u8]) {
        for _ in 0..bytes.len() / 1024 {
            yield_now().await;
        }
        self.0.receive(area, bytes);
    }
}

/// Lets other tasks run once.
async fn yield_now() {
    let mut waited = false;
    std::future::poll_fn(|context| {
        context.waker().wake_by_ref();
        if std::mem::replace(&mut waited, true) {
            Poll::Ready(())
        } else {
            Poll::Pending
        }
    })
    .await;
}

async fn draw(scene: &mut Scene, bus: &mut Bus) -> Result<(), Box<dyn Error>> {
    let mut strip = [0; STRIP];
    let (mut frame, mut contents) = scene.begin_frame()?;
    while let Some(mut band) = frame.next_band(&mut strip)? {
        contents.draw(&mut band)?;
        bus.write(&band.area(), band.bytes()).await;
    }
    Ok(())
}

/// Draws a frame. Returns the display, and how often another task ran during transfers.
pub(crate) fn show(scene: &mut Scene, display: Display) -> Result<(Display, u32), Box<dyn Error>> {
    let mut bus = Bus(display);
    let others = Cell::new(0);
    block_on(draw(scene, &mut bus), || others.set(others.get() + 1))?;
    Ok((bus.0, others.get()))
}

/// The smallest executor: polls a task until it is done, and runs another task in between.
fn block_on<T>(task: impl Future<Output = T>, meanwhile: impl Fn()) -> T {
    struct Always;
    impl Wake for Always {
        fn wake(self: Arc<Self>) {}
    }
    let waker = Waker::from(Arc::new(Always));
    let mut context = Context::from_waker(&waker);
    let mut task = pin!(task);
    loop {
        if let Poll::Ready(result) = task.as_mut().poll(&mut context) {
            return result;
        }
        meanwhile();
    }
}
