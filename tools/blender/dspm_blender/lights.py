"""Lights in Blender's units, as Cycles renders them.

With P the power in W: a point or spot light has the intensity P / (4 pi), whatever the spot's cone; a point light with
a radius r is a sphere of radiance P / (4 pi) / (pi r^2); an area light of area A has the radiance P / (4 A), since Blender 4
P / (pi A). A sun's strength is irradiance, and its angle the diameter of its disk. tests/blender compares each of them with Cycles.
"""
import math

from mathutils import Matrix

from .blocks import in_block, placed
from .camera import unscaled
from .colours import constant_colour
from .directive import Directive, over_frames, quoted
from .light_groups import light_group
from .versions import POWER_OF_AREA

LEAST_ANGLE = 0.01  # degrees: of dspm's disks
LEAST_SOFT = 1  # degrees: sharper shadows go without a note
BLACK = 'Material "diffuse" "rgb reflectance" [0 0 0]'


class Light:
    """One placed light over the frames."""

    def __init__(self, name, notes, block):
        """`block` is the Dynamic block that it comes and goes with, or None."""
        self.name, self.notes, self.block = name, notes, block
        self.matrices, self.lights, self.shapes, self.between = [], [], [], []
        self.medium = None  # the name of what it stands in, if that is not what is around all

    def see(self, frame, instance):
        light = instance.object.data
        if light.type == "AREA" and not area_of(light, instance.matrix_world):
            return  # shrunk to nothing
        matrix, directive, shape = KINDS[light.type](self, light, instance.matrix_world)
        self.hidden = not instance.object.visible_camera
        self.mirrored = instance.object.visible_glossy
        self.common = {"string name": self.name, **light_group(instance.object)}
        self.matrices.append((frame, matrix))
        self.lights.append((frame, directive.with_params(self.common)))
        self.shapes.append((frame, shape))

    def see_between(self, time, instance):
        light = instance.object.data
        if light.type != "AREA" or area_of(light, instance.matrix_world):
            self.between.append((time, KINDS[light.type](self, light, instance.matrix_world)[0]))

    def is_far(self):
        """A sun shines from beyond everything, wherever its object is."""
        return self.lights[0][1].names == ("distant",)

    def lines(self, all_frames, camera):
        """A lamp that the camera is not to see is a hole if it would, and a sun a point; else mirrors show it, as in Cycles."""
        if not self.lights:
            return []
        if self.hidden and (not self.mirrored or camera.shows(self._extents())):
            for _, shape in self.shapes:
                if shape:
                    shape.params["float alpha"] = 0.0
            self._be_a_point()
        elif any(light.params.get("float angle") for _, light in self.lights):
            for _, light in self.lights:  # dspm's suns are disks in all frames or in none
                light.params["float angle"] = max(light.params["float angle"], LEAST_ANGLE)
        return in_block(self.block, placed(self.name, self.matrices, all_frames, self._inside, between=self.between))

    def _extents(self):
        """What places the unit square or ball that is the lamp; a sun's disk is far away."""
        angles = dict((frame, light.params.get("float angle")) for frame, light in self.lights)
        return [(frame, matrix if angles[frame] is None else far_disk(matrix, angles[frame]))
                for frame, matrix in self.matrices]

    def _be_a_point(self):
        angles = [light.params.pop("float angle", 0) for _, light in self.lights]
        if max(angles) > LEAST_SOFT:
            self.notes.add(f'light "{self.name}": the camera would see it, so it is a point in the sky, and its shadows are sharp')

    def _inside(self, frames):
        among = lambda states: [(frame, state) for frame, state in states if frame in frames]
        medium = [f"MediumInterface {quoted(self.medium)}"] if self.medium else []
        light = over_frames(among(self.lights), self.notes)
        if self.shapes[0][1] is None:
            return [*medium, light]
        return [*medium, light, BLACK, over_frames(among(self.shapes), self.notes)]

    def point(self, light, matrix):
        intensity = self._colour(light, 1 / (4 * math.pi))
        radius = light.shadow_soft_size
        if radius == 0:
            return unscaled(matrix), Directive("LightSource", "point").with_params({"rgb I": intensity}), None
        return unscaled(matrix) @ Matrix.Scale(2 * radius, 4), area_light(times(intensity, 1 / (math.pi * radius**2))), Directive(
            "Shape", "sphere").with_params({"float radius": 0.5})

    def spot(self, light, matrix):
        if light.shadow_soft_size > 0:
            self.notes.add(f'light "{self.name}": a spot shines from a point, so its shadows are sharp')
        outer = math.cos(light.spot_size / 2)
        inner = math.acos(min(1, outer + (1 - outer) * light.spot_blend))
        cone = math.degrees(light.spot_size / 2)
        return unscaled(matrix), Directive("LightSource", "spot").with_params(
            {"rgb I": self._colour(light, 1 / (4 * math.pi)), "float coneangle": cone,
             "float conedeltaangle": cone - math.degrees(inner), "point3 to": (0, 0, -1)}), None

    def sun(self, light, matrix):
        return unscaled(matrix), Directive("LightSource", "distant").with_params(
            {"rgb L": self._colour(light, 1), "point3 to": (0, 0, -1), "float angle": math.degrees(light.angle)}), None

    def area(self, light, matrix):
        """It shines along -z."""
        if light.spread < math.pi - 1e-4:
            self.notes.add(f'light "{self.name}": its spread is 180 degrees')
        size = (*sides(light), 1)
        round_one = light.shape in {"DISK", "ELLIPSE"}
        turned = matrix @ Matrix.Rotation(math.pi, 4, "X") @ Matrix.Diagonal((*size, 1))
        shape = Directive("Shape", "disk").with_params({"float radius": 0.5}) if round_one else Directive(
            "Shape", "trianglemesh").with_params({
                "point3 P": [-.5, -.5, 0, .5, -.5, 0, .5, .5, 0, -.5, .5, 0], "integer indices": [0, 1, 2, 0, 2, 3]})
        return turned, area_light(self._colour(light, 1 / (POWER_OF_AREA * area_of(light, matrix)))), shape

    def _colour(self, light, factor):
        if getattr(light, "exposure", 0) or getattr(light, "use_temperature", False) or not getattr(light, "normalize", True):
            self.notes.add(f'light "{self.name}": its exposure, temperature and Normalize are left out')  # of Blender 4.5
        colour = times(light.color, light.energy * factor)
        if not light.use_nodes:
            return colour
        emission = next((node for node in light.node_tree.nodes if node.bl_idname == "ShaderNodeEmission"), None)
        if emission is None:
            self.notes.add(f'light "{self.name}": it has no Emission node; its own colour holds')
            return colour
        tint = constant_colour(emission.inputs["Color"], self.notes)
        strength = constant_colour(emission.inputs["Strength"], self.notes)[0]
        return [a * b * strength for a, b in zip(colour, tint)]


KINDS = {"POINT": Light.point, "SPOT": Light.spot, "SUN": Light.sun, "AREA": Light.area}


def sides(light):
    return light.size, light.size if light.shape in {"SQUARE", "DISK"} else light.size_y


def area_of(light, matrix):
    (x, y), scale = sides(light), matrix.to_scale()
    return abs(x * scale.x * y * scale.y) * (math.pi / 4 if light.shape in {"DISK", "ELLIPSE"} else 1)


def area_light(radiance):
    return Directive("AreaLightSource", "diffuse").with_params({"rgb L": radiance})


def far_disk(matrix, degrees):
    """Around a sun's disk."""
    far = 1e5
    size = 2 * far * math.tan(math.radians(min(degrees, 170)) / 2)
    return matrix @ Matrix.Translation((0, 0, far)) @ Matrix.Diagonal((size, size, 1, 1))


def times(colour, factor):
    return [component * factor for component in colour]
