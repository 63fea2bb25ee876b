"""The world: a colour or a picture around the scene."""
import os

from mathutils import Euler, Matrix

from .blocks import matrix_text
from .colours import Colours
from .directive import Directive, over_frames, quoted
from .image_fields import file_of, is_missing, is_plain, missing, pixels
from .light_groups import light_group
from .links import LinkedSocket
from .textures import file_name
from .volumes import Volume, VolumeTree
from .write_pfm import write_pfm


class World:
    def __init__(self, folder, notes):
        self.folder, self.notes, self.states, self.turn = folder, notes, [], None
        self.volume, self.media = Volume(), []  # what fills all space in the latest frame, and (frame, directive) pairs

    def see(self, frame, world):
        if world is None:
            return
        if world.original.animation_data or (world.node_tree and world.original.node_tree.animation_data) or not (self.states or self.media):
            self._see_volume(frame, world)
            directive = self._directive(world)
            if directive:
                self.states.append((frame, directive))

    def medium(self):
        """The name of what fills all space."""
        return "world" if self.media else ""

    def medium_lines(self):
        """Before the camera, which is in it."""
        return [over_frames(self.media, self.notes), f"MediumInterface {quoted(self.medium())}"] if self.media else []

    def _see_volume(self, frame, world):
        output = world.node_tree.get_output_node("CYCLES") if world.use_nodes else None
        volume = output and VolumeTree(f'world "{world.name}"', self.notes).of(LinkedSocket(output.inputs["Volume"]))
        if volume:
            self.volume = volume
            self.media.append((frame, Directive("MakeNamedMedium", "world").with_params(volume.params())))

    def lines(self):
        if all(not any(state.params.get("rgb L", [1])) for _, state in self.states):
            return []
        turn = [matrix_text("ConcatTransform", self.turn)] if self.turn else []
        return ["AttributeBegin", *(f"  {line}" for line in [*turn, over_frames(self.states, self.notes)]), "AttributeEnd"]

    def _directive(self, world):
        light = Directive("LightSource", "infinite").with_params({"string name": world.name, **light_group(world)})
        if not world.use_nodes:
            return light.with_params({"rgb L": list(world.color)})
        output = world.node_tree.get_output_node("CYCLES")
        source = LinkedSocket(output.inputs["Surface"]).source() if output else None
        if source is None:
            return None
        if source.node.bl_idname != "ShaderNodeBackground":
            self.notes.add(f'world "{world.name}", node "{source.node.name}": {source.node.bl_label} is left out')
            return None
        colours = Colours(self.notes, f'world "{world.name}"')
        strength = colours.of(source.input("Strength")).mean().number()
        picture = source.input("Color").source()
        if picture and picture.node.bl_idname == "ShaderNodeTexEnvironment":
            if is_missing(picture.node.image):
                self.notes.add(f"{colours.named(picture.node)}: {missing(picture.node.image)}")
                return light.with_params({"rgb L": [strength, 0.0, strength]})
            return light.with_params(self._picture(world, picture, colours) | {"float scale": strength})
        colour = [each * strength for each in colours.of(source.input("Color")).mean().colour()]
        return light.with_params({"rgb L": colour})

    def _picture(self, world, source, colours):
        node = source.node
        if node.projection != "EQUIRECTANGULAR":
            self.notes.add(f"{colours.named(node)}: the picture is taken as latitude and longitude")
        self.turn = self._turn(world, source.input("Vector").source(), colours) @ FROM_LIGHT_SPACE
        file = file_of(node.image) if is_plain(node.image) else None
        if file:
            name = os.path.relpath(file, os.path.dirname(self.folder))
        else:
            name = f"{os.path.basename(self.folder)}/{file_name(node.image.name)}.pfm"
            os.makedirs(self.folder, exist_ok=True)
            write_pfm(os.path.join(self.folder, os.path.basename(name)), pixels(node.image)[..., :3])
        return {"string filename": name, "string mapping": "equirectangular"}

    def _turn(self, world, source, colours):
        """A Mapping turns the directions that are looked up, so the picture turns back."""
        if source is None or source.node.bl_idname != "ShaderNodeMapping":
            return Matrix.Identity(4)
        angles = colours.of(source.input("Rotation")).mean().colour()
        turn = Euler(angles).to_matrix().to_4x4()
        return turn if source.node.vector_type == "TEXTURE" else turn.transposed()


# Of a direction (x, y, z), Blender's column is 1/2 - atan2(y, x) / (2 pi) and dspm's atan2(y, x) / (2 pi).
FROM_LIGHT_SPACE = Matrix.Diagonal((-1, 1, 1, 1))
