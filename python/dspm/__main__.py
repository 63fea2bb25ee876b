"""python -m dspm scene.dsc: the program, as if it had been called by its name."""

import os
import pathlib
import shutil
import sys


def program():
    folders = pathlib.Path(__file__).resolve().parents
    in_wheel, built, installed = folders[0] / "bin/dspm", folders[2] / "dspm", folders[4] / "bin/dspm"
    return next((str(file) for file in (in_wheel, built, installed) if file.is_file()), shutil.which("dspm"))


def main():
    found = program()
    if found is None:
        sys.exit("dspm: the program is neither in the build of this module nor on the PATH")
    os.execv(found, [found, *sys.argv[1:]])


if __name__ == "__main__":
    main()
