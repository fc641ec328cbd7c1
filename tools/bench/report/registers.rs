//! The registers before each instruction of the frames that are counted: from the log that QEMU writes when it executes one
//! instruction at a time.

use crate::core::Core;
use crate::log::lines;
use crate::provenance::Frame;
use crate::timing::program::{Conditions, Executed, Program, State};
use crate::trace::{clock_code, counted, filter, EARLIER};
use crate::{elf, provenance, Result};
use std::io::BufRead;
use std::path::Path;
use std::process::Stdio;

/// The state of the core before each instruction.
const LOG: [&str; 5] = ["-singlestep", "-d", "cpu,nochain", "-D", "/dev/stderr"];

/// The frames of an image that are counted, one after the other.
pub(crate) struct Frames {
    pub(crate) program: Program,
    pub(crate) frames: Vec<Recorded>,
}

/// A frame, and the address of the instruction after it.
pub(crate) struct Recorded {
    pub(crate) run: Vec<Executed>,
    pub(crate) end: u32,
}

/// The address of the first function of this name.
pub(crate) fn function(image: &Path, places: &[Vec<Frame>], name: &str) -> Result<u32> {
    let named = |place: &Vec<Frame>| place.last().is_some_and(|frame| frame.function.ends_with(name));
    let at = places.iter().position(named).ok_or_else(|| format!("{}: no {name}", image.display()))?;
    Ok(u32::try_from(elf::sizes(image)?.code.start + provenance::STEP * at as u64)?)
}

/// Runs an image and records its first `count` frames.
pub(crate) fn record(core: Core, image: &Path, places: &[Vec<Frame>], count: usize) -> Result<Frames> {
    let clock = clock_code(image, places)?;
    let mut command = core.emulate(image);
    command.args(LOG).args(filter(image, places)?);
    let mut qemu = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn()?;
    let mut lines = lines(qemu.stderr.take().ok_or("its log")?);
    let mut recorder = Recorder { program: Program::of(image)?, clock: clock.start, ..Recorder::default() };
    let mut line = Vec::new();
    while recorder.frames.len() < count {
        line.clear();
        if lines.read_until(b'\n', &mut line)? == 0 {
            break;
        }
        recorder.read(&line);
    }
    // QEMU is stopped: only the frames are needed.
    let _ = qemu.kill();
    qemu.wait()?;
    match recorder.frames.len() {
        found if found == count => {
            let frame = |run: Vec<Executed>| {
                let (run, end) = counted(&run, clock.clone())?;
                Ok(Recorded { run: run.to_vec(), end })
            };
            let frames = recorder.frames.into_iter().map(frame).collect::<Result<_>>()?;
            Ok(Frames { program: recorder.program, frames })
        }
        found => Err(format!("{}: {found} of {count} frames in QEMU's log", image.display()).into()),
    }
}

#[derive(Default)]
struct Recorder {
    program: Program,
    /// The address of the function that starts and stops the clock.
    clock: u32,
    /// The state before the instruction that is being read, and before the one before it.
    state: State,
    before: State,
    conditions: Conditions,
    /// The number of calls of the clock.
    calls: u32,
    /// The address to which the clock returns from a frame, while the frame lasts.
    back: Option<u32>,
    run: Vec<Executed>,
    frames: Vec<Vec<Executed>>,
}

impl Recorder {
    fn read(&mut self, line: &[u8]) {
        if let Some(flags) = line.strip_prefix(b"XPSR=") {
            self.state.flags = hexadecimal(flags);
            // QEMU names an instruction twice if it has to see to something else first.
            if self.state != self.before {
                self.execute();
                self.before = self.state;
            }
        } else if line.starts_with(b"R") {
            // `R04=00000000 R05=...`
            for register in line.chunks(13) {
                let number = register.get(1..3).map_or(0, |digits| 10 * value(digits[0]) + value(digits[1]));
                if let (Some(to), Some(digits)) =
                    (self.state.registers.get_mut(number as usize), register.get(4..12))
                {
                    *to = hexadecimal(digits);
                }
            }
        }
    }

    fn execute(&mut self) {
        let at = self.state.registers[15];
        if let Some(back) = self.back {
            if at == back {
                self.back = None;
                self.frames.push(std::mem::take(&mut self.run));
                return;
            }
        } else if at == self.clock {
            self.calls += 1;
            if self.calls > EARLIER {
                // The link register, without the bit that says Thumb.
                self.back = Some(self.state.registers[14] & !1);
            }
        }
        if self.back.is_some() {
            let executed = self.program.record(&self.state, &mut self.conditions);
            self.run.push(executed);
        }
    }
}

fn value(digit: u8) -> u32 {
    match digit {
        b'0'..=b'9' => u32::from(digit - b'0'),
        b'a'..=b'f' => u32::from(digit - b'a') + 10,
        _ => 0,
    }
}

/// A number of up to eight hexadecimal digits.
fn hexadecimal(digits: &[u8]) -> u32 {
    digits.iter().take(8).fold(0, |sum, digit| sum << 4 | value(*digit))
}
