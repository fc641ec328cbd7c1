"""Runs an image on an emulated STM32F411 and reports what its SPI bus and its pins do: see events.mjs.

    python stm32f411.py IMAGE wires=5,7 select=4 command=3 watch=2 log=ADDRESS

The core is Unicorn's Cortex-M4. Here are the peripherals that the firmware uses, after the reference manual RM0383: RCC, as
far as clocks start and switch; GPIOA; SPI1 as a master that sends; SysTick with its exception. `wires`, `select`, `command` and
`watch` are pins of port A: clock and data of SPI1, the display's CS and D/C, and those whose changes are reported, separated
by commas. `log` is the address of the image's RTT control block. `overrun=N` sets SPI1's overrun flag once, with byte N.

Time is counted in cycles of basic blocks (cortex_m4.py), with 2 more for an access to a peripheral. Flash answers at once:
the chip's prefetch and caches hide most of its wait states.
"""

import struct
import sys

from unicorn import UC_ARCH_ARM, UC_HOOK_BLOCK, UC_HOOK_MEM_INVALID, UC_MODE_MCLASS, UC_MODE_THUMB, Uc, UcError
from unicorn import arm_const as arm

import cortex_m4
from events import BROKEN, BYTE, CLOCK, LOG, PIN, TIME, WAITED, flush, report

FLASH, RAM, RAM_SIZE = 0x0800_0000, 0x2000_0000, 128 << 10
HSI, HSE = 16_000_000, 25_000_000
PERIPHERAL = 2

image, *rest = sys.argv[1:]
options = dict(option.split("=") for option in rest)
select, command, log = (int(options[name]) for name in ("select", "command", "log"))
wires = [int(pin) for pin in options["wires"].split(",")]
watched = [int(pin) for pin in options.get("watch", "").split(",") if pin]


class Clock:
    """Cycles since power on, and their time: the frequency changes once or twice."""

    def __init__(self):
        self.cycles = 0
        self.since, self.nanoseconds, self.frequency = 0, 0, HSI

    def time(self, cycles=None):
        cycles = self.cycles if cycles is None else cycles
        return self.nanoseconds + (cycles - self.since) * 1_000_000_000 // self.frequency

    def set(self, frequency):
        self.nanoseconds, self.since, self.frequency = self.time(), self.cycles, frequency


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
            spi.bit_cycles = None  # it may have another clock or other pins


class Rcc(Registers):
    CR, PLLCFGR, CFGR, AHB1ENR, APB2ENR = 0x00, 0x04, 0x08, 0x30, 0x44

    def write_30(self, value):
        self.words[self.AHB1ENR] = value
        gpio.clocked = bool(value & 1)

    def write_44(self, value):
        self.words[self.APB2ENR] = value
        spi.clocked = bool(value >> 12 & 1)

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
        spi.bit_cycles = None

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
        spi.bit_cycles = None
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
            spi.unselected = True

    def update(self):
        mode = self.words.get(self.MODER, 0)
        outputs = sum((mode >> 2 * pin & 3 == 1) << pin for pin in range(16))
        self.level = self.words.get(self.ODR, 0) | ~outputs & 0xFFFF

    level = 0xFFFF

    def levels(self):
        return self.level

    def is_connected(self, pin):
        """Whether a pin is SPI1's: alternate function 5."""
        function = self.words.get(0x20 if pin < 8 else 0x24, 0) >> 4 * (pin & 7) & 0xF
        return self.words.get(self.MODER, 0) >> 2 * pin & 3 == 2 and function == 5


class Spi1(Registers):
    """A byte that waits, a byte that is shifted out, and a byte that was shifted in."""

    clocked = False
    CR1, CR2, SR, DR = 0x00, 0x04, 0x08, 0x0C
    CPHA, CPOL, MASTER, ENABLED, LSB_FIRST, DFF = (1 << bit for bit in (0, 1, 2, 6, 7, 11))
    RXNE, TXE, OVR, BSY = (1 << bit for bit in (0, 1, 6, 7))

    def __init__(self):
        super().__init__()
        self.waiting = self.shifting = None
        self.end = 0  # of the byte that is shifted, in cycles
        self.received = self.overrun = self.unselected = False
        self.bit_cycles = None  # cycles of a bit, once SPI1 is found to be set up
        self.polled = (None, 0, 0)  # the status that was read last, when and in which block, if nothing has happened since
        self.rounds = {}  # cycles of a loop that waits, by the block that it is entered with
        self.sent = 0
        self.fail_at = int(options.get("overrun", -1))

    def settle(self):
        """What has happened until now."""
        while self.shifting is not None and self.end <= clock.cycles:
            levels = gpio.levels()
            lines = (levels >> command & 1) | self.unselected << 1
            report(BYTE | lines, self.shifting, clock.time(self.end))
            self.overrun |= self.received
            if self.sent == self.fail_at:
                self.overrun = True
                report(BROKEN, 0, clock.time(self.end))
            self.received = True
            self.sent += 1
            byte, self.shifting, self.waiting = self.waiting, None, None
            if byte is not None:
                self.shift(byte, self.end)

    def shift(self, byte, now):
        if self.bit_cycles is None:
            self.bit_cycles = self.set_up()
        self.shifting = byte
        self.unselected = bool(gpio.levels() >> select & 1)
        self.end = now + 8 * self.bit_cycles

    def set_up(self):
        control = self.words.get(self.CR1, 0)
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
        report(CLOCK, 0, 8 * bit_cycles * 1_000_000_000 // clock.frequency)
        return bit_cycles

    def status(self):
        return (
            (self.RXNE if self.received else 0)
            | (self.TXE if self.waiting is None else 0)
            | (self.OVR if self.overrun else 0)
            | (self.BSY if self.shifting is not None else 0)
        )

    def read_08(self):
        self.settle()
        status, (last, when, where) = self.status(), self.polled
        if self.shifting is not None:
            # A loop that waits for the end of the byte is known once it has read the same status twice. Its rounds until the end
            # go by at once.
            if status == last:
                self.rounds[where] = clock.cycles - when
            round_ = self.rounds.get(where if status == last else current)
            if round_:
                wait = -(-(self.end - clock.cycles) // round_) * round_
                waited.cycles += wait
                clock.cycles += wait
                self.settle()
                status = self.status()
        self.polled = (status, clock.cycles, current)
        return status

    def read_0c(self):
        self.settle()
        self.polled = (None, 0, 0)
        self.received = self.overrun = False
        return 0xFF

    def write_0c(self, value):
        self.settle()
        self.polled = (None, 0, 0)
        if self.shifting is None:
            self.shift(value & 0xFF, clock.cycles)
        elif self.waiting is None:
            self.waiting = value & 0xFF
        else:
            problem("SPI1 has no room for another byte")


class Waited:
    """The time that the core has waited, which is reported from time to time."""

    def __init__(self):
        self.cycles = 0

    def report(self):
        report(WAITED, 0, self.cycles * 1_000_000_000 // clock.frequency)
        self.cycles = 0


class System(Registers):
    """SysTick. Interrupts of peripherals are not modelled."""

    CSR, RVR = 0x10, 0x14

    def __init__(self):
        super().__init__()
        self.start = 0

    def period(self):
        return (self.words.get(self.RVR, 0) & 0xFFFFFF) + 1

    def write_10(self, value):
        self.words[self.CSR] = value
        self.start = clock.cycles

    def write_18(self, _value):  # CVR: any write clears the count
        self.start = clock.cycles

    def read_18(self):
        passed = (clock.cycles - self.start) % self.period()
        return (self.period() - passed) % self.period()

    def due(self):
        """When the exception comes, if it does."""
        return self.start + self.period() if self.words.get(self.CSR, 0) & 3 == 3 else None


rcc, power, gpio, spi, system, waited = Rcc(), Power(), GpioA(), Spi1(), System(), Waited()

uc = Uc(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS)
uc.ctl_set_cpu_model(arm.UC_CPU_ARM_CORTEX_M4)
uc.mem_map(FLASH, 512 << 10)
uc.mem_map(RAM, RAM_SIZE)
PERIPHERALS, BIT_BAND, BIT_BAND_SIZE = 0x4000_0000, 0x4200_0000, 32 << 20
PAGE, BLOCK = 0x1000, 0x400  # Unicorn maps pages; a peripheral has a block
blocks = {
    0x4000_7000: power,
    0x4001_3000: spi,
    0x4002_0000: gpio,
    0x4002_3800: rcc,
    0x4002_3C00: Registers(),  # flash interface: wait states and caches
    0xE000_E000: system,
    0xE000_EC00: Registers(),  # system control block
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


for page in {address & -PAGE for address in blocks}:
    uc.mmio_map(page, PAGE, read, page, write, page)
uc.mmio_map(BIT_BAND, BIT_BAND_SIZE, read_bit, None, write_bit, None)

failure = None


def problem(text):
    """Ends the run: an exception would not leave Unicorn."""
    global failure
    failure = failure or text
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
RETURN = 0x1000_0000  # where exception handlers return to; the chip has nothing there
costs = {}
after = current = due = repeated = 0
exception = False


def block(_uc, address, size, _data):
    """A basic block begins."""
    global after, current, repeated
    cost = costs.get(address)
    if cost is None:
        cost = costs[address] = cortex_m4.cycles(uc.mem_read(address, size))
    clock.cycles += cost if address == after else cost + cortex_m4.TAKEN
    after = address + size
    if address == current:
        repeated += 1
        if repeated > 100:
            skip(address, size, cost + cortex_m4.TAKEN)
    else:
        current, repeated = address, 0
    if clock.cycles >= due:
        look()


def skip(address, size, cost):
    """Many rounds of a loop that only counts down go by at once, up to the next look."""
    first, second = struct.unpack("<HH", uc.mem_read(address, 4)) if size == 4 else (0, 0)
    if (first & 0xF8FF, second) == COUNTDOWN:
        register = arm.UC_ARM_REG_R0 + (first >> 8 & 7)
        count = uc.reg_read(register)
        rounds = min(max(due - clock.cycles, 0) // cost, count - 1)
        uc.reg_write(register, count - rounds)
        clock.cycles += rounds * cost


def look():
    """What is not looked at in every block."""
    global due, exception
    take_log()
    waited.report()
    report(TIME, 0, clock.time())
    due = clock.cycles + INTERVAL
    if system.due() is not None:
        if clock.cycles >= system.due():
            exception = True
            uc.emu_stop()
        due = min(due, system.due())


def systick():
    """Runs the handler of SysTick as the core would, but keeps the registers here instead of on the stack."""
    saved = [arm.UC_ARM_REG_R0, arm.UC_ARM_REG_R1, arm.UC_ARM_REG_R2, arm.UC_ARM_REG_R3, arm.UC_ARM_REG_R12]
    saved += [arm.UC_ARM_REG_LR, arm.UC_ARM_REG_PC, arm.UC_ARM_REG_XPSR]
    values = [uc.reg_read(register) for register in saved]
    system.start += system.period()
    (handler,) = struct.unpack("<I", uc.mem_read(FLASH + 4 * 15, 4))
    uc.reg_write(arm.UC_ARM_REG_LR, RETURN | 1)
    uc.emu_start(handler, RETURN)
    clock.cycles += 24  # entry and return
    for register, value in zip(saved, values):
        uc.reg_write(register, value)


def invalid(_uc, _kind, address, _size, _value, _data):
    problem(f"nothing is at address {address:#010x}")
    return False


load(image)
uc.mem_map(RETURN, 0x1000)
uc.hook_add(UC_HOOK_BLOCK, block)
uc.hook_add(UC_HOOK_MEM_INVALID, invalid)
stack, start = struct.unpack("<II", uc.mem_read(FLASH, 8))
uc.reg_write(arm.UC_ARM_REG_SP, stack)
while failure is None:
    try:
        uc.emu_start(start, 0xFFFF_FFFF)
    except UcError as error:
        # Unicorn stops after a `yield`, with which the firmware says that it only waits: until the next look.
        (before,) = struct.unpack("<H", uc.mem_read(uc.reg_read(arm.UC_ARM_REG_PC) - 2, 2))
        if before == YIELD:
            clock.cycles = max(clock.cycles, due)
            look()
        else:
            problem(str(error))
    if exception and failure is None:
        exception = False
        systick()
    start = uc.reg_read(arm.UC_ARM_REG_PC) | 1
flush()
sys.exit(f"{failure}, at {uc.reg_read(arm.UC_ARM_REG_PC):#010x} after {clock.time() / 1e6:.3f} ms")
