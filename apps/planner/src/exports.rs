//! The functions that the page calls. The page writes a text or a file into the memory at `input(length)`, calls one of the
//! functions below, and reads the result at `output()`, `output_len()` bytes, and after `draw` also the pixels at `pixels()`,
//! `pixels_len()` bytes. Each function returns 1 on success; otherwise the output is JSON: a message,
//! and the buttons of its remedies.

use crate::choice::Choice;
use crate::planner::Planner;
use crate::warning::Refusal;
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};

/// The planner of the page, with its input and output.
#[derive(Default)]
struct Desk {
    planner: Planner,
    input: Vec<u8>,
    output: Vec<u8>,
    pixels: Vec<u8>,
}

static DESK: LazyLock<Mutex<Desk>> = LazyLock::new(Mutex::default);

// A page has one thread, so the lock is always free.
fn desk() -> MutexGuard<'static, Desk> {
    DESK.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Desk {
    fn bytes(&mut self, result: Result<Vec<u8>, Refusal>) -> u32 {
        let is_good = result.is_ok();
        self.output = result.unwrap_or_else(|problem| problem.json().into_bytes());
        u32::from(is_good)
    }

    fn answer(&mut self, result: Result<String, Refusal>) -> u32 {
        self.bytes(result.map(String::into_bytes))
    }

    /// The parts of the input, which zero bytes separate.
    fn parts(&self) -> Result<Vec<String>, Refusal> {
        Ok(self.text()?.split('\0').map(str::to_owned).collect())
    }

    fn choice(&self) -> Result<Choice, Refusal> {
        Ok(Choice::parse(self.text()?)?)
    }

    fn text(&self) -> Result<&str, Refusal> {
        std::str::from_utf8(&self.input).map_err(|_| "the page sent a text that is not UTF-8".into())
    }
}

/// Exports a function for each row.
macro_rules! exports {
    ($($(#[$about:meta])* $name:ident($($argument:ident)?) -> $result:ty: |$desk:ident| $answer:expr;)*) => {$(
        $(#[$about])*
        #[unsafe(no_mangle)]
        extern "C" fn $name($($argument: usize)?) -> $result {
            let $desk = &mut *desk();
            $answer
        }
    )*};
}

exports! {
    /// Makes room for `length` bytes of input, and returns its address.
    input(length) -> *mut u8: |desk| {
        desk.input = vec![0; length];
        desk.input.as_mut_ptr()
    };

    /// The address of the output, and its length in bytes.
    output() -> *const u8: |desk| desk.output.as_ptr();
    output_len() -> usize: |desk| desk.output.len();

    /// The address of the pixels, and their length in bytes.
    pixels() -> *const u8: |desk| desk.pixels.as_ptr();
    pixels_len() -> usize: |desk| desk.pixels.len();

    /// Outputs the menu.
    menu() -> u32: |desk| desk.answer(Ok(Planner::menu()));

    /// Takes a file. The input is its name, of `name` bytes, followed by its content.
    load(name) -> u32: |desk| {
        let mut name_bytes = std::mem::take(&mut desk.input);
        let bytes = name_bytes.split_off(name.min(name_bytes.len()));
        desk.planner.load(&String::from_utf8_lossy(&name_bytes), bytes);
        desk.answer(Ok(String::new()))
    };

    /// Takes a picture for textures, of `width` pixels a row. The input has red, green, blue and opacity of each pixel.
    picture(width) -> u32: |desk| {
        let bytes = std::mem::take(&mut desk.input);
        let loaded = desk.planner.load_picture(&bytes, width);
        desk.answer(loaded.map(|()| String::new()))
    };

    /// Draws a frame. The input is a choice.
    draw() -> u32: |desk| {
        let drawn = desk.choice().and_then(|choice| desk.planner.draw(&choice));
        let drawn = drawn.map(|(pixels, what)| {
            desk.pixels = pixels;
            what
        });
        desk.answer(drawn)
    };

    /// Outputs the costs of a choice.
    costs() -> u32: |desk| {
        let costs = desk.choice().and_then(|choice| desk.planner.costs(&choice));
        desk.answer(costs)
    };

    /// Outputs a file of a choice's firmware. The input is the choice, the path of the file, and its text in the template.
    firmware() -> u32: |desk| {
        let file = desk.parts().and_then(|parts| match &parts[..] {
            [choice, path, text] => desk.planner.firmware(&Choice::parse(choice)?, path, text),
            _ => Err("not a choice, a path and a text".into()),
        });
        desk.answer(file)
    };

    /// Outputs the mesh of a choice as Rust.
    rust() -> u32: |desk| {
        let source = desk.choice().and_then(|choice| desk.planner.rust(&choice));
        desk.answer(source)
    };

    /// Draws the next frame of a turn of the model, for a GIF file. If the input is a choice, the frame is the first. Outputs the
    /// number of frames done and the number of all frames, with a space between them.
    film() -> u32: |desk| {
        let begins = if desk.input.is_empty() { Ok(None) } else { desk.choice().map(Some) };
        let frames = begins.and_then(|choice| desk.planner.film(choice.as_ref()));
        desk.answer(frames.map(|[done, all]| format!("{done} {all}")))
    };

    /// Outputs the GIF file of the frames that were drawn.
    gif() -> u32: |desk| {
        let file = desk.planner.gif();
        desk.bytes(file)
    };

    /// Outputs the files of the model in the folder of a firmware: for each its name and its length, with a zero byte after each, and
    /// its bytes.
    model() -> u32: |desk| {
        let files = desk.choice().and_then(|choice| desk.planner.model(&choice));
        let file = |(name, bytes): (String, Vec<u8>)| {
            [format!("{name}\0{}\0", bytes.len()).into_bytes(), bytes].concat()
        };
        desk.bytes(files.map(|files| files.into_iter().flat_map(file).collect()))
    };
}

/// Memory for the C++ code of the decimation, because no C++ library is linked.
#[cfg(all(target_family = "wasm", feature = "decimate"))]
mod memory {
    use std::sync::{Mutex, PoisonError};

    /// The blocks in use. Moving a vector leaves its elements where they are, so addresses stay valid.
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
