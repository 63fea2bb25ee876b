"""What the export operator wants of the next render: a file and no picture."""
from contextlib import contextmanager


class ExportRequest:
    wanted = None

    def __init__(self, path, frames, variations):
        self.path, self.frames, self.variations, self.notes, self.error = path, frames, variations, [], None

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
