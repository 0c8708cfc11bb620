"""What a user asks: a mechanism, what of it is uncertain, which outputs are wanted, by which analyses."""

import copy
import json
import os
import tomllib
from typing import NamedTuple

from . import _gamut, toml
from .errors import Interrupted
from .progress import told
from .results import Results

_SECTIONS = json.loads(_gamut.schema())["properties"]


class Quantity(NamedTuple):
    """A number of a mechanism, with its unit and its nominal value, or its value at the start (NaN: it has none)."""

    name: str
    unit: str
    nominal: float


class Quantities(NamedTuple):
    """What can be uncertain, and what can be an output: a Quantity by its name."""

    uncertain: dict
    outputs: dict

    def _repr_html_(self):
        def table(title, quantities):
            rows = "".join(f"<tr><td>{q.name}</td><td>{q.nominal:.12g}</td><td>{q.unit}</td></tr>" for q in quantities)
            return f"<table><caption>{title}</caption><tr><th>name<th>value<th>unit</tr>{rows}</table>"

        return table("can be uncertain", self.uncertain.values()) + table("can be outputs", self.outputs.values())


class Settings(dict):
    """A section of a study, whose keys are attributes too."""

    def __repr__(self):
        return f"{type(self).__name__}({dict(self)})"

    def __reduce__(self):
        return _settings, (type(self).__name__, dict(self))

    def __setattr__(self, key, value):
        if not isinstance(getattr(type(self), key, None), property):
            known = ", ".join(k for k in dir(type(self)) if isinstance(getattr(type(self), k), property))
            raise AttributeError(f"[{type(self).__name__}] has no setting '{key}'; expected one of: {known}")
        object.__setattr__(self, key, value)


def _setting(key, schema):
    def read(self):
        return self.get(key)

    def write(self, value):
        if value is None:
            self.pop(key, None)
        else:
            self[key] = value

    return property(read, write, None, schema.get("description", ""))


def _settings_type(name, schema):
    members = {key: _setting(key, of) for key, of in schema.get("properties", {}).items()}
    return type(name, (Settings,), {"__doc__": schema.get("description", Settings.__doc__), **members})


_TYPES = {name: _settings_type(name, schema) for name, schema in _SECTIONS.items() if "properties" in schema}
_OF_STUDY = frozenset(_SECTIONS["study"]["properties"])


def _settings(name, values):
    return _TYPES[name](values)


def _taken(name, value):
    """A section as it is kept: nothing of it is the caller's."""
    is_table, is_list = isinstance(value, dict), isinstance(value, (list, tuple))
    if name in _TYPES and is_table:
        return _TYPES[name](copy.deepcopy(value))
    if name not in _TYPES and is_list and all(isinstance(each, dict) for each in value):
        return [copy.deepcopy(dict(each)) for each in value]
    expected = "a dictionary" if name in _TYPES else "a list of dictionaries"
    raise TypeError(f"{name}: expected {expected}, as [{name}] in a study file, not {type(value).__name__}")


def _told_of(section):
    def read(self):
        if section not in self._data and section in _TYPES:
            self._data[section] = _TYPES[section]()
        return self._data.setdefault(section, [])

    def write(self, value):
        self._data[section] = _taken(section, value)

    return property(read, write, None, _SECTIONS[section].get("description", f"[{section}] of the study file"))


def _checked(samples, seed, jobs, time_limit, memory_limit):
    """Refuses what no run can be told."""
    for name, value, least, most in (("samples", samples, 1, 10**7), ("seed", seed, 0, 2**63 - 1), ("jobs", jobs, 1, 1024)):
        if value is not None and not (hasattr(value, "__index__") and least <= value <= most):
            raise ValueError(f"{name} = {value!r}: expected a whole number from {least} to {most}")
    for name, value in (("time_limit", time_limit), ("memory_limit", memory_limit)):
        if value is not None and not (isinstance(value, (int, float)) and value > 0):
            raise ValueError(f"{name} = {value!r}: expected a number above 0")


def _is_json(text):
    return text.lstrip(" \t\r\n").startswith("{")


def _loaded(text):
    return json.loads(text) if _is_json(text) else tomllib.loads(text)


class Study:
    """A study file, or the same words in Python.

    `Study("arm.toml")` reads a file, in JSON too. `Study(title=..., horizon=..., mechanism={...}, uncertain=[...], output=[...])` is
    built of the words of the file: each section is a keyword, a dictionary or a list of dictionaries; the keys of
    `[study]` may stand alone. Sections are attributes, and their settings attributes of these, with docstrings: `study.interval.tightness = 1.01`. What makes no sense is told by StudyError
    when it is used, with line and column of `to_toml()`.
    """

    def __init__(self, path=None, /, **sections):
        self._text, self._name, self._machine = None, "study", (None, None)
        self._data = {}
        if path is not None:
            self._name = os.path.abspath(os.fspath(path))
            self._text = _gamut.text_of(self._name)
            self._parse()
        for name, value in sections.items():
            if name in _SECTIONS:
                self._data[name] = _taken(name, value)
        for name, value in sections.items():
            if name in _OF_STUDY and name not in _SECTIONS:
                self.study[name] = value
            elif name not in _SECTIONS:
                known = ", ".join(sorted({*_SECTIONS, *_OF_STUDY}))
                raise TypeError(f"a study has no section '{name}'; expected one of: {known}")

    @classmethod
    def from_toml(cls, text, name="study"):
        """Of the text of a study file; `name` is what messages call it, and where paths of other files begin."""
        study = cls()
        study._text, study._name = text, name
        study._parse()
        return study

    def __setattr__(self, name, value):
        if not name.startswith("_") and not isinstance(getattr(type(self), name, None), property):
            known = ", ".join(sorted({*_SECTIONS, *_OF_STUDY}))
            raise AttributeError(f"a study has no section '{name}'; expected one of: {known}")
        object.__setattr__(self, name, value)

    def __getstate__(self):
        return {**self.__dict__, "_machine": (None, None)}

    def __copy__(self):
        return copy.deepcopy(self)

    def _parse(self):
        try:
            data = _loaded(self._text)
        except ValueError:
            _gamut.read(self._text, self._name, None)  # says where and what
            raise
        self._data = {k: _taken(k, v) if k in _SECTIONS and isinstance(v, (dict, list)) else v for k, v in data.items()}

    def to_toml(self):
        """The study as a file: word for word the one that was read, unless something was changed since."""
        text = self._as_read()
        return toml.dumps(self._stated()) if text is None or _is_json(text) else text

    def to_json(self):
        """The same in JSON, which `gamut` reads as well."""
        text = self._as_read()
        if text is not None and _is_json(text):
            return text
        return json.dumps(tomllib.loads(self.to_toml()), ensure_ascii=False, allow_nan=False, indent=2) + "\n"

    def _stated(self):
        return {k: v for k, v in self._data.items() if v or k not in _SECTIONS}

    def _as_read(self):
        """The file's text, if it says what is stated now."""
        return self._text if self._text is not None and _loaded(self._text) == self._stated() else None

    def _text_now(self):
        return self._as_read() or self.to_toml()

    def _read(self, show=None):
        text = self._text_now()
        if self._machine[0] != text:
            machine, was_interrupted = _gamut.read(text, self._name, show)
            if was_interrupted:
                raise Interrupted()
            self._machine = (text, machine)
        return self._machine[1]

    def validate(self):
        """Reads and checks all as for a run; returns notes on what may be a mistake. Throws StudyError."""
        return self._read().notes()

    def quantities(self):
        """What of the mechanism can be uncertain, and what can be an output. The rest of the study may be missing."""
        numbers, outputs = _gamut.quantities(self._text_now(), self._name)
        return Quantities(*({q[0]: Quantity(*q) for q in of} for of in (numbers, outputs)))

    def run(self, *, samples=None, seed=None, jobs=None, time_limit=None, memory_limit=None, progress=True):
        """Does what the study asks for; returns Results.

        `samples` and `seed` take the place of the study's; `jobs`: threads, as many as the machine has unless given;
        `time_limit`: CPU time, s; `memory_limit`: bytes that the process may have. A limit that was reached is no
        exception: the results say so. `progress`: True for a bar, False, or what is called with a task and the fraction
        done of it. An interrupt (Ctrl-C) throws Interrupted, which holds what was found and proved until then.
        """
        _checked(samples, seed, jobs, time_limit, memory_limit)
        show, wipe = told(progress)
        try:
            held, was_interrupted = self._read(show).run(seed, samples, jobs, time_limit, memory_limit, show)
        finally:
            wipe()
        if was_interrupted:
            raise Interrupted(Results(held, self._name))
        return Results(held, self._name)

    def tolerance(self, *, jobs=None, time_limit=None, progress=True):
        """By what factor the uncertain intervals may grow, or must shrink, so that all requirements are met."""
        from .results import Tolerances

        _checked(None, None, jobs, time_limit, None)
        show, wipe = told(progress)
        try:
            nominal, together, alone, was_interrupted = self._read(show).tolerance(jobs, time_limit, show)
        finally:
            wipe()
        found = Tolerances(nominal, together, alone)
        if was_interrupted:
            raise Interrupted(found)
        return found

    def sweep(self, over=None, *, points=None, file=None, overwrite=False, samples=None, seed=None, jobs=None,
              time_limit=None, memory_limit=None, progress=True):  # fmt: skip
        """Runs the study at many nominal values; returns a Sweep.

        `over`: of each number that is varied, by its name as of `gamut sweep --over`, its values: "0.9:1.1:21", or a list
        or array of numbers in the SI unit, or of texts with units; all combinations. `points`: instead a list of points,
        a dictionary or a data frame with a column for each number. Without both: what the study's `sweep` section says.
        `file`: where it is written on the way; the same sweep that is there already is gone on with, unless `overwrite`.
        Other arguments as of run, limits of each point. Points run in processes of their own, `jobs` at a time. An
        interrupt throws Interrupted, whose `results` are the Sweep with the points that had ended.
        """
        from .sweep import Sweep, _stated

        _checked(samples, seed, jobs, time_limit, memory_limit)
        grid, axes = _stated(over, points)
        path = None if file is None else os.fspath(file)
        show, wipe = told(progress)
        try:
            held, was_interrupted = _gamut.sweep(
                self.to_toml(), self._name, grid, axes, path, overwrite, seed, samples, jobs, time_limit, memory_limit, show
            )
        finally:
            wipe()
        if was_interrupted:
            raise Interrupted(Sweep(held))
        return Sweep(held)

    def __repr__(self):
        title = self._data.get("study", {}).get("title", "untitled")
        return f"<gamut.Study '{title}'>"


for _name in _SECTIONS:
    if not hasattr(Study, _name):  # sweep, which a study does, is stated to its constructor
        setattr(Study, _name, _told_of(_name))
for _name in _OF_STUDY - set(_SECTIONS):
    setattr(
        Study,
        _name,
        property(
            lambda self, key=_name: self.study.get(key),
            lambda self, value, key=_name: setattr(self.study, key, value),
            None,
            _SECTIONS["study"]["properties"][_name].get("description", ""),
        ),
    )
