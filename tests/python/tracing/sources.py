"""Where a text stands in a function."""

import inspect
import os


def line_of(function, text):
    """The file and line where the text stands in a function, as reasons say it."""
    file = os.path.basename(inspect.getsourcefile(function))
    lines, first = inspect.getsourcelines(function)
    for i, line in enumerate(lines):
        if text in line:
            return f"{file}:{first + i} (`{line.strip()}`)"
    raise AssertionError(text)
