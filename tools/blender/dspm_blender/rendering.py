"""Frames that are rendered together: exported, rendered by the program, and shown while they get better."""
import os
import tempfile

import bpy

from .export_frames import export_frames
from .passes import combined, passes, picture
from .process import Run, find_program


class Rendering:
    """One view layer of some frames. Its pictures last as long as it does."""

    def __init__(self, engine, depsgraph, frames):
        self.frames, self.layer = frames, depsgraph.view_layer.name
        self.passes = list(passes(depsgraph.view_layer_eval))
        self.folder = tempfile.TemporaryDirectory(prefix="dspm-")
        scene = os.path.join(self.folder.name, "scene.dsc")
        for note in export_frames(engine, depsgraph, scene, frames):
            engine.report({"WARNING"}, note)
        outputs = ",".join(sorted({each.output for each in self.passes}))
        arguments = depsgraph.scene.dspm.arguments() + (["--aov", outputs] if outputs else [])
        program = find_program(bpy.context.preferences.addons[__package__].preferences.program)
        with Run(program, scene, len(frames), arguments, self._seconds_between_pictures(engine)) as self.run:
            self._watch(engine)

    def show(self, engine, frame):
        """The last picture of one of Blender's frames."""
        exr = self.run.picture(self.frames.index(frame) + 1)
        if exr is None:
            raise RuntimeError("dspm was stopped before there was a picture")
        result = self._begin(engine, exr)
        self._fill(result, exr)
        engine.end_result(result)
        self._name_mattes(engine.get_result(), exr)

    def _seconds_between_pictures(self, engine):
        """Writing them takes a twentieth of the time at most, on a disk that takes 200 MB in a second."""
        numbers = 3 + sum(len(each.channels) for each in self.passes)
        size = 4 * numbers * engine.resolution_x * engine.resolution_y * len(self.frames)
        return max(2, size // 10_000_000)

    def _watch(self, engine):
        """Shows frame after frame, whenever the files are new."""
        result, shown, at = None, {}, 0
        while not self.run.poll(0.2):
            if engine.test_break():
                self.run.stop()
            engine.update_progress(self.run.share)
            engine.update_stats("dspm", f"{len(self.frames)} frames together; frame {self.frames[at]} is shown")
            written = self.run.written(at + 1)
            if written != shown.get(at):
                exr = self.run.picture(at + 1)
                result = result or self._begin(engine, exr)
                self._fill(result, exr)
                engine.update_result(result)
                shown[at], at = written, (at + 1) % len(self.frames)
        if result:
            engine.end_result(result, cancel=True)
        if self.run.problem():
            raise RuntimeError(self.run.problem())

    def _begin(self, engine, exr):
        for each in self.passes:
            engine.add_pass(each.name, len(each.letters), each.letters, layer=self.layer)
        return engine.begin_result(0, 0, exr.width, exr.height, layer=self.layer)

    def _fill(self, result, exr):
        layer = result.layers[0]
        layer.passes["Combined"].rect.foreach_set(combined(exr))
        for each in self.passes:
            layer.passes[each.name].rect.foreach_set(picture(exr, each.channels, len(each.letters)))

    def _name_mattes(self, result, exr):
        """What Blender's Cryptomatte node knows of names; the passes are called after the view layer."""
        for name, text in exr.texts.items():
            if name.startswith("cryptomatte/"):
                result.stamp_data_add_field(name, f"{self.layer}.{text}" if name.endswith("/name") else text)
