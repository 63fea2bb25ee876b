"""Where the program is."""
import bpy


class DspmPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name="Program", subtype="FILE_PATH", description="The program dspm; empty: the one that PATH finds")

    def draw(self, _context):
        self.layout.prop(self, "program")


def register():
    bpy.utils.register_class(DspmPreferences)


def unregister():
    bpy.utils.unregister_class(DspmPreferences)
