"""File > Export > dspm (.dsc)."""
import bpy
from bpy_extras.io_utils import ExportHelper

from .baking import any_baked, bake, forget
from .export_frames import animation_frames
from .export_request import ExportRequest


class ExportDspm(bpy.types.Operator, ExportHelper):
    """Write the scene as dspm renders it, with meshes and textures beside it"""
    bl_idname = "export_scene.dspm"
    bl_label = "Export dspm"
    filename_ext = ".dsc"
    filter_glob: bpy.props.StringProperty(default="*.dsc", options={"HIDDEN"})
    animation: bpy.props.BoolProperty(name="Animation", default=True, description="All frames; else the current one")
    variations: bpy.props.BoolProperty(
        name="Variations", default=True, description="Of materials and collections that have them; else as it is here")

    bake: bpy.props.BoolProperty(
        name="Bake Procedural Textures", description="As pictures, which goes for this export only unless there are some already")

    def execute(self, context):
        scene, had_some = context.scene, any_baked()
        for note in bake(scene, context.view_layer, scene.dspm.bake_size) if self.bake else ():
            self.report({"WARNING"}, note)
        try:
            return self._export(scene)
        finally:
            if self.bake and not had_some:
                forget()

    def _export(self, scene):
        frames = animation_frames(scene) if self.animation else [scene.frame_current]
        request = ExportRequest(bpy.path.abspath(self.filepath), frames, self.variations)
        with request.in_scene(scene):
            bpy.ops.render.render()
        if request.error:
            self.report({"ERROR"}, request.error)
            return {"CANCELLED"}
        for note in request.notes.texts:
            self.report({"WARNING"}, note)
        return {"FINISHED"}


def menu_entry(self, _context):
    self.layout.operator(ExportDspm.bl_idname, text="dspm (.dsc)")


def register():
    bpy.utils.register_class(ExportDspm)
    bpy.types.TOPBAR_MT_file_export.append(menu_entry)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(menu_entry)
    bpy.utils.unregister_class(ExportDspm)
