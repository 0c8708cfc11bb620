"""Studies as the text of a file."""

import math
import os
import re

from . import _gamut

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r", "\b": "\\b", "\f": "\\f"}


def _text(value):
    return '"' + "".join(_ESCAPES.get(c, c if c.isprintable() else f"\\U{ord(c):08X}") for c in value) + '"'


def _key(name):
    return name if _BARE.fullmatch(name) else _text(name)


def _number(value):
    if math.isfinite(value):
        return repr(value)
    return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"


def _value(value, where):
    if isinstance(value, (str, os.PathLike)):
        return _text(os.fspath(value))
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v, f'{where}.{k}')}" for k, v in value.items()) + " }"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, _gamut.Interval):
        return f"[{_number(value.lower)}, {_number(value.upper)}]"
    if isinstance(value, (list, tuple)):
        return "[" + ",\n  ".join(_value(v, where) for v in value) + "]" if len(value) > 100 else (
            "[" + ", ".join(_value(v, where) for v in value) + "]")
    if hasattr(value, "tolist") and not isinstance(value.tolist(), type(value)):  # of NumPy
        return _value(value.tolist(), where)
    raise TypeError(f"{where}: a study holds no {type(value).__name__}; expected a number, text, truth, list or dict")


def _are_tables(value):
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(v, dict) for v in value)


def _table(lines, path, table):
    below = {k: v for k, v in table.items() if _are_tables(v) or (isinstance(v, dict) and len(path) == 0)}
    for key, value in table.items():
        if key not in below:
            lines.append(f"{_key(key)} = {_value(value, '.'.join((*path, key)))}")
    for key, value in below.items():
        heading = ".".join(_key(k) for k in (*path, key))
        for each in value if _are_tables(value) else [value]:
            lines += ["", f"[[{heading}]]" if _are_tables(value) else f"[{heading}]"]
            _table(lines, (*path, key), each)


def dumps(study):
    """The text of a study file of these sections, dictionaries and lists of them; TypeError for what no file can hold."""
    lines = []
    _table(lines, (), study)
    return "\n".join(lines).lstrip("\n") + "\n"
