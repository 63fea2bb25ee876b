#!/usr/bin/env python3
"""Compares the pixels of PFM files of the same names in two folders, bit by bit; as dspm writes them, in colour.
usage: pfm_pixels.py folder folder; says how many pixels differ, and how far at most; exit 1 if any does."""
import pathlib
import struct
import sys


def read(file):
    """The width, and the pixels' bytes, the last row first."""
    kind, size, order, data = file.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    if kind != b"PF" or float(order) > 0 or len(data) != 12 * width * height:
        sys.exit(f"pfm_pixels.py: {file} is none of dspm's PFM files")
    return width, data


def distance(a, b):
    return max(abs(x - y) if x == x and y == y else float("inf") for x, y in zip(a, b))


def in_words(pixel):
    return " ".join(f"{value:.9g}" for value in pixel)


def different(name):
    """The number of pixels, of those that differ, and the farthest: the distance, and where and what it is."""
    (width, a), (other_width, b) = read(first / name), read(second / name)
    if (width, len(a)) != (other_width, len(b)):
        sys.exit(f"pfm_pixels.py: {name} has two sizes")
    differ, farthest = 0, (-1, "")
    for at in range(0, len(a), 12) if a != b else ():
        if a[at:at + 12] != b[at:at + 12]:
            differ += 1
            one, other = struct.unpack_from("<3f", a, at), struct.unpack_from("<3f", b, at)
            x, y = at // 12 % width, (len(a) - at - 1) // 12 // width
            farthest = max(farthest, (distance(one, other), f"{name}, pixel {x}, {y}: {in_words(one)} and {in_words(other)}"))
    return len(a) // 12, differ, farthest


first, second = map(pathlib.Path, sys.argv[1:3])
names = sorted(each.name for each in first.glob("*.pfm"))
if not names or names != sorted(each.name for each in second.glob("*.pfm")):
    sys.exit(f"pfm_pixels.py: {first} and {second} do not have the same images")
counts, differs, farthest = zip(*map(different, names))
differ = sum(differs)
print(f"{len(names)} images, {differ} of {sum(counts)} pixels differ" +
      (f" in {sum(d > 0 for d in differs)} images; the farthest by {max(farthest)[0]:.3g}, {max(farthest)[1]}" if differ else ""))
sys.exit(1 if differ else 0)
