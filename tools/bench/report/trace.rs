//! The instructions of the frame that is counted, one after the other: from the log that QEMU writes of the blocks of code
//! that it executes.

use crate::core::Core;
use crate::log::lines;
use crate::provenance::{Frame, STEP};
use crate::timing::program::Executed;
use crate::{elf, Result};
use std::collections::HashMap;
use std::io::BufRead;
use std::ops::Range;
use std::path::Path;
use std::process::Stdio;

/// QEMU translates a block once, and logs its instructions then (`in_asm`); after that it says each time that it enters one
/// (`exec`), if blocks are not chained. A log that is named as a file is written line by line, a plain stderr word by word.
const LOG: [&str; 4] = ["-d", "exec,nochain,in_asm", "-D", "/dev/stderr"];

/// `Clock::count` is called this often before it counts the frame: by `Clock::new`.
pub(crate) const EARLIER: u32 = 3;

/// The address of `Clock::count`, given the frames at every [`STEP`] of the code.
pub(crate) fn clock(image: &Path, places: &[Vec<Frame>]) -> Result<u64> {
    let counts = |place: &Vec<Frame>| {
        place.last().is_some_and(|f| f.function.contains("Clock") && f.function.ends_with("count"))
    };
    let at = places.iter().position(counts).ok_or("no Clock::count")?;
    Ok(elf::sizes(image)?.code.start + STEP * at as u64)
}

/// The addresses of `Clock::count`.
pub(crate) fn clock_code(image: &Path, places: &[Vec<Frame>]) -> Result<Range<u32>> {
    let start = clock(image, places)?;
    let at = ((start - elf::sizes(image)?.code.start) / STEP) as usize;
    let name = |place: &Vec<Frame>| place.last().map(|frame| frame.function.clone());
    let count = places[at..].iter().take_while(|place| name(place) == name(&places[at])).count();
    Ok(u32::try_from(start)?..u32::try_from(start + STEP * count as u64)?)
}

/// The counted part of a run of `Clock::count`, and the address after it: from the call by its only `BLX`, of two bytes.
pub(crate) fn counted(run: &[Executed], clock: Range<u32>) -> Result<(&[Executed], u32)> {
    let outside = |executed: &Executed| !clock.contains(&executed.at);
    let start = run.iter().position(outside).filter(|start| *start > 0).ok_or("the clock counts nothing")?;
    let end = run[start - 1].at + 2;
    let length = run[start..].iter().position(|executed| executed.at == end);
    Ok((&run[start..start + length.ok_or("a frame does not return to the clock")?], end))
}

/// Limits QEMU's log to the code that can run while the clock counts a frame: not what paints the stack or adds up a
/// checksum, which takes most of the time of a run.
pub(crate) fn filter(image: &Path, places: &[Vec<Frame>]) -> Result<[String; 2]> {
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

/// Whether a function runs only outside of frames, and long.
fn is_elsewhere(frame: &Frame) -> bool {
    frame.file.ends_with("src/stack.rs")
        || ["Checksum", "Clock::turns", "Clock>::turns"].iter().any(|name| frame.function.contains(name))
}

/// The state of reading the log.
#[derive(Default)]
struct Log {
    /// The instruction addresses of each block, by the block's address in QEMU's cache.
    blocks: HashMap<u64, Vec<u64>>,
    /// The block that is being translated.
    new: Option<Vec<u64>>,
    /// The block that was entered; it is not executed if QEMU must do something else first.
    entered: Option<u64>,
    /// The block that was executed before it.
    before: Vec<u64>,
    /// The number of calls of the clock, and the address to which the clock returns in the counted frame, which lies after this
    /// instruction.
    calls: u32,
    call: Option<u64>,
}

/// Hands `each` the addresses of the instructions of the first frame, block by block, in their order.
pub(crate) fn frame(
    core: Core,
    image: &Path,
    places: &[Vec<Frame>],
    mut each: impl FnMut(&[u64]),
) -> Result<()> {
    frames(core, image, places, 1, |_, block| each(block))
}

/// Hands `each` the number of the frame and the addresses of its instructions, block by block, in their order.
pub(crate) fn frames(
    core: Core,
    image: &Path,
    places: &[Vec<Frame>],
    count: usize,
    mut each: impl FnMut(usize, &[u64]),
) -> Result<()> {
    let clock = clock(image, places)?;
    let mut command = core.emulate(image);
    command.args(LOG).args(filter(image, places)?);
    let mut qemu = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn()?;
    let mut lines = lines(qemu.stderr.take().ok_or("its log")?);
    let (mut line, mut log, mut number) = (Vec::new(), Log::default(), 0);
    while number < count {
        line.clear();
        if lines.read_until(b'\n', &mut line)? == 0 {
            break;
        }
        if log.read(&line, clock, &mut |block| each(number, block)) {
            (log.call, number) = (None, number + 1);
        }
    }
    // QEMU is stopped: only the frames are needed.
    let _ = qemu.kill();
    qemu.wait()?;
    match number == count {
        true => Ok(()),
        false => Err(format!("{}: {number} of {count} frames in QEMU's log", image.display()).into()),
    }
}

impl Log {
    /// Whether the frame is over.
    fn read(&mut self, line: &[u8], clock: u64, each: &mut impl FnMut(&[u64])) -> bool {
        if line.starts_with(b"IN:") {
            self.new = Some(Vec::new());
        } else if line.starts_with(b"Stopped") {
            self.entered = None;
        } else if let (Some(new), Some(address)) = (&mut self.new, line.strip_prefix(b"0x")) {
            new.extend(hexadecimal(address));
        } else if let Some(entry) = line.strip_prefix(b"Trace ") {
            let over = self.execute(clock, each);
            // `0: 0x<where QEMU keeps it> […]`
            let kept = entry.splitn(2, |&byte| byte == b'x').nth(1).and_then(hexadecimal);
            if let (Some(kept), Some(new)) = (kept, self.new.take()) {
                self.blocks.insert(kept, new);
            }
            self.entered = kept;
            return over;
        }
        false
    }

    /// Takes the block that was entered last as executed. Returns whether it lies after the frame.
    fn execute(&mut self, clock: u64, each: &mut impl FnMut(&[u64])) -> bool {
        let Some(block) = self.entered.and_then(|kept| self.blocks.get(&kept)) else { return false };
        let first = block.first().copied().unwrap_or_default();
        if first == clock {
            self.calls += 1;
            if self.calls > EARLIER {
                self.call = self.before.last().copied();
            }
        }
        if let Some(call) = self.call {
            // The call takes two bytes or four.
            if (call + 1..=call + 4).contains(&first) {
                return true;
            }
            each(block);
        }
        self.before.clone_from(block);
        false
    }
}

/// The hexadecimal number at the start.
fn hexadecimal(text: &[u8]) -> Option<u64> {
    let digits = text.iter().position(|byte| !byte.is_ascii_hexdigit()).unwrap_or(text.len());
    u64::from_str_radix(std::str::from_utf8(text.get(..digits)?).ok()?, 16).ok()
}
