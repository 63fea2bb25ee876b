"""A run of the program dspm: its progress, its messages, its pictures so far."""
import ctypes
import json
import os
import queue
import shutil
import signal
import subprocess
import sys
import threading

from .exr import Exr


def find_program(preferred):
    program = preferred or shutil.which("dspm")
    if not program or not os.access(program, os.X_OK):
        raise RuntimeError("the program dspm is not found: Preferences > Add-ons > dspm says where it is")
    return os.path.abspath(program)


LIBC = ctypes.CDLL(None) if sys.platform == "linux" else None
PR_SET_PDEATHSIG = 1  # <sys/prctl.h>


def ends_with_blender():
    """In the program's process: if Blender crashes, it saves its checkpoint and ends, instead of going on unseen. The signal
    comes once for each of Blender's threads, and dspm ends at once on a second SIGTERM."""
    if LIBC:
        LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGUSR2)


class Run:
    """Renders a scene's frames into `picture(frame)`, frames from 1, until it is closed."""

    def __init__(self, program, scene, frames, arguments, seconds_between_pictures):
        self.stem = f"{os.path.splitext(scene)[0]}.result"
        folder, name = os.path.split(self.stem)  # apart, as braces in a name are a template's
        self.numbers = ".{:04}" if frames > 1 else ""
        self.share, self.messages, self.lines, self.is_stopping = 0.0, [], queue.Queue(), False
        self.done = set()  # frames whose pictures do not get better
        self.process = subprocess.Popen(
            [program, scene, "-o", f"{name}{'.####' if frames > 1 else ''}.exr", "--float", "--compression", "none",
             "--progress", "json", "--write-every", f"{seconds_between_pictures}s", *arguments],
            cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace",
            preexec_fn=ends_with_blender)
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def close(self):
        self.process.kill()
        self.process.wait()

    def poll(self, seconds):
        """Takes what it says during this time. Has it ended?"""
        try:
            self._take(self.lines.get(timeout=seconds))
            while True:
                self._take(self.lines.get_nowait())
        except queue.Empty:
            return not self.reader.is_alive() and self.lines.empty()

    def stop(self):
        """As Ctrl-C: the images so far are written. A second one would not wait for them."""
        if not self.is_stopping:
            self.process.send_signal(signal.SIGINT)
        self.is_stopping = True

    def picture(self, frame, kind=""):
        """An Exr, or None if there is none yet. dspm replaces whole files."""
        path = self._path(frame, kind)
        return Exr(path) if os.path.exists(path) else None

    def written(self, frame):
        """When its picture was."""
        path = self._path(frame)
        return os.stat(path).st_mtime_ns if os.path.exists(path) else None

    def problem(self):
        """Of a run that has ended."""
        return None if self.process.wait() in {0, 130} else "\n".join(self.messages[-20:]) or "dspm has failed"

    def is_complete(self):
        return self.process.poll() == 0

    def _path(self, frame, kind=""):
        return f"{self.stem}{kind}{self.numbers.format(frame)}.exr"

    def _read(self):
        for line in self.process.stderr:
            self.lines.put(line.rstrip())

    def _take(self, line):
        if line.startswith("{"):
            event = json.loads(line)
            self.share = event.get("share_done", self.share)
            if event.get("last"):
                self.done.update(map(int, event["frames"]))
        elif line:
            self.messages.append(line)
