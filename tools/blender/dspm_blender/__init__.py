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

from . import baking_operators, engine, export_operator, panels, preferences, settings, variation_settings

MODULES = (preferences, settings, variation_settings, baking_operators, engine, export_operator, panels)


def register():
    for each in MODULES:
        each.register()


def unregister():
    for each in reversed(MODULES):
        each.unregister()
