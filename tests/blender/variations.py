"""Runs in Blender: marked materials and collections become axes, and each variation is the scene with that choice made by hand.
usage: blender -b --factory-startup --python variations.py -- dspm folder"""
import os
import subprocess
import sys

import addon_utils
import bpy
import numpy as np

here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [here, os.path.join(here, "../../tools/blender")]
import scenes

program, folder = sys.argv[sys.argv.index("--") + 1:][:2]


def prepare():
    """A panel in three paints, one of them a mix, with a ball or a cone in front."""
    scenes.empty(camera=(0, -7, 2.5), target=(0, 0, 1), lens=40)
    addon_utils.enable("dspm_blender")
    scenes.sky((.6, .7, .9, 1), 1.0)
    scenes.lamp("SUN", (0, 0, 5), 2, turn=(0.6, 0.3, 0), angle=0.0)
    red = scenes.material("red", lambda tree: scenes.bsdf(tree, "Diffuse", Color=(.7, .1, .1, 1)))
    scenes.plane(8, red)
    for paint in (scenes.material("mixed", scenes.mixed), scenes.material("metal", lambda tree: scenes.bsdf(tree, "Glossy"))):
        red.dspm.alternatives.add().material = paint
    red.dspm.axis = "paint"
    for name, add in (("ball", bpy.ops.mesh.primitive_uv_sphere_add), ("cone", bpy.ops.mesh.primitive_cone_add)):
        collection = bpy.data.collections.new(name)
        collection.dspm.axis = "thing"
        bpy.context.scene.collection.children.link(collection)
        add(location=(0, 0, 1))
        collection.objects.link(bpy.context.object)
        bpy.context.collection.objects.unlink(bpy.context.object)
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 48, 36, 100


def rendered(name):
    path = os.path.join(folder, name + ".dsc")
    bpy.ops.export_scene.dspm(filepath=path, animation=False, variations=name == "all")
    subprocess.run([program, path, "-o", path[:-4] + ".pfm", "--integrator", "path", "--iterations", "4", "--quiet"], check=True)
    return path[:-4]


def pixels(path):
    with open(path, "rb") as file:
        return np.frombuffer(file.read()[-48 * 36 * 12:], dtype="<f4")


def main():
    prepare()
    everything = rendered("all")
    listing = subprocess.run([program, everything + ".dsc", "--list-variations"], capture_output=True, text=True)
    names = listing.stdout.split()
    expected = [f"{paint}-{thing}" for paint in ("red", "mixed", "metal") for thing in ("ball", "cone")]
    failures = [] if names == expected else [f"the variations are {names}"]
    ground = bpy.data.objects["Plane"]
    for paint in ("red", "mixed", "metal"):
        ground.data.materials[0] = bpy.data.materials[paint]
        for thing, other in (("ball", "cone"), ("cone", "ball")):
            bpy.data.collections[thing].hide_render, bpy.data.collections[other].hide_render = False, True
            alone = rendered(f"{paint}-{thing}")
            together, by_hand = pixels(f"{everything}.{paint}-{thing}.pfm"), pixels(alone + ".pfm")
            if not np.allclose(together, by_hand, rtol=1e-4, atol=1e-5):
                failures.append(f"{paint}-{thing} is not what it is alone, by up to {np.abs(together - by_hand).max()}")
    print("\n".join(failures) or f"{len(names)} variations are what they are alone")
    sys.exit(1 if failures else 0)


main()
