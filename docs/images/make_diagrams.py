#!/usr/bin/env python3
"""Draws the diagrams of docs/architecture/ as SVG files beside this script.

Run it after a change: docs/images/make_diagrams.py. Standard library only. Each diagram has a white background of its
own, so that it can be read on light and on dark pages.
"""
import math
from pathlib import Path
from xml.sax.saxutils import escape

INK, MUTED, LINE = "#1f2328", "#59636e", "#8b949e"
BLUE, GREEN, AMBER, GREY, RED = "#ddebfb", "#dcf3e2", "#fdf0cf", "#eef0f2", "#fbdedb"
FONT = "font-family='DejaVu Sans, Verdana, Helvetica, Arial, sans-serif'"
MONO = "font-family='DejaVu Sans Mono, Consolas, Menlo, monospace'"


class Drawing:
    def __init__(self, width, height, title):
        self.width, self.height, self.title = width, height, title
        self.parts = []

    def box(self, x, y, w, h, fill=GREY, stroke=LINE, dash=False, radius=5, stroke_width=1.2):
        dashes = " stroke-dasharray='5 4'" if dash else ""
        self.parts.append(f"<rect x='{x:g}' y='{y:g}' width='{w:g}' height='{h:g}' rx='{radius}' fill='{fill}' "
                          f"stroke='{stroke}' stroke-width='{stroke_width}'{dashes}/>")

    def text(self, x, y, words, size=13, anchor="start", colour=INK, bold=False, mono=False):
        weight = " font-weight='bold'" if bold else ""
        self.parts.append(f"<text x='{x:g}' y='{y:g}' font-size='{size}' text-anchor='{anchor}' fill='{colour}'"
                          f"{weight} {MONO if mono else FONT}>{escape(words)}</text>")

    def lines(self, x, y, rows, size=13, step=None, **more):
        for i, row in enumerate(rows):
            self.text(x, y + i * (step or size * 1.35), row, size, **more)

    def label(self, x, y, w, h, rows, fill=GREY, size=13, bold_first=True, dash=False):
        """A box with centred lines, the first one bold."""
        self.box(x, y, w, h, fill, dash=dash)
        step = size * 1.35
        top = y + h / 2 - (len(rows) - 1) * step / 2 + size * 0.36
        for i, row in enumerate(rows):
            self.text(x + w / 2, top + i * step, row, size if i == 0 else size - 1, "middle",
                      INK if i == 0 else MUTED, bold=bold_first and i == 0)

    def arrow(self, points, colour=INK, dash=False):
        path = "M" + " L".join(f"{x:g},{y:g}" for x, y in points)
        dashes = " stroke-dasharray='5 4'" if dash else ""
        self.parts.append(f"<path d='{path}' fill='none' stroke='{colour}' stroke-width='1.6'{dashes}/>")
        (x0, y0), (x1, y1) = points[-2:]
        turn = math.atan2(y1 - y0, x1 - x0)
        head = [(x1, y1)] + [(x1 - 9 * math.cos(turn + side), y1 - 9 * math.sin(turn + side)) for side in (0.42, -0.42)]
        self.parts.append("<polygon points='" + " ".join(f"{x:.1f},{y:.1f}" for x, y in head) + f"' fill='{colour}'/>")

    def path(self, commands, fill="none", stroke=LINE):
        self.parts.append(f"<path d='{commands}' fill='{fill}' stroke='{stroke}' stroke-width='1.2'/>")

    def save(self, name):
        body = "\n".join(self.parts)
        (Path(__file__).parent / name).write_text(
            f"<svg xmlns='http://www.w3.org/2000/svg' width='{self.width}' height='{self.height}' "
            f"viewBox='0 0 {self.width} {self.height}' role='img'>\n<title>{escape(self.title)}</title>\n"
            f"<rect width='{self.width}' height='{self.height}' rx='8' fill='#ffffff'/>\n{body}\n</svg>\n", "utf-8")


def ring():
    """A ring of N = 8 slots behind 26 events."""
    slots, total = 8, 26
    write = total % slots
    d = Drawing(760, 350, "A ring of 8 slots that has received 26 events: write index 2, wrap count 3")
    cx, cy, outer, inner = 190, 178, 118, 62
    for k in range(slots):
        begin, end = (2 * math.pi * (k + side) / slots - math.pi / 2 for side in (0, 1))
        corner = [(cx + r * math.cos(a), cy + r * math.sin(a))
                  for r, a in ((outer, begin), (outer, end), (inner, end), (inner, begin))]
        (ax, ay), (bx, by), (ex, ey), (fx, fy) = corner
        d.path(f"M{ax:.1f},{ay:.1f} A{outer},{outer} 0 0 1 {bx:.1f},{by:.1f} L{ex:.1f},{ey:.1f} "
               f"A{inner},{inner} 0 0 0 {fx:.1f},{fy:.1f} Z", AMBER if k == write else BLUE)
        middle = (begin + end) / 2
        number = total - 1 - (total - 1 - k) % slots
        d.text(cx + 91 * math.cos(middle), cy + 91 * math.sin(middle) + 5, f"e{number}", 14, "middle", bold=True)
        d.text(cx + 134 * math.cos(middle), cy + 134 * math.sin(middle) + 5, str(k), 13, "middle", MUTED)
    d.text(cx, cy - 3, "N = 8", 14, "middle", bold=True)
    d.text(cx, cy + 16, "slots", 13, "middle", MUTED)
    d.text(24, 28, "The ring of one patch", 15, bold=True)
    # Slot 2 is at the right, below the middle.
    middle = 2 * math.pi * (write + 0.5) / slots - math.pi / 2
    pointed = cy + 134 * math.sin(middle)
    d.arrow([(388, pointed), (cx + 134 * math.cos(middle) + 14, pointed)])
    x = 396
    d.lines(x, 58, ["26 events came: e0 to e25."], bold=True)
    d.lines(x, 80, ["The n-th event is stored in slot n mod N, so the", "ring holds the last 8: e18 to e25."], colour=MUTED)
    d.lines(x, 134, ["wrap count = 26 div 8 = 3"], bold=True)
    d.lines(x, 154, ["How often the write index came back to slot 0."], colour=MUTED)
    d.lines(x, pointed + 5, ["write index = 26 mod 8 = 2"], bold=True)
    d.lines(x, pointed + 25, ["The slot of the next event, e26. It overwrites e18,", "the oldest event."], colour=MUTED)
    d.lines(x, 186, ["events received = wrap count × N + write index"], bold=True)
    d.lines(x, 206, ["3 × 8 + 2 = 26"], colour=MUTED)
    d.text(24, 334, "Small numbers beside the ring: slots. Inside: the event that a slot holds.", 12, colour=MUTED)
    d.save("ring.svg")


def example():
    """The worked example: two patches on six pixels, and what is stored behind six events."""
    d = Drawing(760, 372, "Two patches on a sensor of six pixels, their rings behind six events, and the picture")
    left, cell, top = 200, 84, 66
    d.text(24, 30, "Two patches on a sensor of 6 x 1 pixels, N = 2", 15, bold=True)
    for x in range(6):
        d.text(left + (x + 0.5) * cell, top - 8, f"x = {x}", 12, "middle", MUTED)
    for row, (name, cell_range, field_range, fill) in enumerate((("patch 0", (0, 3), (0, 4), BLUE),
                                                                 ("patch 1", (3, 6), (2, 6), GREEN))):
        y = top + row * 46
        d.text(24, y + 23, name, 14, bold=True)
        d.box(left + field_range[0] * cell + 3, y + 2, (field_range[1] - field_range[0]) * cell - 6, 34, "#ffffff", dash=True)
        d.box(left + cell_range[0] * cell + 3, y + 2, (cell_range[1] - cell_range[0]) * cell - 6, 34, fill)
        d.text(left + (cell_range[0] + 1.5) * cell, y + 24, "cell", 13, "middle")
        margin = 3.5 if row == 0 else 2.5
        d.text(left + margin * cell, y + 24, "margin", 12, "middle", MUTED)
    d.text(24, 182, "The receptive field is cell and margin: events there are stored. Events in the cell are active: they are shown.",
           12, colour=MUTED)
    y = 202
    d.text(24, y + 25, "ring of patch 0", 13, bold=True)
    d.text(24, y + 71, "ring of patch 1", 13, bold=True)
    for row, slots in enumerate(((("e3", "x = 3", False), ("e2", "x = 2", True)), (("e6", "x = 5", True), ("e5", "x = 5", True)))):
        for k, (event, where, active) in enumerate(slots):
            bx, by = left + k * 190, y + row * 46
            d.box(bx + 3, by + 2, 180, 36, (BLUE, GREEN)[row] if active else "#ffffff", dash=not active)
            d.text(bx + 12, by + 25, f"slot {k}:", 12, colour=MUTED)
            d.text(bx + 58, by + 25, event, 14, bold=True)
            d.text(bx + 84, by + 25, where + ("" if active else ", inactive"), 12, colour=MUTED)
        d.text(left + 394, y + row * 46 + 19, ("3 events: wrap count 1,", "5 events: wrap count 2,")[row], 12, colour=MUTED)
        d.text(left + 394, y + row * 46 + 34, "write index 1", 12, colour=MUTED)
    y = 306
    d.text(24, y + 18, "picture (u8)", 13, bold=True)
    d.text(24, y + 35, "active events, each 0.3", 12, colour=MUTED)
    for x, value in enumerate((0, 0, 76, 0, 0, 153)):
        d.box(left + x * cell + 3, y, cell - 6, 40, f"#{value:02x}{value:02x}{value:02x}")
        d.text(left + (x + 0.5) * cell, y + 25, str(value), 14, "middle", "#ffffff" if value < 100 else INK, bold=True)
    d.save("example.svg")


def chunks():
    """The cursors of the worked example, cut into two chunks of three events."""
    d = Drawing(760, 420, "Chunks and patches: how many hits each chunk skips on each patch, and the slot of its first surviving hit")
    d.text(24, 30, "The same six events in one submission: two chunks, side by side", 15, bold=True)
    left, wide, top, high = 178, 270, 96, 82
    for p, fill in enumerate((BLUE, GREEN)):
        d.label(left + p * (wide + 12), 50, wide, 36, [f"patch {p}"], fill)
    cells = ((("hits: e1, e2, e3", "skip 1, then slot 1", "e2 to slot 1, e3 to slot 0"), ("hits: e2, e3", "none survives", "nothing is stored")),
             (("no hit", "none survives", "nothing is stored"), ("hits: e4, e5, e6", "skip 1, then slot 1", "e5 to slot 1, e6 to slot 0")))
    for c, row in enumerate(cells):
        y = top + c * (high + 10)
        d.label(24, y, 142, high, [f"chunk {c}", ("e1, e2, e3", "e4, e5, e6")[c], "one team of lanes"], GREY)
        for p, (hits, cursor, stored) in enumerate(row):
            x = left + p * (wide + 12)
            survives = cursor.startswith("skip")
            d.box(x, y, wide, high, AMBER if survives else "#ffffff", dash=not survives)
            d.text(x + 14, y + 24, hits, 13)
            d.text(x + 14, y + 46, ("cursor: " + cursor) if survives else cursor, 13, bold=survives,
                   colour=INK if survives else MUTED)
            d.text(x + 14, y + 67, stored, 12, colour=MUTED)
    y = top + 2 * (high + 10) + 4
    d.text(24, y + 22, "scan, per patch", 13, bold=True)
    d.text(24, y + 42, "walks down a column", 12, colour=MUTED)
    for p, (hits, skipped) in enumerate(((3, 1), (5, 3))):
        x = left + p * (wide + 12)
        d.box(x, y, wide, 56, "#ffffff")
        d.text(x + 14, y + 23, f"T = {hits} hits, N = 2 slots", 13)
        d.text(x + 14, y + 43, f"the first T - N = {skipped} would be overwritten", 12, colour=MUTED)
    y += 66
    d.text(24, y + 24, "rings behind it", 13, bold=True)
    for p, pair in enumerate((("e3", "e2"), ("e6", "e5"))):
        for k, event in enumerate(pair):
            x = left + p * (wide + 12) + k * (wide / 2)
            d.box(x, y, wide / 2 - 4, 38, (BLUE, GREEN)[p])
            d.text(x + 14, y + 24, f"slot {k}:", 12, colour=MUTED)
            d.text(x + 66, y + 24, event, 14, bold=True)
    d.save("chunks.svg")


def file_to_picture():
    d = Drawing(760, 484, "From a file to a picture: reader, batch, submission, state on the device, query, image")
    w, h, gap, x0 = 216, 64, 34, 22
    rows = (
        (("file or pipe", ["bytes", "src/io/base/byte_reader.h"]), ("EventSource", ["decodes, drops events outside", "src/io/<family>/"]),
         ("play", ["batches, cut where frames are due", "src/session/play.h"])),
        (("push", ["checks the whole batch", "src/core/batch_check.h"]), ("staging memory", ["gathers until a slot is full", "src/device/stream.h"]),
         ("submission", ["copied or read in place", "src/device/push_commands.h"])),
        (("append", ["or count, sum, scan, place", "src/pipelines/scarf/pipeline.cpp"]), ("state on the device", ["rings, write indices, wrap counts", "src/layout/ring_head.h"]),
         ("query", ["paint, or render and tone;", "or extract"])),
        (("copy to the host", ["result memory of its own", "src/device/stream.h"]), ("Pending", ["handed over once", "include/scarf/core/pending.h"]),
         ("consumer", ["picture, tensor, events", "src/output/products.h"])),
    )
    titles = ("reading", "upload", "SCARF", "result")
    fills = (GREEN, GREY, BLUE, AMBER)
    y = 58
    d.text(x0, 26, "From file to picture", 15, bold=True)
    for r, row in enumerate(rows):
        d.text(x0, y - 6, titles[r], 12, colour=MUTED)
        for c, (name, words) in enumerate(row):
            x = x0 + c * (w + gap)
            d.box(x, y, w, h, fills[r])
            d.text(x + w / 2, y + 20, name, 13, "middle", bold=True)
            for i, word in enumerate(words):
                path = "/" in word
                d.text(x + w / 2, y + 38 + i * 16, word, 10.5 if path else 11.5, "middle", MUTED, mono=path)
            if c < 2:
                d.arrow([(x + w + 3, y + h / 2), (x + w + gap - 4, y + h / 2)])
        if r < 3:
            right, lower = x0 + 2 * (w + gap) + w / 2, y + h
            d.arrow([(right, lower + 3), (right, lower + 20), (x0 + w / 2, lower + 20), (x0 + w / 2, lower + 40)])
        y += h + 46
    d.save("file_to_picture.svg")


def rooms():
    d = Drawing(760, 528, "The rooms: each may include what it stands on")
    x, w = 22, 716
    d.text(x, 28, "A room may include what it stands on, if src/CMakeLists.txt names it", 15, bold=True)
    d.label(x, 44, w, 50, ["tools", "the program, one file per sub-command; alone sees CLI11"], AMBER)
    d.box(x, 102, 596, 128, "#ffffff", dash=True)
    d.text(x + 10, 120, "the engine", 12, colour=MUTED)
    d.label(x + 110, 112, 270, 32, ["reprocess"], AMBER)
    d.label(x + 110, 150, 270, 32, ["output: files, OpenCV"], AMBER)
    d.label(x + 388, 112, 198, 70, ["compare", "states, lockstep, dumps"], AMBER)
    d.label(x + 110, 188, 476, 32, ["session: settings, requests, play"], AMBER)
    d.label(x + 604, 102, 112, 128, ["bench", "measures"], AMBER)
    y, high = 240, 214
    left = x
    for name, wide in (("scarf::device", 280), ("scarf::reference", 120), ("scarf::io", 116), ("scarf::digest", 84),
                       ("scarf::simulate", 84)):
        d.box(left, y, wide, high, "#ffffff", dash=True)
        d.text(left + wide / 2, y + 18, name, 12 if wide > 100 else 9.5, "middle", MUTED)
        inner, top = left + 8, y + 28
        if name == "scarf::device":
            for i, room in enumerate(("device", "pipelines/<name>, replay on scarf", "base, kernels, compiled shaders")):
                d.label(inner, top + i * 36, wide - 16, 32, [room], BLUE, 12.5)
            d.label(inner, top + 108, 128, 68, ["vulkan", "knows no events"], BLUE, 12.5)
            d.label(inner + 136, top + 108, 128, 32, ["layout"], BLUE, 12.5)
            d.label(inner + 136, top + 144, 128, 32, ["shader headers"], BLUE, 12)
        elif name == "scarf::reference":
            d.label(inner, top, wide - 16, 176, ["cpu_ref", "the definitions,", "a file each"], RED)
        elif name == "scarf::io":
            for i, room in enumerate(("io/open", "io/<family>", "io/base", "io/files")):
                d.label(inner, top + i * 45, wide - 16, 41, [room], GREEN, 12.5)
        else:
            d.label(inner, top, wide - 16, 176, [name.split(":")[-1]], GREEN, 11.5)
        left += wide + 8
    d.label(x, 464, w, 46, ["core: rules and values (scarf::core), with the public headers in include/scarf/core/"], GREY)
    d.save("rooms.svg")


if __name__ == "__main__":
    for draw in (ring, example, chunks, file_to_picture, rooms):
        draw()
