"""What the export operator wants of the next render: files and no picture."""
import os
from contextlib import contextmanager

from .notes import Notes
from .textures import file_name


class ExportRequest:
    wanted = None

    def __init__(self, path, frames, variations):
        self.path, self.frames, self.variations, self.error = path, frames, variations, None
        self.files, self.notes = {}, Notes()  # files by view layer

    def file_of(self, layer):
        """Blender asks for one view layer after the other. The first one has the file's own name."""
        if not self.files:
            self.files[layer] = self.path
        elif layer not in self.files:
            stem, ending = os.path.splitext(self.path)
            name = f"{stem}.{file_name(layer)}"
            while name + ending in self.files.values():
                name += "_"
            self.files[layer] = name + ending
            self.notes.add(f'view layer "{layer}" is in {os.path.basename(self.files[layer])}')
        return self.files[layer]

    @contextmanager
    def in_scene(self, scene):
        """The scene is rendered by dspm for this request, without anything after it."""
        render = scene.render
        kept = {name: getattr(render, name) for name in ("engine", "use_compositing", "use_sequencer")}
        render.engine, render.use_compositing, render.use_sequencer = "DSPM", False, False
        ExportRequest.wanted = self
        try:
            yield
        finally:
            ExportRequest.wanted = None
            for name, value in kept.items():
                setattr(render, name, value)
