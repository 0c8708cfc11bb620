"""What can go wrong. A limit that was reached, or an enclosure that ends early, is no exception: results say so."""


class StudyError(ValueError):
    """A study makes no sense: where, what is wrong, and what was expected."""

    def __init__(self, place, problem, expected):
        super().__init__(f"{place}: {problem}" + (f"; expected {expected}" if expected else ""))
        self.place = place
        """Of a file "file:line:column"."""
        self.problem = problem
        self.expected = expected
        parts = place.rsplit(":", 2)
        stands = len(parts) == 3 and parts[1].isdigit() and parts[2].isdigit()
        self.file = parts[0] if stands else place
        self.line = int(parts[1]) if stands else None
        self.column = int(parts[2]) if stands else None

    def __reduce__(self):
        return type(self), (self.place, self.problem, self.expected)


class ResultsFileError(ValueError):
    """A file that is no results file, or a damaged one."""


class NotComparable(ValueError):
    """Results that have no output in common."""


class Interrupted(KeyboardInterrupt):
    """An interrupt (Ctrl-C) ended the work; `results` is what was found and proved until then, or None."""

    def __init__(self, results=None):
        super().__init__("interrupted; what was found until then is the attribute results of this exception")
        self.results = results
