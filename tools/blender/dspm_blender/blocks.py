"""Blocks of the scene language: where something stands, and in which frames."""
from mathutils import Matrix

from .directive import constant, keys, quoted, written

INDENT = "  "


def indented(lines):
    return [INDENT + line for line in lines]


def matrix_text(keyword, matrix):
    """Column by column."""
    return f"{keyword} {written([row[column] for column in range(4) for row in matrix])}"


def transform(matrix):
    return [] if matrix == Matrix.Identity(4) else [matrix_text("ConcatTransform", matrix)]


def pose(matrices):
    """The transform of (frame, matrix) pairs."""
    if constant(matrices):
        return transform(matrices[0][1])
    return [f"Keyframe {frame} {matrix_text('ConcatTransform', matrix)}" for frame, matrix in keys(matrices)] + ["KeyframeEnd"]


def stretches(values):
    """(frame, value) pairs, cut where a frame is missing."""
    cut = []
    for frame, value in values:
        if cut and cut[-1][-1][0] == frame - 1:
            cut[-1].append((frame, value))
        else:
            cut.append([(frame, value)])
    return cut


def dynamic(name, first, last, all_frames, inside):
    limits = f' "integer frames" [{first} {last}]' if (first, last) != (1, all_frames) else ""
    return [f"DynamicBegin {quoted(name)}{limits}", *indented(inside), "DynamicEnd"]


def in_block(name, lines):
    """Lines that variations show and hide; without a name they are always there."""
    return [f"DynamicBegin {quoted(name)}", *indented(lines), "DynamicEnd"] if name else lines


def placed(name, matrices, all_frames, inside, deforms=False):
    """`inside(frames)` yields lines that stand where (frame, matrix) pairs say; in other frames there is nothing."""
    lines = []
    for stretch in stretches(matrices):
        first, last = stretch[0][0], stretch[-1][0]
        body = pose(stretch) + inside([frame for frame, _ in stretch])
        if constant(stretch) and (first, last) == (1, all_frames) and not deforms:
            lines += ["AttributeBegin", *indented(body), "AttributeEnd"]
        else:
            lines += dynamic(name, first, last, all_frames, body)
    return lines
