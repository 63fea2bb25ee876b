"""What materials and collections say about variations, and the panels that ask for it."""
import bpy


class Alternative(bpy.types.PropertyGroup):
    material: bpy.props.PointerProperty(type=bpy.types.Material)


class MaterialVariations(bpy.types.PropertyGroup):
    axis: bpy.props.StringProperty(name="Axis", description="Name of this choice; empty: the material's")
    alternatives: bpy.props.CollectionProperty(type=Alternative)

    def materials(self):
        return [each.material for each in self.alternatives if each.material]


class CollectionVariations(bpy.types.PropertyGroup):
    axis: bpy.props.StringProperty(
        name="Axis", description="Of the collections with this axis, each variation shows one; empty: it is always there")


class AddAlternative(bpy.types.Operator):
    """Another material that this one can be replaced by"""
    bl_idname, bl_label = "dspm.add_alternative", "Add Alternative"

    def execute(self, context):
        context.material.dspm.alternatives.add()
        return {"FINISHED"}


class RemoveAlternative(bpy.types.Operator):
    """This material is no alternative any more"""
    bl_idname, bl_label = "dspm.remove_alternative", "Remove Alternative"
    index: bpy.props.IntProperty()

    def execute(self, context):
        context.material.dspm.alternatives.remove(self.index)
        return {"FINISHED"}


class MaterialPanel(bpy.types.Panel):
    bl_label, bl_idname = "dspm Variations", "DSPM_PT_material_variations"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "material"

    @classmethod
    def poll(cls, context):
        return context.material is not None

    def draw(self, context):
        layout, variations = self.layout, context.material.dspm
        layout.prop(variations, "axis")
        for index, alternative in enumerate(variations.alternatives):
            row = layout.row(align=True)
            row.prop(alternative, "material", text="")
            row.operator(RemoveAlternative.bl_idname, text="", icon="X").index = index
        layout.operator(AddAlternative.bl_idname, icon="ADD")


class CollectionPanel(bpy.types.Panel):
    bl_label, bl_idname = "dspm Variations", "DSPM_PT_collection_variations"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "collection"

    def draw(self, context):
        self.layout.prop(context.collection.dspm, "axis")


CLASSES = (Alternative, MaterialVariations, CollectionVariations, AddAlternative, RemoveAlternative, MaterialPanel,
           CollectionPanel)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Material.dspm = bpy.props.PointerProperty(type=MaterialVariations)
    bpy.types.Collection.dspm = bpy.props.PointerProperty(type=CollectionVariations)


def unregister():
    del bpy.types.Collection.dspm, bpy.types.Material.dspm
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
