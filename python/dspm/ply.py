"""Meshes of numpy arrays as PLY files, which Shape "plymesh" reads."""
import numpy as np


def ply(vertices, faces, normals=None, uv=None, colours=None):
    """The bytes of a binary PLY file.

    vertices are (n, 3), faces (m, 3) or (m, 4) indices into them; normals (n, 3), uv (n, 2) and colours (n, 3) or (n, 4),
    linear, belong to vertices."""
    columns = []
    for name, values, properties in (("vertices", vertices, ("x", "y", "z")), ("normals", normals, ("nx", "ny", "nz")),
                                     ("uv", uv, ("u", "v")), ("colours", colours, ("red", "green", "blue", "alpha"))):
        if values is None:
            continue
        values = np.asarray(values, "<f4")
        widths = (3, 4) if name == "colours" else (len(properties),)
        if values.ndim != 2 or values.shape[1] not in widths or len(values) != len(vertices):
            raise ValueError(f"{name}: expected an array of shape ({len(vertices)}, {widths[0]}), not {values.shape}")
        columns += [(properties[i], values[:, i]) for i in range(values.shape[1])]
    faces = np.asarray(faces, "<i4")
    if faces.ndim != 2 or faces.shape[1] not in (3, 4):
        raise ValueError(f"faces: expected an array of shape (m, 3) or (m, 4), not {faces.shape}")
    corners = np.empty(len(faces), [("count", "u1"), ("index", "<i4", faces.shape[1])])
    corners["count"], corners["index"] = faces.shape[1], faces
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}",
              *(f"property float {name}" for name, _ in columns),
              f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header\n"]
    return "\n".join(header).encode() + np.stack([column for _, column in columns], 1).tobytes() + corners.tobytes()
