#!/usr/bin/env python3
"""--preview in terminals: what libsixel reads of its sixels, and what xterm and kitty show. Exit code 77: none of them is there.
With a folder as the second argument, screenshots stay there.
usage: terminals.py dspm [folder]"""
import base64, contextlib, fcntl, json, os, pathlib, pty, re, struct, subprocess, sys, termios, time

from support import Checks, is_there, np, program, read_png

PICTURE = ["--contact-sheet", "page.png"]
WIDE = ["--frames", "1", "--resolution", "1100x30"]  # wider than the 1000 pixels that xterm takes


def preview(folder, size, answer, words, term="xterm"):
    """What dspm prints in a terminal of this size (rows, columns, and their pixels) that answers so."""
    child, master = pty.fork()
    if child == 0:
        fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("4H", *size))
        os.chdir(folder)
        os.execve(program, [program, "tiny.dsc", "--preview", *words], os.environ | {"TERM": term})
    printed = b""
    with contextlib.suppress(OSError):  # the end of a terminal is an error
        while part := os.read(master, 65536):
            printed += part
            if printed.endswith(b"\x1b[c"):
                os.write(master, answer(printed))
    os.close(master)
    os.waitpid(child, 0)
    return printed


def as_sixel_terminal(printed):
    return (b"\x1b[?2;0;1000;1000S" if printed.endswith(b"\x1b[?2;4;0S\x1b[c") else b"") + b"\x1b[?63;1;2;4;22c"


def last_sixels(printed):
    return re.findall(rb"\x1bP.*?\x1b\\", printed, re.DOTALL)[-1]


def last_of_kitty(printed):
    commands = re.findall(rb"\x1b_G([^;\x1b]*);([^\x1b]*)\x1b\\", printed)
    begin = max(i for i, (head, _) in enumerate(commands) if b"a=T" in head)
    return read_png(base64.b64decode(b"".join(payload for _, payload in commands[begin:])))


def page_of(checks):
    return read_png((checks.folder / "page.png").read_bytes())


class Screen:
    """An X server whose screen lies in a file, as xwd writes it."""

    def __init__(self, folder):
        self.folder = folder
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x900x24", "-nolisten", "tcp", "-fbdir", folder],
                                       pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.display = ":" + number.readline().strip()

    def pixels(self):
        data = (self.folder / "Xvfb_screen0").read_bytes()
        head = struct.unpack(">25I", data[:100])
        size, width, height, row, colours = head[0], head[4], head[5], head[12], head[19]
        rows = np.frombuffer(data, np.uint8, height * row, size + 12 * colours).reshape(height, row // 4, 4)
        return rows[:, :width, 2::-1].astype(int)

    def of(self, terminal, words, finds):
        """The size and the screen of a terminal in which dspm has run, once `finds` has found something on it, or after a while."""
        begun, go = self.folder / "shown", self.folder / "go"
        environment = os.environ | {"DISPLAY": self.display, "LIBGL_ALWAYS_SOFTWARE": "1", "HOME": str(self.folder)}
        run = subprocess.Popen([*terminal, sys.executable, os.path.abspath(__file__), str(program), "--inside", str(self.folder), *words],
                               env=environment, stderr=subprocess.DEVNULL)
        end = time.monotonic() + 60
        while time.monotonic() < end and run.poll() is None and not begun.exists():
            time.sleep(0.05)
        size, patience = json.loads(begun.read_text()), time.monotonic() + 10
        while not finds(size, self.pixels()) and time.monotonic() < patience:
            time.sleep(0.1)
        pixels = self.pixels()
        go.touch()
        run.wait()
        begun.unlink(), go.unlink()
        return size, pixels

    def close(self):
        self.server.terminate()
        self.server.wait()


def inside(folder, words):
    """Runs in the terminal."""
    with open("/dev/tty", "r+b", buffering=0) as terminal:
        size = struct.unpack("4H", fcntl.ioctl(terminal, termios.TIOCGWINSZ, bytes(8)))
        subprocess.run([program, "tiny.dsc", "--preview", *words], cwd=folder, stdout=terminal, stderr=terminal)
    part = pathlib.Path(folder, "part")
    part.write_text(json.dumps(size))
    part.rename(pathlib.Path(folder, "shown"))
    while not pathlib.Path(folder, "go").exists():
        time.sleep(0.05)


def shows(screen, picture, tolerance):
    """Whether the picture stands somewhere on the screen, pixel by pixel."""
    height, width = picture.shape[:2]
    places = np.argwhere(np.ones((screen.shape[0] - height + 1, screen.shape[1] - width + 1)))
    for y, x in np.random.default_rng(1).permutation(np.argwhere(np.ones((height, width)))):
        apart = np.abs(screen[places[:, 0] + y, places[:, 1] + x] - picture[y, x])
        places = places[(apart <= tolerance).all(axis=1)]
        if len(places) == 0:
            return False
    return True


def keep(name, pixels):
    if len(sys.argv) > 2:
        np.save(os.path.join(sys.argv[2], name), pixels.astype(np.uint8))


def check_protocols(checks):
    size = (40, 100, 1000, 800)
    printed = preview(checks.folder, size, lambda _: b"\x1b_Gi=31;OK\x1b\\\x1b[?62;c", PICTURE, "xterm-kitty")
    checks.expect(np.array_equal(last_of_kitty(printed), page_of(checks)), "kitty gets the contact sheet")
    printed = preview(checks.folder, size, lambda _: b"\x1b[?1;2c", PICTURE, "tmux-256color")
    checks.expect(b"shows nothing: this terminal knows neither" in printed and b"\x1b_G" not in printed, "tmux is told that it shows nothing")
    if is_there("sixel2png", "libsixel-bin"):
        printed = preview(checks.folder, size, as_sixel_terminal, PICTURE)
        seen, page = read_png(checks.run("sixel2png", input=last_sixels(printed)))[..., :3], page_of(checks)
        checks.expect(seen.shape == page.shape and np.abs(seen - page).max() <= 51, "each pixel has one of the two nearest colours of the palette")
        checks.expect(np.abs(seen.mean((0, 1)) - page.mean((0, 1))).max() < 4, "dithering keeps the mean")


def check_xterm(checks, screen):
    def wanted(size):
        if size not in sheets:
            sixels = last_sixels(preview(checks.folder, size, as_sixel_terminal, WIDE))
            sheets[size] = read_png(checks.run("sixel2png", input=sixels))[..., :3]
        return sheets[size]
    sheets = {}
    size, seen = screen.of(["xterm", "-ti", "vt340", "-geometry", "190x30", "-e"], WIDE, lambda size, seen: shows(seen, wanted(tuple(size)), 1))
    keep("xterm", seen)
    checks.expect(wanted(tuple(size)).shape[1] == 1000, f"a sheet is as wide as xterm lets it be, in a window of {size}")
    checks.expect(shows(seen, wanted(tuple(size)), 1), "xterm shows what libsixel reads")


def check_kitty(checks, screen):
    _, seen = screen.of(["kitty", "--config", "NONE"], PICTURE, lambda _, seen: shows(seen, page_of(checks), 2))
    keep("kitty", seen)
    checks.expect(shows(seen, page_of(checks), 2), "kitty shows the contact sheet")


def main():
    checks = Checks()
    check_protocols(checks)
    if is_there("Xvfb", "xvfb"):
        screen = Screen(checks.folder)
        if is_there("xterm", "xterm") and is_there("sixel2png", "libsixel-bin"):
            check_xterm(checks, screen)
        if is_there("kitty", "kitty"):
            check_kitty(checks, screen)
        screen.close()
    checks.finish()


if sys.argv[2:3] == ["--inside"]:
    inside(sys.argv[3], sys.argv[4:])
else:
    main()
