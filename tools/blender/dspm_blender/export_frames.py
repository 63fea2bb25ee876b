"""Frames of a Blender scene into a .dsc file. Only a render engine sees the scene as it renders, and may change its frame."""
import math

from .scene_export import SceneExport
from .shutter import Shutter


def export_frames(engine, depsgraph, path, frames, variations=False):
    """`frames` are Blender's; the file's are numbered from 1. Without variations it is the scene as Blender shows it. Returns
    the notes."""
    scene = depsgraph.scene
    current, part = scene.frame_current, scene.frame_subframe
    step = frames[1] - frames[0] if len(frames) > 1 else 1
    shutter = Shutter(scene, step)
    export = SceneExport(path, variations, shutter)
    for number, frame in enumerate(frames, 1):
        engine.update_stats("dspm", f"exporting frame {frame}")
        if len(frames) > 1:
            engine.frame_set(frame, 0.0)
        export.see(number, depsgraph)
    for time in shutter.times(len(frames), depsgraph.view_layer_eval.use_pass_vector):
        frame = frames[0] + (time - 1) * step
        engine.frame_set(math.floor(frame), frame - math.floor(frame))
        export.see_between(time, depsgraph)
    engine.frame_set(current, part)
    export.write(scene, scene.dspm, len(frames))
    return export.notes.texts


def animation_frames(scene):
    return list(range(scene.frame_start, scene.frame_end + 1, scene.frame_step))
