"""Blocks of the scene language: where something stands, and in which frames."""
from operator import itemgetter

from mathutils import Matrix

from .directive import constant, key, keys, quoted, written

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
    return [f"Keyframe {key(frame)} {matrix_text('ConcatTransform', matrix)}" for frame, matrix in keys(matrices)] + ["KeyframeEnd"]


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


def with_inverse(matrix):
    """A flattened object keeps a trace of thickness. None: the scale of 0 leaves nothing of it."""
    columns = [matrix.col[i].to_3d() for i in range(3)]
    largest = max(column.length for column in columns)
    flat = [i for i in range(3) if columns[i].length <= 1e-12 * largest]
    if len(flat) == 1:
        normal = columns[flat[0] - 2].cross(columns[flat[0] - 1]).normalized()
        matrix = matrix.copy()
        matrix.col[flat[0]] = (*(normal * largest * 1e-6), 0)
    return matrix if matrix.to_3x3().determinant() else None


def near(stretch, between):
    """(frame, value) pairs together with the (time, value) pairs less than a frame before, between and after them."""
    first, last = stretch[0][0], stretch[-1][0]
    values = {time: value for time, value in between if first - 1 < time < last + 1.001}
    return sorted((values | dict(stretch)).items(), key=itemgetter(0))


def usable(matrices):
    """(frame, matrix) pairs of what has a size."""
    return [(frame, whole) for frame, matrix in matrices if (whole := with_inverse(matrix)) is not None]


def placed(name, matrices, all_frames, inside, deforms=False, between=()):
    """`inside(frames)` yields lines that stand where (frame, matrix) pairs say; in other frames there is nothing. `between` are
    pairs of times between frames."""
    lines = []
    between = usable(between)
    for stretch in stretches(usable(matrices)):
        first, last = stretch[0][0], stretch[-1][0]
        way = near(stretch, between)
        body = pose(way) + inside([frame for frame, _ in stretch])
        if constant(way) and (first, last) == (1, all_frames) and not deforms:
            lines += ["AttributeBegin", *indented(body), "AttributeEnd"]
        else:
            lines += dynamic(name, first, last, all_frames, body)
    return lines
