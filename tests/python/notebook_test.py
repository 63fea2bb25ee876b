"""Runs the cells of docs/first_frames.ipynb, and looks at what they have found."""

import json
import os
import sys

from surroundings import SOURCE, need

need("matplotlib", "python3-matplotlib")

import matplotlib

try:
    import IPython  # noqa: F401
except ImportError:
    print("without IPython (python3-ipython), its HTML is a string here")
    import types

    sys.modules["IPython"] = types.ModuleType("IPython")
    sys.modules["IPython"].get_ipython = lambda: None
    sys.modules["IPython"].version_info = (0, 0)  # which matplotlib asks for
    sys.modules["IPython.display"] = types.ModuleType("IPython.display")
    sys.modules["IPython.display"].HTML = str
matplotlib.use("Agg")
os.chdir(SOURCE)

names = {}
for cell in json.loads((SOURCE / "docs/first_frames.ipynb").read_text())["cells"]:
    if cell["cell_type"] == "code":
        exec("".join(cell["source"]), names)

errors = names["errors"]
assert len(errors) == 12, errors
assert errors[-1] < 0.6 * errors[0], errors
assert names["statistics"]["photon segments"]["separate"] > names["statistics"]["photon segments"]["done"]
assert "<script" in names["film"].to_jshtml()
