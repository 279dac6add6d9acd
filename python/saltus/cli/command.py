"""`saltus SUBCOMMAND ...`: the parser, and how errors are shown."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

from saltus import __version__
from saltus.cli import (
    describe_scene,
    list_scenes,
    new_scene,
    report_scene,
    run_scene,
    sweep_scene,
    view_scene,
)
from saltus.cli.once import OnceAction, OnceTrueAction
from saltus.errors import Error

__all__ = ["UsageError", "main"]

SUBCOMMANDS = (
    list_scenes,
    run_scene,
    view_scene,
    describe_scene,
    report_scene,
    sweep_scene,
    new_scene,
)
INTERRUPTED = 130  # the exit code in a shell of a program that Ctrl-C ended


class UsageError(Exception):
    """A mistake that the user can mend. It is shown as a message without a traceback."""


class _Parser(argparse.ArgumentParser):
    """Answers wrong use in one line, as the subcommands do. An option with one value is given
    once.
    """

    def __init__(self, *arguments: Any, **options: Any):
        super().__init__(*arguments, **options)
        self.register("action", None, OnceAction)
        self.register("action", "store_true", OnceTrueAction)

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message}; `{self.prog} --help` says more\n")


def parser() -> argparse.ArgumentParser:
    """The parser of all subcommands."""
    whole = _Parser(
        prog="saltus",
        description="Hybrid ODEs: run ready scenes, or systems of your own.",
        epilog="`saltus SUBCOMMAND --help` says more. Exit codes: 0; 1 for a run that did not end "
        "well; 2 for wrong use.",
    )
    whole.add_argument("--version", action="version", version=f"saltus {__version__}")
    subcommands = whole.add_subparsers(metavar="SUBCOMMAND", required=True)
    for module in SUBCOMMANDS:
        summary = (module.__doc__ or "").split(": ", 1)[1].split("\n")[0]
        sub = subcommands.add_parser(
            module.NAME,
            help=summary,
            description=module.__doc__,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        module.add_arguments(sub)
        sub.set_defaults(act=module.act, name=module.NAME)
    return whole


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command with these arguments, by default those of the process.

    Parameters
    ----------
    arguments : sequence of str, optional
        The words after ``saltus`` in the shell.

    Returns
    -------
    int
        The exit code: 0, 1 for a run that did not end well, 2 for wrong use, 130 after Ctrl-C.

    Examples
    --------
    >>> from saltus.cli import main
    >>> main(["run", "bouncing-ball", "--t-end", "3", "--quiet"])
    0
    """
    chosen = parser().parse_args(arguments)
    try:
        code: int = chosen.act(chosen)
        sys.stdout.flush()
        return code
    except (Error, UsageError, ImportError, OSError, ArithmeticError) as error:
        if isinstance(error, BrokenPipeError):  # `saltus list | head`
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return 0
        message = " ".join(str(error).split())  # one line, also for an algebraic loop
        message = message.removeprefix(f"{chosen.name}: ")  # saltus.sweep says its name too
        print(f"saltus {chosen.name}: {message}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(f"saltus {chosen.name}: interrupted", file=sys.stderr)
        return INTERRUPTED
