"""The tree that mutants are built in: a copy of the sources with a build of its own, which stays between runs."""
import contextlib
import dataclasses
import fcntl
import hashlib
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import time

# Most of a mutant's time is compiling and linking.
CMAKE_OPTIONS = ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG -w", "-DDSPM_BENCH=OFF"]

# They take minutes, or look at what no mutant changes.
LEFT_OUT = re.compile("fuzz/|hostile/bounds|modules/(?!not_finite|crash)|scenes/|include_directions|documents/|checkpoint/kill|output/disk_faults|app/(memory_faults|long_run)")

MEMORY = 12 << 30  # of address space


@dataclasses.dataclass
class Test:
    name: str
    program: pathlib.Path
    alone: bool  # depends on the clock: run only where it is named
    needs_dspm: bool = False  # runs the program
    seconds: float = 0  # without a mutant


@dataclasses.dataclass
class Outcome:
    passed: bool
    why: str
    seconds: float
    timed_out: bool


class Tree:
    def __init__(self, root, jobs):
        self.root, self.jobs = root, jobs
        self.home = root / "build" / "mutants"
        self.sources, self.build_folder, self.scratch = self.home / "tree", self.home / "build", self.home / "tmp"

    @contextlib.contextmanager
    def for_oneself(self):
        with open(self.home / "lock", "w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise SystemExit(f"mutants: another run is at work in {self.home}")
            yield

    def update(self):
        """Makes the copy what the project's files are, tracked and new ones; touches only what differs."""
        listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=self.root, check=True,
                                capture_output=True, text=True).stdout.split("\0")
        files = {name for name in listed if name and (self.root / name).is_file()}
        for path in [p for p in self.sources.rglob("*") if not p.is_dir()]:
            if path.relative_to(self.sources).as_posix() not in files:
                path.unlink()
        for name in files:
            source, copy = self.root / name, self.sources / name
            if not copy.is_file() or source.read_bytes() != copy.read_bytes():
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, copy)

    def configure(self):
        options = list(CMAKE_OPTIONS)
        for linker in ["lld", "gold"]:
            if shutil.which(f"ld.{linker}"):
                options += [f"-DCMAKE_{kind}_LINKER_FLAGS=-fuse-ld={linker}" for kind in ["EXE", "SHARED", "MODULE"]]
                break
        done = subprocess.run(["cmake", "-G", "Ninja", "-S", self.sources, "-B", self.build_folder, *options],
                              capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stdout + done.stderr)

    def tests(self):
        """By name those that are programs of their own; scripts are not."""
        shown = subprocess.run(["ctest", "--test-dir", self.build_folder, "--show-only=json-v1"], check=True,
                               capture_output=True, text=True).stdout
        found, links = {}, self.links()
        for test in json.loads(shown[shown.index("{"):])["tests"]:
            if LEFT_OUT.match(test["name"]):
                continue
            settings = {p["name"]: p["value"] for p in test["properties"]}
            folder = pathlib.Path(settings["WORKING_DIRECTORY"])
            program = folder / (test["name"].replace("/", "_") + "_test")  # see dspm_test() in cmake/dspm.cmake
            made = Test(test["name"], program, settings.get("RUN_SERIAL", False))
            if (linked_from := links.get(self.target(made))) is not None:
                made.needs_dspm = "dspm" in linked_from
                found[made.name] = made
        return found

    def target(self, test):
        return test.program.relative_to(self.build_folder).as_posix()

    def ninja(self, *arguments):
        return subprocess.run(["ninja", "-C", self.build_folder, "-j", str(self.jobs), *arguments],
                              capture_output=True, text=True)

    def build(self, tests):
        return self.ninja(*[self.target(test) for test in tests])

    def links(self):
        """By output what it is linked from; a test that runs dspm has it among them."""
        links = {}
        for line in (self.build_folder / "build.ninja").read_text().splitlines():
            if edge := re.fullmatch(r"build ([^:]+): \w+_LINKER__\w+ (.*)", line):
                inputs, _, before = edge[2].partition(" || ")
                for output in edge[1].split():
                    links[output] = inputs.split() + (["dspm"] if "dspm" in before.split() else [])
        return links

    def dependents(self, tests):
        """The names of the tests by the source file that is in them. Everything must be built."""
        links, sources = self.links(), {}  # by object
        for line in self.ninja("-t", "deps").stdout.splitlines():
            if line.startswith("    "):
                file = line.strip().replace(f"{self.build_folder}/include/dspm/", f"{self.sources}/")
                if file.startswith(f"{self.sources}/"):
                    files.append(os.path.relpath(file, self.sources))
            elif line:
                files = sources.setdefault(line.split(": ")[0], [])
        names = {}
        for test in tests:
            linked, todo = set(), [self.target(test)]
            while todo:
                if (part := todo.pop()) not in linked:
                    linked.add(part)
                    todo += links.get(part, [])
            for part in linked:
                for file in sources.get(part, []):
                    names.setdefault(file, set()).add(test.name)
        return names

    @contextlib.contextmanager
    def mutated(self, mutant):
        """Both changes get the time at which they are made, so that the build after each is right."""
        path = self.sources / mutant.path
        before = path.read_bytes()
        path.write_text(mutant.applied_to(before.decode()))
        try:
            yield
        finally:
            path.write_bytes(before)

    def run(self, test, limit):
        shutil.rmtree(self.scratch, ignore_errors=True)
        self.scratch.mkdir(parents=True)
        begin = time.monotonic()
        timed_out = False
        process = subprocess.Popen([test.program, "--gtest_fail_fast", "--gtest_brief=1"], cwd=test.program.parent,
                                   env={**os.environ, "TMPDIR": str(self.scratch)}, start_new_session=True,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   preexec_fn=limit_process)
        try:
            output, _ = process.communicate(timeout=limit)
            failed = re.findall(rb"^\[  FAILED  \] ([^ ,]+)", output, re.MULTILINE)
            why = failed[0].decode() if failed else f"exit code {process.returncode}"
        except subprocess.TimeoutExpired:
            timed_out, why = True, f"still running after {limit:.0f} s"
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
        return Outcome(process.returncode == 0, why, time.monotonic() - begin, timed_out)

    def digest(self, test):
        """Of what running the test depends on."""
        parts = [test.program] + [self.build_folder / name for name in ["dspm", "libdspm.so"] if test.needs_dspm]
        return hashlib.sha256(b"".join(part.read_bytes() for part in parts)).hexdigest()


def limit_process():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
