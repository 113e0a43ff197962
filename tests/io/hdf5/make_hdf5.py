"""Writes events into HDF5 files as other people's programs do, with h5py alone.

  make_hdf5.py LAYOUT EVENTS OUT     EVENTS: packed little-endian records t u64, x u16, y u16, p u8
  make_hdf5.py check-dsec EVENTS IN  whether h5py finds those events in a DSEC file, with a right index
Exit status 77: h5py, or a filter that the layout needs, is not installed.
"""
import os
import struct
import sys

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

PACKED = np.dtype([("t", "<i8"), ("x", "<u2"), ("y", "<u2"), ("p", "u1")])
ECF, BLOSC, LZ4, ZSTD = 36559, 32001, 32004, 32015
CHUNK = 16384


# --- An encoder of ECF, written from the description of the format. -----------------------------------------------
def runs(values):
    """(value, first index, length) of runs of equal values."""
    cuts = np.flatnonzero(np.diff(values)) + 1
    begins = np.concatenate(([0], cuts))
    ends = np.concatenate((cuts, [len(values)]))
    return [(int(values[b]), int(b), int(e - b)) for b, e in zip(begins, ends)]


def ecf_times(t):
    out = bytearray(struct.pack("<q", int(t[0])))
    previous = int(t[0])
    for value, _, length in runs(t):
        step = value - previous
        previous = value
        if step > 14:
            nibbles = step
            step = 0
            while nibbles:
                out.append(0xF0 | (nibbles & 15))
                nibbles >>= 4
        if length < 15:
            out.append(step << 4 | length)
        else:
            out.append(step << 4 | 15)
            out += struct.pack("<H", length)
    return out


def ecf_groups(values, bits):
    """Four values of 3 * bits / 4 bits in three words."""
    part = bits // 4
    out = bytearray()
    padded = [int(v) for v in values] + [0] * (-len(values) % 4)
    for i in range(0, len(padded), 4):
        a, b, c, d = padded[i:i + 4]
        low = (1 << part) - 1
        # The second value is spread over words 0 and 1, the third over words 1 and 2.
        w0 = a << part | (b & low)
        w1 = (b >> part) << 2 * part | (c & ((1 << 2 * part) - 1))
        w2 = (c >> 2 * part) << 3 * part | d
        out += struct.pack("<III" if bits == 32 else "<HHH", w0, w1, w2)
    return out


def ecf_rows(y):
    out = bytearray()
    for value, _, length in runs(y):
        if length < 31:
            out += struct.pack("<H", value << 5 | length)
        else:
            out += struct.pack("<HH", value << 5 | 31, length)
    return out


def ecf_columns(x):
    out = bytearray()
    i = 0
    while i < len(x):
        base, mask = int(x[i]), 0
        i += 1
        last = base
        while i < len(x) and last < int(x[i]) <= base + 5:
            last = int(x[i])
            mask |= 1 << (4 - (last - base - 1))
            i += 1
        out += struct.pack("<H", base << 5 | mask)
    return out


def ecf_polarities(p):
    out = bytearray()
    for value, _, length in runs(p):
        if length < 127:
            out.append(value << 7 | length)
        else:
            out.append(value << 7 | 127)
            out += struct.pack("<H", length)
    return out


def ecf_chunk(e, mode):
    """mode 0: y, x, p packed; 1: runs of y, x and p packed; 2: runs of y, masks of x, runs of p."""
    yxp, xp = (1, 0) if mode == 0 else (0, 1 if mode == 1 else 0)
    out = bytearray(struct.pack("<I", len(e) << 2 | yxp << 1 | xp)) + ecf_times(e["t"])
    x, y, p = (e[name].astype(np.int64) for name in "xyp")
    if mode == 0:
        return bytes(out + ecf_groups(y << 12 | x << 1 | p, 32))
    out += ecf_rows(y)
    return bytes(out + (ecf_groups(x << 1 | p, 16) if mode == 1 else ecf_columns(x) + ecf_polarities(p)))


def ecf_chunks(e, out):
    """Chunks of all modes and many sizes: u32 mode-independent n, u32 length, the chunk, and its packed events."""
    with open(out, "wb") as file:
        for n in [1, 2, 3, 4, 5, 6, 7, 8, 14, 15, 16, 30, 31, 32, 126, 127, 128, 1000, 4095, 16384]:
            for mode in range(3):
                part = np.sort(e[:n], order="t", kind="stable") if n > 8 else e[:n]
                chunk = ecf_chunk(part, mode)
                file.write(struct.pack("<II", len(part), len(chunk)) + chunk + part.tobytes())


# --- Layouts -------------------------------------------------------------------------------------------------------
CD = np.dtype({"names": ["x", "y", "p", "t"], "formats": ["<u2", "<u2", "<i2", "<i8"], "offsets": [0, 2, 4, 8],
               "itemsize": 16})


def need(filter_id):
    if not h5py.h5z.filter_avail(filter_id):
        sys.exit(77)


def metavision(e, f, how):
    f.attrs["version"] = "1.0"
    f.attrs["geometry"] = "1280x720"
    records = np.zeros(len(e), CD)
    for name in "xypt":
        records[name] = e[name]
    if how == "plain":
        f.create_dataset("CD/events", data=records)
    elif how == "gzip":
        f.create_dataset("CD/events", data=records, chunks=(CHUNK,), compression="gzip", shuffle=True)
    else:
        properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        properties.set_chunk((CHUNK,))
        properties.set_filter(ECF, h5py.h5z.FLAG_OPTIONAL)
        space = h5py.h5s.create_simple((len(e),), (h5py.h5s.UNLIMITED,))
        group = f.create_group("CD")
        dataset = h5py.h5d.create(group.id, b"events", h5py.h5t.py_create(CD), space, properties)
        for k, i in enumerate(range(0, len(e), CHUNK)):
            broken = how == "broken" and k == 1
            dataset.write_direct_chunk((i,), b"\xff" * 100 if broken else ecf_chunk(e[i:i + CHUNK], k % 3))


def columns(f, group, e, names="xytp", types=("<u2", "<u2", "<i8", "u1"), **how):
    for name, field, kind in zip(names if isinstance(names, list) else list(names), "xytp", types):
        f.create_dataset(f"{group}/{name}", data=e[field].astype(kind), **how)


def dsec(e, f, **how):
    origin = e["t"][0]
    relative = e.copy()
    relative["t"] -= origin
    columns(f, "events", relative, types=("<u2", "<u2", "<u4", "u1"), **how)
    f["t_offset"] = np.int64(origin)
    f["ms_to_idx"] = np.searchsorted(relative["t"], np.arange(relative["t"][-1] // 1000 + 1) * 1000).astype("<u8")


def mvsec(e, f):
    # Unix time in seconds, as doubles.
    def rows(x):
        return np.stack([x, e["y"], 1506117899 + e["t"] / 1e6, e["p"] * 2.0 - 1], axis=1).astype("f8")
    for side, x in (("left", e["x"]), ("right", 1279 - e["x"].astype(int))):
        f.create_dataset(f"davis/{side}/events", data=rows(x), chunks=True, compression="gzip")
        pictures = np.arange(3 * 720 * 1280, dtype="u8").reshape(3, 720, 1280) % 251 + (side == "right")
        f.create_dataset(f"davis/{side}/image_raw", data=pictures.astype("u1"), chunks=(1, 720, 1280))
        f[f"davis/{side}/image_raw_ts"] = np.array([1506117899.000001, 1506117899.25, 1506117900.999999])


# x, y, t, p as other tools call them.
NAMES = {
    "names-dv": ("x", "y", "timestamp", "polarity"),
    "names-loris": ("x", "y", "t", "is_increase"),
    "names-upper": ("X", "Y", "T", "P"),
    "names-plural-deep": ("xs", "ys", "timestamps", "polarities"),
    "names-faery": ("x", "y", "time", "on"),
}


def matlab(e, f, what):
    """As MATLAB 7.3 writes: doubles, the dimensions of a matrix in reverse, the class in an attribute."""
    def save(path, values):
        f[path] = values
        f[path].attrs["MATLAB_class"] = np.bytes_("double")

    doubles = {name: e[name].astype("f8") for name in "xytp"}
    if what == "struct":  # a struct of columns, N x 1
        for name in "xytp":
            save(f"events/{name}", doubles[name][np.newaxis, :])
        f["events"].attrs["MATLAB_class"] = np.bytes_("struct")
    elif what == "vectors":  # in the root, 1 x N and in chunks
        for name, field in (("ts", "t"), ("x", "x"), ("y", "y"), ("pol", "p")):
            f.create_dataset(name, data=doubles[field][:, np.newaxis], chunks=(1000, 1), compression="gzip")
            f[name].attrs["MATLAB_class"] = np.bytes_("double")
    elif what == "matrix":  # N x 4
        f.create_dataset("TD", data=np.stack([doubles[name] for name in "xytp"]), chunks=(1, 1000), compression="gzip")
        f["TD"].attrs["MATLAB_class"] = np.bytes_("double")
    elif what == "square":
        save("TD", np.stack([doubles[name][:4] for name in "xytp"]))


def write(layout, e, f):
    if layout.startswith("metavision-"):
        metavision(e, f, layout.split("-")[1])
    elif layout == "dsec-gzip":
        dsec(e, f, chunks=(10000,), compression="gzip", shuffle=True, fletcher32=True)
    elif layout == "dsec-blosc":
        need(BLOSC)
        dsec(e, f, chunks=(40000,), compression=BLOSC, compression_opts=(0, 0, 0, 0, 1, 1, 5))
    elif layout == "dsec-lz4":
        need(LZ4)
        dsec(e, f, chunks=(40000,), compression=LZ4)
    elif layout == "dsec-broken":
        dsec(e, f, chunks=(10000,), compression="gzip")
        f["events/x"].id.write_direct_chunk((10000,), b"\x00" * 64)
    elif layout == "dsec-shorter":
        dsec(e, f)
        y = f["events/y"][:-5]
        del f["events/y"]
        f["events/y"] = y
    elif layout == "rvt":
        signed = e.copy().astype([("t", "i8"), ("x", "u2"), ("y", "u2"), ("p", "i1")])
        signed["p"] = signed["p"] * 2 - 1
        columns(f, "events", signed, types=("<u2", "<u2", "<i8", "i1"), chunks=True, compression="lzf")
        f["events/height"], f["events/width"] = 720, 1280
    elif layout == "m3ed":
        other = e.copy()
        other["x"] = 1279 - e["x"]
        for side, events in (("left", e), ("right", other)):
            columns(f, f"prophesee/{side}", events, types=("<u2", "<u2", "<i8", "i1"), chunks=(40000,),
                    compression="lzf")
            f[f"prophesee/{side}/calib/resolution"] = np.array([1280, 720])
    elif layout == "mvsec":
        mvsec(e, f)
    elif layout == "event-utils":
        for name, values in (("xs", e["x"].astype("<i2")), ("ys", e["y"].astype("<i2")), ("ts", e["t"] / 1e6),
                             ("ps", e["p"].astype(bool))):
            f.create_dataset(f"events/{name}", data=values, chunks=True)
        f.attrs["sensor_resolution"] = (720, 1280)
        f.attrs["num_imgs"] = 1
    elif layout == "columns-big-endian":
        columns(f, "/", e, types=(">u4", ">i2", ">i8", ">f4"))
    elif layout == "records":
        f["events"] = e
    elif layout == "array-integers":
        f["events"] = np.stack([e[name].astype("i8") for name in "txyp"], axis=1)
    elif layout == "array-milliseconds":
        f["events"] = np.stack([e["x"], e["y"], e["p"], e["t"] / 1e3], axis=1).astype("f8")
    elif layout in NAMES:
        columns(f, "deep/er" if layout.endswith("deep") else "/events", e, names=list(NAMES[layout]))
    elif layout.removesuffix("-records") in NAMES:
        names = NAMES[layout.removesuffix("-records")]
        records = np.zeros(len(e), list(zip(names, ("<u2", "<i4", "<i8", "?"))))
        for name, field in zip(names, "xytp"):
            records[name] = e[field]
        f["recording/all" if "deep" in layout else "events"] = records
    elif layout == "nanoseconds":
        columns(f, "events", e, names=["x", "y", "time_x", "p"])
        f["events/t_ns"] = e["t"] * 1000 + np.arange(len(e)) % 1000 - 500
    elif layout == "two-tables":
        columns(f, "left", e, names=["xs", "ys", "timestamps", "pol"])
        columns(f, "right", e[::-1], names=["xs", "ys", "timestamps", "pol"])
        f["left/width"], f["left/height"] = 1280, 720
    elif layout == "foreign-names":
        f["a/when"] = e["t"] / 1e6
        f["a/where"] = np.stack([e["x"], e["y"]], axis=1)
        f["b/sign"] = np.array(list(zip(e["p"], e["p"])), [("up", "u1"), ("down", "u1")])
    elif layout == "whole-doubles":
        columns(f, "/", e, types=("<u2", "<u2", "<f8", "u1"))
    elif layout.startswith("matlab-"):
        matlab(e, f, layout.removeprefix("matlab-"))
    elif layout == "odd-values":
        f["events/x"] = np.array([1, -1, 2, 3, 70000, 5], "i4")
        f["events/y"] = np.array([1, 1, 2, 3, 4, 5], "i4")
        f["events/t"] = np.array([0.5e-6, 1.5e-6, np.nan, 3e-6, 4e-6, 2.5e-6])
        f["events/p"] = np.array([1, 1, 1, -1, 1, 1], "i1")
    elif layout.startswith("polarities-"):  # of any type, as numbers between commas
        kind, values = layout.split("-", 2)[1:]
        f["events/p"] = np.array([float(v) for v in values.split(",")]).astype(kind)
        for name in "xyt":
            f[f"events/{name}"] = np.arange(len(f["events/p"]), dtype="u4")
    elif layout == "hole":  # nearly endless, and nothing of it was written but a chunk in the middle
        for name in "xytp":
            f.create_dataset(f"events/{name}", shape=(10**17,), dtype="<u4", chunks=(1024,))
            f[f"events/{name}"][20480:21504] = 1 if name == "p" else 7
    elif layout == "huge-chunk":
        f.create_dataset("events/x", shape=(10,), maxshape=(None,), chunks=(2**25 + 1,), dtype="<u2")
        columns(f, "events", e[:10], names=["x2", "y", "t", "p"])
    elif layout == "external":
        f.create_dataset("events/x", shape=(100,), dtype="u1", external=[("/etc/passwd", 0, 100)])
        columns(f, "events", e[:100], names=["y", "y2", "t", "p"])
        f["events/height"] = 720
    elif layout in ("virtual", "virtual-unlimited", "virtual-size"):
        # Of a pipe: whoever opens it waits.
        os.mkfifo(f.filename + ".pipe")
        n = 1 if layout == "virtual-size" else 100
        limit = h5py.h5s.UNLIMITED if layout == "virtual-unlimited" else n
        spaces = [h5py.h5s.create_simple((n,), (limit,)) for _ in range(3)]
        if limit != n:
            for space in spaces[:2]:
                space.select_hyperslab((0,), (1,), (1,), (h5py.h5s.UNLIMITED,))
        properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        properties.set_virtual(spaces[0], (f.filename + ".pipe").encode(), b"/d", spaces[1])
        columns(f, "events", e[:100], names=["x" if layout == "virtual-size" else "x2", "y", "t", "p"])
        name = b"width" if layout == "virtual-size" else b"x"
        h5py.h5d.create(f["events"].id, name, h5py.h5t.NATIVE_UINT16, spaces[2], properties)
        f["events/height"] = 720
    elif layout == "external-link":
        columns(f, "events", e[:100], names=["x2", "y", "t", "p"])
        f["events/x"] = h5py.ExternalLink(f.filename + ".other", "x")
        with h5py.File(f.filename + ".other", "w") as other:
            other["x"] = e["x"][:100]
    elif layout == "zstd":
        properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        properties.set_chunk((100,))
        properties.set_filter(ZSTD, h5py.h5z.FLAG_OPTIONAL)
        group = f.create_group("events")
        h5py.h5d.create(group.id, b"x", h5py.h5t.NATIVE_UINT16, h5py.h5s.create_simple((100,)), properties)
        columns(f, "events", e[:100], names=["x2", "y", "t", "p"])
    elif layout == "no-events":
        f["pictures"] = np.zeros((3, 4, 5))
    else:
        sys.exit(f"unknown layout {layout}")


def check_dsec(e, path):
    with h5py.File(path, "r") as f:
        t = f["events/t"][:].astype("i8") + f["t_offset"][()]
        assert f["events/t"].dtype == np.dtype("<u4") and f["events/p"].dtype == np.dtype("u1")
        for name, values in (("x", f["events/x"][:]), ("y", f["events/y"][:]), ("t", t), ("p", f["events/p"][:])):
            assert np.array_equal(values, e[name]), name
        relative = f["events/t"][:].astype("i8")
        index = f["ms_to_idx"][:]
        wanted = np.searchsorted(relative, np.arange(relative[-1] // 1000 + 2) * 1000)
        assert np.array_equal(index, wanted), "ms_to_idx"


def main():
    layout, events, out = sys.argv[1:]
    e = np.fromfile(events, PACKED)
    if layout == "check-dsec":
        check_dsec(e, out)
    elif layout == "ecf-chunks":
        ecf_chunks(e, out)
    else:
        with h5py.File(out, "w", userblock_size=512 if layout.startswith("matlab-") else 0) as f:
            write(layout, e, f)


main()
