# SPDX-License-Identifier: Apache-2.0
# Start of a program, and the way to its interrupt handler. The lamps show what main returned, then the CPU stops.
.section .text.start
.globl _start
_start:
    j begin

# 0x10: the CPU comes here with interrupts masked, the way back in q0 and what is pending in q1. `interrupt(pending)`
# may change what a C function may.
.balign 16
    addi sp, sp, -64
    sw ra, 0(sp)
    sw t0, 4(sp)
    sw t1, 8(sp)
    sw t2, 12(sp)
    sw a0, 16(sp)
    sw a1, 20(sp)
    sw a2, 24(sp)
    sw a3, 28(sp)
    sw a4, 32(sp)
    sw a5, 36(sp)
    sw a6, 40(sp)
    sw a7, 44(sp)
    sw t3, 48(sp)
    sw t4, 52(sp)
    sw t5, 56(sp)
    sw t6, 60(sp)
    .word 0x0000c50b        # getq a0, q1
    call interrupt
    lw ra, 0(sp)
    lw t0, 4(sp)
    lw t1, 8(sp)
    lw t2, 12(sp)
    lw a0, 16(sp)
    lw a1, 20(sp)
    lw a2, 24(sp)
    lw a3, 28(sp)
    lw a4, 32(sp)
    lw a5, 36(sp)
    lw a6, 40(sp)
    lw a7, 44(sp)
    lw t3, 48(sp)
    lw t4, 52(sp)
    lw t5, 56(sp)
    lw t6, 60(sp)
    addi sp, sp, 64
    .word 0x0400000b        # retirq

begin:
    la sp, _stack
    la a0, _bss
    la a1, _end
    j 2f
1:  sw zero, 0(a0)
    addi a0, a0, 4
2:  bltu a0, a1, 1b
    call main
    li t0, 0x10000000
    sw a0, 4(t0)
3:  lw t1, 0(t0)            # what is being sent
    bnez t1, 3b
4:  ebreak

.weak interrupt             # a program without one has all interrupts masked
interrupt:
    j 4b
