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
