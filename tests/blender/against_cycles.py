"""Runs in Blender: exports each scene, and compares dspm's pictures with Cycles' by blocks.
usage: blender -b --factory-startup --python against_cycles.py -- dspm folder [--width W] [--samples N] [scenes]"""
import argparse
import os
import subprocess
import sys

import addon_utils
import bpy
import numpy as np

here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [here, os.path.join(here, "../../tools/blender")]
import scenes

BLOCK = 8
LIMITS = (0.04, 0.35, 0.02)  # of `errors`, most of which is noise at 64 samples
# Principled before Blender 4 adds its gloss to the diffuse ground; dspm's ground gets what the gloss leaves.
WITH_PRINCIPLED = (0.06, 0.35, 0.055)


def enable():
    for name in ("cycles", "dspm_blender"):
        addon_utils.enable(name)


def exported(name, folder):
    path = os.path.join(folder, name + ".dsc")
    if bpy.ops.export_scene.dspm(filepath=path) != {"FINISHED"}:
        sys.exit(f"FAILED: {name} is not exported")
    return path


def by_cycles(frame, path, samples):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling = samples, False, False
    scene.cycles.sample_clamp_indirect, scene.cycles.blur_glossy = 0, 0
    for name in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces", "transparent_max_bounces", "volume_bounces"):
        setattr(scene.cycles, name, 16)
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = path
    scene.frame_set(frame)
    bpy.ops.render.render(write_still=True)
    return pixels(path)


def by_dspm(program, path, samples, frames):
    result = path[:-4] + (".####.exr" if frames > 1 else ".exr")
    subprocess.run([program, path, "--integrator", "path", "--iterations", str(samples), "--quiet", "-o", result], check=True)
    return [pixels(result.replace("####", f"{frame:04}")) for frame in range(1, frames + 1)]


def pixels(path):
    image = bpy.data.images.load(path, check_existing=False)
    values = np.empty(image.size[0] * image.size[1] * 4, dtype=np.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(image.size[1], image.size[0], 4)[..., :3]
    bpy.data.images.remove(image)
    return values


def blocks(image):
    rows, columns = (length // BLOCK for length in image.shape[:2])
    cut = image[:rows * BLOCK, :columns * BLOCK]
    return cut.reshape(rows, BLOCK, columns, BLOCK, 3).mean(axis=(1, 3))


def errors(image, reference):
    """Of blocks' means, relative to half of the block and half of the picture: their mean, their largest, and the bias."""
    a, b = blocks(image), blocks(reference)
    relative = np.abs(a - b) / (0.5 * b + 0.5 * b.mean())
    return relative.mean(), relative.max(), a.mean() / b.mean() - 1


def is_principled(material):
    return material.use_nodes and any(node.bl_idname == "ShaderNodeBsdfPrincipled" for node in material.node_tree.nodes)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--width", type=int, default=64)
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("names", nargs="*")
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    failed = []
    for make in scenes.ALL:
        name = make.__name__
        if options.names and name not in options.names:
            continue
        make()
        enable()
        scene = bpy.context.scene
        scene.render.resolution_x, scene.render.resolution_y = options.width, options.width * 3 // 4
        scene.render.resolution_percentage, scene.dspm.max_depth = 100, 16
        limits = WITH_PRINCIPLED if any(map(is_principled, bpy.data.materials)) else LIMITS
        images = by_dspm(options.program, exported(name, options.folder), options.samples, scene.frame_end)
        for frame, image in enumerate(images, 1):
            reference = by_cycles(frame, os.path.join(options.folder, f"{name}.cycles.{frame:04}.exr"), options.samples)
            mean, largest, bias = errors(image, reference)
            good = all(abs(error) <= limit for error, limit in zip((mean, largest, bias), limits))
            print(f"{'ok' if good else 'FAILED'}: {name}, frame {frame}: blocks differ by {mean:.1%} on average, "
                  f"{largest:.1%} at most, bias {bias:+.1%}", flush=True)
            failed += [] if good else [name]
    sys.exit(1 if failed else 0)


main()
