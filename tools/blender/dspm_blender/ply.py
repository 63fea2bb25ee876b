"""Binary PLY files of triangles."""
import numpy as np


PROPERTIES = {"points": ("x", "y", "z"), "normals": ("nx", "ny", "nz"), "uvs": ("u", "v"), "second_uvs": ("u2", "v2"),
              "colours": ("red", "green", "blue", "alpha")}


def write_ply(path, triangles, **columns):
    """Of `columns`, named as PROPERTIES, rows belong together, None is left out; `triangles` are rows of three of their numbers."""
    columns = {kind: values for kind, values in columns.items() if values is not None}
    names = [name for kind in columns for name in PROPERTIES[kind]]
    vertices = np.ascontiguousarray(np.hstack(list(columns.values())), dtype="<f4")
    faces = np.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"] = 3
    faces["corners"] = triangles
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}",
              *(f"property float {name}" for name in names), f"element face {len(faces)}",
              "property list uchar int vertex_indices", "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode())
        file.write(vertices)
        file.write(faces)
