// SPDX-License-Identifier: Apache-2.0
// soc.v with DIVIDE = 1: what its serial line sends goes to the standard output until the program ends.
//   system LIMIT        a program that runs for more clocks is stopped
// The last line of the standard error: lamps and clocks, or "none" and clocks.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "Vsoc.h"
#include "verilated.h"

int main(int, char **argv) {
    auto soc = std::make_unique<Vsoc>();
    const uint64_t limit = strtoull(argv[1], nullptr, 10);
    uint64_t clocks = 0;
    int bit = 0, byte = 0;
    for (; clocks < limit && !soc->trap; clocks++) {
        soc->clk = 0;
        soc->rst = clocks < 4;
        soc->eval();
        soc->clk = 1;
        soc->eval();
        if (bit == 0) {
            bit = !soc->tx && clocks > 4;  // a start bit
        } else if (bit <= 8) {
            byte = byte >> 1 | soc->tx << 7;
            bit++;
        } else {
            if (!soc->tx) return fprintf(stderr, "no stop bit in clock %llu\n", (unsigned long long)clocks), 1;
            putchar(byte);
            bit = 0;
        }
    }
    if (soc->trap) fprintf(stderr, "%d ", soc->led);
    else fprintf(stderr, "none ");
    fprintf(stderr, "%llu\n", (unsigned long long)clocks);
    return 0;
}
