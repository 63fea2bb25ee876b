"""Frames that are rendered together: exported, rendered by the program, shown while they get better, and handed over one by one."""
import bpy

from .export_frames import export_frames
from .passes import combined, lacking, passes, picture
from .process import Run, find_program
from .render_folder import RenderFolder
from .versions import fill


class Rendering:
    """One view layer of some frames. It goes on while Blender takes the frames that are done, until it is closed."""

    def __init__(self, engine, depsgraph, frames):
        settings = depsgraph.scene.dspm
        self.frames, self.layer, self.at, self.taken = frames, depsgraph.view_layer.name, -1, set()
        self.denoise, self.keep = settings.denoise, settings.resume
        self.passes = list(passes(depsgraph.view_layer_eval, self.denoise))
        if missing := list(lacking(depsgraph.view_layer_eval)):
            engine.report({"WARNING"}, f'view layer "{self.layer}": passes that dspm lacks are left out: {", ".join(missing)}')
        self.folder = RenderFolder(settings, self.layer, frames)
        resumes = settings.resume and self.folder.holds_a_render()
        try:
            if not resumes:
                self._export(engine, depsgraph, settings)
            self.run = self._begun(engine, settings, resumes)
        except BaseException:
            if not resumes:
                self.folder.remove()
            raise

    def show(self, engine, frame):
        """One of Blender's frames, as soon as its picture does not get better."""
        number = self.frames.index(frame) + 1
        self._wait(engine, number)
        exr = self.run.picture(number)
        if exr is None:
            raise RuntimeError("dspm was stopped before there was a picture")
        result = self._begin(engine, exr)
        self._fill(result, exr, self._shown(number) or exr)
        engine.end_result(result)
        self._name_mattes(engine.get_result(), exr)
        self.taken.add(number)

    def close(self):
        """What can be resumed stays, in its folder."""
        is_over = self.run.is_complete() and len(self.taken) == len(self.frames)
        self.run.close()
        if not self.folder.is_kept or (is_over and not self.keep):
            self.folder.remove()

    def _begun(self, engine, settings, resumes):
        outputs = ",".join(sorted({each.output for each in self.passes if each.output}))
        arguments = settings.arguments(resumes) + (["--aov", outputs] if outputs else [])
        if self.folder.is_kept:
            arguments += ["--resume" if resumes else "--checkpoint", self.folder.checkpoint]
        program = find_program(bpy.context.preferences.addons[__package__].preferences.program)
        return Run(program, self.folder.scene, len(self.frames), arguments, self._seconds_between_pictures(engine))

    def _export(self, engine, depsgraph, settings):
        if settings.checkpoint and not self.folder.is_kept and len(self.frames) > 1:
            engine.report({"WARNING"}, "the .blend file has not been saved, or its folder cannot be written, so there is no checkpoint beside it")
        if settings.resume:
            engine.report({"WARNING"}, f"there is nothing to resume in {self.folder.path}: the render begins")
        self.folder.begin()
        for note in export_frames(engine, depsgraph, self.folder.scene, self.frames):
            engine.report({"WARNING"}, note)

    def _seconds_between_pictures(self, engine):
        """Writing them takes a twentieth of the time at most, on a disk that takes 200 MB in a second."""
        numbers = 3 + sum(len(each.channels) for each in self.passes)
        size = 4 * numbers * engine.resolution_x * engine.resolution_y * len(self.frames)
        return max(2, size // 10_000_000)

    def _wait(self, engine, number):
        """Shows frame after frame meanwhile, whenever the files are new."""
        result, seen = None, {}
        while not self.run.poll(0.2) and number not in self.run.done:
            if engine.test_break():
                self.run.stop()
            engine.update_progress(self.run.share)
            engine.update_stats("dspm", f"{len(self.frames)} frames together; frame {self.frames[max(self.at, 0)]} is shown")
            if (new := self._next_new(seen)) is not None:
                self.at = new
                exr = self.run.picture(new + 1)
                result = result or self._begin(engine, exr)
                self._fill(result, exr, exr)
                engine.update_result(result)
        if result:
            engine.end_result(result, cancel=True)
        if number not in self.run.done and self.run.problem():
            raise RuntimeError(self.run.problem())

    def _next_new(self, seen):
        """The next frame after the one that is shown whose picture is a new one, or None."""
        for i in [*range(self.at + 1, len(self.frames)), *range(self.at + 1)]:
            written = None if i + 1 in self.run.done else self.run.written(i + 1)
            if written is not None and written != seen.get(i):
                seen[i] = written
                return i
        return None

    def _shown(self, number):
        return self.run.picture(number, ".denoised") if self.denoise else None

    def _begin(self, engine, exr):
        for each in self.passes:
            engine.add_pass(each.name, len(each.letters), each.letters, layer=self.layer)
        return engine.begin_result(0, 0, exr.width, exr.height, layer=self.layer)

    def _fill(self, result, exr, shown):
        """`shown` is what Combined becomes."""
        layer = result.layers[0]
        fill(layer.passes["Combined"].rect, combined(shown))
        for each in self.passes:
            fill(layer.passes[each.name].rect,
                 picture(exr, each.channels, len(each.letters)) if each.output else combined(exr))

    def _name_mattes(self, result, exr):
        """What Blender's Cryptomatte node knows of names; the passes are called after the view layer."""
        for name, text in exr.texts.items():
            if name.startswith("cryptomatte/"):
                result.stamp_data_add_field(name, f"{self.layer}.{text}" if name.endswith("/name") else text)
