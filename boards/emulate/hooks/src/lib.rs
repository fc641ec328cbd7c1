//! The emulated STM32F411 in every basic block and for every byte on its bus, as callbacks for Unicorn.
//!
//! A turn of the board is 60 million blocks and 30 million accesses to SPI1. A callback in Python takes half a microsecond, one
//! of these functions some nanoseconds. Everything else is in `stm32f411.py`, which makes a [`Hooks`], calls the functions here,
//! and is called back for rare events.
#![allow(unsafe_code)] // callbacks by pointer, from C and to Python

use std::cell::Cell;

/// Additional cycles of an access to a peripheral.
const PERIPHERAL: u64 = 2;
/// Additional cycles of a branch that is taken.
const TAKEN: u64 = 1;
/// Rounds after which `skip` may count down a loop of one block.
const ROUNDS: u64 = 100;
/// Bytes of such a loop: two short instructions.
const COUNTDOWN: u32 = 4;

const FLASH: u64 = 0x0800_0000;
/// Halfwords of flash: an instruction begins at each of them.
const HALFWORDS: usize = 256 << 10;
/// The number of records that are collected before they are written.
const RECORDS: usize = 8192;

/// Offsets of SPI1's status and data in the page of its registers.
const STATUS: u64 = 0x08;
const DATA: u64 = 0x0c;
const RXNE: u64 = 1 << 0;
const TXE: u64 = 1 << 1;
const OVERRUN: u64 = 1 << 6;
const BUSY: u64 = 1 << 7;

/// Offset of DMA2's status of streams 0 to 3 in the page of its registers, and from SPI1's page to that page.
const DMA_STATUS: u64 = 0x400;
const DMA_PAGE: u64 = 0x1_3000;
/// Flags of stream 3 in it.
const DMA_ERROR: u64 = 1 << 25;
const DMA_COMPLETE: u64 = 1 << 27;
/// What the byte `fail_at` does to DMA, besides an overrun of SPI1: see [`Hooks::dma_on`].
const STALLED: u64 = 2;

/// Kinds of records: see `rp2040.mjs`.
const BYTE: u64 = 0x00;
const BROKEN: u64 = 0x50;

/// The value that stands for none, in [`Hooks::waiting`] and other fields.
const NONE: u64 = u64::MAX;

/// The state shared with `stm32f411.py`, which declares the fields in the same order. Fields are `Cell`s, because functions that
/// are called back change them, too.
#[repr(C)]
pub struct Hooks {
    /// Time: the cycles since power on, and since the last change of the frequency.
    cycles: Cell<u64>,
    since: Cell<u64>,
    nanoseconds: Cell<u64>,
    frequency: Cell<u64>,
    /// The cycle at which `look` is called.
    due: Cell<u64>,

    /// The current block, its end, and how often it has run without another block in between.
    current: Cell<u64>,
    after: Cell<u64>,
    repeated: Cell<u64>,

    /// Levels of port A, and which of them are the display's CS and D/C.
    levels: Cell<u64>,
    select: u64,
    command: u64,

    /// SPI1: whether it has a clock; the byte that waits, the byte that is shifted out, and the cycle at which that ends.
    clocked: Cell<u64>,
    waiting: Cell<u64>,
    shifting: Cell<u64>,
    end: Cell<u64>,
    /// Whether a byte was shifted in, whether one was lost, and whether CS was high while a byte was shifted.
    received: Cell<u64>,
    overrun: Cell<u64>,
    unselected: Cell<u64>,
    /// Cycles of a bit; 0 until SPI1 is found to be set up.
    bit_cycles: Cell<u64>,
    /// The status that was read last, and when and in which block; no status if something has happened since.
    polled: Cell<u64>,
    polled_at: Cell<u64>,
    polled_in: Cell<u64>,
    /// The number of bytes sent, and the number of the byte with which the bus fails. If DMA has sent it, DMA stalls or reports an
    /// error; else SPI1 reports an overrun.
    sent: Cell<u64>,
    fail_at: u64,
    stalls: u64,
    /// Cycles for which the core has waited for the bus.
    waited: Cell<u64>,

    /// DMA2's stream 3, which sends by SPI1: whether it is on (1), or on but not served any more (2); the next byte and the bytes
    /// left; its flags.
    dma_on: Cell<u64>,
    dma_next: Cell<u64>,
    dma_left: Cell<u64>,
    dma_flags: Cell<u64>,
    /// Whether SPI1 only sends: then it receives nothing, and nothing can be lost.
    only_sends: Cell<u64>,

    filled: Cell<u64>,

    cost: extern "C" fn(u64, u32) -> u64,
    look: extern "C" fn(),
    skip: extern "C" fn(u64, u64),
    set_up: extern "C" fn() -> u64,
    no_room: extern "C" fn(),
    flush: extern "C" fn(),
    read: extern "C" fn(u64) -> u64,
    write: extern "C" fn(u64, u64),

    records: [Cell<u64>; RECORDS],
    /// Cycles of the block that begins at a halfword; 0 if they are not known.
    costs: [Cell<u16>; HALFWORDS],
    /// Cycles of a loop that polls SPI1, by the block at which it is entered; 0 if they are not known.
    rounds: [Cell<u32>; HALFWORDS],
}

/// The size of [`Hooks`], by which the caller checks that it declares equal fields.
#[no_mangle]
pub extern "C" fn hooks_size() -> usize {
    size_of::<Hooks>()
}

/// A basic block begins: Unicorn's `uc_cb_hookcode_t`.
///
/// # Safety
///
/// `hooks` is valid.
#[no_mangle]
pub unsafe extern "C" fn hooks_block(_engine: *mut (), address: u64, size: u32, hooks: *const Hooks) {
    // SAFETY: as the caller promises
    unsafe { &*hooks }.block(address, size);
}

/// A register of SPI1's page is read: Unicorn's `uc_cb_mmio_read_t`.
///
/// # Safety
///
/// `hooks` is valid.
#[no_mangle]
pub unsafe extern "C" fn hooks_read(_engine: *mut (), offset: u64, _size: u32, hooks: *const Hooks) -> u64 {
    // SAFETY: as the caller promises
    unsafe { &*hooks }.read(offset)
}

/// A register of SPI1's page is written: Unicorn's `uc_cb_mmio_write_t`.
///
/// # Safety
///
/// `hooks` is valid.
#[no_mangle]
pub unsafe extern "C" fn hooks_write(
    _engine: *mut (),
    offset: u64,
    _size: u32,
    value: u64,
    hooks: *const Hooks,
) {
    // SAFETY: as the caller promises
    unsafe { &*hooks }.write(offset, value);
}

/// A register of the page of DMA1 and DMA2 is read: Unicorn's `uc_cb_mmio_read_t`.
///
/// # Safety
///
/// `hooks` is valid.
#[no_mangle]
pub unsafe extern "C" fn hooks_read_dma(
    _engine: *mut (),
    offset: u64,
    _size: u32,
    hooks: *const Hooks,
) -> u64 {
    // SAFETY: as the caller promises
    unsafe { &*hooks }.read_dma(offset)
}

/// DMA2's stream 3 is switched on.
///
/// # Safety
///
/// `hooks` is valid, and its `dma_next` and `dma_left` are bytes of memory that live as long.
#[no_mangle]
pub unsafe extern "C" fn hooks_start_dma(hooks: *const Hooks) {
    // SAFETY: as the caller promises
    let hooks = unsafe { &*hooks };
    hooks.settle();
    hooks.dma_on.set(1);
    hooks.feed(hooks.cycles.get());
}

/// A record for the reader: see `rp2040.mjs`.
///
/// # Safety
///
/// `hooks` is valid.
#[no_mangle]
pub unsafe extern "C" fn hooks_report(hooks: *const Hooks, kind: u64, value: u64, nanoseconds: u64) {
    // SAFETY: as the caller promises
    unsafe { &*hooks }.report(kind, value, nanoseconds);
}

impl Hooks {
    fn block(&self, address: u64, size: u32) {
        let known = address.checked_sub(FLASH).and_then(|offset| self.costs.get(offset as usize / 2));
        let cost = known.map_or(0, |cost| u64::from(cost.get()));
        let cost = if cost == 0 { (self.cost)(address, size) } else { cost };
        if let Some(known) = known {
            known.set(cost.try_into().unwrap_or(0));
        }
        let taken = if address == self.after.get() { 0 } else { TAKEN };
        add(&self.cycles, cost + taken);
        self.after.set(address + u64::from(size));
        if address == self.current.get() {
            add(&self.repeated, 1);
            if self.repeated.get() > ROUNDS && size == COUNTDOWN {
                (self.skip)(address, cost + TAKEN);
            }
        } else {
            self.current.set(address);
            self.repeated.set(0);
        }
        // DMA reads memory when the bus has room, not when somebody looks.
        if self.dma_on.get() != 0 {
            self.settle();
        }
        if self.cycles.get() >= self.due.get() {
            (self.look)();
        }
    }

    fn read_dma(&self, offset: u64) -> u64 {
        if offset != DMA_STATUS {
            return (self.read)(DMA_PAGE + offset);
        }
        add(&self.cycles, PERIPHERAL);
        self.settle();
        self.poll(
            || self.dma_flags.get(),
            || {
                let bytes = if self.dma_on.get() == 1 { self.dma_left.get().saturating_sub(1) } else { 0 };
                self.end.get() + bytes * 8 * self.bit_cycles.get()
            },
        )
    }

    fn read(&self, offset: u64) -> u64 {
        if self.clocked.get() == 0 || !matches!(offset, STATUS | DATA) {
            return (self.read)(offset);
        }
        add(&self.cycles, PERIPHERAL);
        self.settle();
        if offset == STATUS {
            return self.poll(|| self.status(), || self.end.get());
        }
        self.polled.set(NONE);
        self.received.set(0);
        self.overrun.set(0);
        0xff
    }

    fn write(&self, offset: u64, value: u64) {
        if self.clocked.get() == 0 || offset != DATA {
            return (self.write)(offset, value);
        }
        add(&self.cycles, PERIPHERAL);
        self.settle();
        self.polled.set(NONE);
        if self.shifting.get() == NONE {
            self.shift(value & 0xff, self.cycles.get());
        } else if self.waiting.get() == NONE {
            self.waiting.set(value & 0xff);
        } else {
            (self.no_room)();
        }
    }

    /// The status of SPI1 or DMA. A loop that waits is recognised when it has read the same status twice; its rounds until the
    /// `end` of the wait are then skipped.
    fn poll(&self, read: impl Fn() -> u64, end: impl Fn() -> u64) -> u64 {
        let mut status = read();
        if self.shifting.get() != NONE && self.dma_on.get() != STALLED {
            let again = status == self.polled.get();
            let entered = if again { self.polled_in.get() } else { self.current.get() };
            let round = entered.checked_sub(FLASH).and_then(|offset| self.rounds.get(offset as usize / 2));
            if let Some(round) = round {
                if again {
                    let cycles = self.cycles.get() - self.polled_at.get();
                    round.set(cycles.try_into().unwrap_or(0)); // of a longer loop, nothing is known
                }
                let round = u64::from(round.get());
                if round > 0 {
                    // Later than now, because `settle` has taken all else.
                    let rounds = (end() - self.cycles.get()).div_ceil(round);
                    add(&self.waited, rounds * round);
                    add(&self.cycles, rounds * round);
                    self.settle();
                    status = read();
                }
            }
        }
        self.polled.set(status);
        self.polled_at.set(self.cycles.get());
        self.polled_in.set(self.current.get());
        status
    }

    fn status(&self) -> u64 {
        let flag = |set: bool, bit: u64| if set { bit } else { 0 };
        flag(self.received.get() != 0, RXNE)
            | flag(self.waiting.get() == NONE, TXE)
            | flag(self.overrun.get() != 0, OVERRUN)
            | flag(self.shifting.get() != NONE, BUSY)
    }

    /// Brings the bus up to date.
    fn settle(&self) {
        while self.shifting.get() != NONE && self.end.get() <= self.cycles.get() {
            let end = self.end.get();
            let lines = self.level(self.command) | self.unselected.get() << 1;
            self.report(BYTE | lines, self.shifting.get(), self.time(end));
            if self.received.get() != 0 {
                self.overrun.set(1);
            }
            if self.sent.get() == self.fail_at {
                self.fail();
                self.report(BROKEN, 0, self.time(end));
            }
            self.received.set(u64::from(self.only_sends.get() == 0));
            add(&self.sent, 1);
            self.shifting.set(NONE);
            let byte = self.waiting.replace(NONE);
            if byte != NONE {
                self.shift(byte, end);
            }
            self.feed(end);
        }
    }

    fn fail(&self) {
        if self.dma_on.get() == 0 {
            self.overrun.set(1);
        } else if self.stalls != 0 {
            self.dma_on.set(STALLED);
        } else {
            self.dma_on.set(0);
            self.dma_flags.set(DMA_ERROR);
        }
    }

    /// DMA fills the bus's registers.
    fn feed(&self, now: u64) {
        while self.dma_on.get() == 1 && self.waiting.get() == NONE {
            // SAFETY: as the caller of `hooks_start_dma` promises
            let byte = unsafe { *(self.dma_next.get() as *const u8) };
            add(&self.dma_next, 1);
            self.dma_left.set(self.dma_left.get() - 1);
            if self.dma_left.get() == 0 {
                self.dma_on.set(0);
                self.dma_flags.set(DMA_COMPLETE);
            }
            match self.shifting.get() {
                NONE => self.shift(byte.into(), now),
                _ => self.waiting.set(byte.into()),
            }
        }
    }

    fn shift(&self, byte: u64, now: u64) {
        if self.bit_cycles.get() == 0 {
            self.bit_cycles.set((self.set_up)());
        }
        self.shifting.set(byte);
        self.unselected.set(self.level(self.select));
        self.end.set(now + 8 * self.bit_cycles.get());
    }

    /// 1 if a pin of port A is high.
    fn level(&self, pin: u64) -> u64 {
        self.levels.get() >> pin & 1
    }

    fn time(&self, cycles: u64) -> u64 {
        let passed = u128::from(cycles - self.since.get()) * 1_000_000_000 / u128::from(self.frequency.get());
        self.nanoseconds.get() + passed as u64 // a run takes less than 2⁶⁴ ns
    }

    fn report(&self, kind: u64, value: u64, nanoseconds: u64) {
        if let Some(record) = self.records.get(self.filled.get() as usize) {
            record.set((nanoseconds << 16 | kind << 8 | value).to_le());
        }
        add(&self.filled, 1);
        if self.filled.get() as usize >= RECORDS {
            (self.flush)(); // which empties the buffer
        }
    }
}

fn add(to: &Cell<u64>, amount: u64) {
    to.set(to.get() + amount);
}
