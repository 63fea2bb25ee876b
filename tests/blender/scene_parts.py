"""What the scenes of these tests are made of."""
import bpy
import numpy as np
from mathutils import Vector


def empty(camera, target, lens, frames=1):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.frame_end = frames
    data = bpy.data.cameras.new("camera")
    data.lens = lens
    scene.camera = bpy.data.objects.new("camera", data)
    scene.camera.location = camera
    scene.camera.rotation_euler = (Vector(target) - Vector(camera)).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(scene.camera)


def material(name, shader_of):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader_of(tree).outputs[0], output.inputs["Surface"])
    return made


def bsdf(tree, kind, **inputs):
    node = tree.nodes.new(f"ShaderNode{'' if kind == 'Emission' else 'Bsdf'}{kind}")
    for name, value in inputs.items():
        node.inputs[name].default_value = value
    return node


def image(name, colours, width, height, linear=False):
    """`colours` gives red, green and blue at places in 0..1."""
    made = bpy.data.images.new(name, width, height, float_buffer=linear and name == "sky")
    if not made.is_float:  # those of floats are linear
        made.colorspace_settings.name = "Non-Color" if linear else "sRGB"
    x, y = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    rgba = np.dstack([*(each + 0.0 * x for each in colours(x, y)), np.ones_like(x)])
    made.pixels.foreach_set(rgba.astype(np.float32).ravel())
    made.pack()
    return made


def texture(tree, picture, scale=None):
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = picture
    if scale:
        mapping, place = tree.nodes.new("ShaderNodeMapping"), tree.nodes.new("ShaderNodeTexCoord")
        mapping.inputs["Scale"].default_value = scale
        tree.links.new(place.outputs["UV"], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs["Vector"], node.inputs["Vector"])
    return node


def plane(size, paint):
    bpy.ops.mesh.primitive_plane_add(size=size)
    bpy.context.object.data.materials.append(paint)
    return bpy.context.object


def lamp(kind, place, strength, turn=(0, 0, 0), **settings):
    data = bpy.data.lights.new(kind.lower(), kind)
    data.energy = strength
    for name, value in settings.items():
        setattr(data, name, value)
    made = bpy.data.objects.new(kind.lower(), data)
    made.location, made.rotation_euler, made.visible_camera = place, turn, False
    bpy.context.scene.collection.objects.link(made)
    return made


def sky(colour, strength):
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value, background.inputs["Strength"].default_value = colour, strength
    bpy.context.scene.world = world
    return world
