#!/usr/bin/env python3
"""The add-on in Debian's Blender. Exit code 77: blender, or numpy for its Python, is missing.
usage: run.py dspm script [arguments of the script in Blender]"""
import os, pathlib, shutil, subprocess, sys, tempfile

blender = shutil.which("blender")
command = [blender, "-b", "--factory-startup", "--python-exit-code", "1"]
environment = os.environ | {"PATH": f"/usr/bin:{os.environ['PATH']}"}  # Blender's Python is that of the first python3
if not blender or subprocess.run([*command, "--python-expr", "import numpy"], env=environment, capture_output=True).returncode:
    print("SKIPPED: needs the packages blender and python3-numpy")
    sys.exit(77)

program, script = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(__file__).with_name(sys.argv[2])
with tempfile.TemporaryDirectory() as folder:
    environment |= {"BLENDER_USER_CONFIG": folder, "BLENDER_USER_SCRIPTS": folder}
    run = subprocess.run([*command, "--python", str(script), "--", str(program), folder, *sys.argv[3:]],
                         env=environment, capture_output=True, text=True)
noise = ("Fra:", "Saved:", " Time:", "Blender ")
print("\n".join(line for line in run.stdout.splitlines() if line and not line.startswith(noise)))
print(run.stderr, end="", file=sys.stderr)
sys.exit(run.returncode)
