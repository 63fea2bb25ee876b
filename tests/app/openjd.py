"""A stand-in for a scheduler of Open Job Description: holds the template that is named to the schema of 2023-09, as far
as dspm's use of it goes, and prints a script that does its tasks. Exits with 1 if it is refused, with 77 without PyYAML."""
import re
import shlex
import sys

try:
    import yaml
except ImportError:
    sys.exit(77)


def expect(holds, what):
    if not holds:
        sys.exit(what)


def fields(thing, required, optional=()):
    expect(isinstance(thing, dict) and set(required) <= set(thing) <= {*required, *optional}, f"{thing}: {required}")
    return [thing[name] for name in required]


def resolved(text, values):
    def value(match):
        expect(match[1] in values, f"{{{{{match[1]}}}}} is not known there")
        return values[match[1]]
    return re.sub(r"\{\{\s*(.*?)\s*\}\}", value, text)


def identifier(name):
    expect(re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]{0,63}", name), f"{name} is no identifier")
    return name


def tasks_of(space):
    """The values of the one parameter, each by the name that format strings know it by."""
    if space is None:
        return [{}]
    (definitions,) = fields(space, ["taskParameterDefinitions"], ["combination"])
    expect(len(definitions) == 1, "one parameter")
    name, kind, numbers = fields(definitions[0], ["name", "type", "range"])
    expect(kind == "INT" and isinstance(numbers, str), f"{kind} {numbers}")
    first, last = re.fullmatch(r"(\d+)-(\d+)", numbers).groups()
    return [{f"Task.Param.{identifier(name)}": str(i)} for i in range(int(first), int(last) + 1)]


version, job, steps = fields(yaml.safe_load(open(sys.argv[1])), ["specificationVersion", "name", "steps"])
expect(version == "jobtemplate-2023-09", version)
expect(1 <= len(job) <= 128 and job.isprintable() and "{{" not in job, job)
done = set()
print("set -e\nmkdir session")
for step in steps:
    name, script = fields(step, ["name", "script"], ["parameterSpace", "dependencies"])
    expect(1 <= len(name) <= 64 and name not in done, name)
    for dependency in step.get("dependencies", []):
        expect(fields(dependency, ["dependsOn"])[0] in done, f"{name} waits for {dependency}")
    actions, files = fields(script, ["actions", "embeddedFiles"])
    command, words = fields(fields(actions, ["onRun"])[0], ["command", "args"])
    for values in tasks_of(step.get("parameterSpace")):
        values |= {f"Task.File.{identifier(file['name'])}": f"session/{file['name']}" for file in files}
        for file in files:
            file_name, kind, data = fields(file, ["name", "type", "data"])
            expect(kind == "TEXT" and data, file_name)
            print(f"printf %s {shlex.quote(resolved(data, values))} > session/{file_name}")
        print(shlex.join([command, *(resolved(word, values) for word in words)]))
    done.add(name)
