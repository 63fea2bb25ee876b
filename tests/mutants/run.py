#!/usr/bin/env python3
"""Puts small bugs into the sources, one at a time, and reports those that no test notices. See README.md."""
import argparse
import json
import os
import pathlib
import sys
import time

sys.dont_write_bytecode = True  # no folder of its own among the sources

import mutant as lists
from tree import Tree

KILLED, SURVIVED, NOT_COMPILED = "killed", "survived", "does not compile"
LEAST_SHARE = 0.95
OTHERS_SECONDS = 60  # for test programs that a mutant does not name, building included
SLOW = 30  # seconds: tests that take longer run only where they are named


def say(words):
    print(f"mutants: {words}", file=sys.stderr, flush=True)


class Records:
    """What is known so far, by key; written after every change."""

    def __init__(self, path):
        self.path = path
        self.of = json.loads(path.read_text()) if path.exists() else {}

    def set(self, key, value):
        self.of[key] = value
        part = self.path.with_suffix(".part")
        part.write_text(json.dumps(self.of, indent=1) + "\n")
        os.replace(part, self.path)


def check_unmutated(tree, tests, named):
    """Everything built from the sources as they are passes. A test that did so is run again only when it changed."""
    say(f"building {len(tests)} test programs; the first time takes minutes")
    built = tree.build(tests.values())
    if built.returncode != 0:
        raise SystemExit(built.stdout + built.stderr)
    checked = Records(tree.home / "unmutated.json")
    for test in tests.values():
        digest = tree.digest(test)
        known = checked.of.get(test.name)
        if not known or known["digest"] != digest or test.name in named and not known["passed"]:
            say(f"unmutated: {test.name}")
            outcome = tree.run(test, 1800 if test.name in named else SLOW)
            if not outcome.passed and (test.name in named or not outcome.timed_out):
                raise SystemExit(f"mutants: {test.name} fails without a mutant: {outcome.why}")
            known = {"digest": digest, "passed": outcome.passed, "seconds": outcome.seconds}
            checked.set(test.name, known)
        test.seconds = known["seconds"]


def stale_ones(mutants, tree):
    """Why, by place."""
    stale = {}
    for mutant in mutants:
        try:
            mutant.applied_to((tree.root / mutant.path).read_text())
        except (lists.Stale, FileNotFoundError) as error:
            stale[mutant.place] = error
        for name in mutant.tests:
            if not (tree.root / "tests" / f"{name}_test.cpp").is_file():
                stale[mutant.place] = f"there is no test {name}"
    return stale


def tests_to_try(mutant, tests, dependents):
    """Those that the mutant names, then those of its room, then the others that depend on its file; quickest first."""
    named = [tests[name] for name in mutant.tests]
    rooms = mutant.file.split("/")[:-1]  # tests are named without wings
    others = [t for t in tests.values() if t.name in dependents and t not in named and t.seconds < SLOW]
    return named, sorted(others, key=lambda t: (t.name.split("/")[0] not in rooms, t.seconds))


def try_mutant(tree, mutant, named, others):
    begin = time.monotonic()
    tried = 0

    def result(word, why=""):
        return {"result": word, "by": why, "tests": tried, "seconds": round(time.monotonic() - begin, 1)}

    with tree.mutated(mutant):
        deadline = None
        for test in named + others:
            if test not in named:
                deadline = deadline or time.monotonic() + OTHERS_SECONDS
                if time.monotonic() > deadline:
                    break
            if tree.build([test]).returncode != 0:
                return result(NOT_COMPILED)
            tried += 1
            outcome = tree.run(test, 20 + 4 * test.seconds)
            if not outcome.passed:
                return result(KILLED, f"{test.name}: {outcome.why}")
    return result(SURVIVED)


def try_all(tree, mutants, stale, results):
    todo = [m for m in mutants if m.place not in stale]
    if not todo:
        return
    tree.update()
    tree.configure()
    named = {name for mutant in todo for name in mutant.tests}
    tests = {name: test for name, test in tree.tests().items() if not test.alone or name in named}
    check_unmutated(tree, tests, named)
    dependents = tree.dependents(tests.values())
    for number, mutant in enumerate(todo, 1):
        named, others = tests_to_try(mutant, tests, dependents.get(mutant.path, ()))
        outcome = try_mutant(tree, mutant, named, others)
        results.set(mutant.key, outcome)
        say(f"{number}/{len(todo)} {outcome['result']} in {outcome['seconds']} s: {mutant.place} {mutant.file}: "
            f"{mutant.sentence} [{outcome['by'] or outcome['tests']}]")


def report(mutants, stale, results):
    """Returns whether all is well."""
    by = {word: [] for word in (KILLED, SURVIVED, NOT_COMPILED)}
    for mutant in mutants:
        if not mutant.equivalent and mutant.place not in stale and mutant.key in results.of:
            by[results.of[mutant.key]["result"]].append(mutant)
    for word in (SURVIVED, NOT_COMPILED):
        for mutant in by[word]:
            print(f"{word}: {mutant.place} {mutant.file}: {mutant.sentence}\n  - {mutant.old}\n  + {mutant.new}")
    for place, why in stale.items():
        print(f"stale: {place}: {why}")
    killed, tried = len(by[KILLED]), len(by[KILLED]) + len(by[SURVIVED])
    share = killed / tried if tried else 1
    equivalent = sum(bool(m.equivalent) for m in mutants)
    untried = len(mutants) - equivalent - len(stale) - sum(map(len, by.values()))
    print(f"{len(mutants)} mutants: {killed} killed, {len(by[SURVIVED])} survived, {len(by[NOT_COMPILED])} do not compile, "
          f"{equivalent} equivalent, {len(stale)} stale, {untried} not tried; {100 * share:.1f}% of those tried were killed")
    return share >= LEAST_SHARE and not stale


def main():
    parser = argparse.ArgumentParser(prog="./dev mutants", description=__doc__)
    parser.add_argument("words", nargs="*", help="only mutants whose list, file or sentence holds one of these")
    parser.add_argument("--again", action="store_true", help="forget earlier results of these mutants")
    parser.add_argument("--report", action="store_true", help="try nothing: print what is known")
    parser.add_argument("--jobs", type=int, default=1, help="compilers at a time")
    options = parser.parse_args()

    mutants = [m for m in lists.read_lists()
               if not options.words or any(w in f"{m.place} {m.file}: {m.sentence}" for w in options.words)]
    tree = Tree(pathlib.Path(__file__).resolve().parents[2], options.jobs)
    tree.sources.mkdir(parents=True, exist_ok=True)
    results = Records(tree.home / "results.json")

    stale = stale_ones(mutants, tree)
    if not options.report:
        todo = [m for m in mutants if not m.equivalent and (options.again or m.key not in results.of)]
        with tree.for_oneself():
            try_all(tree, todo, stale, results)
    return 0 if report(mutants, stale, results) else 1


if __name__ == "__main__":
    sys.exit(main())
