"""Runs in Blender: what comes back into Blender is, to the bit, what dspm renders of the exported scene.
usage: blender -b --factory-startup --python through_blender.py -- dspm folder"""
import os
import subprocess
import sys
from types import SimpleNamespace

import addon_utils
import bpy
import numpy as np

here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [here, os.path.join(here, "../../tools/blender")]
import scenes
from dspm_blender.engine import DspmEngine
from dspm_blender.export_request import ExportRequest
from dspm_blender.exr import Exr
from dspm_blender.fields import Field
from dspm_blender.passes import lacking
from dspm_blender.principled_node import gloss
from dspm_blender.process import find_program

program, folder = sys.argv[sys.argv.index("--") + 1:][:2]
FRAMES = 3


def prepare():
    """A turning monkey with two light groups, and all passes. It is flat, because Blender adds smooth normals up in threads, with
    other last bits each time."""
    scenes.glass_monkey()
    monkey = bpy.data.objects["Suzanne"]
    monkey.modifiers.clear()
    monkey.data.polygons.foreach_set("use_smooth", [False] * len(monkey.data.polygons))
    addon_utils.enable("dspm_blender", default_set=True)
    bpy.context.preferences.addons["dspm_blender"].preferences.program = program
    scene, layer = bpy.context.scene, bpy.context.view_layer
    scene.frame_end = FRAMES
    scene.dspm.iterations, scene.dspm.photons = 2, 2000
    scene.render.engine = "DSPM"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 48, 36, 100
    format = scene.render.image_settings
    format.file_format, format.color_depth, format.exr_codec = "OPEN_EXR_MULTILAYER", "32", "NONE"
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_position = layer.use_pass_uv = True
    layer.use_pass_cryptomatte_object = layer.dspm.albedo = layer.dspm.variance = True
    layer.use_pass_mist = layer.use_pass_diffuse_color = True
    layer.aovs.add().name = "own"
    layer.lightgroups.add(name="big lamp")
    bpy.data.objects["area"].lightgroup = "big lamp"
    return scene


# Blender's channel, and dspm's.
CHANNELS = {"Combined.R": "R", "Combined.G": "G", "Combined.B": "B", "Depth.Z": "Z", "Normal.X": "N.X", "Normal.Z": "N.Z",
            "Position.Y": "P.Y", "UV.U": "u", "Albedo.G": "Albedo.G", "CryptoObject00.R": "CryptoObject00.r",
            "CryptoObject01.G": "CryptoObject01.g", "Variance.B": "variance.B", "Combined_big lamp.R": "light_big_lamp.R"}
failures = []


def expect(holds, text):
    if not holds:
        failures.append(text)
        print("FAILED:", text)


def compare(blenders, dspms, whose):
    theirs, ours = Exr(blenders), Exr(dspms)
    for name, own in CHANNELS.items():
        found = theirs.channels.get(f"ViewLayer.{name}")
        expect(found is not None, f"{whose} has no {name}, but {sorted(theirs.channels)}")
        if found is not None:
            expect(found.tobytes() == ours.channels[own].tobytes(), f"{whose}: {name} is not what dspm gives")
    mattes = {name.split("/")[-1]: text for name, text in theirs.texts.items() if name.startswith("cryptomatte/")}
    expect(mattes.get("name") == "ViewLayer.CryptoObject" and "Suzanne" in mattes["manifest"],
           f"{whose} does not name mattes but has {sorted(theirs.texts)}")
    expect(ours.channels["Z"].max() > 0 and ours.channels["Albedo.G"].max() > 0, f"{whose} is empty")


def rendered_alone(scene, name, animation):
    path = os.path.join(folder, name + ".dsc")
    bpy.ops.export_scene.dspm(filepath=path, animation=animation)
    subprocess.run([program, path, "-o", path[:-4] + (".####.exr" if animation else ".exr"), "--float", "--compression", "none",
                    "--quiet", "--aov", "N,P,Z,albedo,cryptoobject,lights,uv,variance", "--denoise"], check=True)
    return path[:-4]


def expect_lacking(scene):
    """Passes that dspm does not have are named."""
    said = set(lacking(bpy.context.view_layer))
    expect(said == {"Mist", "Diffuse Color", "own"}, f"it says which passes are left out, not {said}")


def rendered_in_blender(scene, name):
    """The files of an animation in Blender."""
    scene.render.filepath = os.path.join(folder, name + ".")
    bpy.ops.render.render(animation=True)
    return [os.path.join(folder, f"{name}.{frame:04}.exr") for frame in range(1, FRAMES + 1)]


def expect_denoised(scene, alone):
    """Combined is the image with less noise, and the other one stays."""
    scene.dspm.denoise = True
    for frame, path in enumerate(rendered_in_blender(scene, "denoised"), 1):
        theirs, plain, better = Exr(path), Exr(f"{alone}.{frame:04}.exr"), Exr(f"{alone}.denoised.{frame:04}.exr")
        expect(np.array_equal(theirs.channels["ViewLayer.Combined.R"], better.channels["R"]), f"frame {frame} is denoised")
        expect(np.array_equal(theirs.channels["ViewLayer.Noisy Image.R"], plain.channels["R"]), f"its noisy image is there")
        expect(not np.array_equal(plain.channels["R"], better.channels["R"]), "which makes a difference")
    scene.dspm.denoise = False


def expect_frames_as_they_are_done(scene):
    """sppm renders frame by frame: Blender has the first one before the last one is begun."""
    scene.dspm.integrator, running = "sppm", []

    def look(*_):
        running.append(DspmEngine.animations["ViewLayer"].run.process.poll() is None)
    bpy.app.handlers.render_write.append(look)
    rendered_in_blender(scene, "one by one")
    bpy.app.handlers.render_write.remove(look)
    scene.dspm.integrator = "dsppm"
    expect(len(running) == FRAMES and running[0], f"the first of {len(running)} frames is there while others are rendered: {running}")


def expect_resumed(scene, alone):
    """A render that breaks off leaves its checkpoint beside the .blend file, from which the next one gets the same bits."""
    blend = os.path.join(folder, "{a} #1", "kept.blend")
    os.mkdir(os.path.dirname(blend))
    bpy.ops.wm.save_as_mainfile(filepath=blend)
    kept, program_that_breaks = blend[:-6] + ".dspm/ViewLayer.0001-0003", os.path.join(folder, "breaking")
    with open(program_that_breaks, "w") as script:
        script.write(f'#!/bin/sh\n"{program}" "$@" --checkpoint-every 1\nexit 1\n')
    os.chmod(program_that_breaks, 0o755)
    preferences = bpy.context.preferences.addons["dspm_blender"].preferences
    preferences.program, scene.dspm.iterations = program_that_breaks, 1
    try:
        rendered_in_blender(scene, "broken")
    except RuntimeError:
        pass
    preferences.program, scene.dspm.iterations, scene.dspm.resume = program, 2, True
    expect(os.path.exists(os.path.join(kept, "checkpoint")), f"a render that breaks off leaves a checkpoint in {kept}")
    begun = os.stat(os.path.join(kept, "scene.dsc")).st_mtime_ns
    for frame, path in enumerate(rendered_in_blender(scene, "resumed"), 1):
        expect(np.array_equal(Exr(path).channels["ViewLayer.Combined.R"], Exr(f"{alone}.{frame:04}.exr").channels["R"]),
               f"frame {frame} is what it is without the break")
    expect(os.stat(os.path.join(kept, "scene.dsc")).st_mtime_ns == begun, "what is resumed is not exported again")
    scene.dspm.resume = False
    rendered_in_blender(scene, "again")
    expect(not os.path.exists(blend[:-6] + ".dspm"), "nothing is kept of a render that is complete")


def expect_guide(scene):
    """It is learned once."""
    scene.dspm.guide = os.path.join(folder, "photons.guide")
    bpy.ops.render.render()
    learned = os.stat(scene.dspm.guide).st_mtime_ns
    bpy.ops.render.render()
    expect(os.stat(scene.dspm.guide).st_mtime_ns == learned, "a guide that is there is not learned again")
    scene.dspm.guide = ""


def expect_notes(scene):
    """What is not known is said by its name."""
    def odd(tree):
        shader, lost = scenes.bsdf(tree, "Toon"), tree.nodes.new("ShaderNodeTexImage")
        lost.image = bpy.data.images.new("lost", 4, 4)
        lost.image.source, lost.image.filepath = "FILE", "//nowhere/lost.png"
        tree.links.new(lost.outputs["Color"], scenes.bsdf(tree, "Diffuse").inputs["Color"])
        mix = tree.nodes.new("ShaderNodeMixShader")
        for i, node in enumerate((shader, tree.nodes["Diffuse BSDF"]), 1):
            tree.links.new(node.outputs[0], mix.inputs[i])
        return mix
    bpy.data.objects["Suzanne"].data.materials[0] = scenes.material("odd", odd)
    request = ExportRequest(os.path.join(folder, "odd.dsc"), [1], False)
    with request.in_scene(scene):
        bpy.ops.render.render()
    for text in ('material "odd", node "Toon BSDF": Toon BSDF is not known', "//nowhere/lost.png cannot be read"):
        expect(any(text in note for note in request.notes.texts), f"a note says {text}, not only {request.notes.texts} {request.error}")


def expect_gloss():
    """The share that is mirrored straight on, specular ((eta - 1) / (eta + 1))^2, is Blender's, with specular of at most 1."""
    of_ior = (0.45 / 2.45) ** 2
    for new, level, glass, mirrored in ((False, 0.5, 0, 0.04), (False, 1, 0, 0.08), (False, 0.2, 0, 0.016), (False, 0.5, 1, of_ior),
                                        (False, 0.2, 0.5, 0.016), (False, 0.5, 0.5, of_ior), (True, 0.5, 0, of_ior),
                                        (True, 1, 0, 2 * of_ior), (True, 0.1, 0.5, 0.2 * of_ior), (True, 1, 1, of_ior)):
        notes = []
        tree = SimpleNamespace(animated=False, note=lambda source, text: notes.append(text))
        eta, specular = gloss(tree, None, Field.of(level), Field.of(glass), 1.45, new)
        found = specular.number() * ((eta - 1) / (eta + 1)) ** 2
        whose = f"gloss {level} of {'new' if new else 'old'} Principled with transmission {glass}"
        expect(abs(found - mirrored) < 1e-5 and specular.number() <= 1, f"{whose} mirrors {mirrored}, not {found}")
        expect(bool(notes) == (not new and (level, glass) == (0.5, 0.5)), f"{whose} says what is lost: {notes}")
        expect(glass == 0 or eta == 1.45, f"{whose} refracts by its IOR, not {eta}")


def expect_glass():
    """Principled with only Transmission is what dspm takes."""
    glassy = "Transmission Weight" if scenes.SINCE_4 else "Transmission"
    bpy.data.objects["Suzanne"].data.materials[0] = scenes.material(
        "clear", lambda tree: scenes.bsdf(tree, "Principled", **{glassy: 1, "IOR": 1.45}))
    path = os.path.join(folder, "clear.dsc")
    bpy.ops.export_scene.dspm(filepath=path, animation=False)
    run = subprocess.run([program, path, "--check"], capture_output=True, text=True)
    expect(run.returncode == 0, f"dspm takes clear glass: {run.stderr}")


def expect_shadow_catcher(scene):
    """Of two objects with one mesh only the catcher is one. It darkens what is behind the picture."""
    ground = next(each for each in scene.objects if each.data and each.type == "MESH" and each.data.materials[0].name == "ground")
    ground.is_shadow_catcher = True
    twin = ground.copy()
    twin.is_shadow_catcher, twin.scale, twin.location = False, (0.01, 0.01, 0.01), (0, 0, -1)
    scene.collection.objects.link(twin)
    path = os.path.join(folder, "catcher.dsc")
    bpy.ops.export_scene.dspm(filepath=path, animation=False)
    with open(path) as file:
        catchers = [line for line in file if '"bool shadowcatcher" true' in line]
    expect(len(catchers) == 1 and f'"string name" "{ground.name}"' in catchers[0], f"one shape is a catcher, not: {catchers}")
    subprocess.run([program, path, "-o", path[:-4] + ".exr", "--float", "--compression", "none", "--quiet"], check=True,
                   capture_output=True)
    alpha = Exr(path[:-4] + ".exr").channels["A"]
    expect(alpha.min() < 0.9 < alpha.max(), f"a catcher is see-through where it has no shadow, not {alpha.min()} to {alpha.max()}")


def expect_refusal():
    """What dspm refuses is an error of Blender's operator, in dspm's words."""
    refusing, preferences = os.path.join(folder, "refusing"), bpy.context.preferences.addons["dspm_blender"].preferences
    with open(refusing, "w") as script:
        script.write(f'#!/bin/sh\nexec "{program}" "$@" --integrator nonsense\n')
    os.chmod(refusing, 0o755)
    preferences.program = refusing
    try:
        bpy.ops.render.render()
        expect(False, "a scene that dspm refuses is an error")
    except RuntimeError as error:
        expect("--integrator nonsense: available:" in str(error), f"the error is dspm's, not: {error}")
    preferences.program = program


def main():
    scene = prepare()
    alone = rendered_alone(scene, "all", True)
    scene.render.filepath = os.path.join(folder, "blender.")
    bpy.ops.render.render(animation=True)
    for frame in range(1, FRAMES + 1):
        compare(os.path.join(folder, f"blender.{frame:04}.exr"), f"{alone}.{frame:04}.exr", f"frame {frame}")
    expect_lacking(scene)
    expect_denoised(scene, alone)
    expect_frames_as_they_are_done(scene)
    expect_resumed(scene, alone)
    expect_guide(scene)
    scene.frame_set(2)
    scene.render.use_border = scene.render.use_crop_to_border = True
    scene.render.border_min_x, scene.render.border_max_x, scene.render.border_min_y, scene.render.border_max_y = .25, .75, .1, .5
    alone = rendered_alone(scene, "part", False)
    scene.render.filepath = os.path.join(folder, "part.blender.exr")
    bpy.ops.render.render(write_still=True)
    compare(scene.render.filepath, alone + ".exr", "a border")
    expect_notes(scene)
    expect_gloss()
    expect_glass()
    expect_shadow_catcher(scene)
    expect_refusal()
    try:
        find_program("/nowhere/dspm")
        expect(False, "a missing program is an error")
    except RuntimeError as error:
        expect("not found" in str(error), f"the error says what is missing, not: {error}")
    print(f"{len(CHANNELS)} channels of {FRAMES} frames and of a border: {len(failures)} failures")
    sys.exit(1 if failures else 0)


main()
