"""saltus list: the scenes of the shelf, each with its difficulty."""

from __future__ import annotations

import argparse
import json

from saltus.cli.table import print_table
from saltus.scenes import shelf

__all__ = ["act", "add_arguments"]

NAME = "list"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--json", action="store_true", help="an object of names and titles")


def act(chosen: argparse.Namespace) -> int:
    if chosen.json:
        print(json.dumps(shelf(), indent=1))
    else:
        print_table(list(shelf().items()))
    return 0
