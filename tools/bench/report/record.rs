//! The instructions of counted frames, one after the other, from the log that QEMU writes when it executes one instruction at a time:
//! of an Arm core with the registers before each instruction, of RISC-V its address alone.

use crate::core::{emulate, Core};
use crate::elf::{self, frames, Place, STEP};
use crate::timing::decode::Instruction;
use crate::timing::program::{Conditions, Executed, Program, State};
use crate::{Result, RV32};
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

/// The first frame that an image counts.
pub(crate) struct Frame {
    pub(crate) program: Program,
    pub(crate) run: Vec<Executed>,
    /// The address of the instruction behind the frame.
    pub(crate) end: u32,
    /// The address of the function that takes the pixels of a band, if the image has one.
    pub(crate) mark: Option<u32>,
    /// Bytes of the image's mesh and other constants.
    pub(crate) constants: u64,
}

/// The addresses of the first function whose name passes the test.
fn function(code: &Range<u64>, places: &[Place], is_it: impl Fn(&str) -> bool) -> Option<Range<u32>> {
    let name = |place: &Place| place.last().map(|frame| frame.function.clone()).unwrap_or_default();
    let at = places.iter().position(|place| is_it(&name(place)))?;
    // An assembler's label, such as that of reading a counter of RISC-V, hides the function's name.
    let is_in = |place: &&Place| name(place) == name(&places[at]) || name(place).starts_with(".L");
    let count = places[at..].iter().take_while(is_in).count();
    let start = u32::try_from(code.start).ok()? + STEP as u32 * at as u32;
    Some(start..start + STEP as u32 * count as u32)
}

/// Limits QEMU's log to the code that can run while the clock counts a frame: not what paints the stack or adds up a
/// checksum, which takes most of the time of a run.
fn filter(code: &Range<u64>, places: &[Place]) -> [String; 2] {
    let is_elsewhere = |frame: &elf::Frame| {
        frame.file.ends_with("src/stack.rs")
            || ["Checksum", "Clock::turns", "Clock>::turns"].iter().any(|name| frame.function.contains(name))
    };
    let (mut ranges, mut left_out): (Vec<Range<u64>>, bool) = (Vec::new(), false);
    for (at, place) in (code.start..).step_by(STEP as usize).zip(places) {
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
    ["-dfilter".into(), ranges.join(",")]
}

/// Runs an image and records its first frame.
pub(crate) fn record(core: Core, image: &Path) -> Result<Frame> {
    let has_registers = core.target != RV32;
    let (elf::Sizes { flash, code, bytes, .. }, places) = (elf::sizes(image)?, frames(image)?);
    let named = |what: &str| format!("{}: {what}", image.display());
    let clock = function(&code, &places, |name| name.contains("Clock") && name.ends_with("count"));
    let mut command = emulate(core.name, image);
    command.args(if has_registers { LOG } else { LOG_OF_ADDRESSES }).args(filter(&code, &places));
    let mut qemu = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn()?;
    let mut lines = BufReader::with_capacity(1 << 20, Paused(qemu.stderr.take().ok_or("its log")?));
    let mut recorder = Recorder {
        program: Program::new(
            u32::try_from(code.start)?,
            bytes.as_chunks().0.iter().map(|pair| u16::from_le_bytes(*pair)).collect(),
            if has_registers { Instruction::thumb } else { Instruction::riscv },
        ),
        clock: clock.ok_or_else(|| named("no clock"))?,
        has_registers,
        ..Recorder::default()
    };
    let mut line = Vec::new();
    while recorder.end.is_none() {
        line.clear();
        if lines.read_until(b'\n', &mut line)? == 0 {
            break;
        }
        match has_registers {
            true => recorder.read(&line),
            false => recorder.read_address(&line),
        }
    }
    // QEMU is stopped: only the frame is needed.
    let _ = qemu.kill();
    qemu.wait()?;
    let Recorder { program, run, end, .. } = recorder;
    let end = end.ok_or_else(|| named("no frame in QEMU's log"))?;
    let takes = |name: &str| name.ends_with("take_bytes");
    let mark = function(&code, &places, takes).map(|range| range.start);
    Ok(Frame { program, run, end, mark, constants: flash - (code.end - code.start) })
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
    end: Option<u32>,
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
                let [b'R', tens, ones, b'=', digits @ ..] = register else { continue };
                let number = 10 * (tens - b'0') + (ones - b'0');
                self.state.registers[usize::from(number & 15)] = hexadecimal(digits);
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
            Some(Some(end)) if at == end && self.end.is_none() => {
                (self.back, self.end) = (None, Some(end));
            }
            // The clock has called the frame.
            Some(None) if !self.clock.contains(&at) => {
                self.back = Some(Some(self.last + self.program.size(self.last)));
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

/// A number of up to eight hexadecimal digits.
fn hexadecimal(digits: &[u8]) -> u32 {
    let value = |digit: u8| char::from(digit).to_digit(16).unwrap_or(0);
    digits.iter().take(8).fold(0, |sum, digit| sum << 4 | value(*digit))
}
