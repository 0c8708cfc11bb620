"""A study over many nominal values: what was found at each, with what was varied as dimensions."""

import os

import numpy as np

from . import _gamut
from .results import Described, _framed


def _texts(values):
    """Numbers, or texts with units, as a study has them."""
    return [value if isinstance(value, str) else repr(float(value)) for value in values]


def _stated(over, points):
    """Whether it is a grid, and pairs of a name and its values: one text or a list of texts."""
    if over is not None and points is not None:
        raise TypeError("over and points are both given; expected one of them")
    if points is not None:
        return False, [(str(name), _texts(points[name])) for name in points]
    return True, [
        (str(name), values if isinstance(values, str) else _texts(np.atleast_1d(values)))
        for name, values in (over or {}).items()
    ]


class Sweep(Described):
    """What `Study.sweep` found. `sweep["clearance"]` has the arrays of a requirement, or of an output, by their names;
    `sweep.to_xarray()` is all of it."""

    @property
    def title(self):
        return self.value("/study/title")

    @property
    def is_grid(self):
        """Whether all combinations of the values were asked for; else it is a list of points."""
        return self._held.is_grid()

    @property
    def axes(self):
        """What is varied: of each number its values."""
        return {name: np.array(values) for name, _, values in self._held.axes()}

    @property
    def units(self):
        """In which these are; empty of plain numbers."""
        return {name: unit for name, unit, _ in self._held.axes()}

    @property
    def shape(self):
        """Of the arrays, but for their last dimension."""
        axes = self.axes
        return tuple(len(values) for values in axes.values()) if self.is_grid else (len(next(iter(axes.values()))),)

    @property
    def states(self):
        """How each point ended: "open" (not run), "done", "early", "refused" or "failed", in the sweep's shape."""
        return np.array(self.value("/points/state")).reshape(self.shape)

    @property
    def points(self):
        """A row a point: what it was asked, how it ended, and why."""
        axes = self.axes
        grids = np.meshgrid(*axes.values(), indexing="ij") if self.is_grid else list(axes.values())
        columns = {name: grid.ravel() for name, grid in zip(axes, grids)}
        columns |= {key: self.value(f"/points/{key}") for key in ("state", "why", "verdict", "reached", "cpu")}
        return _framed([dict(zip(columns, row)) for row in zip(*columns.values())])

    @property
    def requirements(self):
        """Their names."""
        return tuple(self.value("/requirements/name") or ())

    @property
    def outputs(self):
        """Their names."""
        return tuple(self.value("/outputs/name") or ())

    def __getitem__(self, name):
        for names, group in ((self.requirements, "/answers/"), (self.outputs, "/motion/")):
            if name in names:
                at = names.index(name)
                return {
                    path.rsplit("/", 1)[-1]: field.value[..., at]
                    for path, field in self.fields.items()
                    if path.startswith(group) and field.value is not None
                }
        known = ", ".join(f"'{each}'" for each in (*self.requirements, *self.outputs))
        raise KeyError(f"no requirement and no output is called '{name}'; expected one of {known}")

    def study(self, *place):
        """The Study of a point: its places on the axes, of a list its number."""
        from .study import Study

        text, name = self._held.study_at(int(np.ravel_multi_index(place, self.shape)))
        return Study.from_toml(text, name)

    def to_xarray(self):
        """An xarray.Dataset: of each field of /answers and /motion an array whose dimensions are what is varied, then
        `requirement` or `output`; `state` and `why` of the points besides."""
        import xarray

        axes = self.axes
        dimensions = list(axes) if self.is_grid else ["point"]
        units = self.units
        coordinates = {
            name: ([name] if self.is_grid else ["point"], values, {"units": units[name]}) for name, values in axes.items()
        }
        coordinates |= {"requirement": list(self.requirements), "output": list(self.outputs)}
        coordinates["unit"] = (["output"], list(self.value("/outputs/unit") or ()))
        variables = {
            key: (dimensions, np.array(self.value(f"/points/{key}")).reshape(self.shape))
            for key in ("state", "why", "verdict", "reached", "cpu")
        }
        for path, field in self.fields.items():
            group, name = path.strip("/").split("/")
            if group in ("answers", "motion") and field.value is not None:
                last = "requirement" if group == "answers" else "output"
                described = {"units": field.unit, "long_name": field.meaning}
                variables[name] = ([*dimensions, last], field.value, described)
        return xarray.Dataset(variables, coordinates, {"title": self.title})

    def save(self, path, *, overwrite=False):
        """Writes the file (HDF5), whole or not at all."""
        self._held.save(os.fspath(path), overwrite)

    def report(self, path, *, overwrite=False):
        """Writes the page, which opens in a browser."""
        self._held.save_report(os.fspath(path), overwrite)

    def _repr_html_(self):
        from html import escape

        page = escape(self._held.page(), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 40rem; border: 0"></iframe>'

    def __repr__(self):
        states = list(self.value("/points/state"))
        return f"<gamut.Sweep '{self.title}': {states.count('done')} of {len(states)} points done>"
