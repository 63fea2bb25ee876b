"""Materials over the frames."""
import math
from dataclasses import replace

from .directive import Directive, over_frames
from .links import LinkedSocket
from .relief import displacement
from .shader_tree import ShaderTree
from .volumes import Volume, VolumeTree


class Materials:
    """All materials of a scene, by name. Those with animated nodes are read again in each frame."""

    def __init__(self, textures, notes):
        self.textures, self.notes, self.states, self.override = textures, notes, {}, None
        self.media = {}  # material -> the name of the medium inside
        self.around = Volume()  # the world's, which Cycles adds to all others

    def see(self, frame, material):
        """Its name in the scene."""
        if material is None:
            self.states.setdefault(NONE, [(frame, [Directive("MakeNamedMaterial", NONE).with_params(
                {"string type": "diffuse", "rgb reflectance": [0.8, 0.8, 0.8]})])])
            return NONE
        name = material.name_full
        states = self.states.setdefault(name, [])
        if not states or (states[-1][0] != frame and is_animated(material)):
            states.append((frame, self._directives(material)))
        return name

    def shown(self, frame, material):
        """The same for an object that has this material. A view layer may override all of them."""
        return self.see(frame, self.override or material)

    def volume(self, material):
        """Of a volume object; without a material, Blender's default."""
        tree = material.node_tree if material and material.use_nodes else None
        output = tree.get_output_node("CYCLES") if tree else None
        volume = output and VolumeTree(f'material "{material.name_full}"', self.notes).of(LinkedSocket(output.inputs["Volume"]))
        return volume or Volume((0.5,) * 3, (0.5,) * 3)

    def lines(self):
        for states in self.states.values():
            for each in zip(*([(frame, directive) for directive in directives] for frame, directives in states)):
                yield over_frames(list(each), self.notes)

    def replacement(self, name, replaced):
        """The definition of a material in the place of another one."""
        if self.media.get(name) != self.media.get(replaced):
            self.notes.add(f'material "{name}": in the place of "{replaced}" its volume is left out, and that one\'s stays')
        states = [(frame, Directive("MakeNamedMaterial", replaced).with_params(directives[-1].params))
                  for frame, directives in self.states[name]]
        return over_frames(states, self.notes)

    def _directives(self, material):
        tree = ShaderTree(material.name_full, self.textures, self.notes, is_animated(material))
        if not material.use_nodes or material.node_tree is None:
            return [Directive("MakeNamedMaterial", tree.name).with_params(
                {"string type": "principled", "rgb basecolor": list(material.diffuse_color[:3]),
                 "float metallic": material.metallic, "float roughness": material.roughness})]
        output = material.node_tree.get_output_node("CYCLES")
        if output is None:
            return [Directive("MakeNamedMaterial", tree.name).with_params({"string type": "interface"})]
        surface, volume = (LinkedSocket(output.inputs[name]) for name in ("Surface", "Volume"))
        if surface.source() is None and volume.source() is not None:
            return [*self._medium(tree, volume), Directive("MakeNamedMaterial", tree.name).with_params({"string type": "interface"})]
        shader = tree.of(surface)
        more, media = displacement(tree, output), []
        if absorbs_alone(shader, volume):
            more |= absorption(tree, volume.source())
        else:
            media = self._medium(tree, volume)
        made = tree.directive(replace(shader, plain=shader.plain | more))
        return [*media, *tree.parts, made]

    def _medium(self, tree, socket):
        """What fills objects of this material: a list with one directive, or none."""
        volume = VolumeTree(f'material "{tree.name}"', self.notes).of(socket)
        if volume is None:
            return []
        if volume.grid and volume.grid != "density":
            tree.note(socket.source(), f'meshes have no grid "{volume.grid}"; the medium is the same everywhere')
        if volume.blackbody:
            tree.note(socket.source(), "flames of meshes are left out: they have no temperature")
        name = self.media[tree.name] = f"inside {tree.name}"
        return [Directive("MakeNamedMedium", name).with_params(volume.plus(self.around).params())]


NONE = "no material"


def absorbs_alone(shader, socket):
    """Glass that absorbs is a body of dspm's: it needs no medium."""
    source = socket.source()
    return source is not None and source.node.bl_idname == "ShaderNodeVolumeAbsorption" and shader.kind in {"dielectric", "principled"}


def absorption(tree, source):
    """Beer's law: Volume Absorption leaves exp(-(1 - colour) density) of light in each unit."""
    density = tree.number(source, "Density")
    return {"rgb attenuationcolor": [math.exp(-(1 - each) * density) for each in tree.field(source, "Color").mean().colour()]}


def is_animated(material):
    material = material.original
    trees = [material.node_tree] if material.node_tree else []
    for tree in trees:
        if tree.animation_data:
            return True
        trees += [node.node_tree for node in tree.nodes if node.bl_idname == "ShaderNodeGroup" and node.node_tree]
    return material.animation_data is not None
