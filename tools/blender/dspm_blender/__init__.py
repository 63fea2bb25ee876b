"""dspm in Blender: a render engine, and File > Export > dspm (.dsc)."""
bl_info = {
    "name": "dspm",
    "description": "Renders all frames, or all variations of a product, together",
    "author": "the authors of dspm",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Render > Render Engine; File > Export > dspm (.dsc)",
    "category": "Render",
}

import bpy

from . import engine, export_operator, settings

CLASSES = (settings.DspmSettings, settings.DspmLayerSettings, engine.DspmEngine, export_operator.ExportDspm)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.dspm = bpy.props.PointerProperty(type=settings.DspmSettings)
    bpy.types.ViewLayer.dspm = bpy.props.PointerProperty(type=settings.DspmLayerSettings)
    bpy.types.TOPBAR_MT_file_export.append(export_operator.menu_entry)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(export_operator.menu_entry)
    del bpy.types.ViewLayer.dspm, bpy.types.Scene.dspm
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
