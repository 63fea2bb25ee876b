"""Media: the volume shaders of materials, of the world and of volume objects."""
import os
import shutil
from dataclasses import dataclass, replace

import bpy

from .blocks import in_block, placed
from .colours import Colours
from .directive import Directive, over_frames, quoted, written
from .links import LinkedSocket
from .textures import file_name

LEAST_ABSORPTION = 1e-4  # of what glows: dspm's media give off light in proportion to what they absorb


@dataclass
class Volume:
    """Shares of light for each unit of length, by colour."""
    absorbed: tuple = (0, 0, 0)
    scattered: tuple = (0, 0, 0)
    emitted: tuple = (0, 0, 0)  # radiance
    anisotropy: float = 0
    grid: str = ""  # of which all are multiples
    temperature: str = ""  # another grid
    blackbody: float = 0

    def times(self, share):
        return replace(self, blackbody=share * self.blackbody, **{
            name: tuple(share * each for each in getattr(self, name)) for name in ("absorbed", "scattered", "emitted")})

    def plus(self, other):
        total = lambda name: tuple(a + b for a, b in zip(getattr(self, name), getattr(other, name)))
        scatter, others = sum(self.scattered), sum(other.scattered)
        mean = (self.anisotropy * scatter + other.anisotropy * others) / ((scatter + others) or 1)
        return Volume(total("absorbed"), total("scattered"), total("emitted"), mean, self.grid or other.grid,
                      self.temperature or other.temperature, max(self.blackbody, other.blackbody))

    def params(self):
        """Of a medium that is the same everywhere."""
        absorbed = self.absorbed
        if any(self.emitted):
            absorbed = tuple(max(each, LEAST_ABSORPTION) for each in absorbed)
        return {"string type": "homogeneous", "rgb sigma_a": list(absorbed), "rgb sigma_s": list(self.scattered),
                "rgb Le": [emitted / share if share else 0.0 for emitted, share in zip(self.emitted, absorbed)],
                "float g": self.bounded_anisotropy()}

    def bounded_anisotropy(self):
        """dspm's lies between -1 and 1."""
        return min(max(self.anisotropy, -0.99), 0.99)

    def grid_params(self):
        """Of one whose density a file has."""
        return {"string type": "nanovdb", "string gridname": self.grid or "density",
                "string temperaturename": self.temperature or "temperature", "rgb sigma_a": list(self.absorbed),
                "rgb sigma_s": list(self.scattered), "float g": self.bounded_anisotropy(), "float Lescale": self.blackbody}


class VolumeTree:
    """The volume shaders of one material or world."""

    def __init__(self, whose, notes):
        self.colours, self.notes = Colours(notes, whose), notes

    def of(self, socket):
        """None if nothing enters a LinkedSocket."""
        source = socket.source()
        if source is None:
            return None
        return KINDS.get(source.node.bl_idname, unknown)(self, source)

    def colour(self, source, name):
        return self._mean(source, name).colour()

    def number(self, source, name):
        return self._mean(source, name).number()

    def density(self, source):
        """(density, the grid that it is multiplied by)."""
        entering = source.input("Density").source()
        if entering is not None and entering.node.bl_idname == "ShaderNodeAttribute":
            return 1.0, entering.node.attribute_name
        return max(self.number(source, "Density"), 0.0), ""

    def note(self, source, text):
        self.notes.add(f"{self.colours.named(source.node)}: {text}")

    def _mean(self, source, name):
        value = self.colours.of(source.input(name))
        if not value.is_constant():
            self.note(source, f"{name} is a texture; its mean stands in")
        return value.mean()


def scatter(tree, source):
    density, grid = tree.density(source)
    if getattr(source.node, "phase", "HENYEY_GREENSTEIN") != "HENYEY_GREENSTEIN":  # since Blender 4.3
        tree.note(source, "it scatters as Henyey and Greenstein say")
    scattered = tuple(density * each for each in tree.colour(source, "Color"))
    return Volume(scattered=scattered, anisotropy=tree.number(source, "Anisotropy"), grid=grid)


def absorption(tree, source):
    density, grid = tree.density(source)
    return Volume(absorbed=tuple(density * max(1 - each, 0) for each in tree.colour(source, "Color")), grid=grid)


def principled(tree, source):
    """Of what is not scattered, Cycles absorbs 1 - sqrt(absorption colour)."""
    density, grid = tree.density(source)
    colour, kept = tree.colour(source, "Color"), tree.colour(source, "Absorption Color")
    strength = tree.number(source, "Emission Strength")
    text = lambda name: source.input(name).end().socket.default_value
    blackbody = tree.number(source, "Blackbody Intensity")
    if blackbody > 0:
        tree.note(source, "flames have the colour of their temperature and the brightness that dspm gives them")
    return Volume(tuple(density * max(1 - c, 0) * max(1 - max(k, 0) ** 0.5, 0) for c, k in zip(colour, kept)),
                  tuple(density * each for each in colour),
                  tuple(strength * each for each in tree.colour(source, "Emission Color")),
                  tree.number(source, "Anisotropy"), grid or text("Density Attribute"), text("Temperature Attribute"), blackbody)


def emission(tree, source):
    strength = tree.number(source, "Strength")
    return Volume(emitted=tuple(strength * each for each in tree.colour(source, "Color")))


def add(tree, source):
    parts = [part for index in (0, 1) if (part := tree.of(source.input(index))) is not None]
    return parts[0].plus(parts[1]) if len(parts) == 2 else parts[0] if parts else None


def mix(tree, source):
    share = min(max(tree.number(source, 0), 0), 1)
    parts = [part.times(weight) for index, weight in ((1, 1 - share), (2, share))
             if (part := tree.of(source.input(index))) is not None]
    return parts[0].plus(parts[1]) if len(parts) == 2 else parts[0] if parts else None


def unknown(tree, source):
    tree.note(source, f"{source.node.bl_label} is left out of the volume")
    return None


KINDS = {"ShaderNodeVolumeScatter": scatter, "ShaderNodeVolumeAbsorption": absorption, "ShaderNodeVolumePrincipled": principled,
         "ShaderNodeEmission": emission, "ShaderNodeAddShader": add, "ShaderNodeMixShader": mix}


class VolumeObjects:
    """Objects whose volume is a file, or one for each frame."""

    def __init__(self, path, materials, notes):
        """Files of a sequence go into a folder beside the scene at `path`."""
        self.folder, self.materials, self.notes, self.placements = f"{os.path.splitext(path)[0]}.volumes", materials, notes, {}

    def see(self, frame, key, instance, block):
        object = instance.object
        object.data.grids.load()
        file = object.data.grids.frame_filepath or bpy.path.abspath(object.data.filepath, library=object.data.library)
        if not os.path.isfile(file):
            self.notes.add(f'object "{object.name}": there is no volume file {file!r}')
            return
        if key not in self.placements:
            self.placements[key] = Placement(object.name, block, f"{file_name(object.name)}.{len(self.placements)}")
        slots = object.material_slots
        volume = self.materials.volume(slots[0].material if slots else None)
        if any(volume.emitted):
            self.notes.add(f'object "{object.name}": emission other than that of its temperature is left out')
        if self.materials.around != Volume():
            self.notes.add(f'object "{object.name}": the world\'s volume is not in its box')
        self.placements[key].see(frame, instance.matrix_world.copy(), file, [tuple(c) for c in object.bound_box], volume)

    def lines(self, all_frames, between, outside):
        """`outside` is the name of the medium around."""
        for key, placement in self.placements.items():
            file = placement.file(self.folder, all_frames)
            inside = lambda frames: placement.inside(file, frames, outside, self.notes)
            yield from in_block(placement.block, placed(placement.name, placement.matrices, all_frames, inside,
                                                        placement.changes(), between.get(key, ())))


class Placement:
    def __init__(self, name, block, stem):
        self.name, self.block, self.stem, self.matrices, self.files, self.volumes = name, block, stem, [], {}, []
        self.low, self.high = [float("inf")] * 3, [float("-inf")] * 3

    def see(self, frame, matrix, file, corners, volume):
        self.matrices.append((frame, matrix))
        self.files[frame] = file
        self.volumes.append((frame, volume))
        self.low = [min(bound, *(corner[axis] for corner in corners)) for axis, bound in enumerate(self.low)]
        self.high = [max(bound, *(corner[axis] for corner in corners)) for axis, bound in enumerate(self.high)]

    def changes(self):
        return len(set(self.files.values())) > 1

    def file(self, folder, all_frames):
        """Its name in the scene; a sequence is copied to files by frame. A medium is there in all frames, and so are its files."""
        if not self.changes():
            return os.path.relpath(next(iter(self.files.values())), os.path.dirname(folder))
        os.makedirs(folder, exist_ok=True)
        file = next(iter(self.files.values()))
        kind = os.path.splitext(file)[1]
        for frame in range(1, all_frames + 1):
            file = self.files.get(frame, file)
            shutil.copyfile(file, os.path.join(folder, f"{self.stem}.{frame:04}{kind}"))
        return f"{os.path.basename(folder)}/{self.stem}.%04d{kind}"

    def inside(self, file, frames, outside, notes):
        name = f"{self.stem}.{frames[0]}"  # what is hidden in between has a medium for each stretch
        medium = over_frames([(frame, Directive("MakeNamedMedium", name).with_params(
            volume.grid_params() | {"string filename": file})) for frame, volume in self.volumes if frame in frames], notes)
        margin = [0.01 * (high - low) for low, high in zip(self.low, self.high)]
        xs, ys, zs = ((low - more, high + more) for low, high, more in zip(self.low, self.high, margin))
        corners = [each for z in zs for y in ys for x in xs for each in (x, y, z)]
        return [medium, f"MediumInterface {quoted(name)} {quoted(outside)}", 'Material "interface"',
                f'Shape "trianglemesh" "point3 P" {written(corners)} "integer indices" {written(BOX)}']


# Triangles of a box's corners, x fastest; their normals point outward.
BOX = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5]
