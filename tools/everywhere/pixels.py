#!/usr/bin/env python3
"""Compares the pixels of EXR files of the same names in two folders, bit by bit; headers differ by time and system.
usage: pixels.py folder folder; exit 1 if anything differs. The files must be uncompressed."""
import pathlib
import sys


def after_header(data):
    """The rows and their table of offsets, without what the header's length changes there."""
    at, rows = 8, 0
    while data[at]:
        name, at = word(data, at)
        _, at = word(data, at)
        size = int.from_bytes(data[at:at + 4], "little")
        value, at = data[at + 4:at + 4 + size], at + 4 + size
        if name == b"compression" and value != b"\0":
            sys.exit("pixels.py: the files must be written with --compression none")
        if name == b"dataWindow":
            rows = int.from_bytes(value[12:16], "little", signed=True) - int.from_bytes(value[4:8], "little", signed=True) + 1
    return data[at + 1 + 8 * rows:]


def word(data, at):
    end = data.index(b"\0", at)
    return data[at:end], end + 1


first, second = map(pathlib.Path, sys.argv[1:3])
names = sorted(each.name for each in first.glob("*.exr"))
if not names or names != sorted(each.name for each in second.glob("*.exr")):
    sys.exit(f"pixels.py: {first} and {second} do not have the same images")
differ = [name for name in names if after_header((first / name).read_bytes()) != after_header((second / name).read_bytes())]
print(f"{len(names)} images, {len(differ)} differ" + "".join(f"\n  {name}" for name in differ))
sys.exit(1 if differ else 0)
