"""Where a test of the Python module finds the module and the sources, and what it needs besides."""

import importlib.util
import pathlib
import sys

BUILD, SOURCE = (pathlib.Path(path) for path in sys.argv[1:3])
sys.path.insert(0, str(BUILD / "python"))


def need(module, package):
    if importlib.util.find_spec(module) is None:
        print(f"SKIPPED: no {module} for this Python ({package})")
        sys.exit(77)
