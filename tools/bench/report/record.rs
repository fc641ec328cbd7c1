//! The instructions of counted frames, one after the other, from the log that QEMU writes when it executes one instruction at a time:
//! of an Arm core with the registers before each instruction, of RISC-V its address alone.

use crate::core::Core;
use crate::provenance::{Frame, STEP};
use crate::timing::program::{Conditions, Executed, Program, State};
use crate::{elf, Result, RV32};
use std::io::{BufRead, BufReader, Read};
use std::ops::Range;
use std::path::Path;
use std::process::{ChildStderr, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// A log that is named as a file is written line by line, a plain stderr word by word.
const LOG: [&str; 5] = ["-singlestep", "-D", "/dev/stderr", "-d", "cpu,nochain"];
const LOG_OF_ADDRESSES: [&str; 5] = ["-singlestep", "-D", "/dev/stderr", "-d", "exec,nochain"];

/// `Clock::count` is called this often before it counts a frame: by `Clock::new`.
const EARLIER: u32 = 3;

/// How far apart the clock's count and the log's may be. The clock takes off what it costs to call nothing, which is a little
/// more than what calls the frame.
pub(crate) const APART: u64 = 4;

/// The frames of an image that are counted.
pub(crate) struct Frames {
    pub(crate) program: Program,
    pub(crate) frames: Vec<Recorded>,
}

/// A frame, and the address of the instruction after it.
pub(crate) struct Recorded {
    pub(crate) run: Vec<Executed>,
    pub(crate) end: u32,
}

/// The addresses of the first function whose name passes the test.
pub(crate) fn function(
    image: &Path,
    places: &[Vec<Frame>],
    is_it: impl Fn(&str) -> bool,
) -> Result<Range<u32>> {
    let name = |place: &Vec<Frame>| place.last().map(|frame| frame.function.clone()).unwrap_or_default();
    let at = places.iter().position(|place| is_it(&name(place)));
    let at = at.ok_or_else(|| format!("{}: no such function", image.display()))?;
    // An assembler's label, such as that of reading a counter of RISC-V, hides the function's name.
    let is_in = |place: &&Vec<Frame>| name(place) == name(&places[at]) || name(place).starts_with(".L");
    let count = places[at..].iter().take_while(is_in).count();
    let start = elf::sizes(image)?.code.start + STEP * at as u64;
    Ok(u32::try_from(start)?..u32::try_from(start + STEP * count as u64)?)
}

/// Limits QEMU's log to the code that can run while the clock counts a frame: not what paints the stack or adds up a
/// checksum, which takes most of the time of a run.
fn filter(image: &Path, places: &[Vec<Frame>]) -> Result<[String; 2]> {
    let is_elsewhere = |frame: &Frame| {
        frame.file.ends_with("src/stack.rs")
            || ["Checksum", "Clock::turns", "Clock>::turns"].iter().any(|name| frame.function.contains(name))
    };
    let start = elf::sizes(image)?.code.start;
    let (mut ranges, mut left_out): (Vec<Range<u64>>, bool) = (Vec::new(), false);
    for (at, place) in (start..).step_by(STEP as usize).zip(places) {
        // The first of these may be what the call of a frame returns to.
        let first = !std::mem::replace(&mut left_out, place.iter().any(is_elsewhere));
        if left_out && !first {
            continue;
        }
        match ranges.last_mut() {
            Some(last) if last.end == at => last.end = at + STEP,
            _ => ranges.push(at..at + STEP),
        }
    }
    let ranges: Vec<String> =
        ranges.iter().map(|range| format!("{:#x}..{:#x}", range.start, range.end - 1)).collect();
    Ok(["-dfilter".into(), ranges.join(",")])
}

/// Runs an image and records its first `count` frames.
pub(crate) fn record(core: Core, image: &Path, places: &[Vec<Frame>], count: usize) -> Result<Frames> {
    let has_registers = core.build().target != RV32;
    let clock = function(image, places, |name| name.contains("Clock") && name.ends_with("count"))?;
    let mut command = core.emulate(image);
    command.args(if has_registers { LOG } else { LOG_OF_ADDRESSES }).args(filter(image, places)?);
    let mut qemu = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn()?;
    let mut lines = BufReader::with_capacity(1 << 20, Paused(qemu.stderr.take().ok_or("its log")?));
    let mut recorder = Recorder { program: Program::of(image)?, clock, has_registers, ..Recorder::default() };
    let mut line = Vec::new();
    while recorder.frames.len() < count {
        line.clear();
        if lines.read_until(b'\n', &mut line)? == 0 {
            break;
        }
        match has_registers {
            true => recorder.read(&line),
            false => recorder.read_address(&line),
        }
    }
    // QEMU is stopped: only the frames are needed.
    let _ = qemu.kill();
    qemu.wait()?;
    let Recorder { program, frames, .. } = recorder;
    match frames.len() {
        found if found == count => Ok(Frames { program, frames }),
        found => Err(format!("{}: {found} of {count} frames in QEMU's log", image.display()).into()),
    }
}

/// Reads what a pipe holds after a pause of about as long as it takes to fill it. QEMU writes line by line, and a reader that waits
/// for the pipe is woken by each line, which takes both more time than all else.
struct Paused(ChildStderr);

impl Read for Paused {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        sleep(Duration::from_micros(300));
        self.0.read(into)
    }
}

#[derive(Default)]
struct Recorder {
    program: Program,
    has_registers: bool,
    /// The function that starts and stops the clock.
    clock: Range<u32>,
    /// The state before the instruction that is being read, and before the one before it.
    state: State,
    before: State,
    conditions: Conditions,
    /// The number of calls of the clock.
    calls: u32,
    /// The instruction before this one; and, where the log has no registers, the one that was named last, which is not executed if
    /// QEMU must do something else first.
    last: u32,
    named: Option<u32>,
    /// While a frame is recorded: the address to which the clock's call of it returns, once the clock has called it.
    back: Option<Option<u32>>,
    run: Vec<Executed>,
    frames: Vec<Recorded>,
}

impl Recorder {
    /// A line of the registers: `R04=00000000 R05=...` or `XPSR=...`, the last of an instruction.
    fn read(&mut self, line: &[u8]) {
        if let Some(flags) = line.strip_prefix(b"XPSR=") {
            self.state.flags = hexadecimal(flags);
            // QEMU names an instruction twice if it has to see to something else first.
            if self.state != self.before {
                self.execute();
                self.before = self.state;
            }
        } else if line.starts_with(b"R") {
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

    /// A line of an address: `Trace 0: 0x7f... [00000000/0000000080000000/...]`.
    fn read_address(&mut self, line: &[u8]) {
        if line.starts_with(b"Stopped") {
            self.named = None;
        } else if let Some(digits) =
            line.strip_prefix(b"Trace ").and_then(|line| line.split(|&b| b == b'/').nth(1))
        {
            let address = hexadecimal(&digits[digits.len().saturating_sub(8)..]);
            if let Some(at) = self.named.replace(address) {
                self.state.registers[15] = at;
                self.execute();
            }
        }
    }

    fn execute(&mut self) {
        let at = self.state.registers[15];
        if at == self.clock.start {
            self.calls += 1;
            if self.calls > EARLIER {
                (self.back, self.run) = (Some(None), Vec::new());
            }
        }
        match self.back {
            Some(Some(end)) if at == end => {
                self.back = None;
                self.frames.push(Recorded { run: std::mem::take(&mut self.run), end });
            }
            // The clock has called the frame: by BLX, of two bytes, or RISC-V's c.jalr or jalr.
            Some(None) if !self.clock.contains(&at) => {
                let is_wide = !self.has_registers && self.program.half(self.last) & 3 == 3;
                self.back = Some(Some(self.last + if is_wide { 4 } else { 2 }));
                self.push();
            }
            Some(Some(_)) => self.push(),
            _ => {}
        }
        self.last = at;
    }

    fn push(&mut self) {
        self.run.push(match self.has_registers {
            true => self.program.record(&self.state, &mut self.conditions),
            false => Executed::at(self.state.registers[15]),
        });
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
