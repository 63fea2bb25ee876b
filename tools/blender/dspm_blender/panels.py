"""Panels of the render and view layer properties, and Blender's own that hold for dspm as well."""
import bpy

from .baking_operators import BakeTextures, ForgetTextures
from .versions import owner_of_shutter_position


class RenderPanel(bpy.types.Panel):
    bl_label = "dspm"
    bl_idname = "DSPM_PT_render"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "render"
    COMPAT_ENGINES = {"DSPM"}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES

    def draw(self, context):
        layout, settings = self.layout, context.scene.dspm
        layout.use_property_split = True
        layout.prop(settings, "integrator")
        layout.prop(settings, "iterations")
        if settings.integrator in {"dsppm", "sppm"}:
            layout.prop(settings, "photons")
        for name in ("max_depth", "until_error", "time_limit", "seed", "denoise"):
            layout.prop(settings, name)
        if settings.uses_guide():
            layout.prop(settings, "guide")
        layout.prop(settings, "checkpoint")
        row = layout.row()
        row.enabled = settings.checkpoint
        row.prop(settings, "resume")
        layout.prop(context.scene.render, "film_transparent")
        layout.prop(settings, "bake_size")
        row = layout.row(align=True)
        row.operator(BakeTextures.bl_idname)
        row.operator(ForgetTextures.bl_idname, text="", icon="X")


class PassesPanel(bpy.types.Panel):
    bl_label = "Passes"
    bl_idname = "DSPM_PT_passes"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "view_layer"
    COMPAT_ENGINES = {"DSPM"}

    poll = RenderPanel.poll

    def draw(self, context):
        layout, layer = self.layout, context.view_layer
        layout.use_property_split = True
        for name in ("use_pass_z", "use_pass_normal", "use_pass_position", "use_pass_uv", "use_pass_vector"):
            layout.prop(layer, name)
        for name in ("albedo", "variance", "denoising_data"):
            layout.prop(layer.dspm, name)
        layout.prop(layer, "use_pass_cryptomatte_object")
        layout.prop(layer, "use_pass_cryptomatte_material")


class MotionBlurPanel(bpy.types.Panel):
    bl_label = "Motion Blur"
    bl_idname = "DSPM_PT_motion_blur"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "render"
    COMPAT_ENGINES = {"DSPM"}

    poll = RenderPanel.poll

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "use_motion_blur", text="")

    def draw(self, context):
        layout, scene = self.layout, context.scene
        layout.use_property_split, layout.active = True, scene.render.use_motion_blur
        if owner := owner_of_shutter_position(scene):
            layout.prop(owner, "motion_blur_position", text="Position")
        layout.prop(scene.render, "motion_blur_shutter")


CLASSES = (RenderPanel, MotionBlurPanel, PassesPanel)
# Blender's panels are for its own engines by name. Those for any engine name BLENDER_RENDER; these do not, and hold as well.
OURS_TOO = {"DATA_PT_camera_dof", "DATA_PT_camera_dof_aperture", "DATA_PT_EEVEE_light", "EEVEE_MATERIAL_PT_context_material",
            "EEVEE_MATERIAL_PT_surface", "EEVEE_MATERIAL_PT_volume", "EEVEE_WORLD_PT_surface",
            "VIEWLAYER_PT_layer_passes_lightgroups"}
NOT_OURS = {"DATA_PT_light", "DATA_PT_area", "DATA_PT_spot", "RENDER_PT_gpencil", "RENDER_PT_freestyle", "VIEWLAYER_PT_freestyle"}


def descendants(kind):
    for each in kind.__subclasses__():
        yield each
        yield from descendants(each)


def shared_panels():
    return [panel for panel in descendants(bpy.types.Panel) if hasattr(panel, "COMPAT_ENGINES") and (
        panel.__name__ in OURS_TOO or ("BLENDER_RENDER" in panel.COMPAT_ENGINES and panel.__name__ not in NOT_OURS))]


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    for panel in shared_panels():
        panel.COMPAT_ENGINES.add("DSPM")


def unregister():
    for panel in shared_panels():
        panel.COMPAT_ENGINES.discard("DSPM")
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
