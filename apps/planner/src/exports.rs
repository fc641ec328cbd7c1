//! What the page calls. It writes a text or a file into the memory at `input(length)`, calls one of the functions below, and
//! reads what came of it at `output()`, `output_len()` bytes, and after `draw` the pixels at `pixels()`, `pixels_len()` bytes.
//! Each gives 1 where it succeeded; otherwise the output is a message.

use crate::choice::Choice;
use crate::planner::Planner;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The planner of the page, and what passes between both.
struct Desk {
    planner: Planner,
    input: Vec<u8>,
    output: Vec<u8>,
    pixels: Vec<u8>,
}

static DESK: Mutex<Option<Desk>> = Mutex::new(None);

/// A page has one thread: nobody waits here.
fn desk() -> MutexGuard<'static, Option<Desk>> {
    DESK.lock().unwrap_or_else(PoisonError::into_inner)
}

fn with<T>(call: impl FnOnce(&mut Desk) -> T) -> T {
    let new =
        || Desk { planner: Planner::default(), input: Vec::new(), output: Vec::new(), pixels: Vec::new() };
    call(desk().get_or_insert_with(new))
}

impl Desk {
    fn answer(&mut self, result: Result<String, String>) -> u32 {
        let is_good = result.is_ok();
        let (Ok(text) | Err(text)) = result;
        self.output = text.into_bytes();
        u32::from(is_good)
    }

    /// The parts of the input, with a zero byte between two.
    fn parts(&self) -> Result<Vec<String>, String> {
        let text = std::str::from_utf8(&self.input).map_err(|e| e.to_string())?;
        Ok(text.split('\0').map(str::to_owned).collect())
    }

    fn choice(&self) -> Result<Choice, String> {
        Choice::parse(std::str::from_utf8(&self.input).map_err(|e| e.to_string())?)
    }
}

/// Room for so many bytes.
#[unsafe(no_mangle)]
extern "C" fn input(length: usize) -> *mut u8 {
    with(|desk| {
        desk.input = vec![0; length];
        desk.input.as_mut_ptr()
    })
}

/// Where the output is.
#[unsafe(no_mangle)]
extern "C" fn output() -> *const u8 {
    with(|desk| desk.output.as_ptr())
}

/// How long the output is.
#[unsafe(no_mangle)]
extern "C" fn output_len() -> usize {
    with(|desk| desk.output.len())
}

/// Where the pixels are.
#[unsafe(no_mangle)]
extern "C" fn pixels() -> *const u8 {
    with(|desk| desk.pixels.as_ptr())
}

/// How many bytes the pixels have.
#[unsafe(no_mangle)]
extern "C" fn pixels_len() -> usize {
    with(|desk| desk.pixels.len())
}

/// Gives the menu.
#[unsafe(no_mangle)]
extern "C" fn menu() -> u32 {
    with(|desk| desk.answer(Ok(Planner::menu())))
}

/// Takes a file: its name in so many bytes, and after them its bytes.
#[unsafe(no_mangle)]
extern "C" fn load(name: usize) -> u32 {
    with(|desk| {
        let mut name_bytes = std::mem::take(&mut desk.input);
        let bytes = name_bytes.split_off(name.min(name_bytes.len()));
        desk.planner.load(&String::from_utf8_lossy(&name_bytes), bytes);
        desk.answer(Ok(String::new()))
    })
}

/// Takes a picture for textures: of so many pixels a row, red, green, blue and opacity of each.
#[unsafe(no_mangle)]
extern "C" fn picture(width: usize) -> u32 {
    with(|desk| {
        let bytes = std::mem::take(&mut desk.input);
        let loaded = desk.planner.load_picture(&bytes, width);
        desk.answer(loaded.map(|()| String::new()))
    })
}

/// Draws by a choice.
#[unsafe(no_mangle)]
extern "C" fn draw() -> u32 {
    with(|desk| {
        let drawn = desk.choice().and_then(|choice| desk.planner.draw(&choice));
        let drawn = drawn.map(|(pixels, what)| {
            desk.pixels = pixels;
            what
        });
        desk.answer(drawn)
    })
}

/// Gives the costs of a choice.
#[unsafe(no_mangle)]
extern "C" fn costs() -> u32 {
    with(|desk| {
        let costs = desk.choice().and_then(|choice| desk.planner.costs(&choice));
        desk.answer(costs)
    })
}

/// Gives a file of the firmware of a choice. The input has the choice, the path of the file and its text in the template.
#[unsafe(no_mangle)]
extern "C" fn firmware() -> u32 {
    with(|desk| {
        let file = desk.parts().and_then(|parts| match &parts[..] {
            [choice, path, text] => desk.planner.firmware(&Choice::parse(choice)?, path, text),
            _ => Err("not a choice, a path and a text".into()),
        });
        desk.answer(file)
    })
}

/// Gives the mesh of a choice as Rust.
#[unsafe(no_mangle)]
extern "C" fn rust() -> u32 {
    with(|desk| {
        let source = desk.choice().and_then(|choice| desk.planner.rust(&choice));
        desk.answer(source)
    })
}

/// Draws the next frame of a turn of the model, for a GIF file: with a choice the first one. Gives the frames that are done, and all
/// that there are, with a space between.
#[unsafe(no_mangle)]
extern "C" fn film() -> u32 {
    with(|desk| {
        let begins = if desk.input.is_empty() { Ok(None) } else { desk.choice().map(Some) };
        let frames = begins.and_then(|choice| desk.planner.film(choice.as_ref()));
        desk.answer(frames.map(|[done, all]| format!("{done} {all}")))
    })
}

/// Gives the GIF file of the frames that were drawn.
#[unsafe(no_mangle)]
extern "C" fn gif() -> u32 {
    with(|desk| match desk.planner.gif() {
        Ok(bytes) => {
            desk.output = bytes;
            1
        }
        Err(problem) => desk.answer(Err(problem)),
    })
}

/// Gives the name that the model's file has in the folder of a firmware, a zero byte, and its bytes.
#[unsafe(no_mangle)]
extern "C" fn model() -> u32 {
    with(|desk| {
        let model = desk.choice().and_then(|choice| desk.planner.model(&choice));
        match model {
            Ok((name, bytes)) => {
                desk.output = [name.as_bytes(), &[0], &bytes].concat();
                1
            }
            Err(problem) => desk.answer(Err(problem)),
        }
    })
}

/// C++'s memory, for decimation: no library of C++ is linked.
#[cfg(all(target_family = "wasm", feature = "decimate"))]
mod memory {
    use std::sync::{Mutex, PoisonError};

    /// The blocks in use. A vector that moves leaves its elements where they are.
    static BLOCKS: Mutex<Vec<Vec<u64>>> = Mutex::new(Vec::new());

    /// `operator new(unsigned long)`.
    #[unsafe(no_mangle)]
    extern "C" fn _Znwm(bytes: usize) -> *mut u64 {
        let mut block = vec![0; bytes.div_ceil(8).max(1)];
        let start = block.as_mut_ptr();
        BLOCKS.lock().unwrap_or_else(PoisonError::into_inner).push(block);
        start
    }

    /// `operator delete(void *)`.
    #[unsafe(no_mangle)]
    extern "C" fn _ZdlPv(start: *mut u64) {
        BLOCKS.lock().unwrap_or_else(PoisonError::into_inner).retain(|block| block.as_ptr() != start);
    }
}
