"""Where a prefix has the modules that this Python finds: a path relative to the prefix.
usage: modules_folder.py prefix"""
import os
import site
import sys

prefix = os.path.realpath(sys.argv[1])
folders = [os.path.realpath(each) for each in [*site.getsitepackages(), site.getusersitepackages()]]
inside = [os.path.relpath(each, prefix) for each in folders if each.startswith(os.path.join(prefix, ""))]
# /usr has those of /usr/local, too, which are another prefix's.
own = [each for each in inside if each.startswith("lib")]
if not own:
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    own = [f"lib/python{version}/site-packages"]
    print(f"dspm: {sys.executable} does not look for modules in {prefix}: PYTHONPATH={prefix}/{own[0]} makes it", file=sys.stderr)
print(own[0])
