// The program of a verilated core: with words on its command line a bulk run, without any (but +plusargs) the cocotb
// bench.
#define main cocotb_main
#include "verilator.cpp"  // cocotb's own, with the time that $time returns
#undef main
#include "bulk.cpp"

int main(int argc, char** argv) { return argc > 1 && *argv[1] != '+' ? bulk_main(argc, argv) : cocotb_main(argc, argv); }
