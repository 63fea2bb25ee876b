"""Makes pictures of procedural textures: Cycles evaluates each over the surfaces that show it, on a UV map of their own."""
from contextlib import contextmanager

import bpy

from .baked_pictures import PREFIX, is_of_places
from .colours import NODES
from .layers import BAKED_UVS

GAP = 0.01  # between pieces of the surface; their margins must stay apart, as each object's overwrite those of others


def bake(scene, layer, size):
    """Makes pictures of all procedural textures that objects of the view layer show. Returns sentences about what has none."""
    notes, groups = [], groups_of_meshes([each for each in layer.objects if each.type == "MESH" and not each.hide_render])
    forget()
    for objects, materials in groups:
        with as_cycles_bakes(scene, layer, objects):
            lay_out(objects)
            for material, outputs in materials.items():
                for output in outputs:
                    bake_output(material, output, size)
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.node_tree else ():
            if node.bl_idname == "ShaderNodeGroup" and node.node_tree and any(procedural_outputs(node.node_tree)):
                notes.append(f'material "{material.name}", node "{node.name}": textures within groups are not baked')
    return notes


def any_baked():
    return any(True for _ in baked_outputs())


def baked_outputs():
    """(node, property) pairs."""
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.node_tree else ():
            yield from ((node, key) for key in node.keys() if key.startswith(PREFIX))


def forget():
    """Takes the pictures and their UV maps away."""
    for node, key in list(baked_outputs()):
        image = node[key]
        del node[key]
        if image:
            bpy.data.images.remove(image)
    for mesh in bpy.data.meshes:
        if BAKED_UVS in mesh.uv_layers and mesh.library is None:
            mesh.uv_layers.remove(mesh.uv_layers[BAKED_UVS])


RELIEFS = {"ShaderNodeBump", "ShaderNodeNormalMap", "ShaderNodeDisplacement"}


def procedural_outputs(tree):
    """Those from which a colour is computed, or a shader takes one."""
    return [output for node in tree.nodes for output in node.outputs
            if is_of_places(node, output) and any(takes_colours(link.to_node) for link in output.links)]


def takes_colours(node):
    is_shader = any(output.type == "SHADER" for output in node.outputs)
    return is_shader or (node.bl_idname in NODES and node.bl_idname != "ShaderNodeTexImage") or node.bl_idname in RELIEFS


def groups_of_meshes(objects):
    """[(objects, {material: outputs})]: meshes that share a material share its picture, so they are laid out together. One
    object stands for all of its mesh."""
    groups = []
    for object in {each.data: each for each in objects}.values():
        materials = {slot.material: outputs for slot in object.material_slots if slot.material and slot.material.node_tree
                     and (outputs := procedural_outputs(slot.material.node_tree))}
        if not materials:
            continue
        together = [group for group in groups if group[1].keys() & materials.keys()]
        groups = [group for group in groups if group not in together]
        for others, theirs in together:
            materials = theirs | materials
        groups.append(([object, *(each for others, _ in together for each in others)], materials))
    return groups


@contextmanager
def as_cycles_bakes(scene, layer, objects):
    """Only these objects are selected, and Cycles takes one sample."""
    render, cycles, active = scene.render, scene.cycles, layer.objects.active
    selected = [each for each in layer.objects if each.select_get()]
    kept = [(owner, name, getattr(owner, name)) for owner, name in (
        (render, "engine"), (cycles, "samples"), (cycles, "use_denoising"), (cycles, "use_adaptive_sampling"))]
    render.engine, cycles.samples, cycles.use_denoising, cycles.use_adaptive_sampling = "CYCLES", 1, False, False
    try:
        for each in layer.objects:
            each.select_set(each in objects)
        layer.objects.active = objects[0]
        yield
    finally:
        for owner, name, value in kept:
            setattr(owner, name, value)
        for each in layer.objects:
            each.select_set(each in selected)
        layer.objects.active = active


def lay_out(objects):
    """A UV map for all of them together. The one that is rendered stays as it was."""
    shown = {}
    for each in objects:
        layers = each.data.uv_layers
        shown[each] = next((layer.name for layer in layers if layer.active_render), None)
        layers.active = layers.get(BAKED_UVS) or layers.new(name=BAKED_UVS)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(island_margin=GAP)
    bpy.ops.object.mode_set(mode="OBJECT")
    for each, name in shown.items():
        if name:
            each.data.uv_layers[name].active_render = True


def bake_output(material, output, size):
    """As what the material emits, for a moment."""
    tree, node = material.node_tree, output.node
    image = bpy.data.images.new(f"{material.name}, {node.name}", size, size, float_buffer=True, is_data=True)
    end, active = tree.get_output_node("CYCLES"), tree.nodes.active
    surface = end.inputs["Surface"].links[0].from_socket if end.inputs["Surface"].is_linked else None
    emission, target = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeTexImage")
    target.image, tree.nodes.active = image, target
    tree.links.new(output, emission.inputs["Color"])
    tree.links.new(emission.outputs[0], end.inputs["Surface"])
    try:
        bpy.ops.object.bake(type="EMIT", margin=max(1, int(size * GAP / 4)), use_clear=False)
    finally:
        tree.nodes.remove(emission)
        tree.nodes.remove(target)
        tree.nodes.active = active
        if surface:
            tree.links.new(surface, end.inputs["Surface"])
    image.pack()
    node[PREFIX + output.identifier] = image
