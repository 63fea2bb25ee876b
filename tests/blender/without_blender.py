#!/usr/bin/env python3
"""What of the add-on needs no Blender: its process. If Blender is killed, dspm saves its checkpoint and ends.
Exit code 77: numpy is missing.
usage: without_blender.py dspm"""
import importlib.util
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import types

ADDON = pathlib.Path(__file__).resolve().parents[2] / "tools/blender/dspm_blender"
SCENE = """Frames 2
Integrator "dsppm" "integer photons" 100
Camera "perspective" Film "rgb" "integer xresolution" 16 "integer yresolution" 12
WorldBegin LightSource "infinite" Translate 0 0 3 Shape "sphere" """


def modules():
    """Of the add-on, without what registers it in Blender."""
    package = types.ModuleType("dspm_blender")
    package.__path__ = [str(ADDON)]
    sys.modules["dspm_blender"] = package


def crash(program, scene):
    """Renders until there are pictures, and is killed."""
    modules()
    from dspm_blender.process import Run
    run = Run(program, scene, 2, ["--iterations", "1000000", "--checkpoint", scene + ".checkpoint"], 1)
    print(run.process.pid, flush=True)
    while run.written(2) is None:
        run.poll(0.1)
    os.kill(os.getpid(), signal.SIGKILL)


def is_alive(process):
    state = pathlib.Path(f"/proc/{process}/stat")
    return state.exists() and state.read_text().rsplit(")", 1)[1].split()[0] != "Z"


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        scene = os.path.join(folder, "scene.dsc")
        pathlib.Path(scene).write_text(SCENE)
        child = subprocess.run([sys.executable, __file__, "crash", program, scene], stdout=subprocess.PIPE, text=True)
        process, end = int(child.stdout), time.monotonic() + 30
        while is_alive(process) and time.monotonic() < end:
            time.sleep(0.05)
        if is_alive(process):
            os.kill(process, signal.SIGKILL)
            sys.exit("FAILED: dspm goes on without Blender")
        resumed = subprocess.run([program, scene, "--resume", scene + ".checkpoint", "--iterations", "1", "--progress", "json",
                                  "-o", os.path.join(folder, "again.####.exr")], capture_output=True, text=True)
        if resumed.returncode or '"event": "iteration"' in resumed.stderr:
            sys.exit(f"FAILED: its checkpoint does not go on where it was: {resumed.stderr}")
        print("dspm ends with Blender, and its checkpoint has all iterations")


if importlib.util.find_spec("numpy") is None:
    print("SKIPPED: needs the package python3-numpy")
    sys.exit(77)
if sys.argv[1] == "crash":
    crash(*sys.argv[2:])
else:
    main(os.path.abspath(sys.argv[1]))
