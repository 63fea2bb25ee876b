"""Runs in Blender: its motion blur as dspm's shutter, and its Vector pass, both against formulas.
usage: blender -b --factory-startup --python motion_blur.py -- dspm folder"""
import os
import subprocess
import sys

import addon_utils
import bpy
import numpy as np

here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [here, os.path.join(here, "../../tools/blender")]
import scene_parts
from dspm_blender.exr import Exr
from dspm_blender.shutter import Shutter
from dspm_blender.versions import owner_of_shutter_position

program, folder = sys.argv[sys.argv.index("--") + 1:][:2]
WIDTH, HEIGHT, UNIT = 64, 32, 8  # pixels, and those of a unit
failures = []


def expect(holds, text):
    if not holds:
        failures.append(text)
        print("FAILED:", text)


def begin(frames=3):
    """The camera looks down on a picture of 8 by 4 units."""
    scene_parts.empty(camera=(0, 0, 5), target=(0, 0, 0), lens=40, frames=frames)
    addon_utils.enable("cycles", default_set=True)
    addon_utils.enable("dspm_blender", default_set=True)
    bpy.context.preferences.addons["dspm_blender"].preferences.program = program
    scene = bpy.context.scene
    scene.camera.rotation_euler = (0, 0, 0)
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", WIDTH / UNIT
    render = scene.render
    render.engine, scene.dspm.integrator, scene.dspm.iterations = "DSPM", "path", 4
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, HEIGHT, 100
    format = render.image_settings
    format.file_format, format.color_depth, format.exr_codec = "OPEN_EXR_MULTILAYER", "32", "NONE"
    return scene


def moving(places, kind="LINEAR", size=2):
    """A white square that emits, at (frame, x, y)."""
    square = scene_parts.plane(size, scene_parts.material("white", lambda tree: scene_parts.bsdf(tree, "Emission", Strength=1)))
    for frame, x, y in places:
        square.location = (x, y, 0)
        square.keyframe_insert("location", frame=frame)
    for curve in square.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = kind
    return square


def blurred(scene, length, position):
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, length
    owner_of_shutter_position(scene).motion_blur_position = position


def exported(name, animation=True):
    path = os.path.join(folder, name + ".dsc")
    bpy.ops.export_scene.dspm(filepath=path, animation=animation)
    with open(path, encoding="utf-8") as file:
        return path, file.read()


def rendered(path, iterations):
    """Frames as rows of brightness."""
    run = subprocess.run([program, path, "-o", path[:-4] + ".####.exr", "--iterations", str(iterations), "--float", "--compression",
                          "none"], capture_output=True, text=True)
    expect(run.returncode == 0 and "warning" not in run.stderr, f"dspm takes {path}: {run.stderr}")
    stem = os.path.basename(path)[:-4] + "."
    names = sorted(each for each in os.listdir(folder) if each.startswith(stem) and each.endswith(".exr"))
    return [Exr(os.path.join(folder, name)).channels["G"] for name in names]


def covered(place_at, begin, end):
    """The share of the time from `begin` to `end` at which a square 2 wide, at x = place_at(time), covers each column."""
    columns, times = (np.arange(WIDTH) + 0.5 - WIDTH / 2) / UNIT, np.linspace(begin, end, 400)
    return (np.abs(columns[:, None] - place_at(times)[None, :]) < 1).mean(axis=1)


def expect_streaks():
    """Linear keys, of which those around a shutter that opens before the first frame or closes after the last matter."""
    for position, opens in (("START", 0), ("CENTER", -0.25), ("END", -0.5)):
        scene = begin()
        moving([(-3, -6, 0), (7, 4, 0)])
        blurred(scene, 0.5, position)
        path, text = exported(f"streak {position}")
        expect(f'"float shutteropen" {opens:g} "float shutterclose" {opens + 0.5:g}' in text, f"{position}: when it is open, not {text}")
        for frame, picture in enumerate(rendered(path, 256), 1):
            wanted = covered(lambda time: -6 + time + 3, frame + opens, frame + opens + 0.5)
            off = np.abs(picture[HEIGHT // 2] - wanted).max()
            expect(off < 0.15, f"{position}, frame {frame}: {off:.3f} off")
            expect(abs(picture[HEIGHT // 2].mean() - wanted.mean()) < 0.01, f"{position}, frame {frame}: its sum")


def expect_curves():
    """Something that swings: a half of the frame's way lies in its first third. Keys lie in the middle of the shutter."""
    scene = begin(frames=2)
    square = moving([(1, -3, 0), (2, 3, 0)], "SINE")
    blurred(scene, 1, "START")
    path, text = exported("curve", animation=False)
    expect("Keyframe 1.5 " in text and "Keyframe 2 " in text, f"it has keys within the shutter: {text}")
    scene.frame_set(1, subframe=0.5)
    middle = square.matrix_world.translation.x
    way = lambda time: np.interp(time, [1, 1.5, 2], [-3, middle, 3])
    picture = rendered(path, 512)[0][HEIGHT // 2]
    expect(np.abs(picture - covered(way, 1, 2)).max() < 0.1, "it follows its curve")
    expect(abs(middle) > 0.5, f"which is one: {middle}")


def expect_moving_camera_and_lamp():
    scene = begin(frames=2)
    moving([(1, 0, 0)])
    lamp = scene_parts.lamp("POINT", (0, 0, 3), 10)
    for thing in (scene.camera, lamp):
        for frame, x in ((1, 0), (2, 1)):
            thing.location.x = x
            thing.keyframe_insert("location", index=0, frame=frame)
    scene.camera.data.ortho_scale = 8
    scene.camera.data.keyframe_insert("ortho_scale", frame=1)
    scene.camera.data.ortho_scale = 6
    scene.camera.data.keyframe_insert("ortho_scale", frame=3)
    blurred(scene, 0.5, "CENTER")
    path, text = exported("camera")
    camera, world = text.split("WorldBegin")
    for time in ("0.75", "1.25", "2.25"):
        expect(f"Keyframe {time} " in camera and f"@{time}" in camera, f"the camera has a key at {time}: {camera}")
        expect(f"Keyframe {time} " in world, f"the lamp has a key at {time}")
    rendered(path, 4)


def expect_sharp_ones():
    """Cycles' switch of objects. Another one, outside of the picture, blurs."""
    pictures = []
    for blurs in (False, True):
        scene = begin()
        moving([(1, 20, 0), (3, 30, 0)])
        moving([(1, -1, 0), (3, 1, 0)]).cycles.use_motion_blur = False
        if blurs:
            blurred(scene, 0.5, "START")
        path, text = exported(f"sharp {blurs}")
        pictures.append(rendered(path, 8))
    expect(text.count('"bool blur" false') == 1, f"one does not blur: {text}")
    expect(np.array_equal(*pictures), "its edges are sharp")


def expect_deforming():
    """A mesh that bends has a file a frame, moved by what is between."""
    scene = begin()
    square = moving([(1, -1, 0), (3, 1, 0)])
    square.shape_key_add(name="flat")
    bent = square.shape_key_add(name="bent")
    bent.data[0].co.x -= 1
    for frame, value in ((1, 0), (3, 1)):
        bent.value = value
        bent.keyframe_insert("value", frame=frame)
    blurred(scene, 0.5, "START")
    path, text = exported("deforming")
    expect("%04d.ply" in text and "Keyframe 1.25 " in text, f"a sequence that moves: {text}")
    expect(len(rendered(path, 4)) == 3, "it is rendered")


def expect_closed():
    scene = begin()
    moving([(1, -1, 0), (3, 1, 0)])
    _, text = exported("closed")
    expect("shutter" not in text and "Keyframe 1.5" not in text, f"without motion blur, the shutter is closed: {text}")
    expect(Shutter(scene, 1).times(3, False) == [], "and there is nothing to look at")
    expect(Shutter(scene, 1).times(3, True) == [2**-16, 4], "but for vectors")


def expect_steps():
    """Of two frames: half of Blender's frame is a quarter of the file's."""
    scene = begin()
    blurred(scene, 0.5, "START")
    expect(Shutter(scene, 2).params() == {"float shutteropen": 0, "float shutterclose": 0.25}, "a shutter of steps")
    expect(Shutter(scene, 2).times(2, False) == [1.125, 1.25, 2.125, 2.25], "and its times")


def expect_vectors():
    """As Cycles has them: to where it was, and from where it will be. 8 pixels a unit."""
    for animation in (True, False):
        for engine in ("DSPM", "CYCLES"):
            scene = begin()
            moving([(1, -1, 0), (2, 0, .5), (3, 2, .25)])
            scene.render.engine = engine
            scene.cycles.samples, scene.cycles.use_denoising = 1, False
            scene.view_layers[0].cycles.use_denoising = False
            scene.view_layers[0].use_pass_vector = True
            scene.frame_set(2)
            scene.render.filepath = os.path.join(folder, f"vector {engine} {animation}.")
            bpy.ops.render.render(animation=animation, write_still=not animation)
            channels = Exr(scene.render.filepath + ("0002.exr" if animation else "exr")).channels
            found = [channels[f"ViewLayer.Vector.{letter}"][HEIGHT // 2 + 4, WIDTH // 2] for letter in "XYZW"]
            expect(np.allclose(found, (-8, -4, -16, 2), atol=2e-3), f"{engine}, animation {animation}: {found}")


expect_streaks()
expect_curves()
expect_moving_camera_and_lamp()
expect_sharp_ones()
expect_deforming()
expect_closed()
expect_steps()
expect_vectors()
print(f"motion blur: {len(failures)} failures")
sys.exit(bool(failures))
