"""Normal maps and bumps as parameters of a material."""
from .fields import Place
from .links import LinkedSocket


def relief(tree, socket):
    """Of what enters a Normal input."""
    source = socket.source()
    if source is None:
        return {}
    kind = source.node.bl_idname
    if kind == "ShaderNodeNormalMap":
        return normal_map(tree, source)
    if kind == "ShaderNodeBump":
        if source.input("Normal").source():
            tree.note(source, "a normal map below a bump is left out")
        sign = -1 if source.node.invert else 1
        return bump(tree, source, sign * tree.number(source, "Strength") * tree.number(source, "Distance"))
    tree.note(source, f"normals of {source.node.bl_label} are left out")
    return {}


def normal_map(tree, source):
    field = tree.field(source, "Color")
    if field.is_constant():
        return {}
    if source.node.space != "TANGENT":
        tree.note(source, "normals are taken along the surface")
    if (field.place.scale, field.place.offset, field.place.rotation) != (Place.scale, Place.offset, Place.rotation):
        tree.note(source, "normal maps cover the texture coordinates once")
    file, _ = tree.textures.picture(field, f"{tree.name}, normals")
    return {"string normalmap": file, "float normalscale": tree.number(source, "Strength")}


def bump(tree, source, factor):
    height = tree.field(source, "Height")
    if height.is_constant() or factor == 0:
        return {}
    name = next(iter(tree.textures.number("", height, f"{tree.name}, height").values()))
    return {"texture displacement": tree.textures.scaled(name, factor, f"{name}, scaled")}


def displacement(tree, output):
    """Of a material's Displacement: its surface shows it, but stays where it is."""
    source = LinkedSocket(output.inputs["Displacement"]).source()
    if source is None:
        return {}
    if source.node.bl_idname != "ShaderNodeDisplacement":
        tree.note(source, f"{source.node.bl_label} is left out")
        return {}
    tree.note(source, "the surface is shaded as if it were displaced, and stays where it is")
    return bump(tree, source, tree.number(source, "Scale"))
