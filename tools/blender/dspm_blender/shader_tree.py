"""The shaders of one material: walks its nodes and writes its directives."""
from .colours import Colours
from .directive import Directive
from .fields import Field, is_one, is_zero
from .relief import relief
from .shader import COLOURS, black, diffuse
from .shader_nodes import SHADERS


class ShaderTree:
    def __init__(self, name, textures, notes, animated):
        """Of an animated material every parameter is written, as it may be in use in other frames."""
        self.name, self.textures, self.notes, self.animated = name, textures, notes, animated
        self.colours = Colours(notes, f'material "{name}"')
        self.parts = []  # directives of the materials that a mix names

    def of(self, socket):
        """The shader that enters a LinkedSocket."""
        source = socket.source()
        if source is None:
            return black()
        return SHADERS.get(source.node.bl_idname, unknown)(self, source)

    def field(self, source, name):
        return self.colours.of(source.input(name))

    def number(self, source, name):
        """Where textures cannot be."""
        value = self.field(source, name)
        if not value.is_constant():
            self.note(source, f"{name} is a texture; its mean stands in")
        return value.number()

    def note(self, source, text):
        self.notes.add(f"{self.colours.named(source.node)}: {text}")

    def relief(self, source):
        return relief(self, source.input("Normal"))

    def part(self, shader):
        """The name of a shader that is a part of a mix."""
        if not shader.is_plain():
            self.notes.add(f'material "{self.name}": a part of a mix neither emits nor has holes')
        name = f"{self.name}, part {len(self.parts) + 1}"
        self.parts.append(self._made(name, shader, alone=False))
        return name

    def directive(self, shader):
        return self._made(self.name, shader, alone=True)

    def _made(self, name, shader, alone):
        fields, plain = {}, {}
        if alone and (self.animated or not shader.is_plain()):
            able = shader.principled()
            if able is None and not shader.is_plain():
                self.notes.add(f'material "{name}": {shader.kind} neither emits nor has holes')
            if able:
                shader = able
                if self.animated or not is_one(shader.alpha):
                    fields["alpha"] = shader.alpha
                if self.animated or not is_zero(shader.emission):
                    fields["emission"], strength = normalized(shader.emission)
                    plain["float emissionstrength"] = strength
        if shader.kind == "black":
            shader = diffuse(Field.of(0))
        params = {"string type": shader.kind}
        for param, value in (shader.fields | fields).items():
            write = self.textures.colour if param in COLOURS else self.textures.number
            params |= write(param, value, f"{name}, {param}")
        return Directive("MakeNamedMaterial", name).with_params(params | shader.plain | plain)


def normalized(emission):
    """(colour of at most 1, strength)."""
    strength = max(float(emission.values[..., :3].max()), 1e-9)
    if strength <= 1:
        return emission, 1.0
    values = emission.values / strength
    return emission.with_values(values), strength


def unknown(tree, source):
    tree.note(source, f"{source.node.bl_label} is not known; grey stands in")
    return diffuse(Field.of(0.5))
