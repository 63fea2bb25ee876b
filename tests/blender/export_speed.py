"""Runs in Blender: exports a sheet of 100,000 vertices that deforms in every frame. A frame may take a second of the processor's
time, with what Blender needs to deform it.
usage: blender -b --factory-startup --python export_speed.py -- dspm folder"""
import os
import sys
import time

import addon_utils
import bpy

here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [here, os.path.join(here, "../../tools/blender")]
import scenes

FRAMES, MOST_SECONDS = 10, 1.0
folder = sys.argv[-1]

scenes.empty(camera=(0, -5, 3), target=(0, 0, 0), lens=40, frames=FRAMES)
addon_utils.enable("dspm_blender")
bpy.ops.mesh.primitive_grid_add(x_subdivisions=316, y_subdivisions=316, size=4)
sheet = bpy.context.object
bpy.ops.object.shade_smooth()
sheet.modifiers.new("wave", "WAVE").time_offset = -20

begin = time.process_time()
bpy.ops.export_scene.dspm(filepath=os.path.join(folder, "sheet.dsc"))
seconds = (time.process_time() - begin) / FRAMES
files = len(os.listdir(os.path.join(folder, "sheet.meshes")))
print(f"{len(sheet.data.vertices)} vertices, {files} files: {seconds:.2f} s a frame")
sys.exit(0 if files == FRAMES and seconds < MOST_SECONDS else 1)
