//! Runs a board's firmware on an emulated microcontroller, and compares every frame that reaches its display with the host's
//! drawing of the same scene, over a whole turn. `boards/emulate/run` calls it, with what it needs:
//!
//! ```text
//! boards/emulate/run rp2040-st7789 IMAGE
//! ```
//!
//! An emulator (`rp2040.mjs`, `stm32f411.py`) reports the bytes on the bus, the pins, the log and the time; the display is a
//! model of its controller, which this program shares with the tests of the library (`tests/support/src/panel`). The first byte
//! that a real display would not have taken ends the run with an error.

mod boards;
mod events;
mod film;
mod log;
mod timing;
mod watch;

use boards::{Board, Chip, BOARDS};
use clap::{value_parser, Arg, Command};
use events::{Event, What};
use pinhole_apps_support::command::{matches, run, say};
use std::fs::File;
use std::io::{BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{self, ExitCode, Stdio};
use watch::{Frame, Watch};

/// The longest time for which no frame may end, in nanoseconds, and that after a fault of the bus.
const PATIENCE: u64 = 2_000_000_000;
const RECOVERY: u64 = 1_000_000_000;

fn main() -> ExitCode {
    run(|| {
        let mut given = matches(arguments())?;
        let name: String = given.remove_one("board").ok_or("no board")?;
        let image: PathBuf = given.remove_one("image").ok_or("no image")?;
        let tools: PathBuf = given.remove_one("tools").ok_or("no tools")?;
        let frames: Option<u32> = given.remove_one("frames");
        let break_at: Option<u32> = given.remove_one("break-bus");
        let break_by: String = given.remove_one("by").ok_or("no fault")?;
        let inputs: Option<String> = given.remove_one("inputs");
        let pictures: Option<PathBuf> = given.remove_one("pictures");
        let film: Option<PathBuf> = given.remove_one("film");
        let log: Option<PathBuf> = given.remove_one("log");
        let board = BOARDS.iter().find(|board| board.name == name);
        let board = board.ok_or_else(|| {
            let names: Vec<_> = BOARDS.iter().map(|board| board.name).collect();
            format!("{name}: not an emulated board; they are {}", names.join(", "))
        })?;
        let run = Run {
            frames: frames.unwrap_or(board.frames),
            break_at,
            break_by: &break_by,
            inputs: inputs.as_deref(),
            pictures: pictures.as_deref(),
            film: film.as_deref(),
            log: log.as_deref(),
        };
        let frames = emulate(board, &image, &tools, &run).map_err(|problem| format!("{name}: {problem}"))?;
        if !frames.is_empty() {
            say(format_args!("{name}: {}", summary(&frames)))?;
        }
        if inputs.is_some() {
            let steps: Vec<_> = frames.iter().map(|frame| frame.step.to_string()).collect();
            say(format_args!("{name}: steps: {}", steps.join(" ")))?;
        }
        Ok::<_, String>(ExitCode::SUCCESS)
    })
}

fn arguments() -> Command {
    let tools = concat!(env!("CARGO_MANIFEST_DIR"), "/../../target/emulate");
    let option = |name: &'static str, value: &'static str, help: &'static str| {
        Arg::new(name).long(name).value_name(value).help(help)
    };
    let file = || value_parser!(PathBuf);
    let about =
        "Runs a board's firmware on an emulated microcontroller and compares every frame with the host's";
    let image = "The linked firmware, an ELF file";
    let frames = "Frames to compare, in place of a turn";
    let break_bus = "Let the bus fail with this byte: the firmware must log it, and show whole frames again within a second";
    let by = "How it fails: DMA (or the bus, if the core sends that byte) reports an error, DMA stalls, or the panel is reset";
    let inputs = "Drive pins from outside, each from a time on: a frame then shows the step of the turn after or before the \
                  last one, and the steps are printed";
    let pictures = "What the frames must show, in place of what the host draws: all pixels of a frame of the turn, row by row, \
                    and the next frame behind them; two bytes each as the display's memory stores them, the high one first";
    let film = "Write what the display showed as a GIF file, at the speed of the board";
    let log = "Write the log into a file, a line for each message; the run ends with the line `report: end`";
    Command::new("emulate")
        .about(about)
        .arg(Arg::new("board").value_name("BOARD").required(true).help("Its folder in boards"))
        .arg(Arg::new("image").value_name("IMAGE").required(true).value_parser(file()).help(image))
        .arg(option("frames", "N", frames).value_parser(value_parser!(u32).range(2..)))
        .arg(option("break-bus", "BYTE", break_bus).value_parser(value_parser!(u32)))
        .arg(option("by", "FAULT", by).value_parser(["error", "stall", "reset"]).default_value("error"))
        .arg(option("inputs", "MS:PIN=LEVEL,...", inputs))
        .arg(option("pictures", "FILE", pictures).value_parser(file()))
        .arg(option("film", "FILE", film).value_parser(file()))
        .arg(option("log", "FILE", log).value_parser(file()))
        .arg(
            option("tools", "DIR", "Where boards/emulate/run has installed the emulators")
                .value_parser(file())
                .default_value(tools),
        )
}

/// The options of a run.
struct Run<'a> {
    /// Frames to compare.
    frames: u32,
    /// The byte with which the bus fails, and how.
    break_at: Option<u32>,
    break_by: &'a str,
    /// Changes of pins, as `rp2040.mjs` takes them.
    inputs: Option<&'a str>,
    /// The pictures that frames must show, in place of the host's drawing.
    pictures: Option<&'a Path>,
    /// Where to write the frames as a film.
    film: Option<&'a Path>,
    /// Where the log goes.
    log: Option<&'a Path>,
}

/// Runs the firmware and returns the frames that it has shown, all of which equal the host's drawing.
fn emulate(board: &Board, image: &Path, tools: &Path, run: &Run<'_>) -> Result<Vec<Frame>, String> {
    let &Run { frames, break_at, break_by, inputs, pictures, film, log: log_file } = run;
    let bytes = std::fs::read(image).map_err(|error| format!("{}: {error}", image.display()))?;
    let tables = log::Tables::of(&bytes).map_err(|problem| format!("{}: {problem}", image.display()))?;
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("../common/all/model.stl");
    let pictures = match pictures {
        Some(file) => boards::read(board, file)?,
        None => (board.pictures)(&model)?,
    };
    let mut watch = Watch::new(board, pictures);
    if film.is_some() {
        watch.keep_pictures();
    }
    let mut log = tables.decoder();
    let mut log_file = log_file.map(File::create).transpose().map_err(|error| format!("the log: {error}"))?;

    let mut emulator = emulator(&board.chip, image, tools, tables.address);
    if let Some(pin) = board.display.tearing {
        emulator.arg(format!("tearing={pin}"));
    }
    if let Some(inputs) = inputs {
        if !matches!(board.chip, Chip::Rp2040 { .. }) {
            return Err("nothing is connected to its inputs".into());
        }
        watch.allow_steps_back();
        emulator.arg(format!("inputs={inputs}"));
    }
    match (break_at, break_by) {
        (Some(byte), "reset") => watch.forget_at(byte),
        (Some(byte), fault) => {
            emulator.arg(format!("fail={byte}")).arg(format!("stalls={}", u8::from(fault == "stall")));
        }
        (None, _) => {}
    }
    emulator.stdin(Stdio::null()).stdout(Stdio::piped());
    let running = emulator.spawn().map_err(|error| format!("{:?}: {error}", emulator.get_program()))?;
    let mut running = Running(running);
    let mut events = BufReader::with_capacity(1 << 16, running.0.stdout.take().ok_or("no output")?);
    let mut last_line = String::from("none");
    let (mut problems, mut stack) = (0, None);
    // After a turn, the firmware logs its stack, before the next frame or with it.
    let wants_stack = frames == board.frames;
    while watch.frames().len() < frames as usize
        || watch.broken().is_some()
        || (wants_stack && stack.is_none() && watch.frames().len() == frames as usize)
    {
        let Some(event) = Event::read(&mut events).map_err(|error| error.to_string())? else {
            let status = running.0.wait().map_err(|error| error.to_string())?;
            return Err(format!("the emulator has ended, {status}"));
        };
        let shown = watch.frames().len();
        let at = |problem| format!("{problem}, at {:.3} ms, after {shown} frames", event.time as f64 / 1e6);
        if let What::Log(byte) = event.what {
            if let Some(line) = log.line(byte).map_err(at)? {
                if let Some(file) = &mut log_file {
                    writeln!(file, "{}", line.text).map_err(|error| format!("the log: {error}"))?;
                    if line.text == "report: end" {
                        return Ok(Vec::new());
                    }
                }
                if line.is_problem && break_at.is_none() {
                    return Err(at(format!("the firmware logs: {}", line.text)));
                }
                if line.is_problem {
                    say(format_args!("{}: the firmware logs: {}", board.name, line.text))?;
                    problems += 1;
                    watch.lose_frame();
                }
                if line.text.starts_with("stack: ") {
                    stack = Some(line.text.clone());
                }
                last_line = line.text;
            }
        }
        let since = watch.frames().last().map_or(0, |frame| frame.time);
        if event.time > since + PATIENCE {
            let seconds = PATIENCE / 1_000_000_000;
            return Err(at(format!("no frame for {seconds} s; the last line of the log: {last_line}")));
        }
        if watch.broken().is_some_and(|since| event.time > since + RECOVERY) {
            let problem = "no whole frame for 1 s after the bus has broken; the last line of the log";
            return Err(at(format!("{problem}: {last_line}")));
        }
        watch.event(event).map_err(at)?;
    }
    if break_at.is_some() && break_by != "reset" && problems == 0 {
        return Err("the bus has broken, and the firmware has not logged it".into());
    }
    let (refreshes, torn) = watch.refreshes();
    let tears = format!("{torn} of the panel's {refreshes} refreshes are torn: they show rows of two frames");
    if torn > 0 && break_at.is_none() && board.display.tearing.is_some() {
        return Err(tears);
    }
    say(format_args!("{}: {tears}", board.name))?;
    if let Some(file) = film {
        film::write(file, &board.display, watch.frames(), watch.kept())?;
    }
    if let Some(stack) = stack {
        say(format_args!("{}: {stack}", board.name))?;
    }
    Ok(watch.frames().get(..frames as usize).unwrap_or(watch.frames()).to_vec())
}

/// The command that runs an image on an emulated chip.
fn emulator(chip: &Chip, image: &Path, tools: &Path, log: u64) -> process::Command {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    match *chip {
        Chip::Rp2040 { spi, clock, data, select, command, reset } => {
            let mut node = process::Command::new("node");
            node.arg(folder.join("rp2040.mjs"));
            node.arg(tools.join("rom/thumbv6m-none-eabi/release/boot-rom")).arg(image);
            node.arg(format!("modules={}", tools.join("node").display()));
            node.args([format!("spi={spi}"), format!("wires={clock},{data}")]);
            node.args([format!("select={select}"), format!("command={command}")]);
            node.args([format!("watch={reset}"), format!("log={log}")]);
            node
        }
        Chip::Stm32f411 { clock, data, select, command, reset } => {
            let mut python = process::Command::new(tools.join("python/bin/python"));
            python.arg(folder.join("stm32f411.py")).arg(image);
            let hooks = format!("{}hooks{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
            let hooks = tools.join("hooks/release").join(hooks);
            python.arg(format!("hooks={}", hooks.display()));
            python.args([format!("wires={clock},{data}"), format!("select={select}")]);
            python.args([format!("command={command}"), format!("watch={reset}"), format!("log={log}")]);
            // No compiled modules beside the sources.
            python.env("PYTHONDONTWRITEBYTECODE", "1");
            python
        }
    }
}

/// An emulator, which is ended when this is dropped.
struct Running(process::Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill(); // it may have ended
        let _ = self.0.wait();
    }
}

/// A line about the time between the ends of the first and the last frame.
fn summary(frames: &[Frame]) -> String {
    let [first, .., last] = frames else { return "no time between frames".into() };
    let (count, time) = (frames.len() - 1, last.time - first.time);
    let bytes: usize = frames[1..].iter().map(|frame| frame.bytes).sum();
    format!(
        "{} frames equal, {:.1} frames/s, {:.0} % of the time waiting for the bus, {} bytes a frame",
        frames.len(),
        count as f64 * 1e9 / time as f64,
        (last.waited - first.waited) as f64 * 100.0 / time as f64,
        bytes / count
    )
}
