/* From reset to main: a stack, no timer, floating point; and what interrupts. Memory begins as zeros, so that variables need nothing. */
  .section .start, "ax"
  .globl _start
_start:
  lis 1, stack_top@h
  ori 1, 1, stack_top@l
  lis 2, .TOC.@h
  ori 2, 2, .TOC.@l
  lis 3, 0x7fff
  mtdec 3
  mfmsr 3
  ori 3, 3, 0x2000
  mtmsrd 3
  bl main
  nop
1:
  b 1b

/* All exceptions but one end the program. */
  .macro other at
  . = \at
  b to_exception
  .endm
  other 0x100
  other 0x200
  other 0x300
  other 0x380
  other 0x400
  other 0x480
  . = 0x500
  b to_interrupt
  other 0x600
  other 0x700
  other 0x800
  other 0x900
  other 0xc00
  other 0xd00
  other 0xe40
  other 0xf00
  . = 0x1000
to_exception:
  bl exception
  nop
  b to_exception

/* Registers that a function may change are kept below those that the interrupted function may have written below its stack. */
to_interrupt:
  stdu 1, -512(1)
  std 0, 112(1)
  .irp register, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12
  std \register, 112 + 8 * \register(1)
  .endr
  mflr 3
  mfctr 4
  mfxer 5
  mfcr 6
  std 3, 32(1)
  std 4, 40(1)
  std 5, 48(1)
  std 6, 56(1)
  bl external_interrupt
  nop
  ld 3, 32(1)
  ld 4, 40(1)
  ld 5, 48(1)
  ld 6, 56(1)
  mtlr 3
  mtctr 4
  mtxer 5
  mtcr 6
  ld 0, 112(1)
  .irp register, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12
  ld \register, 112 + 8 * \register(1)
  .endr
  addi 1, 1, 512
  rfid
