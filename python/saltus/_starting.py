"""Ctrl-C while the command `saltus` is being imported ends it quietly, as Ctrl-C in a run does.

Only a process that is the command is concerned: a program that imports saltus keeps its own answer
to Ctrl-C. This module is imported before all others, and imports nothing for such a program.
"""

import os
import sys

__all__ = ["begin", "end", "is_command"]

INTERRUPTED = 130  # the exit code in a shell of a program that Ctrl-C ended

_before = None
"""the answer to Ctrl-C that `end` gives back"""


def is_command(name: str, whole: list[str]) -> bool:
    """Whether `sys.argv[0]` and `sys.orig_argv` are those of the command: the script `saltus`, or
    `python -m saltus`, whose first argument is '-m' as long as the package is imported.
    """
    if name == "-m":
        return "saltus" in whole
    return os.path.basename(name).removesuffix(".exe") == "saltus"


def begin() -> None:
    """From here to `end` Ctrl-C ends the process, if it is the command."""
    global _before
    if not is_command(next(iter(getattr(sys, "argv", ())), ""), sys.orig_argv):
        return
    import signal
    import threading

    main = threading.current_thread() is threading.main_thread()  # others cannot set a handler
    if main and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        _before = signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))


def end() -> None:
    """Gives Ctrl-C its usual answer back: the exception KeyboardInterrupt."""
    global _before
    if _before is not None:
        import signal

        signal.signal(signal.SIGINT, _before)
        _before = None


begin()
