"""python -m dspm scene.dsc: the program, as if it had been called by its name."""

import os
import pathlib
import shutil
import sys


# In a wheel, in the build, in an unpacked tarball, and installed: so many folders up, and from there.
PLACES = [(0, "bin/dspm"), (2, "dspm"), (2, "bin/dspm"), (4, "bin/dspm")]


def program():
    folders = pathlib.Path(__file__).resolve().parents
    files = [folders[up] / name for up, name in PLACES if up < len(folders)]
    return next((str(file) for file in files if file.is_file()), shutil.which("dspm"))


def main():
    found = program()
    if found is None:
        sys.exit("dspm: the program is neither in the build of this module nor on the PATH")
    os.execv(found, [found, *sys.argv[1:]])


if __name__ == "__main__":
    main()
