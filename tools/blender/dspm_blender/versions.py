"""What is otherwise since Blender 4. Tried are 3.4 and 4.3."""

import math

import bpy

PRINCIPLED = {  # dspm's parameter: before and since
    "basecolor": ("Base Color", "Base Color"),
    "metallic": ("Metallic", "Metallic"),
    "roughness": ("Roughness", "Roughness"),
    "alpha": ("Alpha", "Alpha"),
    "anisotropy": ("Anisotropic", "Anisotropic"),
    "specular": ("Specular", "Specular IOR Level"),
    "transmission": ("Transmission", "Transmission Weight"),
    "coat": ("Clearcoat", "Coat Weight"),
    "coatroughness": ("Clearcoat Roughness", "Coat Roughness"),
    "emission": ("Emission", "Emission Color"),
    "subsurface": ("Subsurface", "Subsurface Weight"),
}
# An area light of power P and area A has the radiance P / (this A).
POWER_OF_AREA = math.pi if bpy.app.version >= (4, 0) else 4
RANDOM_WALK_BY_COLOUR = ("RANDOM_WALK", "RANDOM_WALK_SKIN")
ENCODINGS = {"Linear": "linear", "Linear Rec.709": "linear", "Non-Color": "linear", "Raw": "linear", "sRGB": "sRGB"}


# View transforms and looks, and what dspm calls them.
VIEWS = {("Standard", "None"): "standard", ("Khronos PBR Neutral", "None"): "neutral", ("AgX", "None"): "agx",
         ("AgX", "AgX - Base Contrast"): "agx", ("AgX", "AgX - Punchy"): "agx-punchy", ("Raw", "None"): "raw"}


def owner_of_shutter_position(scene):
    """Of "motion_blur_position": once Cycles, now the render. None: Cycles is off."""
    owners = (scene.render, getattr(scene, "cycles", None))
    return next((owner for owner in owners if hasattr(owner, "motion_blur_position")), None)


def shutter_position(scene):
    """START, CENTER or END: where in the time that the shutter is open the frame lies."""
    owner = owner_of_shutter_position(scene)
    return owner.motion_blur_position if owner else "CENTER"


def fill(rect, pixels):
    """Blender 3 takes an array of pixels for those of a pass, later ones an array of all their numbers."""
    try:
        rect.foreach_set(pixels)
    except TypeError:
        rect.foreach_set(pixels.ravel())


def is_new(principled):
    return "Coat Weight" in principled.inputs


def principled_names(node):
    return {name: since if is_new(node) else before for name, (before, since) in PRINCIPLED.items()}


def extent_depends_on_colour(node):
    """Of light inside: as that random walk has it."""
    name = "subsurface_method" if hasattr(node, "subsurface_method") else "falloff"
    before, since = RANDOM_WALK_BY_COLOUR
    return getattr(node, name) == (since if since in node.bl_rna.properties[name].enum_items.keys() else before)
