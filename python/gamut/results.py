"""What a study produced, as data: the fields of the results file, labelled."""

import json
import os
from typing import NamedTuple

import numpy as np

from . import _gamut
from .errors import Interrupted
from .progress import told

_DIMENSIONS = {"/stochastic/probability": "probability", "/fuzzy/alpha": "alpha"}


def _dimension(path):
    return _DIMENSIONS.get(path, path.lstrip("/").replace("/", "_"))


def _framed(records):
    """A DataFrame where pandas is installed, else the list of dictionaries."""
    try:
        import pandas
    except ImportError:
        return records
    return pandas.DataFrame.from_records(records)


class Field(NamedTuple):
    """One field of the results file: its path, its unit ("of the output": that of each), what it is, its dimensions,
    its value; bounds are a pair of arrays."""

    path: str
    unit: str
    meaning: str
    dimensions: tuple
    value: object

    def array(self):
        """The value as one array; bounds stand behind each other in a last dimension. None where there is nothing."""
        value = self.value
        if isinstance(value, list):
            if not value or any(v is None for v in value):
                return None
            value = tuple(map(np.array, zip(*value))) if isinstance(value[0], tuple) else np.array(value)
        if isinstance(value, tuple):
            return np.stack(value, axis=-1)
        return value


class Bounds(NamedTuple):
    """Least and greatest, an array each."""

    lower: np.ndarray
    upper: np.ndarray

    @property
    def width(self):
        return self.upper - self.lower


class Verdict(NamedTuple):
    """Whether the answers agree: "inside", "outside", "unresolved", "incomplete", or "uncompared" where the study asks for
    nothing that could be; in a sentence, with notes on it."""

    word: str
    sentence: str
    notes: list
    overestimation: float
    """The greatest found: width of what is guaranteed over that of what was sampled; NaN: none was."""

    def __str__(self):
        return self.sentence


class Tolerances(NamedTuple):
    """By what factors deviations may be larger than stated (0: by none), so that all requirements are met."""

    nominal: str
    """The requirement that the nominal values violate; empty: none is known."""
    together: dict
    """Of all quantities: `factor`, and by which requirement a greater one is `limited_by`."""
    alone: list
    """Of each quantity alone, likewise, with its `interval` then."""

    def to_frame(self):
        return _framed([{"name": "all together", **{k: self.together[k] for k in ("factor", "limited_by")}}, *self.alone])


class Output:
    """One output over time: guaranteed, probable, possible; None where the study did not ask for it.

    Arrays have an entry a time of `time` (s); NaN beyond what was reached.
    """

    def __init__(self, results, index):
        self._results, self._index = results, index
        self.name = results.outputs[index]
        self.unit = results._text_of("/study/outputs/unit")[index]
        self.time = results.time

    def _of(self, path):
        value = self._results.value(path)
        if value is None:
            return None
        cut = [np.asarray(each)[..., self._index] for each in (value if isinstance(value, tuple) else (value,))]
        return Bounds(*cut) if len(cut) == 2 else cut[0]

    @property
    def guaranteed(self):
        """Bounds of every possible value at the output times."""
        return self._of("/interval/at")

    @property
    def guaranteed_over(self):
        """Bounds over the whole interval since the output time before."""
        return self._of("/interval/over")

    @property
    def sampled(self):
        """Bounds of all samples."""
        return self._of("/stochastic/envelope")

    @property
    def mean(self):
        return self._of("/stochastic/mean")

    @property
    def deviation(self):
        """Standard deviation."""
        return self._of("/stochastic/deviation")

    @property
    def quantiles(self):
        """Of each probability an array."""
        probabilities, quantiles = self._results.value("/stochastic/probability"), self._of("/stochastic/quantiles")
        return None if quantiles is None else dict(zip(probabilities, quantiles))

    @property
    def possible(self):
        """Of each level of membership proved Bounds."""
        cuts = self._of("/fuzzy/outer")
        return None if cuts is None else {a: Bounds(*cut) for a, *cut in zip(self._results.value("/fuzzy/alpha"), *cuts)}

    def plot(self, axes=None):
        """Draws the three answers over time with matplotlib; returns the axes."""
        from .figures import draw

        return draw(self, axes)

    def __repr__(self):
        return f"<gamut output '{self.name}' [{self.unit}] at {len(self.time)} times>"


class Replayed(NamedTuple):
    """One sample again: values of the uncertain quantities, the outputs (time x output), and why that is not all."""

    values: np.ndarray
    motion: np.ndarray
    reached: float
    why: str
    decided: str


class Samples(NamedTuple):
    """Samples of outputs that were not integrated: each is no farther from the true output than its error."""

    values: np.ndarray
    """Of the uncertain quantities: sample x quantity."""
    times: list
    """s"""
    outputs: list
    """Names."""
    numbers: np.ndarray
    """sample x time x output"""
    errors: np.ndarray
    """Likewise, proved."""


class Described:
    """What describes itself as its file does."""

    def __init__(self, held):
        self._held, self._fields = held, None

    @property
    def fields(self):
        """Every Field of the file (docs/results-file.md, docs/sweeps.md), by its path; bounds are one field."""
        if self._fields is None:
            self._fields = {f[0]: Field(f[0], f[1], f[2], tuple(f[3]), f[4]) for f in self._held.fields()}
        return self._fields

    def value(self, path):
        """The value of a field; None if it is not there."""
        field = self.fields.get(path)
        return None if field is None else field.value


class Results(Described):
    """What a run found. `results["tip height"]` is an output; `results.to_xarray()` is all of it."""

    def __init__(self, held, name="results"):
        super().__init__(held)
        self._name = name

    def _text_of(self, path):
        return list(self.value(path) or [])

    @property
    def title(self):
        return self.value("/title")

    @property
    def outputs(self):
        """Names of the outputs, those that requirements brought among them."""
        return tuple(self._text_of("/output"))

    @property
    def quantities(self):
        """Names of the uncertain quantities."""
        return tuple(self._text_of("/quantity"))

    @property
    def time(self):
        """Output times, s."""
        return np.asarray(self.value("/time"))

    @property
    def verdict(self):
        """Whether every sample lies inside what is guaranteed."""
        found = self._held.verdict()
        return Verdict(found["word"] or "uncompared", found["sentence"], list(found["notes"]), found["overestimation"])

    @property
    def ended(self):
        """Why the run ended before all was done; empty if it did not."""
        return self._held.ended()

    @property
    def requirements(self):
        """A row a requirement: its word ("met", "violated", "partly", "open") and the three answers."""
        return _framed(list(self._held.requirements()))

    @property
    def uncertain(self):
        """A row an uncertain quantity: its interval, nominal value, unit, distribution and membership."""
        columns = {"name": "/quantity"} | {
            key: f"/study/uncertain/{key}"
            for key in ("quantity", "unit", "lower", "nominal", "upper", "distribution", "membership")
        }
        values = [self._text_of(path) for path in columns.values()]
        return _framed([dict(zip(columns, row)) for row in zip(*values)])

    def _rows(self, group, dimensions):
        """The fields of a group that have these dimensions, a row for every combination of their places; none of NaN alone."""
        fields = {path.rsplit("/", 1)[-1]: f.array() for path, f in self.fields.items()
                  if path.startswith(group + "/") and f.dimensions == dimensions}  # fmt: skip
        fields = {name: array for name, array in fields.items() if array is not None and array.size}
        if not fields:
            return _framed([])
        places = [self.value(path) for path in dimensions]
        names = [path.rsplit("/", 1)[-1] for path in dimensions]
        rows = []
        for index in np.ndindex(*(len(each) for each in places)):
            row = {name: array[index] for name, array in fields.items()}
            if not all(np.all(np.isnan(number)) for number in row.values()):
                rows.append({**{name: of[i] for name, of, i in zip(names, places, index)}, **row})
        return _framed(rows)

    @property
    def probabilities(self):
        """A row a time, output and value: proved bounds of the probability that the output is not above the value."""
        return self._rows("/distribution", ("/distribution/time", "/output", "/distribution/point"))

    @property
    def sensitivity(self):
        """A row a time, output and quantity: proved bounds of its Sobol' index and total index, and their estimates."""
        return self._rows("/sensitivity", ("/sensitivity/time", "/output", "/quantity"))

    @property
    def derivatives(self):
        """Likewise, bounds of the derivatives of outputs by quantities, where the study asks for them."""
        return self._rows("/derivatives", ("/derivatives/time", "/output", "/quantity"))

    def __getitem__(self, name):
        if name not in self.outputs:
            known = ", ".join(f"'{each}'" for each in self.keys())
            raise KeyError(f"no output is called '{name}'; expected one of {known}")
        return Output(self, self.outputs.index(name))

    def keys(self):
        """Names of the outputs that the study asks for."""
        return [name for name, is_margin in zip(self.outputs, self._held.margins()) if not is_margin]

    def __iter__(self):
        return iter(self.keys())

    def __len__(self):
        return len(self.keys())

    def __contains__(self, name):
        return name in self.outputs

    def to_xarray(self):
        """An xarray.Dataset of all arrays: `interval_at` is the field /interval/at, with dimensions time, output and
        bound. Single numbers and words are attributes."""
        import xarray

        variables, attributes, coordinates = {}, {}, {"bound": ["lower", "upper"]}
        for field in self.fields.values():
            name = "_".join(field.path.strip("/").split("/"))
            value = field.array()
            if not field.dimensions:
                attributes[name] = value
                continue
            if value is None or value.size == 0:
                continue
            dimensions = [_dimension(path) for path in field.dimensions]
            if field.path == field.dimensions[0]:
                coordinates[dimensions[0]] = (dimensions, value, {"units": field.unit, "long_name": field.meaning})
                continue
            if value.ndim == len(dimensions) + 1:
                dimensions.append("bound")
            variables[name] = (dimensions, value, {"units": field.unit, "long_name": field.meaning})
        coordinates["unit"] = (["output"], self._text_of("/study/outputs/unit"))
        return xarray.Dataset(variables, coordinates, attributes)

    def summary(self):
        """What `gamut run --json` says (docs/json.md), as dictionaries."""
        return json.loads(self._held.json())

    def save(self, path, *, overwrite=False):
        """Writes the results file (HDF5), whole or not at all."""
        self._held.save(os.fspath(path), overwrite)

    def report(self, path, *, overwrite=False):
        """Writes the report, one page that opens in a browser."""
        self._held.save_report(os.fspath(path), overwrite)

    def extend(self, samples, *, jobs=None, time_limit=None, memory_limit=None, progress=True):
        """Results with so many samples in all; what was proved stays."""
        from .study import _checked

        _checked(samples, None, jobs, time_limit, memory_limit)
        show, wipe = told(progress)
        try:
            held, note, was_interrupted = self._held.extend(
                self._name, samples, jobs, time_limit, memory_limit, show
            )
        finally:
            wipe()
        extended = None if held is None else Results(held, self._name)
        if was_interrupted:
            raise Interrupted(extended)
        if held is None:
            raise RuntimeError(f"{note}, before the samples that there are had come again")
        return extended

    def replay(self, number):
        """The sample of this number once more, bit for bit as it went into the statistics."""
        return Replayed(**self._held.replay(self._name, number))

    def sample(self, samples, *, plan="random", seed=1, times=(), outputs=(), jobs=None):
        """So many samples of the outputs' polynomials; without `times` (s) and `outputs` (names) of all that there are."""
        return Samples(**self._held.sample(self._name, samples, plan, seed, list(times), list(outputs), jobs))

    def plot(self, name, axes=None):
        """Draws an output's three answers over time with matplotlib; returns the axes."""
        return self[name].plot(axes)

    def _repr_html_(self):
        from html import escape

        page = escape(self._held.page(), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 40rem; border: 0"></iframe>'

    def __str__(self):
        return self._held.text()

    def __repr__(self):
        return f"<gamut.Results '{self.title}': {self.verdict.word}>"


def open(path):  # noqa: A001
    """The results in a file that `gamut run` or Results.save wrote, or the Sweep of `gamut sweep` or Sweep.save."""
    name = os.fspath(path)
    if _gamut.is_sweep(name):
        from .sweep import Sweep

        return Sweep(_gamut.open_sweep(name))
    return Results(_gamut.open(name), name)


def compare(first, second):
    """What two Results, or the files that hold them, differ by, as `gamut compare --json` says (docs/json.md)."""
    first, second = (each if isinstance(each, Results) else open(each) for each in (first, second))
    return json.loads(_gamut.compare(first._held, second._held, first._name, second._name))
