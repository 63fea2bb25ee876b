"""Nodes that compute colours and numbers, evaluated on the pixels of their pictures: what is left is one picture."""
import bpy
import numpy as np

from .baked_pictures import is_of_places, picture_of
from .colour_math import blended, computed, hue_shifted
from .fields import Field, Place, grey, luminance, together
from .image_fields import image_field, is_missing, missing
from . import layers
from .links import LinkedSocket


class Colours:
    """Evaluates sockets; a node that is not known is named, and gives the mean of what enters it."""

    def __init__(self, notes, whose):
        self.notes, self.whose, self.done = notes, whose, {}

    def of(self, socket):
        """Of a LinkedSocket."""
        source = socket.source()
        if source is None:
            return constant(socket.end().socket)
        key = (source.node.as_pointer(), source.socket.identifier, source.groups)
        if key not in self.done:
            evaluate = baked if picture_of(source) else NODES.get(source.node.bl_idname, unknown)
            self.done[key] = evaluate(self, source)
        return self.done[key]

    def inputs(self, source, *names):
        """Values of the node's inputs on one grid, and how to put a result back."""
        entering = [self.of(source.input(name)) for name in names]
        if any(field.of_vertices for field in entering):
            self.notes.add(f"{self.named(source.node)}: colours of vertices are computed as white")
        values, leader = together(entering, self.notes, self.named(source.node))
        return values, leader.with_values

    def named(self, node):
        return f'{self.whose}, node "{node.name}"'


def constant(socket):
    value = getattr(socket, "default_value", 0.0)
    return Field.of(*value) if hasattr(value, "__len__") else Field.of(float(value))


def constant_colour(socket, notes):
    """Where textures cannot be: of lamps."""
    return Colours(notes, f'"{socket.node.id_data.name}"').of(LinkedSocket(socket)).mean().colour()


def unknown(colours, source):
    """A colour may be made of those that enter; numbers, such as a noise's scale, say nothing about what leaves."""
    entering = [colours.of(LinkedSocket(socket, source.groups)) for socket in source.node.inputs
                if socket.type == source.socket.type == "RGBA" and socket.enabled]
    instead = "the mean of the colours that enter it stands in" if entering else "0.5 stands in"
    lack = "has not been baked" if is_of_places(source.node, source.socket) else "is not known"
    colours.notes.add(f"{colours.named(source.node)}: {source.node.bl_label} {lack}; {instead}")
    if not entering:
        return Field.of(0.5)
    return Field(np.mean([field.mean().values for field in entering], axis=0))


def baked(colours, source):
    """The picture of a procedural texture."""
    uv_set = layers.uv_set(layers.BAKED_UVS, bpy.data.meshes)
    return image_field(picture_of(source), Place(uv_set=uv_set or 1))


def picture(colours, source):
    node = source.node
    if is_missing(node.image):
        colours.notes.add(f"{colours.named(node)}: {missing(node.image)}")
        return Field.of(1, 0, 1)
    if node.image.source in {"SEQUENCE", "MOVIE", "TILED"}:
        colours.notes.add(f"{colours.named(node)}: one picture stands in for all of {node.image.name}")
    field = image_field(node.image, placement(colours, source))
    return field.with_values(grey(field.values[..., 3])) if source.socket.name == "Alpha" else field


def of_vertices(colours, source):
    """A Color Attribute, or an Attribute that is one."""
    node = source.node
    name = node.layer_name if node.bl_idname == "ShaderNodeVertexColor" else node.attribute_name
    output = "Alpha" if source.socket.name == "Alpha" else "Color"
    if source.socket.name not in {"Color", "Alpha"} or (name and not any(
            name in getattr(mesh, "color_attributes", ()) for mesh in bpy.data.meshes)):
        return unknown(colours, source)
    return Field(np.ones((1, 1, 4), dtype=np.float32), Place(), of_vertices=output)


def placement(colours, source):
    node = source.node
    if node.projection != "FLAT":
        colours.notes.add(f"{colours.named(node)}: {node.projection.lower()} projection; texture coordinates stand in")
    wrap = {"EXTEND": "clamp", "CLIP": "black"}.get(node.extension, "repeat")
    matrix, offset, uv_set = mapping(colours, source.input("Vector").source())
    scale, rotation, is_straight = scale_and_turn(matrix)
    if not is_straight:
        colours.notes.add(f"{colours.named(node)}: its mapping shears pictures; a turn stands in")
    return Place(scale, tuple(map(float, offset)), rotation, wrap, "point" if node.interpolation == "Closest" else "bilinear", uv_set)


def mapping(colours, source):
    """(matrix, offset, set) of texture coordinates."""
    if source is None or (source.node.bl_idname == "ShaderNodeTexCoord" and source.socket.name == "UV"):
        return np.eye(2), np.zeros(2), 1
    node = source.node
    if node.bl_idname == "ShaderNodeUVMap":
        uv_set = layers.uv_set(node.uv_map, bpy.data.meshes)
        if uv_set is None:
            colours.notes.add(f"{colours.named(node)}: a mesh keeps two UV maps; the one for rendering stands in for {node.uv_map}")
        return np.eye(2), np.zeros(2), uv_set or 1
    if node.bl_idname != "ShaderNodeMapping":
        colours.notes.add(f"{colours.named(node)}: {source.socket.name} of {node.bl_label} places no pictures; UVs stand in")
        return np.eye(2), np.zeros(2), 1
    inner, inner_offset, uv_set = mapping(colours, source.input("Vector").source())
    move, turn, size = (colours.of(source.input(name)).mean().colour() for name in ("Location", "Rotation", "Scale"))
    if any(abs(angle) > 1e-6 for angle in turn[:2]):
        colours.notes.add(f"{colours.named(node)}: pictures are turned about Z only")
    move, size, turned = np.array(move[:2]), np.array(size[:2]), rotated(turn[2])
    if node.vector_type == "TEXTURE":  # the way back: moved, turned, and then scaled
        outer = np.diag([1 / each if each else 1.0 for each in size]) @ turned.T
        move = -outer @ move
    else:
        outer = turned @ np.diag(size)
    if node.vector_type in {"VECTOR", "NORMAL"}:
        move = np.zeros(2)
    return outer @ inner, outer @ inner_offset + move, uv_set


def rotated(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def scale_and_turn(matrix):
    """(scale, degrees, is that all?) of a matrix that scales and then turns."""
    (ux, vx), (uy, vy) = matrix
    angle = np.arctan2(uy, ux) if ux or uy else np.arctan2(-vx, vy)
    if abs(np.sin(angle)) < 1e-7:
        angle = 0.0  # mirrored
    left = rotated(angle).T @ matrix
    is_straight = np.abs(left - np.diag(left.diagonal())).max() <= 1e-5 * np.abs(matrix).max()
    return tuple(map(float, left.diagonal())), float(np.degrees(angle)), is_straight


def value(colours, source):
    return constant(source.node.outputs[0])


def mix_colours(colours, source):
    """Mix Color of before 3.4."""
    node = source.node
    (share, a, b), put = colours.inputs(source, "Fac", "Color1", "Color2")
    return put(blended(node.blend_type, share[..., :1], a, b, node.use_clamp))


def mix(colours, source):
    node, kind = source.node, {"FLOAT": "Float", "VECTOR": "Vector", "RGBA": "Color"}[source.node.data_type]
    (share, a, b), put = colours.inputs(source, "Factor_Float", f"A_{kind}", f"B_{kind}")
    share = np.clip(share[..., :1], 0, 1) if node.clamp_factor else share[..., :1]
    return put(blended(node.blend_type if kind == "Color" else "MIX", share, a, b, kind == "Color" and node.clamp_result))


def arithmetic(colours, source):
    (a, b, c), put = colours.inputs(source, 0, 1, 2)
    result = computed(source.node.operation, *(luminance(each) for each in (a, b, c)))
    if result is None:
        return unknown(colours, source)
    return put(grey(np.clip(result, 0, 1) if source.node.use_clamp else result))


def gamma(colours, source):
    (colour, power), put = colours.inputs(source, "Color", "Gamma")
    return put(opaque(np.maximum(colour, 0) ** power, colour))


def brightness(colours, source):
    (colour, bright, contrast), put = colours.inputs(source, "Color", "Bright", "Contrast")
    return put(opaque(np.maximum((1 + contrast) * colour + bright - contrast / 2, 0), colour))


def invert(colours, source):
    (share, colour), put = colours.inputs(source, "Fac", "Color")
    return put(opaque(share * (1 - colour) + (1 - share) * colour, colour))


def hue(colours, source):
    (turn, saturation, strength, share, colour), put = colours.inputs(source, "Hue", "Saturation", "Value", "Fac", "Color")
    shifted = hue_shifted(colour, turn[..., 0], saturation[..., 0], strength[..., 0])
    return put(opaque(share * shifted + (1 - share) * colour, colour))


def ramp(colours, source):
    (share,), put = colours.inputs(source, "Fac")
    table = np.array([source.node.color_ramp.evaluate(i / 255) for i in range(256)], dtype=np.float32)
    looked_up = table[np.clip(luminance(share) * 255 + 0.5, 0, 255).astype(int)]
    return put(grey(looked_up[..., 3]) if source.socket.name == "Alpha" else looked_up)


def curves(colours, source):
    (share, colour), put = colours.inputs(source, "Fac", "Color")
    mapping = source.node.mapping
    mapping.initialize()
    steps = np.linspace(0, 1, 256)
    bent = [np.interp(np.interp(colour[..., i], steps, [mapping.evaluate(mapping.curves[3], x) for x in steps]),
                      steps, [mapping.evaluate(mapping.curves[i], x) for x in steps]) for i in range(3)]
    return put(opaque(share * np.stack([*bent, colour[..., 3]], axis=-1) + (1 - share) * colour, colour))


def channel(colours, source):
    (colour,), put = colours.inputs(source, 0)
    return put(grey(colour[..., source.node.outputs.find(source.socket.name)]))


def combine(colours, source):
    (r, g, b), put = colours.inputs(source, 0, 1, 2)
    parts = np.broadcast_arrays(*(luminance(each) for each in (r, g, b)))
    return put(np.stack([*parts, np.ones_like(parts[0])], axis=-1))


def to_grey(colours, source):
    (colour,), put = colours.inputs(source, 0)
    return put(grey(luminance(colour)))


def clamp(colours, source):
    (value, low, high), put = colours.inputs(source, "Value", "Min", "Max")
    return put(opaque(np.clip(value, low, high), value))


def map_range(colours, source):
    (value, a, b, c, d), put = colours.inputs(source, 0, 1, 2, 3, 4)
    share = (value - a) / np.where(b == a, 1, b - a)
    return put(opaque(c + (np.clip(share, 0, 1) if source.node.clamp else share) * (d - c), value))


def opaque(values, colour):
    """Alpha stays what it was."""
    values = np.array(np.broadcast_to(values, np.broadcast_shapes(values.shape, colour.shape)), dtype=np.float32)
    values[..., 3] = colour[..., 3]
    return values


NODES = {
    "ShaderNodeRGB": value, "ShaderNodeValue": value, "ShaderNodeTexImage": picture,
    "ShaderNodeVertexColor": of_vertices, "ShaderNodeAttribute": of_vertices, "ShaderNodeMixRGB": mix_colours,
    "ShaderNodeMix": mix, "ShaderNodeMath": arithmetic, "ShaderNodeGamma": gamma, "ShaderNodeBrightContrast": brightness,
    "ShaderNodeInvert": invert, "ShaderNodeHueSaturation": hue, "ShaderNodeValToRGB": ramp, "ShaderNodeRGBCurve": curves,
    "ShaderNodeSeparateColor": channel, "ShaderNodeSeparateRGB": channel, "ShaderNodeSeparateXYZ": channel,
    "ShaderNodeCombineColor": combine, "ShaderNodeCombineRGB": combine, "ShaderNodeCombineXYZ": combine,
    "ShaderNodeRGBToBW": to_grey, "ShaderNodeClamp": clamp, "ShaderNodeMapRange": map_range,
}
