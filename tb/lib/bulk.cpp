// Streams a file of input words through a verilated core and writes its results to a file.
// Words are uint64, one column a port, in the order of ports.inc (written by tb/lib/program.py).
// usage: core CFG,CFG,... IN OUT COUNT [SEED]   (SEED 0: no idle cycles and no back-pressure)
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <unistd.h>
#include <vector>

#include "Vtop.h"
#include "ports.inc"

static uint64_t state;
static unsigned random_bits() {  // xorshift64*: the seed decides every gap and stall
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return static_cast<unsigned>((state * 0x2545F4914F6CDD1DULL) >> 40);
}

static int fail(const char* why) {
    std::fprintf(stderr, "bulk: %s\n", why);
    return 2;
}

static int refuse(const char* why) {  // the core breaks its contract: a verdict, not a failure of the run
    std::fprintf(stderr, "bulk: %s\n", why);
    return 3;
}

static int bulk_main(int argc, char** argv) {
    if (argc < 6) return fail("usage: core CFG IN OUT COUNT SEED [+plusargs]");
    const size_t count = std::strtoull(argv[4], nullptr, 10);
    state = std::strtoull(argv[5], nullptr, 10);
    const bool gaps = state != 0;
    std::vector<uint64_t> cfg, in(count * N_IN), out(count * (N_OUT + 2));
    for (char* word = argv[1]; *word;) {
        cfg.push_back(std::strtoull(word, &word, 10));
        if (*word == ',') ++word;
    }
    if (cfg.size() < N_CFG) return fail("too few configuration words");
    FILE* file = std::fopen(argv[2], "rb");
    if (!file || std::fread(in.data(), 8 * N_IN, count, file) != count) return fail("cannot read the input file");
    std::fclose(file);

    VerilatedContext context;
    context.commandArgs(argc, argv);
    Vtop top{&context};
    SET_CFG(top, cfg.data());
#if CLOCKED
    size_t sent = 0, taken = 0, shown = 0, quiet = 0;
    uint64_t cycle = 0;
    std::vector<uint64_t> accepted(count);
    bool offered = false;
    unsigned stall = 0;  // clocks left of a long stall
    top.rst = 1; top.in_valid = 0; top.out_ready = 0;
    for (int i = 0; i < 4; ++i) { top.clk = 0; top.eval(); top.clk = 1; top.eval(); }
    top.rst = 0;
    while (taken < count) {
        top.clk = 0;
        const unsigned dice = gaps ? random_bits() : 0;
        if (!offered && sent < count && !(dice & 4)) {
            SET_IN(top, (&in[sent * N_IN]));
            offered = true;
        }
        top.in_valid = offered;
        if (stall) --stall;
        else if (gaps && !(dice & 0xff8)) stall = 65 + (dice >> 12 & 127);
        top.out_ready = !stall && !(dice & 2);
        top.eval();
        const bool push = offered && top.in_ready;
        if (top.out_valid && shown == taken) {
            if (taken >= sent) return refuse("a result without an accepted sample");
            out[taken * (N_OUT + 2) + N_OUT] = cycle - accepted[taken];
            ++shown;
        }
        if (top.out_valid && top.out_ready) {
            GET_OUT(top, (&out[taken * (N_OUT + 2)]));
            out[taken * (N_OUT + 2) + N_OUT + 1] = accepted[taken];
            ++taken;
            quiet = 0;
        } else if (++quiet > 100000) {
            return refuse("no result for 100000 cycles");
        }
        if (push) { accepted[sent++] = cycle; offered = false; }
        top.clk = 1;
        top.eval();
        ++cycle;
    }
#else
    for (size_t i = 0; i < count; ++i) {
        SET_IN(top, (&in[i * N_IN]));
        top.eval();
        GET_OUT(top, (&out[i * (N_OUT + 2)]));
    }
#endif
#if VM_COVERAGE
    const std::string counts = std::string(std::getenv("QUADRANCE_COVERAGE")) + "/" + std::to_string(getpid()) + ".dat";
    context.coveragep()->write(counts.c_str());
#endif
    file = std::fopen(argv[3], "wb");
    if (!file || std::fwrite(out.data(), 8 * (N_OUT + 2), count, file) != count) return fail("cannot write the output file");
    return std::fclose(file) ? fail("cannot write the output file") : 0;
}
