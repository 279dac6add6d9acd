"""Options that are given once: of two values one would be ignored."""

from __future__ import annotations

import argparse
from typing import Any

__all__ = ["OnceAction", "OnceTrueAction"]


def _note(action: argparse.Action, namespace: argparse.Namespace) -> None:
    """Refuses an option that is there already, also by its other name."""
    given = vars(namespace).setdefault("given", set())
    if action.option_strings and action.dest in given:
        names = " or ".join(action.option_strings)
        raise argparse.ArgumentError(None, f"{names} is given twice; keep one of them")
    given.add(action.dest)


class OnceAction(argparse.Action):
    """Keeps the value of an option."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        _note(self, namespace)
        setattr(namespace, self.dest, values)


class OnceTrueAction(OnceAction):
    """A flag without a value."""

    def __init__(self, option_strings: list[str], dest: str, **options: Any):
        super().__init__(option_strings, dest, nargs=0, default=False, **options)

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        super().__call__(parser, namespace, True, option_string)
