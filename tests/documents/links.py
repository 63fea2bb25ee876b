#!/usr/bin/env python3
"""Checks that every link between the pages leads somewhere: links.py <source directory>

A link to a file needs the file, one with #section a heading of that name. What sources, scenes and scripts call
docs/<name>.md must be there, too. Exits with 1 and names file:line of each that is broken.
"""
import pathlib
import re
import shutil
import subprocess
import sys

LINK = re.compile(r"\]\(([^)\s]+)\)")
MENTION = re.compile(r"\bdocs/[\w/-]+\.md\b")
MENTIONED_IN = {".h", ".cpp", ".py", ".sh", ".cmake", ".txt", ".dsc", ".js", ""}


def files(root):
    """Those that git tracks, or all of them where there is no git; without this test itself."""
    asked = ["git", "-C", root, "ls-files", "--cached", "--others", "--exclude-standard", "."]
    listed = subprocess.run(asked, capture_output=True, text=True).stdout if shutil.which("git") else ""
    names = listed.splitlines() or [str(path.relative_to(root)) for path in sorted(root.rglob("*"))]
    return [root / name for name in names
            if not name.startswith(("tests/documents/", "build/", "out/")) and (root / name).is_file()]


def prose(page):
    """The lines outside of code, numbered from 1."""
    fenced = False
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if line.startswith("```"):
            fenced = not fenced
        elif not fenced and not line.startswith("    "):
            yield number, line


def anchors(page):
    """What GitHub makes of the headings."""
    headings = (line.lstrip("#").strip() for _, line in prose(page) if re.match("#+ ", line))
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken(page):
    for number, line in prose(page):
        for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
            name, _, section = target.partition("#")
            if re.match(r"\w+:", name):
                continue
            other = page.parent / name if name else page
            if not other.exists():
                yield number, f"{target}: there is no such file"
            elif section and section not in anchors(other):
                yield number, f"{target}: there is no such section"


def not_there(root, source):
    try:
        text = source.read_text()
    except UnicodeDecodeError:
        return
    for number, line in enumerate(text.splitlines(), 1):
        for name in MENTION.findall(line):
            if not (root / name).exists():
                yield number, f"{name}: there is no such page"


def main(root):
    errors = 0
    for path in files(root):
        found = broken(path) if path.suffix == ".md" else not_there(root, path) if path.suffix in MENTIONED_IN else ()
        for number, message in found:
            print(f"{path.relative_to(root)}:{number}: {message}")
            errors += 1
    return errors > 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
