"""Axes of variations: alternatives of a material, and collections of which one is shown."""
import re

import bpy

from .blocks import indented
from .directive import quoted


def choice_name(name):
    """Images are named after it."""
    return re.sub(r'[/\\:*?"<>|]', "_", name)


class Variations:
    """Those that the panels mark; none if they are not wanted, as what is rendered in Blender is as it is there."""

    def __init__(self, wanted):
        self.collections = [each for each in bpy.data.collections if each.dspm.axis] if wanted else []
        self.wanted = wanted
        self.blocks = {thing.name_full: each.name for each in self.collections for thing in each.all_objects}

    def block(self, instance):
        """The collection that an instance comes and goes with, or None."""
        return self.blocks.get((instance.parent if instance.is_instance else instance.object).name_full)

    def see(self, frame, materials):
        """Alternatives are materials of the scene, too, for what they refer to."""
        for base in self._varied(materials):
            for alternative in base.dspm.materials():
                materials.see(frame, alternative)

    def lines(self, materials):
        axes = {}
        for base in self._varied(materials):
            choices = axes.setdefault(base.dspm.axis or base.name, [(base.name, [])])
            choices += [(each.name, [materials.replacement(each.name_full, base.name_full)]) for each in base.dspm.materials()]
        for each in self.collections:
            axes.setdefault(each.dspm.axis, []).append((each.name, [f"Show {quoted(each.name)}"]))
        for axis, choices in axes.items():
            yield f"AxisBegin {quoted(choice_name(axis))}"
            for name, lines in choices if len(choices) > 1 else [*choices, (f"no {choices[0][0]}", [])]:
                yield from indented([f"VariationBegin {quoted(choice_name(name))}", *indented(lines), "VariationEnd"])
            yield "AxisEnd"

    def _varied(self, materials):
        named = [bpy.data.materials.get(name) for name in list(materials.states)] if self.wanted else []
        return [each for each in named if each and each.dspm.materials()]

