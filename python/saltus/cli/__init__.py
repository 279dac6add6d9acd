"""The command `saltus`: ready scenes, and systems of your own, from a shell."""

from saltus import _starting

_starting.begin()  # the imports of the command may be interrupted as those of the package

from saltus.cli.command import main  # noqa: E402

_starting.end()

__all__ = ["main"]
