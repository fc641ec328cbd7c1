"""Runs an image on an emulated STM32F411 and reports what its SPI bus and its pins do: see rp2040.mjs.

    python stm32f411.py IMAGE hooks=FILE wires=5,7 select=4 command=3 watch=2 log=ADDRESS

The core is Unicorn's Cortex-M4. Here are the peripherals that the firmware uses, after the reference manual RM0383: RCC, as
far as clocks start and switch; GPIOA; SPI1 as a master that sends; stream 3 of DMA2, which feeds it; the watchdog IWDG, and the
system reset; the cycle counter. Exceptions are not modelled. `wires`,
`select`, `command` and `watch` are pins of port A: clock and data of SPI1, the display's CS and D/C, and those whose changes
are reported, separated by commas. `log` is the address of the image's RTT control block. With byte N, `fail=N` lets the bus fail
once: DMA ends with an error, or, with `stalls=1`, is not served any more; if the core sends that byte, SPI1 reports an overrun.

`hooks` is the library of hooks/, which does what happens in every basic block and for every byte.

Time is counted in cycles of basic blocks (cortex_m4.py), with 2 more for an access to a peripheral. Flash answers at once:
the chip's prefetch and caches hide most of its wait states.
"""

import ctypes
import os
import struct
import sys

from unicorn import UC_ARCH_ARM, UC_ERR_OK, UC_HOOK_BLOCK, UC_HOOK_MEM_INVALID, UC_MODE_MCLASS, UC_MODE_THUMB
from unicorn import UC_PROT_ALL, Uc, UcError
from unicorn import arm_const as arm
from unicorn.unicorn_py3.unicorn import uclib

import cortex_m4

FLASH, RAM, RAM_SIZE = 0x0800_0000, 0x2000_0000, 128 << 10
HSI, HSE = 16_000_000, 25_000_000
PERIPHERAL = 2
# Kinds of records: see rp2040.mjs.
PIN, LOG, WAITED, TIME, CLOCK, RESET = 0x10, 0x20, 0x30, 0x40, 0x60, 0x70

image, *rest = sys.argv[1:]
options = dict(option.split("=") for option in rest)
select, command, log = (int(options[name]) for name in ("select", "command", "log"))
wires = [int(pin) for pin in options["wires"].split(",")]
watched = [int(pin) for pin in options.get("watch", "").split(",") if pin]


NUMBERS = "cycles since nanoseconds frequency due current after repeated levels select command clocked waiting shifting end"
NUMBERS += " received overrun unselected bit_cycles polled polled_at polled_in sent fail_at stalls waited"
NUMBERS += " dma_on dma_next dma_left dma_flags only_sends filled"
WORD = ctypes.c_uint64
FUNCTIONS = {
    "cost": ctypes.CFUNCTYPE(WORD, WORD, ctypes.c_uint32),
    "look": ctypes.CFUNCTYPE(None),
    "skip": ctypes.CFUNCTYPE(None, WORD, WORD),
    "set_up": ctypes.CFUNCTYPE(WORD),
    "no_room": ctypes.CFUNCTYPE(None),
    "flush": ctypes.CFUNCTYPE(None),
    "read": ctypes.CFUNCTYPE(WORD, WORD),
    "write": ctypes.CFUNCTYPE(None, WORD, WORD),
}
NONE = (1 << 64) - 1


class Hooks(ctypes.Structure):
    """As in hooks/src/lib.rs."""

    _fields_ = [(name, WORD) for name in NUMBERS.split()]
    _fields_ += FUNCTIONS.items()
    _fields_ += [("records", WORD * 8192), ("costs", ctypes.c_uint16 * (256 << 10)), ("rounds", ctypes.c_uint32 * (256 << 10))]


library = ctypes.CDLL(options["hooks"])
hooks = Hooks(frequency=HSI, levels=0xFFFF, select=select, command=command, fail_at=int(options.get("fail", NONE)))
hooks.stalls = int(options.get("stalls", 0))
hooks.waiting = hooks.shifting = hooks.polled = NONE
if library.hooks_size() != ctypes.sizeof(hooks):
    sys.exit(f"{options['hooks']}: of another version: run boards/emulate/run --build")
library.hooks_read.restype = WORD
library.hooks_report.argtypes = [ctypes.c_void_p, WORD, WORD, WORD]
library.hooks_read.argtypes = [ctypes.c_void_p, WORD, ctypes.c_uint32, ctypes.c_void_p]
library.hooks_start_dma.argtypes = [ctypes.c_void_p]
library.hooks_write.argtypes = [ctypes.c_void_p, WORD, ctypes.c_uint32, WORD, ctypes.c_void_p]


def hook(function):
    """Lets the library call a function by its name. An exception would not get through the library: it ends the run."""

    def guarded(*arguments):
        try:
            return function(*arguments)
        except Exception as error:  # whatever it is
            problem(f"{type(error).__name__}: {error}")
            return 0

    setattr(hooks, function.__name__, FUNCTIONS[function.__name__](guarded))
    return function


def report(kind, value, nanoseconds):
    library.hooks_report(ctypes.addressof(hooks), kind, value, nanoseconds)


@hook
def flush():
    length = 8 * hooks.filled
    hooks.filled = 0
    records = memoryview(hooks.records).cast("B")[:length]
    try:
        while records:
            records = records[os.write(1, records) :]
    except BrokenPipeError:
        os._exit(0)  # the reader has seen enough


class Clock:
    """Cycles since power on, and their time: the frequency changes once or twice."""

    @property
    def cycles(self):
        return hooks.cycles

    @cycles.setter
    def cycles(self, cycles):
        hooks.cycles = cycles

    def time(self):
        return hooks.nanoseconds + (hooks.cycles - hooks.since) * 1_000_000_000 // hooks.frequency

    def set(self, frequency):
        hooks.nanoseconds, hooks.since, hooks.frequency = self.time(), hooks.cycles, frequency


clock = Clock()


class Registers:
    """A peripheral: registers that keep what is written, but for those that a subclass names `read_XX` and `write_XX`."""

    clocked = True

    def __init__(self):
        self.words = {}
        self.reads, self.writes = {}, {}
        for name in dir(self):
            kind, _, offset = name.partition("_")
            if kind in ("read", "write") and len(offset) == 2:
                (self.reads if kind == "read" else self.writes)[int(offset, 16)] = getattr(self, name)

    def read(self, offset):
        clock.cycles += PERIPHERAL
        if not self.clocked:
            problem(f"{type(self).__name__} is used without its clock")
        handler = self.reads.get(offset)
        return handler() if handler else self.words.get(offset, 0)

    def write(self, offset, value):
        clock.cycles += PERIPHERAL
        if not self.clocked:
            problem(f"{type(self).__name__} is used without its clock")
        handler = self.writes.get(offset)
        if handler:
            handler(value)
        else:
            self.words[offset] = value
            hooks.bit_cycles = 0  # SPI1 may have another clock or other pins


class Rcc(Registers):
    CR, PLLCFGR, CFGR, AHB1ENR, APB2ENR = 0x00, 0x04, 0x08, 0x30, 0x44

    def write_30(self, value):
        self.words[self.AHB1ENR] = value
        gpio.clocked, dma.clocked = bool(value & 1), bool(value >> 22 & 1)

    def write_44(self, value):
        self.words[self.APB2ENR] = value
        spi.clocked = hooks.clocked = bool(value >> 12 & 1)

    def write_00(self, value):  # CR: an oscillator or a PLL that is on is ready
        self.words[self.CR] = value | sum((value >> on & 1) << on + 1 for on in (0, 16, 24))

    def write_08(self, value):  # CFGR: the switch has switched
        self.words[self.CFGR] = value & ~0xC | (value & 3) << 2
        pll = self.words.get(self.PLLCFGR, 0)
        m, n, p = pll & 0x3F, pll >> 6 & 0x1FF, 2 * (pll >> 16 & 3) + 2
        source = HSE if pll >> 22 & 1 else HSI
        frequency = (HSI, HSE, source // m * n // p if m else 0)[value & 3]
        if value >> 4 & 0x8 or not frequency:
            problem(f"RCC_CFGR {value:#x} is not modelled")
        clock.set(frequency)
        hooks.bit_cycles = 0

    def apb2_divisor(self):
        prescaler = self.words.get(self.CFGR, 0) >> 13 & 7
        return 1 << (prescaler & 3) + 1 if prescaler & 4 else 1


class Power(Registers):
    def read_04(self):  # CSR: the regulator is ready
        return self.words.get(0x04, 0) | 1 << 14


class GpioA(Registers):
    clocked = False
    MODER, ODR = 0x00, 0x14

    def write_00(self, value):
        self.words[self.MODER] = value
        hooks.bit_cycles = 0
        self.drive(self.words.get(self.ODR, 0))

    def write_14(self, value):
        self.drive(value)

    def write_18(self, value):  # BSRR
        self.drive(self.words.get(self.ODR, 0) & ~(value >> 16) | value & 0xFFFF)

    def drive(self, output):
        """A pin that is no output counts as high, as if pulled up."""
        before = self.levels()
        self.words[self.ODR] = output
        self.update()
        changed = before ^ self.levels()
        for pin in watched:
            if changed >> pin & 1:
                report(PIN, pin | (self.levels() >> pin & 1) << 7, clock.time())
        if self.levels() >> select & 1:
            hooks.unselected = 1

    def update(self):
        mode = self.words.get(self.MODER, 0)
        outputs = sum((mode >> 2 * pin & 3 == 1) << pin for pin in range(16))
        hooks.levels = self.words.get(self.ODR, 0) | ~outputs & 0xFFFF

    def levels(self):
        return hooks.levels

    def is_connected(self, pin):
        """Whether a pin is SPI1's: alternate function 5."""
        function = self.words.get(0x20 if pin < 8 else 0x24, 0) >> 4 * (pin & 7) & 0xF
        return self.words.get(self.MODER, 0) >> 2 * pin & 3 == 2 and function == 5


class Spi1(Registers):
    """Its control registers. Status and data are the library's."""

    clocked = False
    CR1, SR, DR = 0x00, 0x08, 0x0C
    CPHA, CPOL, MASTER, ENABLED, LSB_FIRST, DFF = (1 << bit for bit in (0, 1, 2, 6, 7, 11))

    def read(self, offset):
        if self.clocked and offset in (self.SR, self.DR):
            return library.hooks_read(None, offset, 4, ctypes.addressof(hooks))
        return super().read(offset)

    def write(self, offset, value):
        if self.clocked and offset == self.DR:
            library.hooks_write(None, offset, 4, value, ctypes.addressof(hooks))
        else:
            super().write(offset, value)

    def set_up(self):
        """Cycles of a bit."""
        control = self.words.get(self.CR1, 0)
        hooks.only_sends = control >> 14 & 3 == 3  # BIDIMODE and BIDIOE
        if control & (self.MASTER | self.ENABLED) != self.MASTER | self.ENABLED:
            problem("SPI1 is written while it is no master, or not enabled")
        if bool(control & self.CPHA) != bool(control & self.CPOL):
            problem("SPI1 is neither in mode 0 nor in mode 3")
        if control & (self.DFF | self.LSB_FIRST):
            problem("SPI1 does not send bytes, the highest bit first")
        for pin in wires:
            if not gpio.is_connected(pin):
                problem(f"PA{pin} is not SPI1's")
        bit_cycles = (2 << (control >> 3 & 7)) * rcc.apb2_divisor()
        report(CLOCK, 0, 8 * bit_cycles * 1_000_000_000 // hooks.frequency)
        return bit_cycles


class Dma(Registers):
    """Of DMA2 stream 3, from memory to SPI1, byte by byte. The library sends, and reads its flags."""

    clocked = False
    # Channel 3, byte by byte from memory to a peripheral, memory addresses that rise, and no other mode.
    MODE, WANTED = 0x0FECFFE0, 3 << 25 | 1 << 10 | 1 << 6
    SPI1_DATA = 0x4001_300C

    def write_08(self, value):  # LIFCR
        hooks.dma_flags &= ~value

    def read_58(self):  # CR
        return self.words.get(0x58, 0) | bool(hooks.dma_on)

    def write_58(self, value):
        self.words[0x58] = value & ~1
        if not value & 1:
            hooks.dma_on = 0
        elif not hooks.dma_on:
            self.start(value)

    def read_5c(self):  # NDTR
        return hooks.dma_left

    def write_5c(self, value):
        hooks.dma_left = value & 0xFFFF

    def start(self, control):
        peripheral, memory = (self.words.get(offset, 0) for offset in (0x60, 0x64))
        if control & self.MODE != self.WANTED or peripheral != self.SPI1_DATA:
            problem(f"DMA2_S3CR {control:#x} from {memory:#x} to {peripheral:#x} is not modelled")
        elif not RAM <= memory <= memory + hooks.dma_left <= RAM + RAM_SIZE or not hooks.dma_left:
            problem(f"DMA of {hooks.dma_left} bytes at {memory:#x}, which is not in RAM")
        elif hooks.dma_flags:
            problem("DMA is started with flags of the transfer before")
        elif not spi.words.get(0x04, 0) & 2:  # CR2: TXDMAEN
            problem("DMA is started, and SPI1 does not ask for bytes")
        else:
            hooks.dma_next = ctypes.addressof(ram) + memory - RAM
            library.hooks_start_dma(ctypes.addressof(hooks))


class Watchdog(Registers):
    """IWDG, with 32 kHz."""

    due = NONE

    def write_00(self, value):  # KR
        if value == 0xCCCC or value == 0xAAAA and self.due != NONE:
            ticks = (self.words.get(0x08, 0xFFF) + 1) * (4 << min(self.words.get(0x04, 0), 6))
            self.due = clock.time() + ticks * 1_000_000_000 // 32_000


class SystemControl(Registers):
    def write(self, offset, value):
        super().write(offset, value)
        if offset == 0x10C and value == 0x05FA_0004:  # AIRCR: SYSRESETREQ
            reset("the firmware")


class Trace(Registers):
    """DWT: CYCCNT counts, whether it was enabled or not."""

    def read_04(self):
        return clock.cycles & 0xFFFFFFFF


rcc, power, gpio, spi, dma, watchdog = Rcc(), Power(), GpioA(), Spi1(), Dma(), Watchdog()

uc = Uc(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS)
uc.ctl_set_cpu_model(arm.UC_CPU_ARM_CORTEX_M4)
uc.mem_map(FLASH, 512 << 10)
ram = ctypes.create_string_buffer(RAM_SIZE)  # which DMA reads, too
uc.mem_map_ptr(RAM, RAM_SIZE, UC_PROT_ALL, ctypes.addressof(ram))
PERIPHERALS, BIT_BAND, BIT_BAND_SIZE = 0x4000_0000, 0x4200_0000, 32 << 20
PAGE, BLOCK = 0x1000, 0x400  # Unicorn maps pages; a peripheral has a block
blocks = {
    0x4000_3000: watchdog,
    0x4000_7000: power,
    0x4001_3000: spi,
    0x4002_0000: gpio,
    0x4002_3800: rcc,
    0x4002_3C00: Registers(),  # flash interface: wait states and caches
    0x4002_6400: dma,
    0xE000_1000: Trace(),
    0xE004_2000: Registers(),  # DBGMCU
    0xE000_EC00: SystemControl(),
}


def peripheral(address):
    found = blocks.get(address & -BLOCK)
    if found is None:
        problem(f"nothing is modelled at {address:#010x}")
    return found or Registers()


def read(_uc, offset, _size, page):
    return peripheral(page + offset).read(offset & BLOCK - 1)


def write(_uc, offset, _size, value, page):
    peripheral(page + offset).write(offset & BLOCK - 1, value)


def bit(alias):
    """The register and the bit of a word of the bit-band alias."""
    byte = PERIPHERALS + (alias >> 5)
    return peripheral(byte), byte & BLOCK - 4, (byte & 3) * 8 + (alias >> 2 & 7)


def read_bit(_uc, alias, _size, _data):
    registers, offset, number = bit(alias)
    return registers.read(offset) >> number & 1


def write_bit(_uc, alias, _size, value, _data):
    registers, offset, number = bit(alias)
    registers.write(offset, registers.read(offset) & ~(1 << number) | (value & 1) << number)


@hook
def set_up():
    return spi.set_up()


@hook
def no_room():
    problem("SPI1 has no room for another byte")


def check(status):
    if status != UC_ERR_OK:
        raise UcError(status)


MMIO_WRITE = ctypes.CFUNCTYPE(None, ctypes.c_void_p, WORD, ctypes.c_uint32, WORD, ctypes.c_void_p)
# Unicorn calls the library's functions itself, with the structure that is shared.
shared = ctypes.addressof(hooks)
SPI1_PAGE, DMA_PAGE = 0x4001_3000, 0x4002_6000
for page in {address & -PAGE for address in blocks} - {SPI1_PAGE, DMA_PAGE}:
    uc.mmio_map(page, PAGE, read, page, write, page)
# The library calls these for what is neither SPI1's status nor its data.
hooks.read = FUNCTIONS["read"](lambda offset: read(None, offset, 4, SPI1_PAGE))
hooks.write = FUNCTIONS["write"](lambda offset, value: write(None, offset, 4, value, SPI1_PAGE))
check(uclib.uc_mmio_map(uc._uch, SPI1_PAGE, PAGE, library.hooks_read, shared, library.hooks_write, shared))
write_dma = MMIO_WRITE(lambda _uc, offset, size, value, _data: write(None, offset, size, value, DMA_PAGE))
check(uclib.uc_mmio_map(uc._uch, DMA_PAGE, PAGE, library.hooks_read_dma, shared, write_dma, None))
uc.mmio_map(BIT_BAND, BIT_BAND_SIZE, read_bit, None, write_bit, None)

failure, is_reset = None, False


def problem(text):
    """Ends the run: an exception would not leave Unicorn."""
    global failure
    failure = failure or text
    uc.emu_stop()


def reset(by):
    """Ends the run up to here; the chip starts anew."""
    global is_reset
    is_reset = True
    report(RESET, by == "the firmware", clock.time())
    uc.emu_stop()


def load(path):
    """The loadable segments of the ELF file, by physical address."""
    with open(path, "rb") as file:
        elf = file.read()
    if elf[:6] != b"\x7fELF\x01\x01":
        sys.exit(f"{path}: not a 32-bit ELF file")
    (table,) = struct.unpack_from("<I", elf, 28)
    size, count = struct.unpack_from("<HH", elf, 42)
    for i in range(count):
        kind, offset, _, address, length = struct.unpack_from("<5I", elf, table + i * size)
        if kind == 1 and length > 0:
            uc.mem_write(address, elf[offset : offset + length])


def take_log():
    """Takes what the image has put into the first channel of RTT."""
    _, start, size, end, read, _ = struct.unpack("<6I", uc.mem_read(log + 24, 24))
    # Before the image has copied the initial values, the block holds anything.
    if not (RAM <= start and start + size <= RAM + RAM_SIZE and end < size and read < size):
        return
    while read != end:
        report(LOG, uc.mem_read(start + read, 1)[0], clock.time())
        read = (read + 1) % size
    uc.mem_write(log + 40, struct.pack("<I", end))


COUNTDOWN = (0x3801, 0xD1FD)  # subs r0, #1; bne to it
YIELD = 0xBF10
INTERVAL = 10_000  # cycles from one look at the log to the next


@hook
def cost(address, size):
    """Cycles of a basic block."""
    return cortex_m4.cycles(uc.mem_read(address, size))


@hook
def skip(address, cost):
    """Many rounds of a loop of 4 bytes that only counts down go by at once, up to the next look."""
    first, second = struct.unpack("<HH", uc.mem_read(address, 4))
    if (first & 0xF8FF, second) == COUNTDOWN:
        register = arm.UC_ARM_REG_R0 + (first >> 8 & 7)
        count = uc.reg_read(register)
        rounds = min(max(hooks.due - hooks.cycles, 0) // cost, count - 1)
        uc.reg_write(register, count - rounds)
        hooks.cycles += rounds * cost


@hook
def look():
    """What is not looked at in every block."""
    take_log()
    report(WAITED, 0, hooks.waited * 1_000_000_000 // hooks.frequency)  # since the last look
    hooks.waited = 0
    report(TIME, 0, clock.time())
    if clock.time() >= watchdog.due:
        reset("the watchdog")
    hooks.due = hooks.cycles + INTERVAL


def invalid(_uc, _kind, address, _size, _value, _data):
    problem(f"nothing is at address {address:#010x}")
    return False


load(image)
handle = ctypes.c_size_t()
everywhere = 1, 0
check(uclib.uc_hook_add(uc._uch, ctypes.byref(handle), UC_HOOK_BLOCK, library.hooks_block, shared, *everywhere))
uc.hook_add(UC_HOOK_MEM_INVALID, invalid)


def start_chip():
    """Peripherals as after a reset, but for the log and the time; returns the address of the first instruction."""
    global is_reset
    is_reset = False
    for registers in blocks.values():
        registers.words.clear()
    gpio.clocked = spi.clocked = dma.clocked = hooks.clocked = False
    hooks.dma_on = hooks.dma_flags = hooks.received = hooks.overrun = hooks.bit_cycles = 0
    hooks.waiting = hooks.shifting = NONE
    watchdog.due = NONE
    clock.set(HSI)
    gpio.drive(0)
    stack, start = struct.unpack("<II", uc.mem_read(FLASH, 8))
    uc.reg_write(arm.UC_ARM_REG_SP, stack)
    return start


start = start_chip()
while failure is None:
    if is_reset:
        start = start_chip()
    try:
        uc.emu_start(start, 0xFFFF_FFFF)
    except UcError as error:
        # Unicorn stops after a `yield`, with which the firmware says that it only waits: until the next look.
        (before,) = struct.unpack("<H", uc.mem_read(uc.reg_read(arm.UC_ARM_REG_PC) - 2, 2))
        if before == YIELD:
            clock.cycles = max(clock.cycles, hooks.due)
            look()
        else:
            problem(str(error))
    start = uc.reg_read(arm.UC_ARM_REG_PC) | 1
flush()
sys.exit(f"{failure}, at {uc.reg_read(arm.UC_ARM_REG_PC):#010x} after {clock.time() / 1e6:.3f} ms")
