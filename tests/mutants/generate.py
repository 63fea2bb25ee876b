#!/usr/bin/env python3
"""Makes the lists in by_rule/: lines drawn from the sources, each changed by a rule that knows nothing of the tests.

What was drawn earlier stays as long as the sources hold it, with what somebody added to it (`try`, `equivalent`); the rest
is drawn by a hash of the line and the rule.
"""
import hashlib
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # no folder of its own among the sources

import mutant as lists

SEED = "18"
ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOMS = {"accel": 12, "app": 8, "cameras": 7, "session/checkpoint": 7, "image/film": 5, "base/grid": 5, "integrators": 35, "lang": 16,
         "lights": 14, "materials": 15, "output": 14, "session": 8, "shapes": 18, "textures": 9, "world": 16}
MOST_A_FILE = 3

# Declarations, messages, what nobody can see, and loops over a range, which would leave it.
NO_CODE = re.compile(r'//|"|^#|^template|^using|^namespace|static_assert|assert\(|reserve\(|capacity|operator|^for \(|\\')

OPERAND = r"[\w.:\[\]]+(?:\([^()]*\))?"


def replace(pattern, new):
    """At each place where the pattern matches."""
    def apply(line):
        for found in re.finditer(pattern, line):
            yield line[:found.start()] + found.expand(new) + line[found.end():]
    return apply


def negate_condition(line):
    if found := re.fullmatch(r"((?:\} else )?(?:if|while) \()([^;]*)(\)(?: \{| return.*;|))", line):
        if found[2].count("(") == found[2].count(")"):
            yield f"{found[1]}!({found[2]}){found[3]}"


def change_number(line):
    for found in re.finditer(r"(?<![\w.\[])(\d+\.\d+|\d+)(f?)(?![\w.x'])", line):
        value = f"{2 * float(found[1]):g}" if "." in found[1] else str(int(found[1]) + 1)
        if "." in found[1] and "." not in value:
            value += ".0"
        yield line[:found.start()] + value + found[2] + line[found.end():]


RULES = {
    "plus becomes minus": replace(r" \+(=?) ", r" -\1 "),
    "minus becomes plus": replace(r" -(=?) ", r" +\1 "),
    "times becomes divided by": replace(r" \*(=?) ", r" /\1 "),
    "divided by becomes times": replace(r" /(=?) ", r" *\1 "),
    "a comparison takes in its limit": replace(r" ([<>]) ", r" \1= "),
    "a comparison leaves out its limit": replace(r" ([<>])= ", r" \1 "),
    "equal becomes unequal": replace(" == ", " != "),
    "unequal becomes equal": replace(" != ", " == "),
    "and becomes or": replace(" && ", " || "),
    "or becomes and": replace(r" \|\| ", " && "),
    "min becomes max": replace(r"std::min\b", "std::max"),
    "max becomes min": replace(r"std::max\b", "std::min"),
    "a factor is dropped": replace(rf" [*/] {OPERAND}(?=[;,) ])", ""),
    "a term is dropped": replace(rf" [+-] {OPERAND}(?=[;,)])", ""),
    "the condition is negated": negate_condition,
    "another number": change_number,
    "true becomes false": replace(r"\btrue\b", "false"),
    "false becomes true": replace(r"\bfalse\b", "true"),
}


def order_of(mutant):
    return hashlib.sha256(f"{SEED}\n{mutant.key}".encode()).hexdigest()


def candidates(path):
    """One mutant at most for each rule and line that the file holds once."""
    text = path.read_text()
    for line in map(str.strip, text.splitlines()):
        if not line or NO_CODE.search(line) or text.count(line) != 1:
            continue
        for rule, apply in RULES.items():
            changed = [lists.Mutant("", path.relative_to(ROOT).as_posix(), rule, line, new) for new in apply(line)]
            if changed:
                yield min(changed, key=order_of)


def is_fresh(mutant):
    path = ROOT / mutant.file
    return path.is_file() and path.read_text().count(mutant.old) == 1


def room_of(file):
    """The nearest of the folders that it lies in."""
    return max((room for room in ROOMS if file.startswith(room + "/")), key=len, default=None)


def draw(room, count, drawn):
    """Adds to what was drawn earlier."""
    # A rule that many lines obey must not fill the list: each in turn gives its next mutant.
    by_rule = {rule: [] for rule in RULES}
    for path in sorted((ROOT / room).rglob("*")):
        if path.suffix in (".h", ".cpp") and room_of(path.relative_to(ROOT).as_posix()) == room:
            for mutant in candidates(path):
                by_rule[mutant.sentence].append(mutant)
    turns = sorted((turn, order_of(mutant), mutant) for each in by_rule.values()
                   for turn, mutant in enumerate(sorted(each, key=order_of)))
    for _, _, mutant in turns:
        of_file = [other for other in drawn if other.file == mutant.file]
        if len(of_file) < MOST_A_FILE and all(other.old != mutant.old for other in of_file) and len(drawn) < count:
            drawn.append(mutant)
    return sorted(drawn, key=lambda m: (m.file, m.old))


def main():
    earlier = [mutant for path in sorted((lists.LISTS / "by_rule").glob("*.txt")) for mutant in lists.read_list(path)]
    for room, count in ROOMS.items():
        records = ["# Made by generate.py, which keeps what is added to its records.\n"]
        for mutant in draw(room, count, [m for m in earlier if room_of(m.file) == room and is_fresh(m)]):
            record = f"\n{mutant.file}: {mutant.sentence}\n  - {mutant.old}\n  + {mutant.new}\n"
            record += f"  try {' '.join(mutant.tests)}\n" if mutant.tests else ""
            record += f"  equivalent: {mutant.equivalent}\n" if mutant.equivalent else ""
            records.append(record)
        (lists.LISTS / "by_rule" / f"{pathlib.Path(room).name}.txt").write_text("".join(records))


if __name__ == "__main__":
    main()
