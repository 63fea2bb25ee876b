"""File > Export > dspm (.dsc)."""
import bpy
from bpy_extras.io_utils import ExportHelper

from . import engine
from .export_frames import animation_frames


class ExportDspm(bpy.types.Operator, ExportHelper):
    """Write the scene as dspm renders it, with meshes and textures beside it"""
    bl_idname = "export_scene.dspm"
    bl_label = "Export dspm"
    filename_ext = ".dsc"
    filter_glob: bpy.props.StringProperty(default="*.dsc", options={"HIDDEN"})
    animation: bpy.props.BoolProperty(name="Animation", default=True, description="All frames; else the current one")

    def execute(self, context):
        scene = context.scene
        frames = animation_frames(scene) if self.animation else [scene.frame_current]
        request = engine.Export(bpy.path.abspath(self.filepath), frames)
        with engine.engine_of(scene, request):
            bpy.ops.render.render()
        if request.error:
            self.report({"ERROR"}, request.error)
            return {"CANCELLED"}
        for note in request.notes:
            self.report({"WARNING"}, note)
        return {"FINISHED"}


def menu_entry(self, _context):
    self.layout.operator(ExportDspm.bl_idname, text="dspm (.dsc)")
