"""A mutant is one small bug: a piece of one line of the sources, and what it becomes. The lists hold them, see README.md."""
import dataclasses
import pathlib
import re

LISTS = pathlib.Path(__file__).parent


class Stale(Exception):
    """The sources no longer hold the old text once."""


@dataclasses.dataclass
class Mutant:
    place: str  # of the record: list:line
    file: str  # from the top level on
    sentence: str  # what goes wrong; of a mutant by rule: the rule
    old: str = ""
    new: str = ""
    tests: list = dataclasses.field(default_factory=list)  # to be tried first, in this order
    equivalent: str = ""  # why no test can see it

    @property
    def path(self):
        return self.file

    @property
    def key(self):
        return f"{self.file}\n- {self.old}\n+ {self.new}"

    def applied_to(self, text):
        count = text.count(self.old)
        if count != 1:
            raise Stale(f"{self.file} holds {count} times: {self.old}")
        return text.replace(self.old, self.new)


def read_list(path):
    place = path.relative_to(LISTS).as_posix()
    mutants = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line or line.startswith("#"):
            continue
        where = f"{place}:{number}"
        if head := re.fullmatch(r"(\S+\.(?:h|cpp)): (.+)", line):
            mutants.append(Mutant(where, head[1], head[2]))
        elif mutants and (field := re.fullmatch(r"  (- |\+ |try |equivalent: )(.*)", line)):
            name = {"- ": "old", "+ ": "new", "try ": "tests", "equivalent: ": "equivalent"}[field[1]]
            setattr(mutants[-1], name, field[2].split() if name == "tests" else field[2])
        else:
            raise SystemExit(f"{where}: neither `file: sentence` nor one of `  - `, `  + `, `  try `, `  equivalent: `")
    for mutant in mutants:
        if not mutant.old or mutant.old == mutant.new:
            raise SystemExit(f"{mutant.place}: changes nothing")
    return mutants


def read_lists():
    return [mutant for path in sorted(LISTS.glob("by_*/*.txt")) for mutant in read_list(path)]
