"""Cycles of a basic block on a Cortex-M4, by the instruction timings of its technical reference manual, section 3.3.

Memory answers at once. A load or store takes 2 cycles, and 1 right after another one; several registers take 1 each and 1 more.
The manual leaves a range for a division and for a branch that is taken: here is what tools/bench/report/timing takes, which is
compared with a chip. TAKEN is what a branch takes more if it is taken, which only the caller knows.
"""

TAKEN = 1
DIVISION = 7


def _bits(list_of_registers):
    return bin(list_of_registers).count("1")


def cycles(code):
    """`code` is the block's bytes."""
    total, index, after_access = 0, 0, False
    while index + 1 < len(code):
        first = int.from_bytes(code[index : index + 2], "little")
        index += 2
        access = False
        if first >> 11 < 0b11101:  # 16 bits
            top = first >> 12
            if top in (5, 6, 7, 8, 9) or first >> 11 == 0b01001:
                access = True
            elif top == 0xC or first & 0xF600 == 0xB400:  # ldm, stm, push, pop
                total += _bits(first & (0x1FF if top == 0xB else 0xFF))
            total += 1
        else:
            second = int.from_bytes(code[index : index + 2], "little")
            index += 2
            if first & 0xFE40 == 0xE800:  # ldm, stm
                total += 1 + _bits(second)
            elif first & 0xFE40 == 0xE840:  # ldrd, strd, and table branches
                total += 3
            elif first & 0xFE00 == 0xF800:  # ldr, str
                access = True
                total += 1
            elif first & 0xFFE0 == 0xEC40:  # vmov of two registers
                total += 2
            elif first & 0xFE00 == 0xEC00:  # vldr, vstr, vldm, vstm
                total += 1 + (second & 0xFF if first & 0x0120 != 0x0100 else 1)
            else:
                total += DIVISION if first & 0xFFD0 == 0xFB90 else 1
        total += access and not after_access
        after_access = access
    return total


# Added up by hand after the manual's table: code, and its cycles.
BLOCKS = [
    # Loads right after a load or store take 1.
    ("0168 4268 8918 0160 02d1", 2 + 1 + 1 + 2 + 1),  # ldr; ldr; adds; str; bne
    ("d1f89001 0248 00f032f8", 2 + 1 + 1),  # ldr.w; ldr of a constant; bl
    # Several registers take 1 each, and 1.
    ("10b5", 1 + 2),  # push {r4, lr}
    ("30bd", 1 + 3),  # pop {r4, r5, pc}
    ("0ec8", 1 + 3),  # ldm r0!, {r1-r3}
    ("2de9f04f", 1 + 9),  # push {r4-r11, lr}
    ("d2e90001", 1 + 2),  # ldrd
    # The unit for floating point.
    ("90ed000a", 2),  # vldr s0
    ("b0ec040a", 1 + 4),  # vldmia r0!, {s0-s3}
    ("51ec100b", 2),  # vmov r0, r1, d0
    # Arithmetic.
    ("b1fbf2f0", 7),  # udiv
    ("a2fb0301", 1),  # umull
    ("", 0),
]

if __name__ == "__main__":
    for block, wanted in BLOCKS:
        assert cycles(bytes.fromhex(block.replace(" ", ""))) == wanted, block
