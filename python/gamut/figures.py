"""An output's three answers, in the colours of the report."""

GUARANTEED, PROBABLE, POSSIBLE, NOMINAL = "#1f5f99", "#c46a00", "#7a4fa3", "#1d2733"


def _draw_at_rest(output, axes):
    for row, (bounds, colour, name) in enumerate(
        ((output.guaranteed, GUARANTEED, "guaranteed"), (output.sampled, PROBABLE, "sampled"))
    ):
        if bounds is not None:
            axes.plot([bounds.lower[0], bounds.upper[0]], [row, row], color=colour, linewidth=6, label=name)
    axes.set_yticks([])
    axes.set_xlabel(f"{output.name} [{output.unit}]")


def _draw_in_time(output, axes):
    time = output.time
    if output.guaranteed is not None:
        axes.fill_between(time, *output.guaranteed, color=GUARANTEED, alpha=0.18, linewidth=0, label="guaranteed")
    for level, cut in (output.possible or {}).items():
        if 0 < level < 1:
            axes.plot(time, cut.lower, time, cut.upper, color=POSSIBLE, linewidth=0.6, alpha=0.3 + 0.6 * level)
    if output.possible:
        axes.plot([], [], color=POSSIBLE, linewidth=0.9, label="possible")
    if output.sampled is not None:
        axes.fill_between(time, *output.sampled, color=PROBABLE, alpha=0.25, linewidth=0, label="sampled")
        axes.plot(time, output.mean, color=PROBABLE, linewidth=1.2, label="mean")
    axes.set_xlabel("time [s]")
    axes.set_ylabel(f"{output.name} [{output.unit}]" if output.unit else output.name)


def draw(output, axes=None):
    """On these axes of matplotlib, or on new ones."""
    if axes is None:
        from matplotlib import pyplot

        axes = pyplot.subplots()[1]
    (_draw_in_time if len(output.time) > 1 else _draw_at_rest)(output, axes)
    axes.legend()
    return axes
