"""Cycles of basic blocks, added up by hand after the table of the manual: `python -m unittest cortex_m4_test`."""

import unittest

from cortex_m4 import cycles

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


class Cycles(unittest.TestCase):
    def test_blocks(self):
        for code, wanted in BLOCKS:
            self.assertEqual(cycles(bytes.fromhex(code.replace(" ", ""))), wanted, code)


if __name__ == "__main__":
    unittest.main()
