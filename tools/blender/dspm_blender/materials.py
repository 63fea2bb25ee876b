"""Materials over the frames."""
import math
from dataclasses import replace

from .directive import Directive, over_frames
from .links import LinkedSocket
from .relief import displacement
from .shader_tree import ShaderTree


class Materials:
    """All materials of a scene, by name. Those with animated nodes are read again in each frame."""

    def __init__(self, textures, notes):
        self.textures, self.notes, self.states, self.override = textures, notes, {}, None

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

    def lines(self):
        for states in self.states.values():
            for each in zip(*([(frame, directive) for directive in directives] for frame, directives in states)):
                yield over_frames(list(each), self.notes)

    def replacement(self, name, replaced):
        """The definition of a material in the place of another one."""
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
            tree.note(volume.source(), "a volume without a surface is left out, and light passes its object")
            return [Directive("MakeNamedMaterial", tree.name).with_params({"string type": "interface"})]
        shader = tree.of(surface)
        more = displacement(tree, output) | absorption(tree, shader, volume)
        made = tree.directive(replace(shader, plain=shader.plain | more))
        return [*tree.parts, made]


NONE = "no material"


def absorption(tree, shader, socket):
    """Beer's law: Volume Absorption leaves exp(-(1 - colour) density) of light in each unit."""
    source = socket.source()
    if source is None:
        return {}
    if source.node.bl_idname != "ShaderNodeVolumeAbsorption" or shader.kind not in {"dielectric", "principled"}:
        tree.note(source, "volumes other than absorbing glass are left out")
        return {}
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
