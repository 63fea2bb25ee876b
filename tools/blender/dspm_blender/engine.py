"""The render engine."""
from contextlib import contextmanager

import bpy

from .export_frames import export_frames


class Export:
    """What the operator wants of the next render: a file and no picture."""
    wanted = None

    def __init__(self, path, frames):
        self.path, self.frames, self.notes, self.error = path, frames, [], None


@contextmanager
def engine_of(scene, request):
    """The scene is rendered by dspm, for `request`, without anything after it."""
    render = scene.render
    kept = {name: getattr(render, name) for name in ("engine", "use_compositing", "use_sequencer")}
    render.engine, render.use_compositing, render.use_sequencer = DspmEngine.bl_idname, False, False
    Export.wanted = request
    try:
        yield
    finally:
        Export.wanted = None
        for name, value in kept.items():
            setattr(render, name, value)


class DspmEngine(bpy.types.RenderEngine):
    bl_idname = "DSPM"
    bl_label = "dspm"
    bl_use_shading_nodes_custom = False  # Cycles' nodes

    def render(self, depsgraph):
        try:
            if Export.wanted:
                Export.wanted.notes = export_frames(self, depsgraph, Export.wanted.path, Export.wanted.frames)
        except Exception as problem:
            if not Export.wanted:
                raise
            Export.wanted.error = str(problem)
            raise
