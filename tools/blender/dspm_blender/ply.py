"""Binary PLY files of triangles."""
import numpy as np


def write_ply(path, triangles, points, normals=None, uvs=None):
    """Rows of `points`, `normals` and `uvs` belong together; `triangles` are rows of three of their numbers."""
    names = ["x", "y", "z"] + (["nx", "ny", "nz"] if normals is not None else []) + (["u", "v"] if uvs is not None else [])
    columns = [points] + [each for each in (normals, uvs) if each is not None]
    vertices = np.ascontiguousarray(np.hstack(columns), dtype="<f4")
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
