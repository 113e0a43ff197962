"""Writes events as AEDAT 1, 2 and 3.1, from the descriptions of those formats alone.

  make_aedat.py KIND EVENTS OUT   EVENTS: packed little-endian records t i64, x u16, y u16, p u8
"""
import struct
import sys

JAER = ("#!AER-DAT2.0\r\n# This is a raw AE data file - do not edit\r\n"
        "# Data format is int32 address, int32 timestamp (8 bytes total), repeated for each event\r\n"
        "# Timestamps tick is 1 us\r\n# created Fri Sep 18 09:50:42 CEST 2015\r\n# HardwareInterface: test\r\n")
V2E = ("#!AER-DAT2.0\r\n# This is a raw AE data file created by AEDat2Output in v2e (see https://github.com/SensorsINI/v2e) "
       "as specified at https://inivation.com/support/software/fileformat/#aedat-20\r\n"
       "# Data format is int32 address, int32 timestamp (8 bytes total), repeated for each event\r\n"
       "# Timestamps tick is 1 us\r\n# Creation time: 01:57PM December 01 2026\r\n# User name: t\r\n")
PREFERENCES = "".join(f'#                <entry key="DAVIS.Bias{i}" value="{i * 7}"/>\r\n' for i in range(3000))


def davis(width, height):
    return lambda x, y, p: (height - 1 - y) << 22 | (width - 1 - x) << 12 | p << 11


def dvs128(x, y, p):
    return (127 - y) << 8 | (127 - x) << 1 | (1 - p)


def dvs640(x, y, p):
    return (479 - y) << 11 | (639 - x) << 1 | p


def records(events, address, between=lambda i, t: b""):
    out = b""
    for i, (t, x, y, p) in enumerate(events):
        out += between(i, t) + struct.pack(">Ii", address(x, y, p), wrapped(t))
    return out


def wrapped(t):
    return (t + 2**31) % 2**32 - 2**31


def samples(i, t):
    """A few samples of a frame, of the IMU, and a trigger."""
    if i % 50 != 7:
        return b""
    return (struct.pack(">Ii", 1 << 31 | 5 << 22 | 6 << 12 | 300, wrapped(t)) +
            struct.pack(">Ii", 1 << 31 | 3 << 10 | 77, wrapped(t - 900)) +
            struct.pack(">Ii", 1 << 10 | (2 if i % 100 == 7 else 3), wrapped(t)))


def aedat3(events, sources, mixed):
    head = "#!AER-DAT3.1\r\n#Format: RAW\r\n"
    for i, name in enumerate(sources):
        head += f"#Source {i}: {name}\r\n#-Source 0: File\r\n"
    head += "#Start-Time: 2017-03-08 12:00:00 (TZ+0100)\r\n#!END-HEADER\r\n"

    def packet(kind, source, size, turns, listed, capacity=None):
        body = b"".join(listed)
        number = len(listed)
        capacity = number if capacity is None else capacity
        return struct.pack("<hhiiiiii", kind, source, size, 4, turns, capacity, number, number) + body + bytes(
            size * (capacity - number))

    out = head.encode()
    for first in range(0, len(events), 700):
        group = events[first:first + 700]
        # A packet holds events of one turn of the clock.
        for turn in sorted({t >> 31 for t, *_ in group}):
            ours = [e for e in group if e[0] >> 31 == turn]
            listed = [struct.pack("<Ii", x << 17 | y << 2 | p << 1 | 1, t & 0x7FFFFFFF) for t, x, y, p in ours]
            if mixed:
                listed.insert(len(listed) // 2, struct.pack("<Ii", 5 << 17 | 5 << 2, ours[0][0] & 0x7FFFFFFF))
                other = [struct.pack("<Ii", x << 17 | y << 2 | (1 - p) << 1 | 1, t & 0x7FFFFFFF) for t, x, y, p in ours]
                out += packet(1, 1, 8, turn, other)
                t = ours[0][0] & 0x7FFFFFFF
                out += packet(0, 0, 8, turn, [struct.pack("<Ii", kind << 1 | valid, t + i) for i, (kind, valid) in
                                              enumerate([(2, 1), (3, 1), (3, 0), (6, 1), (14, 1), (13, 1)])])
                pixels = b"".join(struct.pack("<H", 300 * i) for i in range(12))
                frame = struct.pack("<Iiiiiiiii", 1 << 1 | 1, t, t + 40, t + 10, t + 30, 4, 3, 0, 0) + pixels
                coloured = struct.pack("<Iiiiiiiii", 3 << 1 | 1, t, t + 40, t + 10, t + 30, 2, 2, 0, 0) + b"".join(
                    struct.pack("<HHH", 60000, 30000, 15000) for _ in range(4))
                broken = struct.pack("<Iiiiiiiii", 1 << 1 | 1, t, t + 40, t + 10, t + 30, 400, 300, 0, 0) + pixels
                out += packet(2, 0, 60, turn, [frame, coloured, broken][first // 700 % 3:][:1])
                out += packet(3, 0, 36, turn, [bytes(36)])
            out += packet(1, 0, 8, turn, listed, len(listed) + 2)
    return out


def main():
    kind, source, path = sys.argv[1:]
    with open(source, "rb") as file:
        events = list(struct.iter_unpack("<qHHB", file.read()))
    if kind == "davis240":
        data = (JAER + "# AEChip: eu.seebetter.ini.chips.davis.DAVIS240C\r\n" + PREFERENCES +
                "#End Of ASCII Header\r\n").encode() + records(events, davis(240, 180), samples)
    elif kind == "davis346":
        data = (JAER + "# AEChip: eu.seebetter.ini.chips.davis.Davis346red\r\n").encode() + records(events, davis(346, 260))
    elif kind == "v2e346":
        data = V2E.encode() + records(events, davis(346, 260))
    elif kind == "v2e346-noise":  # simulated noise is labelled by the bit of triggers
        data = (V2E + "# noise events are labeled as addressed external input events when the --label_signal_noise option "
                "is selected for output\r\n").encode()
        data += records(events, lambda x, y, p: davis(346, 260)(x, y, p) | (1 << 10 if x % 3 == 0 else 0))
    elif kind == "v2e640":
        data = V2E.encode() + records(events, dvs640)
    elif kind == "dvs128":
        def sync(i, t):
            return struct.pack(">Ii", 1 << 15, wrapped(t)) if i % 100 == 3 else b""
        data = (JAER + "# AEChip: ch.unizh.ini.jaer.chip.retina.DVS128\r\n").encode() + records(events, dvs128, sync)
    elif kind == "dvs128-no-chip":
        data = JAER.encode() + records(events, dvs128)
    elif kind == "aedat1":
        data = b"".join(struct.pack(">Hi", dvs128(x, y, p), wrapped(t)) for t, x, y, p in events)
    elif kind == "aedat3":
        data = aedat3(events, ["DAVIS240C"], mixed=False)
    elif kind == "aedat3-dvs128":
        data = aedat3(events, ["DVS128"], mixed=False)
    elif kind == "aedat3-mixed":
        data = aedat3(events, ["DAVIS240C", "DAVIS346B"], mixed=True)
    else:
        sys.exit(f"make_aedat: unknown kind {kind}")
    with open(path, "wb") as file:
        file.write(data)


main()
