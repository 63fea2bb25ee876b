"""Runs in Blender: small scenes of what went wrong once, exported, and what dspm makes of them.
usage: blender -b --factory-startup --python exported.py -- dspm folder"""
import os
import shutil
import subprocess
import sys

import addon_utils
import bpy
import numpy as np

here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [here, os.path.join(here, "../../tools/blender")]
import scenes
from dspm_blender.export_request import ExportRequest
from dspm_blender.exr import Exr

program, folder = sys.argv[sys.argv.index("--") + 1:][:2]
failures = []


def expect(holds, text):
    if not holds:
        failures.append(text)
        print("FAILED:", text)


def begin(frames=1, camera=(0, -6, 2)):
    scenes.empty(camera=camera, target=(0, 0, 0), lens=40, frames=frames)
    addon_utils.enable("dspm_blender")
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 16, 12, 100
    return scene


def exported(scene, name):
    """(the file, the notes)"""
    request = ExportRequest(os.path.join(folder, name + ".dsc"), list(range(1, scene.frame_end + 1)), True)
    with request.in_scene(scene):
        try:
            bpy.ops.render.render()
        except RuntimeError:
            pass  # it is in the request as well
    expect(request.error is None, f"{name} is exported, without: {request.error}")
    return request.path, request.notes.texts


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def rendered(path, iterations=1):
    """Its frames as floats, rows from below."""
    images = path[:-4] + ".####.exr"
    run = subprocess.run([program, path, "-o", images, "--integrator", "path", "--iterations", str(iterations), "--float",
                          "--compression", "none", "--quiet"], capture_output=True, text=True)
    expect(run.returncode == 0, f"dspm renders {os.path.basename(path)}: {run.stderr}")
    names = sorted(each for each in os.listdir(folder) if each.startswith(os.path.basename(path)[:-4] + ".") and each.endswith("exr"))
    return [np.dstack([Exr(os.path.join(folder, each)).channels[letter] for letter in "RGB"]) for each in names]


def keyed_scale(object, *scales):
    for frame, scale in enumerate(scales, 1):
        object.scale = scale
        object.keyframe_insert("scale", frame=frame)


def expect_what_is_shrunk_to_nothing():
    """Scales of 0, of one axis or of all, of a mesh, of lamps, of what they hang on; and one that changes its sign."""
    scene = begin(frames=3)
    scenes.sky((1, 1, 1, 1), 1)
    for i, scales in enumerate((((1, 1, 1), (0, 0, 0), (-1, 1, 1)), ((1, 1, 1), (1, 1, 0), (1, 0, 0)),
                                ((1, 1, 1), (-1, 1, 1), (1, 1, 1)), ((1e-12,) * 3, (1e-15,) * 3, (1e-30,) * 3))):
        bpy.ops.mesh.primitive_cube_add(size=1, location=(2 * i - 3, 0, 0))
        keyed_scale(bpy.context.object, *scales)
    area = scenes.lamp("AREA", (0, 0, 4), 100, shape="ELLIPSE", size=1, size_y=2)
    keyed_scale(area, (1, 1, 1), (1, 0, 1), (0, 0, 0))
    scenes.lamp("AREA", (0, 0, 4), 100, size=0).name = "never there"
    anchor = bpy.data.objects.new("anchor", None)
    scene.collection.objects.link(anchor)
    keyed_scale(anchor, (0, 0, 0), (1, 1, 1), (1, 1, 1))
    for kind, settings in (("POINT", {"shadow_soft_size": 0.2}), ("SPOT", {"shadow_soft_size": 0}), ("SUN", {}), ("AREA", {})):
        scenes.lamp(kind, (1, 0, 3), 10, **settings).parent = anchor
    path, _ = exported(scene, "shrunk")
    images = rendered(path)
    expect(len(images) == 3 and all(np.isfinite(each).all() for each in images), "what is shrunk to nothing is rendered")
    text = text_of(path)
    expect('DynamicBegin "area" "integer frames" [1 1]' in text and "never there" not in text, "a lamp of no size is not there")


def expect_view_layers():
    """Each has its file, of what it shows, as it shows it."""
    scene = begin()
    scenes.sky((1, 1, 1, 1), 1)
    paint = scenes.material("grey", lambda tree: scenes.bsdf(tree, "Diffuse", Color=(.5, .5, .5, 1)))
    for name in ("near", "far"):
        collection = bpy.data.collections.new(name)
        scene.collection.children.link(collection)
        thing = scenes.plane(1, paint)
        thing.name = f"{name} thing"
        collection.objects.link(thing)
        scene.collection.objects.unlink(thing)
    second = scene.view_layers.new("Back/ground")
    scene.view_layers[0].layer_collection.children["far"].exclude = True
    second.layer_collection.children["near"].exclude = True
    second.layer_collection.children["far"].holdout = True
    second.material_override = scenes.material("clay", lambda tree: scenes.bsdf(tree, "Diffuse", Color=(.9, .1, .1, 1)))
    path, notes = exported(scene, "layers")
    other = os.path.join(folder, "layers.Back_ground.dsc")
    expect('view layer "Back/ground" is in layers.Back_ground.dsc' in notes, f"a note says where the second layer is: {notes}")
    expect("near thing" in text_of(path) and "far thing" not in text_of(path), "the first view layer has its objects")
    expect("far thing" in text_of(other) and "near thing" not in text_of(other), "so has the second one")
    expect('NamedMaterial "grey"' in text_of(path) and 'NamedMaterial "clay"' in text_of(other), "and its material")
    expect(any("holdout" in note for note in notes), f"a holdout is named: {notes}")
    second.use = False
    expect(exported(scene, "one layer")[1] == [], "a view layer that is not rendered is not exported")


def expect_fog():
    """A box of fog takes what Beer's law says of the sky; the world's fog is around it, and adds to it."""
    scene = begin(camera=(0, 0, 5))
    scenes.sky((.5, .25, 1, 1), 1)
    bpy.ops.mesh.primitive_cube_add(size=2)
    bpy.context.object.data.materials.append(scenes.volume("fog", "Absorption", Color=(.5, .8, 1, 1), Density=0.6))
    path, notes = exported(scene, "fog")
    middle = rendered(path, 200)[0]
    rows, columns = (length // 2 for length in middle.shape[:2])
    left = np.exp(-2 * 0.6 * (1 - np.array((.5, .8, 1))))
    expect(np.allclose(middle[rows - 2:rows + 2, columns - 2:columns + 2].mean(axis=(0, 1)), (.5, .25, 1) * left, rtol=0.03),
           "a box of fog takes a part of the sky's light")
    expect(notes == [], f"nothing is left out: {notes}")
    bpy.context.object.scale = (8, 8, 8)  # around the camera, and a lamp
    scenes.lamp("POINT", (0, 3, 0), 100)
    scenes.lamp("SUN", (0, -3, 0), 1)  # far away all the same
    path, notes = exported(scene, "in fog")
    text = text_of(path)
    expect(text.index('MediumInterface "inside fog"\n') < text.index("Camera") and text.count('MediumInterface "inside fog"\n') == 2,
           "the camera and a lamp in a box of fog are in it")
    left = np.exp(-(5 + 8) * 0.6 * (1 - np.array((.5, .8, 1))))
    expect(np.allclose(rendered(path, 200)[0][rows - 2:rows + 2, columns - 2:columns + 2].mean(axis=(0, 1)), (.5, .25, 1) * left,
                       rtol=0.1), "and see the sky through it")
    bpy.context.object.scale = (1, 1, 1)
    world = scene.world.node_tree
    world.links.new(world.nodes.new("ShaderNodeVolumeScatter").outputs[0], world.nodes["World Output"].inputs["Volume"])
    path, notes = exported(scene, "world fog")
    text = text_of(path)
    expect('MediumInterface "world"\n' in text and 'MediumInterface "inside fog" "world"' in text, "fog of the world is around all")
    expect(notes == [], f"nothing is left out: {notes}")


def expect_volume_files():
    """A file for each frame is one here, and one that is hidden in between has a medium for each time that it is there."""
    scene = begin(frames=3)
    scenes.sky((1, 1, 1, 1), 1)
    first = scenes.cloud_file()
    for frame in (1, 2, 3):
        shutil.copyfile(first, first.replace("block.vdb", f"sequence_{frame:04}.vdb"))
    bpy.ops.object.volume_import(filepath=first.replace("block.vdb", "sequence_0001.vdb"), align="WORLD", location=(0, 0, 0))
    data = bpy.context.object.data
    data.is_sequence, data.frame_start, data.frame_duration = True, 1, 3
    path, notes = exported(scene, "sequence")
    text = text_of(path)
    expect("%04d.vdb" in text and notes == [], f"a sequence has a file for each frame: {notes}")
    expect(all(os.path.exists(f"{path[:-4]}.volumes/sequence_0001.0.{frame:04}.vdb") for frame in (1, 2, 3)), "which are there")
    expect(len(rendered(path)) == 3, "and are rendered")
    for frame, hidden in ((1, False), (2, True), (3, False)):
        bpy.context.object.hide_render = hidden
        bpy.context.object.keyframe_insert("hide_render", frame=frame)
    path, _ = exported(scene, "hidden")
    expect(text_of(path).count("MakeNamedMedium") == 2, "what is hidden in between has two media")
    expect(len(rendered(path)) == 3, "and is rendered")


# ACEScg to linear Rec. 709 by Bradford's adaptation (ACES TB-2014-004, colour-science.org).
FROM_ACESCG = np.array([[1.70505, -0.62179, -0.08326], [-0.13026, 1.14080, -0.01055], [-0.02400, -0.12897, 1.15297]])


def picture_file(kind, depth, colour):
    """A file of one colour, whose numbers are those given."""
    image = bpy.data.images.new("numbers", 4, 4, float_buffer=True, is_data=True)
    image.pixels.foreach_set(np.tile(np.array([*colour, 1], "f"), 16))
    settings = bpy.context.scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = kind, "RGB", depth
    bpy.context.scene.view_settings.view_transform = "Raw"
    path = os.path.join(folder, f"numbers{len(os.listdir(folder))}.{'exr' if kind == 'OPEN_EXR' else 'png'}")
    image.save_render(path)
    return path


def known(image, *names):
    """The first of a colour space's names that this Blender has."""
    return next(each for each in names if each in image.colorspace_settings.bl_rna.properties["name"].enum_items)


def expect_colour_spaces():
    """Pictures of numbers are what their colour space says, as a surface and as the sky."""
    numbers = np.array([.5, .25, .1])
    linear = ((numbers + 0.055) / 1.055) ** 2.4
    for kind, depth, space, seen in (
            ("OPEN_EXR", "32", "Linear", numbers), ("OPEN_EXR", "32", "sRGB", linear), ("OPEN_EXR", "32", "ACEScg", FROM_ACESCG @ numbers),
            ("PNG", "16", "sRGB", linear), ("PNG", "16", "Non-Color", numbers), ("PNG", "8", "sRGB", linear),
            ("PNG", "8", "ACEScg", FROM_ACESCG @ numbers)):
        scene = begin(camera=(0, 0, 2))
        image = bpy.data.images.load(picture_file(kind, depth, numbers))
        image.colorspace_settings.name = known(image, space, f"{space} Rec.709", f"Linear {space}")

        def glow(tree):
            emission = scenes.bsdf(tree, "Emission")
            tree.links.new(scenes.texture(tree, image).outputs["Color"], emission.inputs["Color"])
            return emission
        scenes.plane(1, scenes.material("glow", glow))
        world = scenes.sky((1, 1, 1, 1), 1.0).node_tree
        sky = world.nodes.new("ShaderNodeTexEnvironment")
        sky.image = image
        world.links.new(sky.outputs["Color"], world.nodes["Background"].inputs["Color"])
        name = f"{kind} {depth} {space}"
        picture = rendered(exported(scene, name)[0])[0]
        for where, found in (("surface", picture[6, 8]), ("sky", picture[0, 0])):
            expect(np.allclose(found, seen, rtol=0.02, atol=0.003), f"{name} as a {where} is {seen}, not {found}")


def spotted(tree):
    """Noise through a ramp, in generated coordinates, brighter above."""
    noise, ramp = tree.nodes.new("ShaderNodeTexNoise"), tree.nodes.new("ShaderNodeValToRGB")
    noise.inputs["Scale"].default_value = 4
    ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[1].position = 0.45, 0.55
    ramp.color_ramp.elements[0].color, ramp.color_ramp.elements[1].color = (.8, .1, .05, 1), (.05, .2, .7, 1)
    emission = scenes.bsdf(tree, "Emission")
    tree.links.new(noise.outputs["Fac"], ramp.inputs["Fac"])
    tree.links.new(ramp.outputs["Color"], emission.inputs["Color"])
    tree.links.new(strength_of_height(tree), emission.inputs["Strength"])
    return emission


def strength_of_height(tree):
    """A half and once the height in generated coordinates, which two of the nodes hand on as vectors."""
    place, away, parts = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("TexCoord", "VectorMath", "SeparateXYZ"))
    away.inputs[1].default_value = (0, 0, .5)
    tree.links.new(place.outputs["Generated"], away.inputs[0])
    tree.links.new(away.outputs[0], parts.inputs[0])
    return parts.outputs["Z"]


def expect_baked_textures(samples=16):
    """Noise looks as Cycles has it if it is baked, and is a mean with a note if it is not. The scene stays as it was."""
    scene = begin(camera=(0, -4, 1))
    addon_utils.enable("cycles")
    scene.render.resolution_x, scene.render.resolution_y, scene.dspm.bake_size = 96, 72, 512
    paint = scenes.material("spotted", spotted)
    for x, add in ((-0.8, bpy.ops.mesh.primitive_monkey_add), (0.9, bpy.ops.mesh.primitive_cube_add)):
        add(location=(x, 0, 0))
        bpy.context.object.scale = (.7, .7, .7)
        bpy.context.object.data.materials.append(paint)
    maps = [[layer.name for layer in each.data.uv_layers] for each in scene.objects if each.type == "MESH"]
    path = os.path.join(folder, "baked.dsc")
    expect(bpy.ops.export_scene.dspm(filepath=path, bake=True) == {"FINISHED"}, "the scene with noise is exported")
    image = rendered(path, samples)[0]
    expect(maps == [[layer.name for layer in each.data.uv_layers] for each in scene.objects if each.type == "MESH"] and
           set(bpy.data.images.keys()) <= {"Render Result"} and len(paint.node_tree.nodes) == 7, "baking for an export leaves nothing behind")
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", samples, False
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR", "32", "NONE"
    scene.render.filepath = os.path.join(folder, "cycles.exr")
    bpy.ops.render.render(write_still=True)
    theirs = np.dstack([Exr(scene.render.filepath).channels[letter] for letter in "RGB"])
    away = np.abs(image - theirs).mean() / theirs.mean()
    expect(away < 0.08, f"baked noise is that of Cycles, not {away:.1%} away")
    _, notes = exported(scene, "not baked")
    expect(any("Noise Texture has not been baked" in note for note in notes), f"what is not baked is named: {notes}")
    bpy.ops.dspm.bake_textures()
    expect("Noise" not in " ".join(exported(scene, "kept")[1]), "what was baked in the panel is exported")
    expect('"integer uvset" 2' in text_of(os.path.join(folder, "kept.dsc")), "it lies by its own map")
    bpy.ops.dspm.forget_textures()
    expect(set(bpy.data.images.keys()) <= {"Render Result"}, "and can be removed")


def expect_principled():
    """Each input of Principled is a parameter, or named. Those that Blender 3 and 4 call otherwise are told by dspm's words."""
    new = scenes.SINCE_4
    scene = begin()
    scenes.sky((1, 1, 1, 1), 1)
    tint = {"Specular Tint": (1, .5, .25, 1) if new else 1.0}
    for name, inputs, expected in (
            ("coat", {"Coat Weight": 0.5, "Coat Tint": (1, .5, 1, 1)} if new else {"Clearcoat": 1.0},
             ['"float coat" 0.5', '"rgb basecolor" [0.8 0.6 0.8]', '"rgb specularcolor" [1 0.75 1]'] if new else ['"float coat" 0.25']),
            ("sheen", {"Sheen Weight": 0.5, "Sheen Roughness": 0.25, "Sheen Tint": (1, .5, 0, 1)} if new else {"Sheen": 0.5, "Sheen Tint": 0.0},
             ['"rgb sheen" [0.5 0.25 0]', '"float sheenroughness" 0.25'] if new else ['"rgb sheen" [0.5 0.5 0.5]']),
            ("tint", tint | {"Base Color": (.8, .8, .8, 1)}, ['"rgb specularcolor" [1 0.5 0.25]'] if new else []),
            ("glow", {"Emission Color" if new else "Emission": (.5, .25, 0, 1), "Emission Strength": 3},
             ['"rgb emission" [1 0.5 0]', '"float emissionstrength" 1.5']),
            *((("film", {"Thin Film Thickness": 300, "Thin Film IOR": 1.4},
                ['"float iridescence" 1', '"float iridescencethickness" 300', '"float iridescenceeta" 1.4']),) if new else ())):
        thing = scenes.plane(1, scenes.material(name, lambda tree: scenes.bsdf(tree, "Principled", **inputs)))
        path, notes = exported(scene, f"principled {name}")
        line = next(each for each in text_of(path).splitlines() if each.startswith(f'MakeNamedMaterial "{name}"'))
        for text in expected:
            expect(near(line, text), f"{name}: {text} is in {line}")
        expect(all("coat" in note for note in notes) if name == "coat" else notes == [], f"{name} is said to lack nothing: {notes}")
        expect(np.isfinite(rendered(path)[0]).all(), f"{name} is rendered")
        bpy.data.objects.remove(thing)


def near(line, text):
    """The parameter is in the line, whose numbers are singles."""
    name, wanted = text.rsplit('"', 1)
    if name not in line:
        return False
    numbers = lambda words: [float(word) for word in words.strip(" []").split()]
    return np.allclose(numbers(line.split(name + '"', 1)[1].split('"')[0]), numbers(wanted), atol=1e-5)


def expect_what_is_new():
    """Light linking is named, metal is metal, and the scene says how Blender shows it."""
    if not scenes.SINCE_4:
        return
    scene = begin()
    scene.view_settings.view_transform, scene.view_settings.look, scene.view_settings.exposure = "AgX", "AgX - Punchy", 0.5
    scenes.lamp("POINT", (0, 0, 4), 100).light_linking.receiver_collection = bpy.data.collections.new("only these")
    kinds = (("F82", {}, '"string type" "principled"'), ("PHYSICAL_CONDUCTOR", {}, '"string type" "conductor"'),
             ("PHYSICAL_CONDUCTOR", {"Anisotropy": 0.5}, '"float anisotropy" 0.5'))

    def metal(tree, kind, inputs):
        node = scenes.bsdf(tree, "Metallic", **inputs)
        node.fresnel_type = kind
        return node
    for i, (kind, inputs, _) in enumerate(kinds if hasattr(bpy.types, "ShaderNodeBsdfMetallic") else ()):
        scenes.plane(1, scenes.material(f"metal {i}", lambda tree: metal(tree, kind, inputs)))
    path, notes = exported(scene, "new")
    expect(any("light linking is left out" in note for note in notes), f"light linking is named: {notes}")
    text = text_of(path)
    expect("# Blender's view: AgX, AgX - Punchy; dspm's: --view agx-punchy --exposure 0.5" in text, "the view is named")
    for i, (kind, inputs, wanted) in enumerate(kinds):
        line = next((each for each in text.splitlines() if each.startswith(f'MakeNamedMaterial "metal {i}"')), "")
        expect(wanted in line, f"metal by {kind} {inputs} has {wanted}: {line}")
    expect(np.isfinite(rendered(path)[0]).all(), "metal is rendered")


def main():
    for test in (expect_principled, expect_what_is_new, expect_what_is_shrunk_to_nothing, expect_view_layers, expect_fog, expect_volume_files,
                 expect_colour_spaces, expect_baked_textures):
        test()
    print(f"{len(failures)} failures")
    sys.exit(1 if failures else 0)


main()
