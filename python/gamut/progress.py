"""How far long work has come: a bar in a notebook and on a terminal."""

import sys


def _in_notebook():
    shell = sys.modules.get("IPython") and sys.modules["IPython"].get_ipython()
    return shell is not None and shell.__class__.__name__ == "ZMQInteractiveShell"


class Bar:
    """Called with a task and the fraction done of it."""

    def __init__(self):
        self._shown = None
        self._is_notebook = _in_notebook()

    def __call__(self, task, fraction):
        if self._is_notebook:
            self._show_in_notebook(task, fraction)
        elif sys.stderr.isatty():
            filled = int(24 * fraction)
            sys.stderr.write(f"\r{task}  [{'#' * filled}{' ' * (24 - filled)}] {100 * fraction:3.0f} %\033[K")
            sys.stderr.flush()
            self._shown = True

    def _show_in_notebook(self, task, fraction):
        from IPython.display import HTML, display

        bar = HTML(f'<progress max="1" value="{fraction:.3f}"></progress> {task}')
        if self._shown is None:
            self._shown = display(bar, display_id=True)
        else:
            self._shown.update(bar)

    def wipe(self):
        if self._shown is None:
            return
        if self._is_notebook:
            from IPython.display import HTML

            self._shown.update(HTML(""))
        else:
            sys.stderr.write("\r\033[K")
        self._shown = None


def told(progress):
    """What is to be called, and what wipes it: of True a bar, of False nothing, of a callable itself."""
    if progress is True:
        bar = Bar()
        return bar, bar.wipe
    return (progress or None), (lambda: None)
