"""Blender's light groups. The language has letters, digits, - and _ in their names."""
import re


def group_name(name):
    return re.sub(r"[^A-Za-z0-9_-]", "_", name)


def light_group(owner):
    """The parameter of a light of an object or a world."""
    name = getattr(owner, "lightgroup", "")
    return {"string group": group_name(name)} if name else {}
