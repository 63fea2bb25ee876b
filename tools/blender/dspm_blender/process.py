"""A run of the program dspm: its progress, its messages, its pictures so far."""
import json
import os
import queue
import shutil
import signal
import subprocess
import threading

from .exr import Exr


def find_program(preferred):
    program = preferred or shutil.which("dspm")
    if not program or not os.access(program, os.X_OK):
        raise RuntimeError("the program dspm is not found: Preferences > Add-ons > dspm says where it is")
    return program


class Run:
    """Renders a scene's frames into `picture(frame)`, frames from 1. Ends when it is left."""

    def __init__(self, program, scene, frames, arguments, seconds_between_pictures):
        stem = os.path.splitext(scene)[0]
        self.pattern = f"{stem}.result.####.exr" if frames > 1 else f"{stem}.result.exr"
        self.share, self.messages, self.lines, self.is_stopping = 0.0, [], queue.Queue(), False
        self.process = subprocess.Popen(
            [program, scene, "-o", self.pattern, "--float", "--compression", "none", "--progress", "json",
             "--write-every", f"{seconds_between_pictures}s", *arguments],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace")
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
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

    def picture(self, frame):
        """An Exr, or None if there is none yet. dspm replaces whole files."""
        path = self.pattern.replace("####", f"{frame:04}")
        return Exr(path) if os.path.exists(path) else None

    def written(self, frame):
        """When its picture was."""
        path = self.pattern.replace("####", f"{frame:04}")
        return os.stat(path).st_mtime_ns if os.path.exists(path) else None

    def problem(self):
        """Of a run that has ended."""
        return None if self.process.wait() in {0, 130} else "\n".join(self.messages[-20:]) or "dspm has failed"

    def _read(self):
        for line in self.process.stderr:
            self.lines.put(line.rstrip())

    def _take(self, line):
        if line.startswith("{"):
            self.share = json.loads(line).get("share_done", self.share)
        elif line:
            self.messages.append(line)
