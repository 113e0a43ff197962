"""Writes databases of ROS 2 bags as no recorder does, with sqlite3 alone.

  make_databases.py KIND EVENTS OUT     EVENTS: as for make_bags.py
"""
import os
import shutil
import sqlite3
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True

TOPICS = "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)"
TOPIC = "INSERT INTO topics VALUES(2, '/events', 'event_camera_msgs/msg/EventPacket', 'cdr')"
MESSAGES = "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB{})"


def created(path, messages, topics=TOPICS):
    base = sqlite3.connect(path)
    base.execute("PRAGMA page_size=512")
    base.execute(topics)
    if topics == TOPICS:
        base.execute(TOPIC)
    base.execute(messages)
    return base


def varint(n):
    out = [n & 127]
    while n := n >> 7:
        out.append(n & 127 | 128)
    return bytes(reversed(out))


def shared_pages(path):
    """Many rows with the same pages of data: more bytes than the file has."""
    large, room = 1_000_000, 512 - 4
    small = large - room * 1930  # as many bytes in the row's own page
    base = created(path, MESSAGES.format(""))
    for i in range(20):
        base.execute("INSERT INTO messages VALUES(?, 2, 5, ?)", (i + 1, bytes(large if i == 0 else small)))
    base.commit()
    base.close()
    with open(path, "rb") as file:
        data = bytearray(file.read())

    def cell(row, size):
        types = b"\0\1\1" + varint(2 * size + 12)
        head = bytes([len(types) + 1]) + types
        front = varint(len(head) + 2 + size) + varint(row)
        at = data.index(front + head)
        inside = 39 + (len(head) + 2 + size - 39) % room
        return at, front + head, at + len(front) + (inside if inside <= 477 else 39)

    _, _, first = cell(1, large)
    pages = data[first:first + 4]
    for row in range(2, 21):
        at, front, pointer = cell(row, small)
        types = b"\0\1\1" + varint(2 * large + 12)
        new = varint(len(types) + 1 + 2 + large) + varint(row) + bytes([len(types) + 1]) + types
        assert len(new) == len(front)
        data[at:at + len(new)] = new
        data[pointer:pointer + 4] = pages
    with open(path, "wb") as file:
        file.write(data)


def write_ahead(path, events, kind):
    """A bag whose recorder wrote ahead, and what it may leave beside: -wal, -shm."""
    import make_bags
    make_bags.database(path + ".live", [make_bags.mono(i, group, order=">", cdr=True)
                                        for i, group in enumerate(make_bags.groups(events))],
                       "event_camera_msgs/msg/EventPacket")
    base = sqlite3.connect(path + ".live")
    base.execute("PRAGMA journal_mode=WAL")
    base.execute("PRAGMA wal_autocheckpoint=0")
    if kind != "wal-none":  # the last messages are in the -wal alone
        rows = base.execute("SELECT * FROM messages ORDER BY id DESC LIMIT 4").fetchall()
        base.execute("DELETE FROM messages WHERE id >= ?", (rows[-1][0],))
        base.commit()
        base.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        base.executemany("INSERT INTO messages VALUES(?, ?, ?, ?)", reversed(rows))
        base.commit()
    if kind == "wal-none":
        base.close()
        shutil.move(path + ".live", path)
        return
    for suffix in {"wal-alone": ["", "-wal"], "wal-shared": ["", "-wal", "-shm"]}[kind]:
        shutil.copy(path + ".live" + suffix, path + suffix)
    base.close()
    os.remove(path + ".live")


def main():
    kind, source, path = sys.argv[1:]
    if kind.startswith("wal-"):
        import struct
        with open(source, "rb") as file:
            return write_ahead(path, list(struct.iter_unpack("<qHHB", file.read())), kind)
    if kind == "shared-pages":
        return shared_pages(path)
    if kind == "computed-data":
        base = created(path, MESSAGES.format(" GENERATED ALWAYS AS (zeroblob(250000000)) VIRTUAL"))
        base.executemany("INSERT INTO messages(topic_id, timestamp) VALUES(2, ?)", ((i,) for i in range(2000)))
    elif kind == "computed-type":
        slow = "('" + "a" * 3000 + "' LIKE '%" + "%".join("a" * 24) + "%b')"
        base = created(path, MESSAGES.format(""), TOPICS.replace("type TEXT", f"type TEXT AS ({slow})"))
        base.execute("INSERT INTO topics(name, serialization_format) VALUES('/events', 'cdr')")
    elif kind == "view":
        base = created(path, "CREATE VIEW messages AS WITH RECURSIVE r(id) AS (SELECT 1 UNION ALL SELECT id + 1 FROM r) "
                       "SELECT id, 2 AS topic_id, zeroblob(100000000) AS data FROM r")
    elif kind == "virtual":
        base = created(path, "CREATE VIRTUAL TABLE messages USING fts4(id, topic_id, data)")
        base.execute("INSERT INTO messages VALUES(1, 2, 'x')")
    else:
        sys.exit(f"make_databases: unknown kind {kind}")
    base.commit()
    base.close()


if __name__ == "__main__":
    main()
