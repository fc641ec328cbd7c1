//! The firmware: draws in bands of eight rows, sends the areas that changed, and waits after each frame until the host has
//! taken its picture. At the end it reports the depth of its stack.

use crate::panel::{Error, Ssd0323};
use crate::show::{self, Display, Scratch, Screen, SolarSystem, FRAMES, SIZE, SOLAR_SYSTEM};
use core::cell::RefCell;
use core::fmt::Write;
use cortex_m as _; // its critical sections
use critical_section::Mutex;
use embedded_graphics::pixelcolor::{BinaryColor, Gray4};
use embedded_graphics::primitives::Rectangle;
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::SpiBus;
use lm3s6965evb::{stack, Board};
use pinhole::bands::Frame;

const ROWS: u32 = 8;

/// All memory but the stack and the nodes.
struct Memory {
    scratch: Scratch,
    colours: [u8; Frame::<Gray4>::strip_bytes(SIZE.width, ROWS)],
    depths: [u16; (SIZE.width * ROWS) as usize],
    bits: [u8; Frame::<BinaryColor>::strip_bytes(SIZE.width, ROWS)],
}

static MEMORY: Mutex<RefCell<Memory>> = Mutex::new(RefCell::new(Memory {
    scratch: Scratch::new(),
    colours: [0; Frame::<Gray4>::strip_bytes(SIZE.width, ROWS)],
    depths: [0; (SIZE.width * ROWS) as usize],
    bits: [0; Frame::<BinaryColor>::strip_bytes(SIZE.width, ROWS)],
}));

/// By themselves: a static that is not all zeros takes as much flash.
static NODES: Mutex<RefCell<SolarSystem>> = Mutex::new(RefCell::new(SOLAR_SYSTEM));

impl<SPI: SpiBus, DC: OutputPin> Display for Ssd0323<SPI, DC> {
    type Error = Error<SPI::Error, DC::Error>;

    fn write(&mut self, area: &Rectangle, pixels: &[u8]) -> Result<(), Self::Error> {
        Ssd0323::write(self, area, pixels)
    }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    stack::paint();
    let Board { spi, data_command, mut serial } = Board::take().expect("the first to take it");
    let mut panel = Ssd0323::new(spi, data_command).expect("a panel");
    let command = critical_section::with(|token| {
        let Memory { scratch, colours, depths, bits } = &mut *MEMORY.borrow_ref_mut(token);
        let nodes = &mut *NODES.borrow_ref_mut(token);
        let mut screen = Screen::new(&mut panel, colours, depths, bits);
        for frame in 0..FRAMES {
            scratch.draw(frame, nodes, &mut screen).expect("a panel");
            // Whoever looks answers: the next frame, or no more, but this for a command.
            let _ = writeln!(serial, "{frame} {} {}", screen.sent(), show::caption(frame));
            let answer = serial.read();
            if answer != b'\n' {
                return Some(answer);
            }
        }
        None
    });
    if let Some(command) = command {
        panel.command(&[command]).expect("a panel");
    }
    let _ = writeln!(serial, "end {}", stack::deepest());
    semihosting::process::exit(0)
}
