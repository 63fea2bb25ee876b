"""Blender's Principled BSDF, of versions before 4 and since. dspm's parameters are explained in materials/principled.cpp."""
from .fields import Field, is_one, is_zero, product
from .shader import Shader


def principled(tree, source):
    new = "Coat Weight" in source.node.inputs
    name = NEW if new else OLD
    get = lambda each: tree.field(source, name[each])
    transmission, colour, eta = get("transmission"), get("basecolor"), max(tree.number(source, "IOR"), 1.0)
    if not is_zero(get("subsurface")):
        tree.note(source, "scatters at its surface only")
    if not new and is_one(transmission):
        colour = product(colour, colour)  # it colours each boundary, dspm's root does
    if new or not is_zero(transmission):
        straight_on = ((eta - 1) / (eta + 1)) ** 2
    else:
        eta, straight_on = 1.5, 0.04
    # What the opaque part mirrors straight on is 0.08 Specular before version 4; since then it is eta's, doubled by 1.
    specular = scaled(get("specular"), 2 if new else 0.08 / max(straight_on, 1e-3))
    fields = {"basecolor": colour, "roughness": get("roughness"), "specular": specular}
    optional = {"metallic": get("metallic"), "transmission": transmission, "anisotropy": get("anisotropy"),
                "coat": scaled(get("coat"), 1 if new else 0.25), "sheen": sheen(tree, source, new)}
    fields |= {each: value for each, value in optional.items() if tree.animated or not is_zero(value)}
    if "coat" in fields:
        fields["coatroughness"] = get("coatroughness")
    if "anisotropy" in fields:
        fields["anisotropyrotation"] = scaled(tree.field(source, "Anisotropic Rotation"), 360)
    light = product(get("emission"), tree.field(source, "Emission Strength"))
    return Shader("principled", fields, {"float eta": eta} | tree.relief(source), get("alpha"), light)


def sheen(tree, source, new):
    if new:
        return product(tree.field(source, "Sheen Tint"), tree.field(source, "Sheen Weight"))
    return tree.field(source, "Sheen")


def scaled(field, factor):
    return field if factor == 1 else product(field, Field.of(factor))


SAME = {"basecolor": "Base Color", "metallic": "Metallic", "roughness": "Roughness", "alpha": "Alpha",
        "anisotropy": "Anisotropic"}
OLD = SAME | {"specular": "Specular", "transmission": "Transmission", "coat": "Clearcoat",
              "coatroughness": "Clearcoat Roughness", "emission": "Emission", "subsurface": "Subsurface"}
NEW = SAME | {"specular": "Specular IOR Level", "transmission": "Transmission Weight", "coat": "Coat Weight",
              "coatroughness": "Coat Roughness", "emission": "Emission Color", "subsurface": "Subsurface Weight"}
