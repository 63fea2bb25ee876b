"""Blender's Principled BSDF, of versions before 4 and since. dspm's parameters are explained in principled.cpp."""
import numpy as np

from .fields import Field, complement, is_one, is_zero, luminance, product, together, total
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
    coat, tint = of_coat(tree, source, get("coat"), new)
    fields = {"basecolor": product(colour, tint), "roughness": get("roughness"), "specular": specular}
    optional = {"metallic": get("metallic"), "transmission": transmission, "anisotropy": get("anisotropy"),
                "coat": coat, "sheen": sheen(tree, source, new)}
    fields |= {each: value for each, value in optional.items() if tree.animated or not is_zero(value)}
    glint = product(specular_tint(tree, source, new), tint)
    if tree.animated or not is_one(glint):
        fields["specularcolor"] = glint
    if "coat" in fields:
        fields["coatroughness"] = get("coatroughness")
    if new and "sheen" in fields:
        fields["sheenroughness"] = tree.field(source, "Sheen Roughness")
    if "anisotropy" in fields:
        fields["anisotropyrotation"] = scaled(tree.field(source, "Anisotropic Rotation"), 360)
    film, plain = thin_film(tree, source)
    light = product(get("emission"), tree.field(source, "Emission Strength"), tint)
    note_lacks(tree, source, transmission)
    return Shader("principled", fields | film, {"float eta": eta} | plain | tree.relief(source), get("alpha"), light)


def of_coat(tree, source, weight, new):
    """(its share of dspm's coat, which has an index of 1.5, and what passes it, straight on)."""
    if not new:
        return scaled(weight, 0.25), Field.of(1)
    if is_zero(weight) and not tree.animated:
        return weight, Field.of(1)
    share = straight_on(tree.number(source, "Coat IOR")) / straight_on(1.5)
    if abs(share - 1) > 1e-3:
        tree.note(source, "its coat has an index of 1.5, and covers as much as mirrors the same straight on")
    coat = weight.with_values(np.minimum(weight.values * share, 1)) if abs(share - 1) > 1e-3 else weight
    absorbed = product(weight, complement(tree.field(source, "Coat Tint")))
    if is_zero(absorbed):
        return coat, Field.of(1)
    tree.note(source, "its coat colours what is below as it does straight on")
    return coat, complement(absorbed)


def specular_tint(tree, source, new):
    """Of what the opaque dielectric mirrors, straight on."""
    tint = tree.field(source, "Specular Tint")
    if not new:
        return hue_by(tree.field(source, "Base Color"), tint)
    if not is_one(tint) and not is_zero(tree.field(source, "Metallic")):
        tree.note(source, "its metal has no tint at grazing angles")
    return tint


def hue_by(colour, share):
    """White, or the colour's hue for that share of it: the tints before Blender 4."""
    if is_zero(share):
        return Field.of(1)
    (values, shares), leader = together([colour, share])
    hue = values / np.maximum(luminance(values), 1e-6)[..., None]
    return leader.with_values(1 + shares * (hue - 1))


def thin_film(tree, source):
    """(fields, plain parameters) since Blender 4.2; it is on dielectrics only."""
    if "Thin Film Thickness" not in source.node.inputs:
        return {}, {}
    thickness = tree.field(source, "Thin Film Thickness")
    if is_zero(thickness) and not tree.animated:
        return {}, {}
    covered = Field.of(0) if is_zero(thickness) else complement(tree.field(source, "Metallic"))
    return ({"iridescence": covered, "iridescencethickness": thickness},
            {"float iridescenceeta": max(tree.number(source, "Thin Film IOR"), 1.0)})


def note_lacks(tree, source, transmission):
    inputs = source.node.inputs
    if "Diffuse Roughness" in inputs and not is_zero(tree.field(source, "Diffuse Roughness")):
        tree.note(source, "its ground is Lambert's, without diffuse roughness")
    if "Transmission Roughness" in inputs and not is_zero(transmission) and not is_zero(tree.field(source, "Transmission Roughness")):
        tree.note(source, "what passes is as rough as what is mirrored")
    for name in ("Coat Normal", "Clearcoat Normal", "Tangent"):
        if name in inputs and source.input(name).source():
            tree.note(source, f"its {name} is left out")


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
    return product(tree.field(source, "Sheen"), hue_by(tree.field(source, "Base Color"), tree.field(source, "Sheen Tint")))


def scaled(field, factor):
    return field if factor == 1 else product(field, Field.of(factor))
