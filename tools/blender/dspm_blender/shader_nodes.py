"""Each shader node and what stands for it."""
from dataclasses import replace

from .fields import Field, complement, is_one, is_zero, product, together, total
from .principled_node import principled
from .shader import HOLE, Shader, black, diffuse
from .subsurface import body


def diffuse_node(tree, source):
    if not is_zero(tree.field(source, "Roughness")):
        tree.note(source, "is Lambert's, without roughness")
    return replace(diffuse(tree.field(source, "Color")), plain=tree.relief(source))


def glossy(tree, source):
    return Shader("principled", {"basecolor": tree.field(source, "Color"), "metallic": Field.of(1),
                                 "roughness": tree.field(source, "Roughness")}, tree.relief(source))


def anisotropic(tree, source):
    shader = glossy(tree, source)
    return replace(shader, fields=shader.fields | {"anisotropy": tree.field(source, "Anisotropy"),
                                                   "anisotropyrotation": turned(tree, source)})


def metallic(tree, source):
    """Since Blender 4.3."""
    if source.node.fresnel_type == "PHYSICAL_CONDUCTOR" and is_zero(tree.field(source, "Anisotropy")):
        rough = tree.field(source, "Roughness")
        return Shader("conductor", {"eta": tree.field(source, "IOR"), "k": tree.field(source, "Extinction"),
                                    "roughness": product(rough, rough)}, {"bool remaproughness": False} | tree.relief(source))
    if source.node.fresnel_type == "PHYSICAL_CONDUCTOR":
        tree.note(source, "its colour is what it mirrors straight on")
        colour = mirrored_straight_on(tree.field(source, "IOR"), tree.field(source, "Extinction"))
    else:
        colour = tree.field(source, "Base Color")
        if not is_one(tree.field(source, "Edge Tint")):
            tree.note(source, "it mirrors white at grazing angles")
    return Shader("principled", {"basecolor": colour, "metallic": Field.of(1), "roughness": tree.field(source, "Roughness"),
                                 "anisotropy": tree.field(source, "Anisotropy"),
                                 "anisotropyrotation": turned(tree, source)}, tree.relief(source))


def mirrored_straight_on(eta, k):
    (n, k), leader = together([eta, k])
    return leader.with_values(((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2))


def turned(tree, source):
    """In degrees."""
    turn = tree.field(source, "Rotation")
    return turn.with_values(turn.values * 360)


def glass(tree, source):
    """Cycles colours what passes each boundary; principled takes the root of basecolor there."""
    colour, roughness, eta = tree.field(source, "Color"), tree.field(source, "Roughness"), tree.number(source, "IOR")
    if is_one(colour) and roughness.is_constant():
        return Shader("dielectric", {}, {"float eta": eta, "float roughness": roughness.number() ** 2,
                                         "bool remaproughness": False} | tree.relief(source))
    return Shader("principled", {"basecolor": product(colour, colour), "roughness": roughness, "transmission": Field.of(1)},
                  {"float eta": eta} | tree.relief(source))


def refraction(tree, source):
    tree.note(source, "also mirrors, as glass does")
    return glass(tree, source)


def translucent(tree, source):
    return Shader("diffusetransmission", {"reflectance": Field.of(0), "transmittance": tree.field(source, "Color")},
                  tree.relief(source))


def transparent(tree, source):
    colour = tree.field(source, "Color")
    if is_one(colour):
        return HOLE
    return Shader("thindielectric", {"tint": colour}, {"float eta": 1.0})


def velvet(tree, source):
    """Velvet, and Sheen, which took its place."""
    fields = {"basecolor": Field.of(0), "specular": Field.of(0), "sheen": tree.field(source, "Color")}
    if "Roughness" in source.node.inputs:
        fields["sheenroughness"] = tree.field(source, "Roughness")
    return Shader("principled", fields)


def subsurface(tree, source):
    """Its surface mirrors nothing."""
    radius = product(tree.field(source, "Radius"), tree.field(source, "Scale"))
    inside = body(source.node, tree.field(source, "Color"), radius, tree.number(source, "Anisotropy"),
                  tree.number(source, "IOR"), 1.0, Field.of(0))
    return replace(inside, plain=inside.plain | tree.relief(source))


def emission(tree, source):
    return black(product(tree.field(source, "Color"), tree.field(source, "Strength")))


def hair(tree, source):
    return Shader("hair", {"reflectance": tree.field(source, "Color")})


def mix(tree, source):
    first, second = (tree.of(source.input(i)) for i in (1, 2))
    factor = source.input(0).source()
    if factor and factor.node.bl_idname in {"ShaderNodeFresnel", "ShaderNodeLayerWeight"}:
        return varnished(tree, source, factor, first, second)
    share = tree.field(source, 0)
    if not tree.animated and (is_zero(share) or is_one(share)):
        return second if is_one(share) else first
    if first.is_hole() or second.is_hole():
        return second.with_holes(share) if first.is_hole() else first.with_holes(complement(share))
    if first.shines_only() or second.shines_only():
        lamp, other, its = (first, second, complement(share)) if first.shines_only() else (second, first, share)
        return shining(tree, source, other.dimmed(complement(its)), product(lamp.emission, its))
    return Shader("mix", {"amount": share}, {"string materials": [tree.part(first), tree.part(second)]})


def varnished(tree, source, factor, first, second):
    """A gloss that grows at grazing angles over something: principled has that itself."""
    base = first.principled()
    if base is None or second.kind != "principled" or "roughness" not in second.fields:
        tree.note(source, "a tenth of the second shader stands in for a share by angle")
        return Shader("mix", {"amount": Field.of(0.1)}, {"string materials": [tree.part(first), tree.part(second)]})
    tree.note(source, "principled stands in for a gloss by angle")
    eta = tree.number(factor, "IOR") if factor.node.bl_idname == "ShaderNodeFresnel" else 1.5
    gloss = {"roughness": second.fields["roughness"], "specular": Field.of(1)}
    return replace(base, fields=base.fields | gloss, plain=base.plain | {"float eta": max(eta, 1.0)})


def add(tree, source):
    first, second = (tree.of(source.input(i)) for i in (0, 1))
    for lamp, other in ((first, second), (second, first)):
        if lamp.shines_only() and not lamp.is_hole():
            return shining(tree, source, other, lamp.emission)
    tree.note(source, "half of each shader stands in for their sum")
    return Shader("mix", {"amount": Field.of(0.5)}, {"string materials": [tree.part(first), tree.part(second)]})


def shining(tree, source, shader, light):
    base = shader.principled()
    if base is None:
        tree.note(source, f"{shader.kind} does not emit")
        return shader
    return replace(base, emission=total(base.emission, light))


SHADERS = {
    "ShaderNodeBsdfPrincipled": principled, "ShaderNodeBsdfDiffuse": diffuse_node, "ShaderNodeBsdfGlossy": glossy,
    "ShaderNodeBsdfAnisotropic": anisotropic, "ShaderNodeBsdfMetallic": metallic, "ShaderNodeBsdfGlass": glass, "ShaderNodeBsdfRefraction": refraction,
    "ShaderNodeBsdfTranslucent": translucent, "ShaderNodeBsdfTransparent": transparent, "ShaderNodeBsdfVelvet": velvet,
    "ShaderNodeBsdfSheen": velvet, "ShaderNodeSubsurfaceScattering": subsurface, "ShaderNodeEmission": emission,
    "ShaderNodeBsdfHair": hair, "ShaderNodeBsdfHairPrincipled": hair, "ShaderNodeMixShader": mix, "ShaderNodeAddShader": add,
}
