"""Directives of the scene language as values, and how one that changes from frame to frame is written with keys."""
import numbers


def quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


def written(value):
    """A parameter's value, or several in brackets."""
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return f"{value:.7g}"
    return "[" + " ".join(written(each) for each in value) + "]"


class Directive:
    """`keyword "name" ... "type parameter" value ...`; parameters are a dict from "type parameter" to the value."""

    def __init__(self, keyword, *names, **unused):
        self.keyword, self.names, self.params = keyword, names, {}

    def with_params(self, params):
        self.params.update(params)
        return self

    def head(self):
        return " ".join([self.keyword, *map(quoted, self.names)])

    def __str__(self):
        return " ".join([self.head(), *(f"{quoted(name)} {written(value)}" for name, value in self.params.items())])

    def same_kind(self, other):
        return self.head() == other.head() and self.params.keys() == other.params.keys()


def key(frame):
    """A frame, or a time between two."""
    return f"{frame:.12g}"


def keys(values):
    """Of (frame, value) pairs those that say the same: the inside of a stretch without change is left out."""
    return [(frame, value) for i, (frame, value) in enumerate(values)
            if i in (0, len(values) - 1) or value != values[i - 1][1] or value != values[i + 1][1]]


def constant(values):
    return all(value == values[0][1] for _, value in values)


def over_frames(states, notes):
    """One directive from its states, (frame, Directive) pairs: parameters that change get keys."""
    first = states[0][1]
    if not all(state.same_kind(first) for _, state in states):
        notes.add(f"{first.head()}: its kind changes between frames; that of the first one holds")
        return str(first)
    keyed = Directive(first.keyword, *first.names)
    for name in first.params:
        values = [(frame, state.params[name]) for frame, state in states]
        if constant(values):
            keyed.params[name] = first.params[name]
        else:
            keyed.params.update({f"{name}@{key(frame)}": value for frame, value in keys(values)})
    return str(keyed)
