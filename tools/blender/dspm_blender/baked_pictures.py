"""Pictures that stand for what nodes compute from places. A picture stays with its node, as the property PREFIX + the output's
identifier, so whatever reads the node finds it there. They lie on the UV map layers.BAKED_UVS."""
from .links import LinkedSocket

PREFIX = "dspm "
TEXTURES = {"ShaderNodeTexNoise", "ShaderNodeTexVoronoi", "ShaderNodeTexMusgrave", "ShaderNodeTexWave", "ShaderNodeTexMagic",
            "ShaderNodeTexBrick", "ShaderNodeTexChecker", "ShaderNodeTexGradient", "ShaderNodeTexWhiteNoise",
            "ShaderNodeTexGabor"}  # Musgrave until Blender 4.0, Gabor since 4.3
PLACES = {"Generated", "Object", "UV"}  # of Texture Coordinate


def picture_of(source):
    """The picture of an output, or None."""
    return source.node.get(PREFIX + source.socket.identifier)


def is_of_places(node, output):
    """Does it depend on where on the surface it is asked, in a way that is no picture on UVs already?"""
    if node.bl_idname == "ShaderNodeTexCoord":
        return output.name in PLACES
    if node.bl_idname == "ShaderNodeTexImage":
        return node.image is not None and (node.projection != "FLAT" or not is_on_uvs(LinkedSocket(node.inputs["Vector"])))
    if node.bl_idname in {"ShaderNodeMapping", "ShaderNodeVectorMath"}:
        return any(socket.is_linked for socket in node.inputs)
    return node.bl_idname in TEXTURES


def is_on_uvs(socket):
    """Do these coordinates place pictures as `colours.placement` can say?"""
    source = socket.source()
    if source is None or source.node.bl_idname == "ShaderNodeUVMap":
        return True
    if source.node.bl_idname == "ShaderNodeMapping":
        return is_on_uvs(source.input("Vector"))
    return source.node.bl_idname == "ShaderNodeTexCoord" and source.socket.name == "UV"
