// Streams a file of input words through a verilated core and writes its results to a file.
// Words are uint64, one column a port, in the order of ports.inc (written by tb/lib/program.py).
// usage: core CFG,CFG,... IN OUT COUNT SEED [PLAN]   (SEED 0: no idle cycles and no back-pressure)
// With a PLAN there are resets, see resets() below.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
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

static const size_t ROW = N_OUT + 2;  // outputs, latency, clock of the accepting edge

#if CLOCKED
// A core, and what its contract says of every clock.
struct Bench {
    Vtop& top;
    uint64_t cycle = 0;
    size_t accepted = 0, taken = 0;        // since the last reset
    bool push = false, fresh = false, pop = false;  // at the last edge: a sample in, a result offered first, taken
    bool waits = false;                    // a result was offered and not taken
    uint64_t now[N_OUT], before[N_OUT];
    const char* wrong = nullptr;

    bool edge() {  // a clock with the inputs as they are; false when the core breaks its contract
        top.clk = 0;
        top.eval();
        push = !top.rst && top.in_valid && top.in_ready;
        pop = !top.rst && top.out_valid && top.out_ready;
        fresh = !top.rst && top.out_valid && !waits;
        if (top.out_valid) GET_OUT(top, now);
        if (!top.rst) {
            if (waits && !top.out_valid) wrong = "out_valid fell before out_ready took the result";
            else if (waits && std::memcmp(now, before, sizeof now)) wrong = "the result changed while it waited";
            else if (top.out_valid && taken >= accepted) wrong = "a result without an accepted sample";
        }
        waits = !top.rst && top.out_valid && !top.out_ready;
        std::memcpy(before, now, sizeof now);
        accepted = top.rst ? 0 : accepted + push;
        taken = top.rst ? 0 : taken + pop;
        top.clk = 1;
        top.eval();
        ++cycle;
        return !wrong;
    }

    int refuse(const char* why, size_t sample) {  // a verdict, not a failure of the run
        std::fprintf(stderr, "bulk: %s: sample %zu, clock %llu of the run\n", why, sample,
                     static_cast<unsigned long long>(cycle));
        return 3;
    }
};

static const unsigned PATIENCE = 100000;

// All samples from one reset; idle cycles and stalls where `gaps`, four of them long while a result waits.
static int stream(Bench& core, const std::vector<uint64_t>& in, std::vector<uint64_t>& out, size_t count, bool gaps) {
    Vtop& top = core.top;
    std::vector<uint64_t> accepted(count);
    bool offered = false;
    unsigned stall = 0, quiet = 0, longer = 0;  // clocks left of a stall, clocks without a result, long stalls so far
    uint64_t longest = 1;
    while (core.taken < count) {
        const unsigned dice = gaps ? random_bits() : 0;
        if (!offered && core.accepted < count && !(dice & 4)) {
            SET_IN(top, (&in[core.accepted * N_IN]));
            offered = true;
        }
        top.in_valid = offered;
        if (stall) --stall;
        else if (gaps && longer < 4 && core.waits && core.taken >= (longer + 1) * count / 5)
            stall = longer++ % 2 ? 1100 : 300;
        else if (gaps && !(dice & 0xff8)) stall = 65 + (dice >> 12 & 127);
        top.out_ready = !stall && !(dice & 2);
        const size_t sample = core.taken;
        const uint64_t cycle = core.cycle;
        if (!core.edge()) return core.refuse(core.wrong, sample);
        if (core.push) { accepted[core.accepted - 1] = cycle; offered = false; }
        uint64_t* row = &out[sample * ROW];
        if (core.fresh) {
            row[N_OUT] = cycle - accepted[sample];
            if (row[N_OUT] > longest) longest = row[N_OUT];
        }
        if (core.pop) {
            std::memcpy(row, core.now, sizeof core.now);
            row[N_OUT + 1] = accepted[sample];
            quiet = 0;
        } else if (++quiet > PATIENCE) {
            return core.refuse("no result for 100000 clocks", sample);
        }
    }
    top.in_valid = 0;
    top.out_ready = 1;
    for (uint64_t i = 0; i < 2 * longest + 4; ++i)  // one too many would come now
        if (!core.edge()) return core.refuse(core.wrong, count);
    return 0;
}

// A round for each row of the plan: `few` samples of IN, the next ones of every round, whose results are kept; then
// the samples behind those of all rounds, in a circle, until the clock of the row; then a clock of reset.
//   plan: rounds, few; a row a round: clock (0: the first of them stands at the idle core in the reset clock), flags
//   flags: 1 a word stands at the input in the reset clock, 2 out_ready is low before it, 4 idle clocks after it
static int resets(Bench& core, const std::vector<uint64_t>& in, std::vector<uint64_t>& out, size_t count,
                  const std::vector<uint64_t>& plan) {
    Vtop& top = core.top;
    const size_t rounds = plan[0], few = plan[1], begin = rounds * few;
    size_t next = begin;
    for (size_t round = 0; round < rounds; ++round) {
        const uint64_t clocks = plan[2 * round + 2], flags = plan[2 * round + 3];
        unsigned quiet = 0;
        top.out_ready = 1;
        while (core.taken < few) {
            const size_t at = round * few + core.taken;
            top.in_valid = core.accepted < few;
            if (core.accepted < few) SET_IN(top, (&in[(round * few + core.accepted) * N_IN]));
            if (!core.edge()) return core.refuse(core.wrong, at);
            if (core.pop) { std::memcpy(&out[at * ROW], core.now, sizeof core.now); quiet = 0; }
            else if (++quiet > PATIENCE) return core.refuse("no result for 100000 clocks", at);
        }
        top.out_ready = !(flags & 2);
        for (uint64_t i = 0; i <= clocks; ++i) {
            top.rst = i == clocks;
            top.in_valid = !top.rst || flags & 1;
            SET_IN(top, (&in[next * N_IN]));
            if (!core.edge()) return core.refuse(core.wrong, round * few + few - 1);
            if (core.push && ++next == count) next = begin;
        }
        top.rst = top.in_valid = 0;
        for (unsigned i = flags & 4 ? random_bits() & 63 : 0; i; --i)
            if (!core.edge()) return core.refuse(core.wrong, (round + 1) * few);
    }
    return 0;
}
#endif

static bool load(const char* name, std::vector<uint64_t>& words) {
    FILE* file = std::fopen(name, "rb");
    const bool done = file && std::fread(words.data(), 8, words.size(), file) == words.size();
    if (file) std::fclose(file);
    return done;
}

static int bulk_main(int argc, char** argv) {
    if (argc < 6) return fail("usage: core CFG IN OUT COUNT SEED [PLAN] [+plusargs]");
    const size_t count = std::strtoull(argv[4], nullptr, 10);
    state = std::strtoull(argv[5], nullptr, 10);
    const bool gaps = state != 0;
    std::vector<uint64_t> cfg, in(count * N_IN), out(count * ROW);
    for (char* word = argv[1]; *word;) {
        cfg.push_back(std::strtoull(word, &word, 10));
        if (*word == ',') ++word;
    }
    if (cfg.size() < N_CFG) return fail("too few configuration words");
    if (!load(argv[2], in)) return fail("cannot read the input file");

    VerilatedContext context;
    context.commandArgs(argc, argv);
    Vtop top{&context};
    SET_CFG(top, cfg.data());
#if CLOCKED
    Bench core{top};
    top.rst = 1; top.in_valid = 0; top.out_ready = 0;
    for (int i = 0; i < 4; ++i) core.edge();
    top.rst = 0;
    int verdict;
    if (argc > 6 && *argv[6] != '+') {
        std::vector<uint64_t> plan(2);
        if (!load(argv[6], plan)) return fail("cannot read the plan");
        plan.resize(2 * plan[0] + 2);
        if (!load(argv[6], plan)) return fail("cannot read the plan");
        verdict = resets(core, in, out, count, plan);
    } else {
        verdict = stream(core, in, out, count, gaps);
    }
    if (verdict) return verdict;
#else
    for (size_t i = 0; i < count; ++i) {
        SET_IN(top, (&in[i * N_IN]));
        top.eval();
        GET_OUT(top, (&out[i * ROW]));
    }
#endif
#if VM_COVERAGE
    const std::string counts = std::string(std::getenv("QUADRANCE_COVERAGE")) + "/" + std::to_string(getpid()) + ".dat";
    context.coveragep()->write(counts.c_str());
#endif
    FILE* file = std::fopen(argv[3], "wb");
    if (!file || std::fwrite(out.data(), 8 * ROW, count, file) != count) return fail("cannot write the output file");
    return std::fclose(file) ? fail("cannot write the output file") : 0;
}
