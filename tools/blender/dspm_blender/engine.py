"""The render engine: F12 renders a frame, Render Animation all frames together."""
import sys
from contextlib import closing

import bpy

from .export_frames import animation_frames, export_frames
from .export_request import ExportRequest
from .passes import passes
from .rendering import Rendering


class DspmEngine(bpy.types.RenderEngine):
    bl_idname = "DSPM"
    bl_label = "dspm"
    bl_use_shading_nodes_custom = False  # Cycles' nodes
    animations = {}                      # of the render that Blender is at: view layer -> Rendering

    def render(self, depsgraph):
        """Blender asks for each frame of an animation; the first question renders them all."""
        request = ExportRequest.wanted
        try:
            if request:
                path = request.file_of(depsgraph.view_layer.name)
                for note in export_frames(self, depsgraph, path, request.frames, request.variations):
                    request.notes.add(note)
            elif self.is_animation:
                self._animation(depsgraph).show(self, depsgraph.scene.frame_current)
            else:
                frame = depsgraph.scene.frame_current
                with closing(Rendering(self, depsgraph, [frame])) as rendering:
                    rendering.show(self, frame)
        except Exception as problem:
            if request:
                request.error = str(problem)  # which its operator tells
            else:
                self._tell(str(problem))
            self.error_set(str(problem))

    def _tell(self, problem):
        """Ends an animation, too. Without windows Blender shows no error that is set, and a script gets this one."""
        self.report({"ERROR"}, problem)
        print(problem, file=sys.stderr, flush=True)

    def _animation(self, depsgraph):
        layer = depsgraph.view_layer.name
        if layer not in self.animations:
            self.animations[layer] = Rendering(self, depsgraph, animation_frames(depsgraph.scene))
        return self.animations[layer]

    def update_render_passes(self, scene=None, renderlayer=None):
        self.register_pass(scene, renderlayer, "Combined", 4, "RGBA", "COLOR")
        for each in passes(renderlayer, scene.dspm.denoise):
            self.register_pass(scene, renderlayer, each.name, len(each.letters), each.letters, each.kind)


@bpy.app.handlers.persistent
def forget_animations(*_):
    """When Blender begins a render, and when it has ended."""
    while DspmEngine.animations:
        DspmEngine.animations.popitem()[1].close()


HANDLERS = (bpy.app.handlers.render_init, bpy.app.handlers.render_complete, bpy.app.handlers.render_cancel)


def register():
    bpy.utils.register_class(DspmEngine)
    for handlers in HANDLERS:
        handlers.append(forget_animations)


def unregister():
    for handlers in HANDLERS:
        handlers.remove(forget_animations)
    bpy.utils.unregister_class(DspmEngine)
