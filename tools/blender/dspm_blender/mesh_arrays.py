"""Blender's mesh as arrays, and as the parts that have one material each."""
import hashlib

import numpy as np

from . import layers


def column(collection, name, width, kind):
    values = np.empty(len(collection) * width, dtype=kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def digest(*arrays):
    made = hashlib.blake2b(digest_size=16)
    for array in arrays:
        made.update(array)
    return made.digest()


class MeshArrays:
    """The mesh as it is now."""

    def __init__(self, mesh):
        self.mesh = mesh
        self.points = column(mesh.vertices, "co", 3, np.float32)
        self.corner_points = column(mesh.loops, "vertex_index", 1, np.int32)
        self.materials = column(mesh.polygons, "material_index", 1, np.int32)
        self.normals = normals_domain(mesh)
        self.uvs, self.second_uvs = (column(layer.data, "uv", 2, np.float32) if layer else None
                                     for layer in (layers.shown_uvs(mesh), layers.second_uvs(mesh)))
        self.colours = self._colours(layers.colours(mesh))
        self.connections = digest(self.corner_points, self.materials, self.normals.encode(), *self._looks())
        self.digest = digest(self.points, self.connections)

    def _colours(self, attribute):
        """Linear, with alpha, of corners."""
        if attribute is None:
            return None
        colours = column(attribute.data, "color", 4, np.float32)
        return colours[self.corner_points] if attribute.domain == "POINT" else colours

    def _looks(self):
        return [each for each in (self.uvs, self.second_uvs, self.colours) if each is not None]

    def parts(self):
        """{material's slot: (corners that become PLY's vertices, triangles of these)}. As long as `connections` are the
        same, so are the parts, unless normals belong to corners."""
        self.mesh.calc_loop_triangles()
        triangles = column(self.mesh.loop_triangles, "loops", 3, np.int32)
        slots = self.materials[column(self.mesh.loop_triangles, "polygon_index", 1, np.int32)]
        looks = self._looks()
        if self.normals == "CORNER":
            looks.append(self.corner_normals())
        return {int(slot): self._part(triangles[slots == slot], looks) for slot in np.unique(slots)}

    def _part(self, triangles, looks):
        """A vertex of PLY has one normal and one place in the texture, so one of Blender's may become several."""
        used = np.zeros(len(self.corner_points), dtype=bool)
        used[triangles] = True
        corners, number = np.flatnonzero(used), np.cumsum(used) - 1
        key = self.corner_points[corners].astype(np.uint64)
        if looks:
            key = key << np.uint64(32) | mixed(np.hstack([array[corners] for array in looks]))
        _, first, of_corner = np.unique(key, return_index=True, return_inverse=True)
        return corners[first], of_corner[number[triangles]]

    def vertices(self, corners):
        """{what `write_ply` takes: values at corners}; flat faces have no normals."""
        points = self.corner_points[corners]
        normals = {"FACE": lambda: None, "CORNER": lambda: self.corner_normals()[corners],
                   "POINT": lambda: column(self.mesh.vertices, "normal", 3, np.float32)[points]}[self.normals]()
        at_corners = {name: None if values is None else values[corners] for name, values in
                      (("uvs", self.uvs), ("second_uvs", self.second_uvs), ("colours", self.colours))}
        return {"points": self.points[points], "normals": normals, **at_corners}

    def corner_normals(self):
        if hasattr(self.mesh, "corner_normals"):
            return column(self.mesh.corner_normals, "vector", 3, np.float32)
        self.mesh.calc_normals_split()
        return column(self.mesh.loops, "normal", 3, np.float32)


def normals_domain(mesh):
    """Blender 4.1 knows by itself."""
    if hasattr(mesh, "normals_domain"):
        return mesh.normals_domain
    smooth = column(mesh.polygons, "use_smooth", 1, np.bool_)
    if not smooth.any():
        return "FACE"
    return "CORNER" if mesh.use_auto_smooth or mesh.has_custom_normals or not smooth.all() else "POINT"


def mixed(rows):
    """32 bits of each row: multiplied by odd numbers and added, so that equal rows agree and others hardly ever do."""
    bits = np.ascontiguousarray(rows + np.float32(0)).view(np.uint32).astype(np.uint64)  # -0 is 0
    odd = np.uint64(0x9E3779B97F4A7C15) * (2 * np.arange(bits.shape[1], dtype=np.uint64) + 1)
    return (bits * odd).sum(axis=1, dtype=np.uint64) >> np.uint64(32)
