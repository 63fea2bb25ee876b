"""What materials ask of a mesh beside its first texture coordinates: another UV map, and the colours of its vertices."""


BAKED_UVS = "dspm baked"  # on which pictures of procedural textures lie


def shown_uvs(mesh):
    """The UV map that is marked for rendering."""
    return next((layer for layer in mesh.uv_layers if layer.active_render), None)


def second_uvs(mesh):
    """The first other one that a material's UV Map node names."""
    shown = shown_uvs(mesh)
    for name in asked_uvs(mesh):
        layer = mesh.uv_layers.get(name)
        if layer is not None and layer != shown:
            return layer
    return None


def colours(mesh):
    """The first attribute that a material's node names, or else the one that is marked for rendering."""
    attributes = getattr(mesh, "color_attributes", [])
    names = [*asked(mesh.materials, "ShaderNodeVertexColor", "layer_name"),
             *asked(mesh.materials, "ShaderNodeAttribute", "attribute_name")]
    for name in names:
        if name == "" and 0 <= attributes.render_color_index < len(attributes):
            return attributes[attributes.render_color_index]
        found = attributes.get(name)
        if found is not None:
            return found
    return None


def asked(materials, kind, attribute):
    """Names in nodes of that kind, in the order of materials."""
    return [getattr(node, attribute) for material in materials if material and material.node_tree
            for node in nodes(material.node_tree) if node.bl_idname == kind]


def nodes(tree):
    for node in tree.nodes:
        yield node
        if node.bl_idname == "ShaderNodeGroup" and node.node_tree:
            yield from nodes(node.node_tree)


def asked_uvs(mesh):
    """Pictures that were baked come first, as nothing can stand in for their map."""
    return [BAKED_UVS, *asked(mesh.materials, "ShaderNodeUVMap", "uv_map")]


def uv_set(name, meshes):
    """1 or 2: as which texture coordinates dspm knows the UV map of that name; None if meshes do not agree or it is a
    third one."""
    sets = set()
    for mesh in meshes:
        if name and name in mesh.uv_layers and name in asked_uvs(mesh):
            second = second_uvs(mesh)
            sets.add(1 if mesh.uv_layers[name] == shown_uvs(mesh) else 2 if second and second.name == name else None)
    return sets.pop() if len(sets) == 1 else None if sets else 1
