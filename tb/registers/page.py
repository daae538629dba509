"""The map of registers as docs/registers.md states it. Nothing here is the generator's."""

from __future__ import annotations

from quadrance.cores import Core, Port

ID, VERSION, START, STATE, IRQ_ENABLE = 0x000, 0x004, 0x008, 0x00C, 0x010
MAP_VERSION = 0x00010000
BLOCKS = ((0x100, "cfg"), (0x200, "in"), (0x300, "out"))


def places(core: Core) -> list[tuple[int, Port, int, int]]:
    """(address, port, its bit that is bit 0 of the register, bits) of every data word, lowest bits first."""
    found = []
    for base, kind in BLOCKS:
        address = base
        for port in {"cfg": core.cfg, "in": core.inputs, "out": core.outputs}[kind]:
            if port.name == "out_status":
                continue
            for low in range(0, port.width, 32):
                found.append((address, port, low, min(32, port.width - low)))
                address += 4
    return found


def register(port: Port, value: int, low: int, width: int) -> int:
    """What a register reads of a word: signed words have their sign in the bits above."""
    bits = value >> low & (1 << width) - 1
    return (bits - (1 << width) if port.signed and bits >> width - 1 else bits) & 0xFFFFFFFF


def outside(core: Core) -> list[tuple[int, int]]:
    """(address, bytes) of writes that must do nothing."""
    at = {kind: [address for address, port, *_ in places(core) if port.name.startswith(kind)] for _, kind in BLOCKS}
    after = [(at[kind] or [base - 4])[-1] + 4 for base, kind in BLOCKS]
    first = at["in"][0]
    return [(address, 4) for address in (ID, VERSION, 0x014, 0x018, 0x01C, 0x080, *after, at["out"][0], at["out"][-1],
                                         0x400 + first, 0x800 + first, 0x400 + START, 0x800 + IRQ_ENABLE, 0x080 + first,
                                         0x040 + first, 0x020 + IRQ_ENABLE, 0xFFC)
            ] + [(first, 2), (first, 3), (START, 1), (IRQ_ENABLE, 1), (STATE, 1)]
