"""What Blender calls otherwise since version 4. The names of 4 are written by its manual for 4.3; tried is 3.4."""

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
RANDOM_WALK_BY_COLOUR = ("RANDOM_WALK", "RANDOM_WALK_SKIN")
ENCODINGS = {"Linear": "linear", "Linear Rec.709": "linear", "Non-Color": "linear", "Raw": "linear", "sRGB": "sRGB"}


def is_new(principled):
    return "Coat Weight" in principled.inputs


def principled_names(node):
    return {name: since if is_new(node) else before for name, (before, since) in PRINCIPLED.items()}


def extent_depends_on_colour(node):
    """Of light inside: as that random walk has it."""
    name = "subsurface_method" if hasattr(node, "subsurface_method") else "falloff"
    before, since = RANDOM_WALK_BY_COLOUR
    return getattr(node, name) == (since if since in node.bl_rna.properties[name].enum_items.keys() else before)
