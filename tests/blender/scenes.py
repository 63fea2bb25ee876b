"""Scenes made by script in Blender, one function each. Each takes Blender's empty scene and leaves one to render."""
import gzip
import math
import os

import bpy
import numpy as np
from mathutils import Vector

from scene_parts import bsdf, empty, image, lamp, material, plane, sky, texture

SINCE_4 = bpy.app.version >= (4, 0)


def startup():
    """Blender's own, as it is."""
    bpy.ops.wm.read_factory_settings()
    bpy.context.scene.frame_end = 1


def lamps():
    """Every kind of light over one floor, far enough apart to be told by their blocks."""
    empty(camera=(0, 0, 14), target=(0, 0, 0), lens=35)
    plane(40, material("floor", lambda tree: bsdf(tree, "Diffuse", Color=(.8, .7, .6, 1))))
    lamp("POINT", (-4, 2.5, 1.5), 120, shadow_soft_size=0.0)
    lamp("POINT", (-4, -2.5, 1.5), 120, shadow_soft_size=0.3)
    lamp("SPOT", (0, 2.5, 3), 600, shadow_soft_size=0.0, spot_size=0.9, spot_blend=0.4)
    lamp("SUN", (0, 0, 5), 0.4, turn=(0.5, 0.2, 0), angle=0.0)
    lamp("AREA", (0, -2.5, 2), 90, shape="RECTANGLE", size=1.5, size_y=0.5)
    disk = lamp("AREA", (4, 2.5, 2), 90, turn=(0.4, 0, 0), shape="ELLIPSE", size=1.2, size_y=0.6)
    disk.scale = (1.5, 1, 1)
    glow = plane(1, material("glow", lambda tree: bsdf(tree, "Emission", Color=(.3, .6, 1, 1), Strength=6)))
    glow.location, glow.rotation_euler = (4, -2.5, 1.5), (math.radians(180), 0, 0)


def glass_monkey():
    """A glass Suzanne turns before a wall, under a large lamp and a sky."""
    empty(camera=(0, -6, 1.5), target=(0, 0, 0.6), lens=45, frames=2)
    plane(30, material("ground", lambda tree: bsdf(tree, "Diffuse", Color=(.5, .5, .45, 1))))
    wall = plane(30, material("wall", lambda tree: bsdf(tree, "Diffuse", Color=(.7, .25, .15, 1))))
    wall.location, wall.rotation_euler = (0, 3, 0), (math.pi / 2, 0, 0)
    bpy.ops.mesh.primitive_monkey_add(location=(0, 0, 1))
    monkey = bpy.context.object
    bpy.ops.object.shade_smooth()
    subdivision = monkey.modifiers.new("subdivision", "SUBSURF")
    subdivision.levels, subdivision.render_levels = 0, 2
    monkey.data.materials.append(material("glass", lambda tree: bsdf(tree, "Glass", IOR=1.45, Roughness=0.0)))
    for frame, angle in ((1, -0.6), (2, 0.6)):
        monkey.rotation_euler.z = angle
        monkey.keyframe_insert("rotation_euler", frame=frame)
    lamp("AREA", (0, -1, 6), 900, size=2)
    sky((.4, .5, .7, 1), 0.5)


def waves():
    """A sheet that deforms like cloth: a lattice of vertices under a driver that Blender evaluates in each frame."""
    empty(camera=(0, -5, 3), target=(0, 0, 0), lens=40, frames=2)
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=40, y_subdivisions=40, size=4)
    sheet = bpy.context.object
    bpy.ops.object.shade_smooth()
    wave = sheet.modifiers.new("wave", "WAVE")
    wave.height, wave.width, wave.narrowness, wave.speed, wave.time_offset = 0.5, 1.0, 1.5, 0.2, -20
    sheet.data.materials.append(material("cloth", lambda tree: bsdf(
        tree, "Principled", **{"Base Color": (.1, .3, .7, 1), "Roughness": 0.4})))
    lamp("AREA", (2, -1, 4), 500, size=2)
    sky((1, 1, 1, 1), 0.3)


def instances():
    """A collection of two meshes, in nine places, turned and stretched."""
    empty(camera=(0, -9, 6), target=(0, 0, 0), lens=40)
    plane(30, material("ground", lambda tree: bsdf(tree, "Diffuse", Color=(.6, .6, .6, 1))))
    bpy.ops.mesh.primitive_cone_add(radius1=0.4, depth=1, location=(0, 0, 0.5))
    cone = bpy.context.object
    cone.data.materials.append(material("paint", lambda tree: bsdf(tree, "Diffuse", Color=(.8, .1, .1, 1))))
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.3, location=(0, 0, 1.2))
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    ball.data.materials.append(material("metal", lambda tree: bsdf(tree, "Glossy", Color=(.9, .8, .5, 1), Roughness=0.3)))
    group = bpy.data.collections.new("chess piece")
    for each in (cone, ball):
        group.objects.link(each)
        bpy.context.collection.objects.unlink(each)
    for i in range(9):
        piece = bpy.data.objects.new("piece", None)
        piece.instance_type, piece.instance_collection = "COLLECTION", group
        piece.location = (2 * (i % 3 - 1), 2 * (i // 3 - 1), 0)
        piece.rotation_euler.z, piece.scale = i, (1, 1, 0.6 + 0.1 * i)
        bpy.context.scene.collection.objects.link(piece)
    lamp("SUN", (0, 0, 5), 2, turn=(0.6, 0.3, 0), angle=math.radians(12))
    sky((.5, .6, .8, 1), 0.6)


def pictures():
    """Textures, their mapping, colours computed from them, a mix, holes, a normal map, a sky of a picture, a shifted camera."""
    empty(camera=(0, -7, 2.5), target=(0, 0, 1), lens=40)
    bpy.context.scene.camera.data.shift_x, bpy.context.scene.camera.data.shift_y = 0.1, -0.05
    plane(30, material("tiles", tiles))
    for x, paint in ((-2, mixed), (0, holes), (2, bumpy)):
        panel = plane(1.6, material(paint.__name__, paint))
        panel.location, panel.rotation_euler = (x, 0, 1), (math.radians(70), 0, 0.3)
    lamp("AREA", (-2, -4, 5), 500, size=2)
    world = sky((1, 1, 1, 1), 1.0)
    environment = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    environment.image = image("sky", lambda x, y: (0.2 + 1.5 * (np.abs(x - 0.3) < 0.1), 0.4 + 0 * x, 0.2 + 0.8 * y), 64, 32, True)
    mapping = world.node_tree.nodes.new("ShaderNodeMapping")
    mapping.inputs["Rotation"].default_value = (0, 0, 0.7)
    place = world.node_tree.nodes.new("ShaderNodeTexCoord")
    world.node_tree.links.new(place.outputs["Generated"], mapping.inputs["Vector"])
    world.node_tree.links.new(mapping.outputs["Vector"], environment.inputs["Vector"])
    world.node_tree.links.new(environment.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])


def tiles(tree):
    picture = texture(tree, image("tiles", lambda x, y: (x, ((x > .5) ^ (y > .5)) * 0.8 + 0.1, y), 64, 64), scale=(8, 4, 1))
    hue = tree.nodes.new("ShaderNodeHueSaturation")
    hue.inputs["Hue"].default_value, hue.inputs["Saturation"].default_value = 0.6, 0.7
    tree.links.new(picture.outputs["Color"], hue.inputs["Color"])
    shader = bsdf(tree, "Principled", Roughness=0.6)
    tree.links.new(hue.outputs["Color"], shader.inputs["Base Color"])
    return shader


def mixed(tree):
    shader = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(texture(tree, image("share", lambda x, y: (x, x, x), 32, 32, True)).outputs["Color"], shader.inputs[0])
    tree.links.new(bsdf(tree, "Diffuse", Color=(.1, .6, .1, 1)).outputs[0], shader.inputs[1])
    tree.links.new(bsdf(tree, "Glossy", Color=(.9, .9, .9, 1), Roughness=0.2).outputs[0], shader.inputs[2])
    return shader


def holes(tree):
    shader = bsdf(tree, "Principled", **{"Base Color": (.9, .5, .1, 1)})
    dots = image("dots", lambda x, y: (((x * 4) % 1 - .5)**2 + ((y * 4) % 1 - .5)**2 < 0.1,) * 3, 128, 128, True)
    tree.links.new(texture(tree, dots).outputs["Color"], shader.inputs["Alpha"])
    return shader


def bumpy(tree):
    shader = bsdf(tree, "Principled", **{"Base Color": (.6, .6, .7, 1), "Roughness": 0.5})
    normal = tree.nodes.new("ShaderNodeNormalMap")
    relief = image("relief", lambda x, y: (0.5 + 0.35 * np.sin(12 * x), 0.5 + 0 * x, 0.9 + 0 * x), 128, 128, True)
    tree.links.new(texture(tree, relief).outputs["Color"], normal.inputs["Color"])
    tree.links.new(normal.outputs[0], shader.inputs["Normal"])
    return shader


def hair():
    """A ball of particle hair that turns, with the hair in its own space."""
    empty(camera=(0, -4, 1), target=(0, 0, 0), lens=45)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.8)
    ball = bpy.context.object
    ball.rotation_euler = (0.3, 0.2, 0.5)
    ball.data.materials.append(material("skin", lambda tree: bsdf(tree, "Diffuse", Color=(.7, .5, .3, 1))))
    settings = ball.modifiers.new("hair", "PARTICLE_SYSTEM").particle_system.settings
    settings.type, settings.count, settings.hair_length, settings.render_step = "HAIR", 300, 0.5, 2
    settings.root_radius, settings.tip_radius, settings.radius_scale = 1.0, 0.5, 0.04
    lamp("AREA", (2, -3, 4), 300, size=2)
    sky((.6, .7, .9, 1), 0.7)


def moving():
    """A camera with a lens goes by and zooms; text, a tube and metaballs; a lamp that grows brighter, and one that comes later."""
    empty(camera=(-1, -6, 2), target=(0, 0, 0.6), lens=40, frames=2)
    camera = bpy.context.scene.camera
    camera.data.dof.use_dof, camera.data.dof.aperture_fstop = True, 0.4
    camera.data.dof.aperture_blades, camera.data.dof.aperture_rotation, camera.data.dof.aperture_ratio = 3, 0.3, 1.5
    camera.data.dof.focus_object = bpy.data.objects.new("focus", None)
    plane(30, material("ground", lambda tree: bsdf(tree, "Diffuse", Color=(.6, .6, .6, 1))))
    paint = material("paint", lambda tree: bsdf(tree, "Diffuse", Color=(.2, .5, .8, 1)))
    bpy.ops.object.text_add(location=(-1.5, -1, 0.3), rotation=(math.pi / 2, 0, 0))
    bpy.context.object.data.extrude = 0.1
    bpy.ops.curve.primitive_bezier_circle_add(location=(1.5, 2, 0.6))
    bpy.context.object.data.bevel_depth = 0.2
    bpy.ops.object.metaball_add(radius=1, location=(0.6, 0, 0.6))
    for shape in bpy.context.scene.objects:
        if shape.type in {"FONT", "CURVE", "META"}:
            shape.data.materials.append(paint)
    glow = material("glow", lambda tree: bsdf(tree, "Emission"))
    strength = glow.node_tree.nodes["Emission"].inputs["Strength"]
    panels = [plane(1.5, glow), plane(1, glow)]
    panels[0].location, panels[1].location = (-2, 0, 3), (2, 0, 2.5)
    for frame in (1, 2):
        camera.location.x, camera.data.lens = (-1, 0.5)[frame - 1], (40, 55)[frame - 1]
        strength.default_value, panels[1].hide_render = (0, 10)[frame - 1], frame == 1
        for owner, name in ((camera, "location"), (camera.data, "lens"), (strength, "default_value"), (panels[1], "hide_render")):
            owner.keyframe_insert(name, frame=frame)
    sky((.6, .7, .9, 1), 0.5)


def painted():
    """Colours of corners and of vertices, and holes by their alpha; a picture that lies by a second UV map."""
    empty(camera=(0, -2, 9), target=(0, 0, 0), lens=45)
    plane(30, material("ground", lambda tree: bsdf(tree, "Diffuse", Color=(.3, .3, .3, 1))))
    corners = [(1, .1, .1, 1), (.1, 1, .1, 1), (.1, .1, 1, .3), (.9, .9, .2, .6)]
    for kind, domain, x in (("BYTE_COLOR", "CORNER", -2.3), ("FLOAT_COLOR", "POINT", 0)):
        sheet = plane(2, material(domain, vertex_paint))
        sheet.location = (x, 0, 1)
        sheet.data.color_attributes.new("other", kind, domain)
        paint = sheet.data.color_attributes.new("paint", kind, domain)
        for each, colour in zip(paint.data, corners):
            each.color = colour
    wall = plane(2, material("second map", second_map))
    wall.location = (2.3, 0, 1)
    turned = wall.data.uv_layers.new(name="turned")
    for each, place in zip(turned.data, ((1, 0), (1, 2), (-1, 0), (-1, 2))):
        each.uv = place
    lamp("AREA", (0, -2, 5), 300, size=2)
    sky((1, 1, 1, 1), 0.6)


def vertex_paint(tree):
    attribute = tree.nodes.new("ShaderNodeVertexColor")
    attribute.layer_name = "paint"
    hole, shader = tree.nodes.new("ShaderNodeBsdfTransparent"), tree.nodes.new("ShaderNodeMixShader")
    paint = bsdf(tree, "Diffuse")
    tree.links.new(attribute.outputs["Color"], paint.inputs["Color"])
    tree.links.new(attribute.outputs["Alpha"], shader.inputs[0])
    tree.links.new(hole.outputs[0], shader.inputs[1])
    tree.links.new(paint.outputs[0], shader.inputs[2])
    return shader


def second_map(tree):
    picture = texture(tree, image("stripes", lambda x, y: (x, (y > .5) * 0.8, 0.2 + 0 * x), 64, 64))
    coordinates = tree.nodes.new("ShaderNodeUVMap")
    coordinates.uv_map = "turned"
    tree.links.new(coordinates.outputs[0], picture.inputs["Vector"])
    paint = bsdf(tree, "Diffuse")
    tree.links.new(picture.outputs["Color"], paint.inputs["Color"])
    return paint


def wax():
    """Two balls with light inside: by a node of its own, and by Principled under its gloss."""
    empty(camera=(0, -6, 2), target=(0, 0, 0.6), lens=45)
    plane(30, material("ground", lambda tree: bsdf(tree, "Diffuse", Color=(.5, .5, .5, 1))))
    milk = material("milk", milky)
    inside = {"Subsurface Weight": 0.4, "Subsurface Scale": 0.4} if SINCE_4 else {"Subsurface": 0.4, "Subsurface Color": (.8, .3, .2, 1)}
    skin = material("skin", lambda tree: bsdf(tree, "Principled", **{
        "Base Color": (.8, .5, .3, 1), "Subsurface Radius": (1, .4, .2), "Roughness": 0.4}, **inside))
    for x, paint in ((-1.1, milk), (1.1, skin)):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.9, location=(x, 0, 0.9))
        bpy.ops.object.shade_smooth()
        bpy.context.object.data.materials.append(paint)
    lamp("AREA", (2, -2, 4), 400, turn=(0.5, 0.5, 0), size=2)
    sky((.6, .7, .9, 1), 0.5)


def milky(tree):
    node = tree.nodes.new("ShaderNodeSubsurfaceScattering")
    node.inputs["Color"].default_value, node.inputs["Scale"].default_value = (.8, .6, .4, 1), 0.5
    node.inputs["Radius"].default_value = (1, .5, .3)
    return node


def turned():
    """Pictures that are scaled, turned and moved by Mapping: as a point, as a texture, after one another, and mirrored."""
    empty(camera=(0, 0, 9), target=(0, 0, 0), lens=45)
    mappings = (("POINT", (.2, .1, 0), .5, (2, 1, 1)),), (("TEXTURE", (.3, -.1, 0), .7, (.6, .6, 1)),), \
               (("VECTOR", (5, 5, 0), 1.2, (2, .7, 1)), ("POINT", (.3, 0, 0), math.pi / 2, (.8, .8, 1))), \
               (("POINT", (0, .2, 0), -2.4, (-1.5, 1, 1)),)
    for i, chain in enumerate(mappings):
        sheet = plane(2, material(f"sheet {i}", lambda tree: mapped(tree, chain)))
        sheet.location = (2.4 * (i % 2) - 1.2, 2.4 * (i // 2) - 1.2, 0)
    sky((1, 1, 1, 1), 1)


def mapped(tree, chain):
    picture = texture(tree, image("corner", lambda x, y: (x, ((x > .5) & (y > .3)) * .9, y), 64, 64, True))
    output = tree.nodes.new("ShaderNodeTexCoord").outputs["UV"]
    for kind, move, angle, size in chain:
        node = tree.nodes.new("ShaderNodeMapping")
        node.vector_type = kind
        for name, value in (("Location", move), ("Rotation", (0, 0, angle)), ("Scale", size)):
            if name in node.inputs:
                node.inputs[name].default_value = value
        tree.links.new(output, node.inputs["Vector"])
        output = node.outputs["Vector"]
    tree.links.new(output, picture.inputs["Vector"])
    paint = bsdf(tree, "Diffuse")
    tree.links.new(picture.outputs["Color"], paint.inputs["Color"])
    return paint


def layers():
    """What Principled has since Blender 4: a coat, sheen, a tint, light inside and a thin film, on five balls."""
    empty(camera=(0, -8, 2.5), target=(0, 0, 0.6), lens=45)
    plane(30, material("ground", lambda tree: bsdf(tree, "Diffuse", Color=(.5, .5, .5, 1))))
    kinds = ({"Coat Weight": 0.8, "Coat Roughness": 0.1, "Coat Tint": (.9, .6, .3, 1), "Roughness": 0.6},
             {"Sheen Weight": 1, "Sheen Roughness": 0.4, "Sheen Tint": (.6, .8, 1, 1), "Roughness": 0.8},
             {"Specular Tint": (1, .4, .2, 1), "Specular IOR Level": 0.8, "Roughness": 0.3},
             {"Emission Color": (1, .6, .2, 1), "Emission Strength": 0.4},
             {"Thin Film Thickness": 450, "Thin Film IOR": 1.4, "Roughness": 0.2, "Base Color": (.05, .05, .05, 1)})
    for i, inputs in enumerate(kinds):
        paint = material(f"ball {i}", lambda tree: bsdf(tree, "Principled", **{"Base Color": (.5, .2, .1, 1)} | inputs))
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.6, location=(1.35 * (i - 2), 0, 0.6))
        bpy.ops.object.shade_smooth()
        bpy.context.object.data.materials.append(paint)
    lamp("AREA", (2, -2, 4), 400, turn=(0.5, 0.5, 0), size=2)
    sky((.6, .7, .9, 1), 0.5)


def volume(name, kind, surface=None, **inputs):
    """A material whose volume is that node; inputs by name."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    node = tree.nodes.new(f"ShaderNodeVolume{kind}")
    for key, value in inputs.items():
        node.inputs[key].default_value = value
    tree.links.new(node.outputs[0], output.inputs["Volume"])
    if surface:
        tree.links.new(surface(tree).outputs[0], output.inputs["Surface"])
    return made


def smoky():
    """Balls of smoke, of light that glows, and of milk in glass."""
    empty(camera=(0, -7, 2), target=(0, 0, 0.8), lens=45)
    plane(30, material("ground", lambda tree: bsdf(tree, "Diffuse", Color=(.5, .5, .5, 1))))
    paints = (volume("smoke", "Principled", Color=(.8, .6, .4, 1), Density=1.5, Anisotropy=0.4, **{"Absorption Color": (.2, .1, 0, 1)}),
              volume("glow", "Principled", Color=(.2, .3, .5, 1), Density=0.8, **{"Emission Strength": 0.5, "Emission Color": (1, .5, .2, 1)}),
              volume("milk", "Scatter", lambda tree: bsdf(tree, "Glass", IOR=1.3, Roughness=0.0), Color=(.9, .8, .7, 1), Density=2))
    for i, paint in enumerate(paints):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, radius=0.8, location=(1.8 * (i - 1), 0, 0.9))
        bpy.ops.object.shade_smooth()
        bpy.context.object.data.materials.append(paint)
    lamp("AREA", (2, -2, 4), 500, turn=(0.5, 0.5, 0), size=2)
    sky((.6, .7, .9, 1), 0.4)


def foggy():
    """A world full of fog, and a ball of smoke in it."""
    empty(camera=(0, -6, 1.5), target=(0, 0, 0.8), lens=45)
    plane(30, material("ground", lambda tree: bsdf(tree, "Diffuse", Color=(.6, .5, .4, 1))))
    lamp("AREA", (0, 0, 5), 400, size=1)
    sky((0, 0, 0, 1), 1)
    tree = bpy.context.scene.world.node_tree
    fog = tree.nodes.new("ShaderNodeVolumeScatter")
    fog.inputs["Color"].default_value, fog.inputs["Density"].default_value = (.8, .9, 1, 1), 0.08
    tree.links.new(fog.outputs[0], tree.nodes["World Output"].inputs["Volume"])
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, radius=0.7, location=(-1.2, 0, 0.9))
    bpy.context.object.data.materials.append(volume("smoke", "Scatter", Color=(.9, .5, .3, 1), Density=1.5))


def cloud():
    """A file of a cloud, turned, over a floor."""
    empty(camera=(0, -6, 1.5), target=(0, 0, 0.8), lens=45)
    plane(30, material("ground", lambda tree: bsdf(tree, "Diffuse", Color=(.6, .5, .4, 1))))
    lamp("AREA", (2, -2, 4), 500, turn=(0.5, 0.5, 0), size=2)
    sky((.6, .7, .9, 1), 0.4)
    bpy.ops.object.volume_import(filepath=cloud_file(), align="WORLD", location=(0, 0, 0))
    block = bpy.context.object
    block.data.materials.append(volume("cloud", "Principled", Color=(.8, .8, .9, 1), Density=1.0))
    block.rotation_euler = (0.3, 0.2, 0.5)
    place(block, 1.6, (0, 0, 1.1))


def cloud_file():
    """The block that dspm's own tests read, unpacked."""
    packed = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../media/block.vdb.gz")
    path = os.path.join(bpy.app.tempdir, "block.vdb")
    with gzip.open(packed) as source, open(path, "wb") as file:
        file.write(source.read())
    return path


def place(object, size, center):
    """Scales the object to that size, and moves its box's middle there."""
    bpy.context.view_layer.update()
    corners = [Vector(corner) for corner in object.bound_box]
    middle = sum(corners, Vector()) / 8
    object.scale = (size / max(object.dimensions),) * 3
    turned_middle = object.rotation_euler.to_matrix() @ (middle * object.scale.x)
    object.location = Vector(center) - turned_middle


ALL = (startup, lamps, glass_monkey, waves, instances, pictures, hair, moving, painted, wax, turned, smoky, foggy, cloud, *((layers,) if SINCE_4 else ()))
