"""The types of _dspm for editors and type checkers, read from the module itself. Prints _dspm.pyi.
usage: stubs.py folder-of-the-package's-folder"""
import importlib.util
import inspect
import pathlib
import re
import sys

HEAD = '''"""What libdspm does for Python."""
from os import PathLike
from pathlib import Path
from typing import Any, Optional, Union

import numpy
from numpy.typing import ArrayLike

'''
# pybind11's words, and Python's: of all, of what functions take, and of what they return.
WORDS = ((r"dspm\._dspm\.|_dspm\.", ""), (r"\bDict\b", "dict"), (r"\bList\b", "list"), (r"\bTuple\b", "tuple"), (r"\bobject\b", "Any"),
         (r"\bself: \w+", "self"))
TAKEN = ((r"numpy\.ndarray(\[[^][]*\])?", "ArrayLike"), (r"os\.PathLike", "Union[str, PathLike[str]]"))
RETURNED = ((r"numpy\.ndarray(\[[^][]*\])?", "numpy.ndarray"), (r"os\.PathLike", "Path"))


def module_in(folder):
    """Without the package around it, which may want numpy."""
    file = next(pathlib.Path(folder, "dspm").glob("_dspm*.so"))
    spec = importlib.util.spec_from_file_location("_dspm", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def in_python(text, words):
    for pattern, word in (*words, *WORDS):
        text = re.sub(pattern, word, text)
    return text


def parted(doc, name):
    """(signature, sentences) of what pybind11 says of a function."""
    first, _, rest = (doc or "").partition("\n")
    found = re.match(rf"{re.escape(name)}(\(.*) *$", first)
    taken, arrow, returned = found[1].partition(" -> ")
    return in_python(taken, TAKEN) + arrow + in_python(returned, RETURNED), rest.strip()


def quoted(doc, indent):
    lines = doc.replace("\\", "\\\\").splitlines()
    return '"""' + "\n".join([lines[0], *(indent + line if line else "" for line in lines[1:])]) + '"""'


def function(name, doc, indent):
    signature, sentences = parted(doc, name)
    if not sentences:
        yield f"{indent}def {name}{signature}: ..."
        return
    yield f"{indent}def {name}{signature}:"
    yield f"{indent}    {quoted(sentences, indent + '    ')}"


def property_of(name, each, indent):
    """pybind11 tells the type of what its function returns, if it knows it."""
    returned = re.search(r"-> (.*)$", each.fget.__doc__.partition("\n")[0])
    yield f"{indent}@property"
    yield f"{indent}def {name}(self) -> {in_python(returned[1], RETURNED)}:"
    yield f"{indent}    {quoted(each.__doc__.strip(), indent + '    ')}"


def class_of(name, each):
    base = "ValueError" if issubclass(each, ValueError) else ""
    yield f"class {name}{f'({base})' if base else ''}:"
    yield f"    {quoted(inspect.cleandoc(each.__doc__), '    ')}"
    for member, value in sorted(vars(each).items()):
        if isinstance(value, property):
            yield from property_of(member, value, "    ")
        elif callable(value) and (value.__doc__ or "").startswith(f"{member}(") and (
                member in {"__init__", "__len__"} or not member.startswith("_")):
            yield from function(member, value.__doc__, "    ")
    yield ""


def stubs(module):
    yield "__version__: str"
    yield ""
    for name, each in sorted(vars(module).items()):
        if inspect.isclass(each):
            yield from class_of(name, each)
    for name, each in sorted(vars(module).items()):
        if inspect.isroutine(each):
            yield from function(name, each.__doc__, "")


print(HEAD + "\n".join(stubs(module_in(sys.argv[1]))))
