/* SPDX-License-Identifier: Apache-2.0 */
/* What every program on the system of soc.v needs. */
#ifndef SOC_H
#define SOC_H
#include <stdint.h>

#define SOC_SERIAL ((volatile uint32_t *)0x10000000)
#define SOC_LAMPS ((volatile uint32_t *)0x10000004)
#define SOC_CORE(i) ((volatile uint32_t *)(0x80000000u + 0x1000u * (i)))
#define SOC_IRQ(i) (1u << (3 + (i)))

/* sends a word, the lowest byte first */
static inline void soc_send(uint32_t word) {
    while (*SOC_SERIAL) { }
    *SOC_SERIAL = word;
}

/* clocks since the reset */
static inline uint32_t soc_clocks(void) {
    uint32_t clocks;
    __asm__ volatile ("rdcycle %0" : "=r"(clocks) :: "memory");
    return clocks;
}

/* interrupts that the CPU takes, of SOC_IRQ; `interrupt` handles them */
static inline void soc_take(uint32_t interrupts) {
    __asm__ volatile (".insn r 0x0b, 6, 3, zero, %0, zero" :: "r"(~interrupts) : "memory");
}
void interrupt(uint32_t pending);
#endif
