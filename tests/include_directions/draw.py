#!/usr/bin/env python3
"""Draws the rooms and who includes whom, as docs/rooms.svg: draw.py <source directory> > docs/rooms.svg

A room stands above all rooms that it includes. Of the arrows those are left out that follow from others.
"""
import pathlib
import re
import sys

WIDTH, HEIGHT, GAP, ROW, MARGIN = 92, 30, 24, 74, 16


def rooms_of(root):
    """The folders of the rooms, from the table in docs/design.md."""
    table = re.search(r"^\| room \|.*\n(?:\|.*\n)+", (root / "docs/design.md").read_text(), re.MULTILINE)[0]
    return re.findall(r"^\| ([a-z/]+) \|", table, re.MULTILINE)[1:]


def includes(root):
    """The other rooms that a room includes, by room; rooms without their wings."""
    rooms = sorted(rooms_of(root), key=len)

    def room_of(file):
        return [room for room in rooms if file.startswith(room + "/")][-1].split("/")[-1]

    found = {room.split("/")[-1]: set() for room in rooms}
    for folder in {room.split("/")[0] for room in rooms}:
        for path in (root / folder).rglob("*"):
            if path.suffix in (".h", ".cpp"):
                room = room_of(path.relative_to(root).as_posix())
                named = re.findall(r'^#include "dspm/([\w/]+[.]h)"', path.read_text(), re.MULTILINE)
                found[room] |= {room_of(file) for file in named} - {room}
    return found


def below(room, direct):
    """All rooms that it includes, also by way of others."""
    rooms = set()
    todo = list(direct[room])
    while todo:
        if (other := todo.pop()) not in rooms:
            rooms.add(other)
            todo += direct[other]
    return rooms


def levels(direct):
    """Each room just below the lowest that includes it, so that arrows are short; the lowest is 0."""
    depth = {}

    def of(room):
        if room not in depth:
            depth[room] = 1 + max((of(other) for other in direct if room in direct[other]), default=-1)
        return depth[room]

    bottom = max(map(of, direct))
    return {room: bottom - depth[room] for room in direct}


def without_implied(direct):
    return {room: {other for other in others
                   if not any(other in below(between, direct) for between in others if between != other)}
            for room, others in direct.items()}


def routes(level, arrows):
    """For each arrow the points that it passes: its ends, and (from, to, row) in the rows between."""
    return {(room, other): [room, *((room, other, row) for row in range(level[room] - 1, level[other], -1)), other]
            for room, others in arrows.items() for other in others}


def places(level, paths):
    """The centre of each room and of each place where an arrow passes a row, and the size of the whole."""
    rows = [[] for _ in range(1 + max(level.values()))]
    for room in sorted(level):
        rows[level[room]].append(room)
    for path in paths.values():
        for point in path[1:-1]:
            rows[point[2]].append(point)
    above = {}
    for path in paths.values():
        for upper, lower in zip(path, path[1:]):
            above.setdefault(lower, []).append(upper)

    def width(point):
        return (WIDTH if isinstance(point, str) else 0) + GAP

    centre = MARGIN + (max(sum(map(width, row)) for row in rows) - GAP) / 2
    x, y = {}, {}
    for number in range(len(rows) - 1, -1, -1):
        row = sorted(rows[number], key=lambda point: (
            sum(x[upper] for upper in above.get(point, [])) / max(1, len(above.get(point, []))), str(point)))
        left = centre - sum(map(width, row)) / 2
        for point in row:
            x[point] = left + width(point) / 2
            y[point] = MARGIN + HEIGHT / 2 + (len(rows) - 1 - number) * ROW
            left += width(point)
    return x, y, 2 * centre, 2 * MARGIN + HEIGHT + (len(rows) - 1) * ROW


def curve(path, x, y):
    """From the lower edge of the first room to the upper edge of the last."""
    text = f"M{x[path[0]]:.0f} {y[path[0]] + HEIGHT / 2:.0f}"
    at = y[path[0]] + HEIGHT / 2
    for upper, lower in zip(path, path[1:]):
        end = y[lower] - HEIGHT / 2
        bend = (end - at) / 2
        text += f"C{x[upper]:.0f} {at + bend:.0f} {x[lower]:.0f} {end - bend:.0f} {x[lower]:.0f} {end:.0f}"
        at = end + HEIGHT
        if lower != path[-1]:
            text += f"V{at:.0f}"
    return text


def draw(direct):
    level = levels(direct)
    paths = routes(level, without_implied(direct))
    x, y, width, height = places(level, paths)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" font-family="sans-serif" '
             'font-size="13">',
             '<rect width="100%" height="100%" fill="#fff"/>',
             '<marker id="end" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
             '<path d="M0 0 8 4 0 8z" fill="#69c"/></marker>']
    for arrow in sorted(paths):
        lines.append(f'<path d="{curve(paths[arrow], x, y)}" fill="none" stroke="#69c" marker-end="url(#end)"/>')
    for room in sorted(direct):
        lines.append(f'<rect x="{x[room] - WIDTH / 2:.0f}" y="{y[room] - HEIGHT / 2:.0f}" width="{WIDTH}" '
                     f'height="{HEIGHT}" rx="4" fill="#eef4fb" stroke="#357"/>'
                     f'<text x="{x[room]:.0f}" y="{y[room] + 5:.0f}" text-anchor="middle">{room}</text>')
    return "\n".join(lines + ["</svg>"]) + "\n"


if __name__ == "__main__":
    sys.stdout.write(draw(includes(pathlib.Path(sys.argv[1]))))
