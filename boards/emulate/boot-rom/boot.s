@ A boot ROM for the emulated RP2040, because the chip's own is in no package registry. Written from section 2.8 of the RP2040
@ data sheet, which describes the layout and the functions; it contains nothing of the chip's ROM.
@
@ It has what firmware calls while it runs: the look-up of functions, copying and filling of memory, and counting of bits.
@ A look-up of anything else stops the emulator, where the chip's would succeed. Not in it: USB, flash programming, the
@ floating point library, the second core's start, and loading the second stage of booting into RAM: that stage runs where
@ it lies in flash, after the emulator has checked its CRC.

  .syntax unified
  .cpu cortex-m0
  .thumb
  .section .boot, "ax"

@ At address 0, so that a distance from here is an address, of which the tables have 16 bits.
rom:
  .word 0x20042000              @ 0x00: the stack, from the end of RAM
  .word reset + 1               @ 0x04
  .word fault + 1               @ 0x08: NMI
  .word fault + 1               @ 0x0c: HardFault
  .byte 'M', 'u', 1, 0          @ 0x10: the mark of a boot ROM, and its version
  .hword functions - rom        @ 0x14
  .hword data - rom             @ 0x16
  .hword lookup - rom + 1       @ 0x18

  .balign 4
functions:                      @ two letters, and the function's address with the bit for Thumb
  .ascii "P3"
  .hword popcount32 - rom + 1
  .ascii "R3"
  .hword reverse32 - rom + 1
  .ascii "L3"
  .hword clz32 - rom + 1
  .ascii "T3"
  .hword ctz32 - rom + 1
  .ascii "MS"
  .hword memset - rom + 1
  .ascii "S4"
  .hword memset - rom + 1
  .ascii "MC"
  .hword memcpy - rom + 1
  .ascii "C4"
  .hword memcpy - rom + 1
data:
  .hword 0, 0                   @ the end of either table

@ The second stage of booting starts the firmware if it is not called by anyone.
reset:
  movs r0, #0
  mov lr, r0
  ldr r0, =0x10000001
  bx r0

fault:
  bkpt #2

@ lookup(table, code) -> address
lookup:
  ldrh r2, [r0]
  cmp r2, #0
  beq unknown
  cmp r2, r1
  beq found
  adds r0, #4
  b lookup
found:
  ldrh r0, [r0, #2]
  bx lr
unknown:                        @ r1 is the code
  bkpt #1

@ memcpy(to, from, length) -> to: words if both addresses are equal modulo 4, else bytes.
memcpy:
  push {r0, r4, lr}
  movs r3, r0
  eors r3, r1
  lsls r3, r3, #30
  bne copy_rest
copy_to_word:
  lsls r3, r0, #30
  beq copy_words
  cmp r2, #0
  beq copied
  ldrb r3, [r1]
  strb r3, [r0]
  adds r0, #1
  adds r1, #1
  subs r2, #1
  b copy_to_word
copy_words:
  subs r2, #4
  blo copy_last
copy_word:
  ldmia r1!, {r3}
  stmia r0!, {r3}
  subs r2, #4
  bhs copy_word
copy_last:
  adds r2, #4
copy_rest:
  cmp r2, #0
  beq copied
copy_byte:
  ldrb r3, [r1]
  strb r3, [r0]
  adds r0, #1
  adds r1, #1
  subs r2, #1
  bne copy_byte
copied:
  pop {r0, r4, pc}

@ memset(to, byte, length) -> to
memset:
  push {r0, r4, lr}
  uxtb r1, r1
  lsls r3, r1, #8
  orrs r1, r3
  lsls r3, r1, #16
  orrs r1, r3
fill_to_word:
  lsls r3, r0, #30
  beq fill_words
  cmp r2, #0
  beq filled
  strb r1, [r0]
  adds r0, #1
  subs r2, #1
  b fill_to_word
fill_words:
  subs r2, #4
  blo fill_last
fill_word:
  stmia r0!, {r1}
  subs r2, #4
  bhs fill_word
fill_last:
  adds r2, #4
  beq filled
fill_byte:
  strb r1, [r0]
  adds r0, #1
  subs r2, #1
  bne fill_byte
filled:
  pop {r0, r4, pc}

@ popcount32(value) -> the number of its bits that are 1
popcount32:
  movs r1, #0
count_bit:
  movs r2, r0
  beq counted
  subs r2, #1
  ands r0, r2                   @ without its lowest 1
  adds r1, #1
  b count_bit
counted:
  movs r0, r1
  bx lr

@ reverse32(value) -> its bits in the opposite order
reverse32:
  movs r1, #0
  movs r2, #32
reverse_bit:
  lsrs r0, r0, #1               @ the lowest bit into the carry,
  adcs r1, r1                   @ and from there
  subs r2, #1
  bne reverse_bit
  movs r0, r1
  bx lr

@ clz32(value) -> the number of zeros above its highest 1; 32 for 0
clz32:
  movs r1, #32
clz_16:
  lsrs r2, r0, #16
  beq clz_8
  subs r1, #16
  movs r0, r2
clz_8:
  lsrs r2, r0, #8
  beq clz_4
  subs r1, #8
  movs r0, r2
clz_4:
  lsrs r2, r0, #4
  beq clz_2
  subs r1, #4
  movs r0, r2
clz_2:
  lsrs r2, r0, #2
  beq clz_1
  subs r1, #2
  movs r0, r2
clz_1:                          @ 0 to 3 are left, of 0, 1 or 2 bits
  lsrs r2, r0, #1
  beq clz_0
  subs r1, #1
  movs r0, r2
clz_0:
  subs r0, r1, r0
  bx lr

@ ctz32(value) -> the number of zeros below its lowest 1; 32 for 0
ctz32:
  cmp r0, #0
  beq ctz_of_0
  push {lr}
  rsbs r1, r0, #0
  ands r0, r1                   @ its lowest 1 alone
  bl clz32
  movs r1, #31
  subs r0, r1, r0
  pop {pc}
ctz_of_0:
  movs r0, #32
  bx lr
  .pool
