#!/usr/bin/env python3
"""Looks whether what the documentation names is there: tests/docs_check.py [REPOSITORY].

Fails, with a line for each, if one of these does not exist:
* a path in backticks that looks like a file or folder of the repository. <name> and * stand for anything;
* the target of a relative link or image, and the heading that its #anchor names;
* a page of docs/ that a source file names in a comment.
"""
import re
import sys
from pathlib import Path

SOURCES = ("h", "cpp", "comp", "glsl", "cmake", "py", "md")  # extensions of files that only the repository has
SOURCE_FOLDERS = ("bench", "cmake", "cpu_ref", "examples", "fuzz", "include", "shaders", "src", "tests", "tools")
HISTORY = "CHANGELOG.md"  # names what was there once
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"`((?:[^`\n]|\n(?!\s*\n))+)`")  # within a paragraph
LINK = re.compile(r"\[[^\]]*\]\(([^()\s]+(?:\([^()\s]*\))?)\)")


def blank(match):
    """What a match covers, as empty lines: line numbers stay."""
    return "\n" * match.group().count("\n")


def line_of(text, place):
    return text.count("\n", 0, place) + 1


def anchors(page):
    """The anchors of a page's headings, as GitHub makes them."""
    found = set()
    for heading in re.findall(r"^#+ (.*)$", FENCE.sub(blank, page.read_text("utf-8")), re.MULTILINE):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
        anchor = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        number = 0
        while (name := anchor if number == 0 else f"{anchor}-{number}") in found:
            number += 1
        found.add(name)
    return found


class Repository:
    def __init__(self, root):
        self.root = root
        self.folders = {entry.name for entry in root.iterdir()
                        if entry.is_dir() and entry.name != ".git" and not entry.name.startswith("build")}

    def is_path(self, word):
        """Whether a word in backticks means a file or folder of the repository."""
        if not re.fullmatch(r"[\w./<>*-]+", word) or word.startswith(("/", "build")):
            return False
        first, slash, rest = word.partition("/")
        if slash and first in self.folders:
            return True
        return word.rpartition(".")[2] in SOURCES and bool(word.rpartition(".")[0].strip("<>*"))

    def has(self, word, page):
        pattern = re.sub(r"<[^<>]*>", "*", word).rstrip("/")
        # From the root, as an #include has it, beside the page; a bare name anywhere.
        places = [(self.root, pattern), (self.root / "include", pattern), (page.parent, pattern)]
        if "/" not in pattern:
            places += [(self.root / folder, "**/" + pattern) for folder in self.folders]
        return any(next(folder.glob(found), None) is not None for folder, found in places if folder.is_dir())

    def check_page(self, page):
        text = FENCE.sub(blank, page.read_text("utf-8"))
        name = page.relative_to(self.root)
        if page.name != HISTORY:
            for span in SPAN.finditer(text):
                for word in span.group(1).split():
                    word = word.strip(",;:()\"'")
                    if self.is_path(word) and not self.has(word, page):
                        yield f"{name}:{line_of(text, span.start())}: `{word}` does not exist"
        for link in LINK.finditer(SPAN.sub(blank, text)):
            path, _, anchor = link.group(1).partition("#")
            where = f"{name}:{line_of(SPAN.sub(blank, text), link.start())}"
            if re.match(r"[a-z]+:", path):
                continue
            target = page.parent / path if path else page
            if not target.exists():
                yield f"{where}: the link to {path} leads nowhere"
            elif anchor and target.suffix == ".md" and anchor not in anchors(target):
                yield f"{where}: {path or name} has no heading #{anchor}"

    def check_source(self, source):
        text = source.read_text("utf-8", "replace")
        for page in re.finditer(r"\bdocs/[\w/-]+\.md\b", text):
            if not (self.root / page.group()).exists():
                yield f"{source.relative_to(self.root)}:{line_of(text, page.start())}: {page.group()} does not exist"

    def check(self):
        for page in sorted([*self.root.glob("*.md"), *self.root.glob("docs/**/*.md")]):
            yield from self.check_page(page)
        for folder in SOURCE_FOLDERS:
            for source in sorted(self.root.glob(folder + "/**/*")):
                if source.is_file() and (source.suffix[1:] in SOURCES or source.name == "CMakeLists.txt"):
                    yield from self.check_source(source)


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    problems = list(Repository(root).check())
    print("\n".join(problems) if problems else "every path and link of the documentation exists")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
