"""Writes events as bags of ROS 1 and 2, MCAP and AEDAT4, from the descriptions of those formats alone.

  make_bags.py KIND EVENTS OUT   EVENTS: packed little-endian records t i64, x u16, y u16, p u8
Exit status 77: a Python module that the kind needs is not installed.
"""
import bz2
import os
import sqlite3
import struct
import sys

WIDTH, HEIGHT = 346, 260
PER_MESSAGE = 100


def lz4(data):
    try:
        import lz4.frame
    except ImportError:
        sys.exit(77)
    return lz4.frame.compress(data)


def zstd(data):
    try:
        import zstandard
    except ImportError:
        sys.exit(77)
    return zstandard.ZstdCompressor().compress(data)


PACK = {"": bytes, "none": bytes, "bz2": bz2.compress, "lz4": lz4, "zstd": zstd}


# --- Messages ------------------------------------------------------------------------------------------------------
class Message:
    """Fields one after the other. order: < or >; cdr: of ROS 2, with alignment and ends of strings."""

    def __init__(self, order="<", cdr=False):
        self.order, self.cdr, self.out = order, cdr, bytearray()

    def numbers(self, codes, *values):
        for code, value in zip(codes, values):
            if self.cdr:
                self.out += bytes(-len(self.out) % struct.calcsize(code))
            self.out += struct.pack(self.order + code, value)

    def string(self, text):
        data = text.encode() + (b"\0" if self.cdr else b"")
        self.block(data)

    def block(self, data):
        self.numbers("I", len(data))
        self.out += data

    def header(self):
        if not self.cdr:
            self.numbers("I", 3)  # seq
        self.numbers("II", 1, 2)  # stamp
        self.string("camera")

    def bytes(self):
        return (bytes([0, self.order == "<", 0, 0]) if self.cdr else b"") + bytes(self.out)


def finer(i, t):
    """Nanoseconds that round to t microseconds, halves up."""
    return t * 1000 + i * 37 % 1000 - 500


def event_array(events, **kind):
    m = Message(**kind)
    m.header()
    m.numbers("III", HEIGHT, WIDTH, len(events))
    for i, (t, x, y, p) in enumerate(events):
        nanoseconds = finer(i, t)
        m.numbers("HHIIB", x, y, nanoseconds // 10**9, nanoseconds % 10**9, p)
    return m.bytes()


def event_packet(seq, encoding, time_base, payload, **kind):
    m = Message(**kind)
    m.header()
    m.numbers("IIQQ", HEIGHT, WIDTH, seq, time_base)
    m.string(encoding)
    m.numbers("B", 0)
    m.block(payload)
    return m.bytes()


def mono(seq, events, **kind):
    base = finer(0, events[0][0])
    words = [p << 63 | y << 48 | x << 32 | (finer(i, t) - base) for i, (t, x, y, p) in enumerate(events)]
    return event_packet(seq, "mono", base, struct.pack(f"<{len(words)}Q", *words), **kind)


def triggers(seq, edges, **kind):
    base = finer(0, edges[0][0])
    words = [value << 63 | source << 48 | (finer(i, t) - base) for i, (t, source, value) in enumerate(edges)]
    return event_packet(seq, "trigger", base, struct.pack(f"<{len(words)}Q", *words), **kind)


def groups(events):
    return [events[i:i + PER_MESSAGE] for i in range(0, len(events), PER_MESSAGE)]


def edges_of(events):
    return [(events[i][0], i % 3, i // PER_MESSAGE % 2) for i in range(0, len(events), PER_MESSAGE)]


# --- ROS 1 bags ----------------------------------------------------------------------------------------------------
def record(data=b"", **fields):
    header = b""
    for name, value in fields.items():
        field = name.encode() + b"=" + value
        header += struct.pack("<I", len(field)) + field
    return struct.pack("<I", len(header)) + header + struct.pack("<I", len(data)) + data


def u32(value):
    return struct.pack("<I", value)


def rosbag(events, package, compression, indexed=True):
    description = b"".join(u32(len(f)) + f for f in (b"topic=/events", b"type=" + package.encode() + b"/EventArray",
                                                     b"md5sum=" + b"0" * 32, b"message_definition=..."))
    connection = record(description, op=b"\x07", conn=u32(0), topic=b"/events")
    chunks = []
    for i, group in enumerate(groups(events)):
        message = record(event_array(group), op=b"\x02", conn=u32(0), time=struct.pack("<II", i, 0))
        inside = (connection if i == 0 else b"") + message
        chunk = record(PACK[compression](inside), op=b"\x05", compression=compression.encode(), size=u32(len(inside)))
        at = struct.pack("<III", i, 0, len(inside) - len(message))
        index = record(at, op=b"\x04", ver=u32(1), conn=u32(0), count=u32(1))
        chunks.append(chunk + index if indexed else chunk)
    start = b"#ROSBAG V2.0\n"
    body = b"".join(chunks)

    def bag_header(index_pos, connections, chunk_count):
        fields = dict(op=b"\x03", index_pos=struct.pack("<Q", index_pos), conn_count=u32(connections),
                      chunk_count=u32(chunk_count))
        return record(b" " * (4096 - len(record(**fields))), **fields)

    if not indexed:
        return start + bag_header(0, 0, 0) + body
    header = bag_header(0, 1, len(chunks))
    positions, infos = len(start) + len(header), b""
    for i, chunk in enumerate(chunks):
        infos += record(u32(0) + u32(1), op=b"\x06", ver=u32(1), chunk_pos=struct.pack("<Q", positions),
                        start_time=struct.pack("<II", i, 0), end_time=struct.pack("<II", i, 0), count=u32(1))
        positions += len(chunk)
    return start + bag_header(positions, 1, len(chunks)) + body + connection + infos


# --- ROS 2 bags ----------------------------------------------------------------------------------------------------
def database(path, messages, type_name):
    base = sqlite3.connect(path)
    base.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
                 "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
    base.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
                 "data BLOB NOT NULL)")
    base.execute("INSERT INTO topics VALUES(1, '/rosout', 'rcl_interfaces/msg/Log', 'cdr', '')")
    base.execute("INSERT INTO topics VALUES(2, '/events', ?, 'cdr', '')", (type_name,))
    for i, message in enumerate(messages):
        base.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(1, ?, ?)", (i, b"\0\1\0\0"))
        base.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(2, ?, ?)", (i, message))
    base.commit()
    base.close()


def rosbag2_folder(path, events, storage="db3", mode=""):
    """mode: MESSAGE or FILE, how the bag is compressed."""
    os.makedirs(path)
    arrays = [event_array(group, order=">", cdr=True) for group in groups(events)]
    if mode == "MESSAGE":
        arrays = [zstd(array) for array in arrays]
    names = []
    # The second file sorts in front of the first: the order is that of the metadata.
    for name, part in (("z_0." + storage, arrays[:3]), ("a_1." + storage, arrays[3:])):
        file = os.path.join(path, name)
        if storage == "db3":
            database(file, part, "dvs_msgs/msg/EventArray")
        else:
            with open(file, "wb") as out:
                out.write(mcap_of(part, "dvs_msgs/msg/EventArray"))
        if mode == "FILE":
            with open(file, "rb") as whole, open(file + ".zstd", "wb") as out:
                out.write(zstd(whole.read()))
            os.remove(file)
            name += ".zstd"
        names.append(name)
    with open(os.path.join(path, "metadata.yaml"), "w") as metadata:
        metadata.write("rosbag2_bagfile_information:\n  version: 4\n  storage_identifier: sqlite3\n"
                       f"  relative_file_paths:\n    - {names[0]}\n    - '{names[1]}'\n  message_count: 5\n"
                       f"  compression_format: {'zstd' if mode else ''}\n  compression_mode: {mode}\n")


# --- MCAP ----------------------------------------------------------------------------------------------------------
def mcap_of(messages, type_name):
    """Messages of one topic, without chunks."""
    def text(word):
        return u32(len(word)) + word.encode()

    def operation(code, content):
        return struct.pack("<BQ", code, len(content)) + content

    out = b"\x89MCAP0\r\n" + operation(1, text("ros2") + text("test"))
    out += operation(3, struct.pack("<H", 7) + text(type_name) + text("ros2msg") + text("..."))
    out += operation(4, struct.pack("<HH", 1, 7) + text("/events") + text("cdr") + u32(0))
    for i, message in enumerate(messages):
        out += operation(5, struct.pack("<HIQQ", 1, i, i, i) + message)
    return out + operation(15, u32(0)) + operation(2, struct.pack("<QQI", 0, 0, 0)) + b"\x89MCAP0\r\n"


def mcap(events, compression):
    def text(word):
        return u32(len(word)) + word.encode()

    def operation(code, content):
        return struct.pack("<BQ", code, len(content)) + content

    def message(channel, i, data):
        return operation(5, struct.pack("<HIQQ", channel, i, i, i) + data)

    schema = operation(3, struct.pack("<H", 7) + text("event_camera_msgs/msg/EventPacket") + text("ros2msg") + text("..."))
    channels = b"".join(operation(4, struct.pack("<HH", number, 7) + text(topic) + text("cdr") + u32(0))
                        for number, topic in ((1, "/events"), (2, "/triggers")))
    out = b"\x89MCAP0\r\n" + operation(1, text("ros2") + text("test"))
    for i, group in enumerate(groups(events)):
        inside = schema + channels if i == 0 else b""
        inside += message(1, i, mono(i, group, cdr=True))
        if i == 0:
            inside += message(2, 0, triggers(0, edges_of(events), cdr=True))
        packed = PACK[compression](inside)
        out += operation(6, struct.pack("<QQQI", i, i, len(inside), 0) + text(compression) +
                         struct.pack("<Q", len(packed)) + packed)
    return out + operation(15, u32(0)) + operation(2, struct.pack("<QQI", 0, 0, 0)) + b"\x89MCAP0\r\n"


# --- AEDAT4 --------------------------------------------------------------------------------------------------------
def put_table(out, fields):
    """Appends a table of a FlatBuffer. fields: None, (code, number), (count, bytes) or [fields of tables]."""
    is_number = [isinstance(f, tuple) and isinstance(f[0], str) for f in fields]
    offsets, size = [], 4
    for field, number in zip(fields, is_number):
        width = struct.calcsize(field[0]) if number else 4
        size += -size % width
        offsets.append(0 if field is None else size)
        size += 0 if field is None else width
    listed = len(out)
    out += struct.pack(f"<{len(fields) + 2}H", 4 + 2 * len(fields), size, *offsets)
    out += bytes(-len(out) % 8)
    place = len(out)
    out += bytes(size)
    struct.pack_into("<i", out, place, place - listed)
    for field, number, offset in zip(fields, is_number, offsets):
        if field is None:
            continue
        at = place + offset
        if number:
            struct.pack_into("<" + field[0], out, at, field[1])
            continue
        out += bytes((4 - len(out)) % 8)
        struct.pack_into("<I", out, at, len(out) - at)
        if isinstance(field, tuple):
            out += struct.pack("<I", field[0]) + field[1]
        else:
            out += struct.pack("<I", len(field)) + bytes(4 * len(field))
            entries = len(out) - 4 * len(field)
            for i, child in enumerate(field):
                out += bytes(-len(out) % 8)
                struct.pack_into("<I", out, entries + 4 * i, put_table(out, child) - entries - 4 * i)
    return place


def flat_buffer(identifier, fields):
    out = bytearray(8)
    out[4:] = identifier
    struct.pack_into("<I", out, 0, put_table(out, fields))
    return struct.pack("<I", len(out)) + bytes(out)


def frame(t, code, pixels, rows=6):
    return flat_buffer(b"FRME", [("q", t), None, None, ("q", t - 300), ("q", t + 300), ("b", code), ("h", 8), ("h", rows),
                                 None, None, (len(pixels), pixels)])


def aedat4(events, compression, streams):
    kinds = ["EVTS"] * streams + ["FRME", "TRIG"]
    xml = '<dv version="2.0"><node name="outInfo" path="/x/">'
    for i, kind in enumerate(kinds):
        xml += (f'<node name="{i}"><attr key="typeIdentifier" type="string">{kind}</attr><node name="info">'
                f'<attr key="source" type="string">CAMERA{i}</attr><attr key="sizeX" type="int">{WIDTH}</attr>'
                f'<attr key="sizeY" type="int">{HEIGHT}</attr></node></node>')
    xml = (xml + "</node></dv>").encode()

    def packet(stream, content):
        packed = PACK[compression](content)
        return struct.pack("<ii", stream, len(packed)) + packed

    packets = b""
    for group in groups(events):
        for stream in range(streams):
            # The second camera sees a mirrored picture.
            data = b"".join(struct.pack("<qhhBxxx", t, WIDTH - 1 - x if stream else x, y, p) for t, x, y, p in group)
            packets += packet(stream, flat_buffer(b"EVTS", [(len(group), data)]))
    t = events[0][0]
    packets += packet(streams, frame(t, 0, bytes(range(48))))
    packets += packet(streams, frame(t + 1000, 16, bytes(range(3 * 48))))
    if compression == "lz4":  # and pixels of 16 bits, as jAER writes them, between some that are not read
        ten_bits = struct.pack("<48H", *(i * 1023 // 47 for i in range(48)))
        packets += packet(streams, frame(t + 2000, 1, bytes(48)))
        packets += packet(streams, frame(t + 3000, 2, ten_bits))
        packets += packet(streams, frame(t + 4000, 2, ten_bits, rows=7))
        packets += packet(streams, frame(t + 5000, 18, struct.pack("<144H", *range(0, 576, 4))))
        packets += packet(streams, frame(t + 6000, 26, struct.pack("<192H", *range(192))))
        packets += packet(streams, frame(t + 7000, 2, struct.pack("<48H", *(i * 1365 for i in range(48)))))
    # Sources of AEDAT4: 1 and 2 are edges of the external signal, 4 and 5 of the generator; 6 begins a frame.
    records = [[("q", t + i), ("b", source)] for i, source in enumerate((1, 2, 6, 4, 5))]
    packets += packet(streams + 1, flat_buffer(b"TRIG", [records]))

    def start(table_position):
        number = {"none": 0, "lz4": 1, "zstd": 3}[compression]
        return b"#!AER-DAT4.0\r\n" + flat_buffer(b"IOHE", [("i", number), ("q", table_position), (len(xml), xml + b"\0")])

    return start(len(start(0)) + len(packets)) + packets + PACK[compression](b"a table that no reader needs")


def main():
    kind, source, path = sys.argv[1:]
    with open(source, "rb") as file:
        events = list(struct.iter_unpack("<qHHB", file.read()))
    words = kind.split("-")
    if words[0] == "rosbag":
        data = rosbag(events, words[1] + ("_event" if words[1] == "prophesee" else "") + "_msgs", words[2],
                      indexed="unindexed" not in words)
    elif words[0] == "mcap":
        data = mcap(events, words[1] if len(words) > 1 else "")
    elif words[0] == "aedat4":
        data = aedat4(events, words[1], streams=int(words[2]))
    elif words[:2] == ["rosbag2", "folder"]:
        return rosbag2_folder(path, events, *words[2:])
    elif kind == "zstd-bomb":
        data = zstd(b"SQLite format 3\0" + bytes(2**28))
    elif kind == "rosbag2-mono":
        return database(path, [mono(i, group, order=">", cdr=True) for i, group in enumerate(groups(events))],
                        "event_camera_msgs/msg/EventPacket")
    else:
        sys.exit(f"make_bags: unknown kind {kind}")
    with open(path, "wb") as file:
        file.write(data)


if __name__ == "__main__":
    main()
