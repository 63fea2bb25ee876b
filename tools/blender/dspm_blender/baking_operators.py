"""What the render panel offers for procedural textures."""
import bpy

from .baking import bake, forget


class BakeTextures(bpy.types.Operator):
    """Make pictures of procedural textures, which dspm renders in their place"""
    bl_idname, bl_label, bl_options = "dspm.bake_textures", "Bake Procedural Textures", {"UNDO"}

    def execute(self, context):
        for note in bake(context.scene, context.view_layer, context.scene.dspm.bake_size):
            self.report({"WARNING"}, note)
        return {"FINISHED"}


class ForgetTextures(bpy.types.Operator):
    """Remove the pictures of procedural textures"""
    bl_idname, bl_label, bl_options = "dspm.forget_textures", "Remove Baked Textures", {"UNDO"}

    def execute(self, _context):
        forget()
        return {"FINISHED"}


CLASSES = (BakeTextures, ForgetTextures)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
