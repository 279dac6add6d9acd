"""The command `saltus`: ready scenes, and systems of your own, from a shell."""

from saltus.cli.command import main

__all__ = ["main"]
