"""Blender's Principled BSDF, of versions before 4 and since. dspm's parameters are explained in principled.cpp."""
import numpy as np

from .fields import Field, complement, is_one, is_zero, luminance, product, total
from .shader import Shader
from .subsurface import body
from .versions import is_new, principled_names


def principled(tree, source):
    """Its opaque ground may be a body that scatters inside."""
    new, name = is_new(source.node), principled_names(source.node)
    surface = of_surface(tree, source, name, new)
    weight = tree.field(source, name["subsurface"])
    if is_zero(weight):
        return surface
    if not surface.is_plain():
        tree.note(source, "scatters at its surface only, as it emits or has holes")
        return surface
    ground = product(complement(tree.field(source, "Metallic")), complement(tree.field(source, name["transmission"])))
    share = product(weight, ground) if new else ground
    if is_zero(share):
        return surface
    inside = body_of(tree, source, weight, surface, new)
    if is_one(share):
        return inside
    return Shader("mix", {"amount": share}, {"string materials": [tree.part(surface), tree.part(inside)]})


def body_of(tree, source, weight, surface, new):
    """Before Blender 4, Subsurface is a factor of the radius and the share of another colour; since then, it is a share of it all."""
    if new:
        colour, size, ior = tree.field(source, "Base Color"), tree.field(source, "Subsurface Scale"), "IOR"
        if "Subsurface IOR" in source.node.inputs and source.node.inputs["Subsurface IOR"].enabled:
            ior = "Subsurface IOR"
    else:
        colour = total(product(tree.field(source, "Subsurface Color"), weight),
                       product(tree.field(source, "Base Color"), complement(weight)))
        size, ior = weight, "Subsurface IOR"
    inside = body(source.node, colour, product(tree.field(source, "Subsurface Radius"), size),
                  tree.number(source, "Subsurface Anisotropy"), tree.number(source, ior), surface.plain["float eta"],
                  surface.fields["roughness"])
    relief = {key: value for key, value in surface.plain.items() if key in tree.relief(source)}
    return Shader(inside.kind, inside.fields, inside.plain | relief)


def of_surface(tree, source, name, new):
    get = lambda each: tree.field(source, name[each])
    transmission, colour, eta = get("transmission"), get("basecolor"), max(tree.number(source, "IOR"), 1.0)
    if not new and is_one(transmission):
        colour = product(colour, colour)  # it colours each boundary, dspm's root does
    eta, specular = gloss(tree, source, get("specular"), transmission, eta, new)
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


def gloss(tree, source, level, transmission, eta, new):
    """(eta, specular): dspm's opaque part mirrors specular <= 1 times what eta does, and its glass what eta does."""
    of_one = 2 * straight_on(eta) if new else 0.08  # what the opaque part mirrors straight on where the level is 1
    most = float(luminance(level.values).max())
    if is_zero(transmission):  # animated materials keep their eta
        eta = index(min(max(of_one * (1 if tree.animated else most), straight_on(eta) if new else 0.04), 0.9))
    share = of_one / max(straight_on(eta), 1e-6)
    if share * most > 1.0001 and not is_one(transmission):
        tree.note(source, "its opaque part mirrors no more than its IOR does")
    return eta, level if share == 1 and most <= 1 else level.with_values(np.minimum(level.values * share, 1))


def straight_on(eta):
    """The share of light that is mirrored there."""
    return ((eta - 1) / (eta + 1)) ** 2


def index(mirrored):
    """Of refraction, that mirrors this straight on."""
    return round(2 / (1 - mirrored ** 0.5) - 1, 6)


def sheen(tree, source, new):
    if new:
        return product(tree.field(source, "Sheen Tint"), tree.field(source, "Sheen Weight"))
    return tree.field(source, "Sheen")


def scaled(field, factor):
    return field if factor == 1 else product(field, Field.of(factor))
