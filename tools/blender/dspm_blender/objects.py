"""What is placed in the scene: meshes, each of which may stand in many places."""
from mathutils import Vector

from .blocks import in_block, indented, placed
from .directive import quoted
from .geometry import Geometry
from .textures import file_name

class Placement:
    """An object or instance over the frames."""

    def __init__(self, name, block):
        self.name, self.block, self.matrices, self.between = name, block, [], ()


class Objects:
    """Geometries with their materials, and where they stand."""

    def __init__(self, folder, materials):
        self.folder, self.materials, self.outside = folder, materials, ""
        self.geometries, self.stems = {}, set()
        self.filled = []  # of the first frame: (object, matrix, the medium inside)
        self.placements = {}  # (geometry's key, materials' names, parameters) -> {the instance's key: Placement}

    def see(self, frame, instance, block):
        """`block` is the Dynamic block that it comes and goes with, or None."""
        object = instance.object
        if not object.data.polygons:
            return
        if any(modifier.type == "FLUID" and modifier.fluid_type == "DOMAIN" for modifier in object.modifiers):
            self.materials.notes.add(f'object "{object.name}": the grids of a fluid are left out')
            return
        key = geometry_key(object)
        if key not in self.geometries:
            self.geometries[key] = Geometry(self._stem(key[-1]), self.folder)
        self.geometries[key].see(frame, object.data)
        names = tuple(self.materials.shown(frame, material) for material in slots(object))
        placement = self.placements.setdefault((key, names, tuple(parameters(object))), {}).setdefault(
            instance_key(instance), Placement(object.name, block))
        placement.matrices.append((frame, instance.matrix_world.copy()))
        if frame == 1:
            self.filled += [(object, instance.matrix_world.copy(), medium) for name in names
                            if (medium := self.materials.media.get(name))][:1]

    def medium_around(self, point):
        """The name of the medium that fills the smallest mesh around a point in the first frame, or None."""
        around = [(object.dimensions.length, medium) for object, matrix, medium in self.filled if contains(object, matrix, point)]
        return min(around)[1] if around else None

    def lines(self, all_frames, between, outside):
        """`between` has the places at times between frames, by the instance's key; `outside` is the medium around them."""
        self.outside = outside
        for geometry in self.geometries.values():
            geometry.finish()
        for i, ((key, names, params), placements) in enumerate(self.placements.items()):
            for instance, placement in placements.items():
                placement.between = between.get(instance, ())
            geometry, params, placements = self.geometries[key], dict(params), list(placements.values())
            if len(placements) == 1:
                yield from self._alone(geometry, names, params, placements[0], all_frames)
            else:
                yield from self._many(f"{geometry.name}.{i}", geometry, names, params, placements, all_frames)

    def _alone(self, geometry, names, params, placement, all_frames):
        inside = lambda frames: self._shapes(
            geometry, names, placement.name, frames, all_frames, params, True)
        return in_block(placement.block,
                        placed(placement.name, placement.matrices, all_frames, inside, geometry.deforms(), placement.between))

    def _many(self, name, geometry, names, params, placements, all_frames):
        frames = list(range(1, all_frames + 1))
        yield f"ObjectBegin {quoted(name)}"
        yield from indented(self._shapes(geometry, names, name, frames, all_frames, params, False))
        yield "ObjectEnd"
        for placement in placements:
            yield from in_block(placement.block, placed(
                placement.name, placement.matrices, all_frames, lambda _: [f"ObjectInstance {quoted(name)}"],
                between=placement.between))

    def _shapes(self, geometry, names, name, frames, all_frames, params, in_their_block):
        lines = []
        for slot in sorted(geometry.files):
            material = names[min(slot, len(names) - 1)]
            lines += [f"NamedMaterial {quoted(material)}", *self._filled(
                material, geometry.shapes(name, slot, frames, all_frames, params, in_their_block))]
        return lines

    def _filled(self, material, lines):
        if material not in self.materials.media:
            return lines
        interface = f"MediumInterface {quoted(self.materials.media[material])} {quoted(self.outside)}"
        return ["AttributeBegin", *indented([interface, *lines]), "AttributeEnd"]

    def _stem(self, name):
        stem = file_name(name)
        while stem in self.stems:
            stem += "_"
        self.stems.add(stem)
        return stem


def contains(object, matrix, point):
    """Whether a ray from the point crosses the mesh an odd number of times."""
    if matrix.determinant() == 0:
        return False
    start, crossings = matrix.inverted() @ point, 0
    for _ in range(64):
        hit, place, _, _ = object.ray_cast(start, DIRECTION)
        if not hit:
            break
        start, crossings = place + 1e-4 * max(object.dimensions) * DIRECTION, crossings + 1
    return crossings % 2 == 1


DIRECTION = Vector((0.36, 0.48, 0.8))  # of no edge


def slots(object):
    """The materials by slot. Geometry nodes may give the mesh more of them than its object has."""
    of_object, of_mesh = [slot.material for slot in object.material_slots], list(object.data.materials)
    return (of_object if len(of_object) >= len(of_mesh) else of_mesh) or [None]


def geometry_key(object):
    """Objects share a mesh unless modifiers or nodes make it their own."""
    if object.modifiers or object.data.shape_keys:
        return (object.name_full, object.data.name_full, object.name)
    return (object.data.name_full, object.data.name)


def instance_key(instance):
    if not instance.is_instance:
        return instance.object.name_full
    return (instance.parent.name_full, tuple(instance.persistent_id), instance.object.name_full)


def parameters(object):
    """Of its shapes: pairs. Seen by nothing but shadow rays is seen by nothing here."""
    if not (object.visible_camera or object.visible_glossy or object.visible_diffuse):
        yield "float alpha", 0.0
    if object.is_shadow_catcher:
        yield "bool shadowcatcher", True
    if not getattr(getattr(object, "cycles", None), "use_motion_blur", True):
        yield "bool blur", False
