"""The progress that a sweep shows while it runs."""

from __future__ import annotations

import sys
import time

__all__ = ["Progress"]

NOTED = 0.25  # [s] the time from one line of progress to the next


class Progress:
    """A bar of tqdm, or a line if tqdm is not installed; nothing unless the user asks for it."""

    def __init__(self, runs: int, wanted: bool):
        self.runs, self.bar, self.wanted = runs, None, wanted
        self.next = 0.0

    def __enter__(self) -> Progress:
        if self.wanted:
            try:
                import tqdm  # type: ignore[import-untyped,unused-ignore]

                self.bar = tqdm.tqdm(total=self.runs, unit="run")
            except ImportError:
                pass
        return self

    def watch(self, done: int) -> bool:
        """Shows the progress. A failure to show it never ends the sweep."""
        if self.bar is not None:
            self.bar.update(done - self.bar.n)
        elif self.wanted and time.monotonic() >= self.next:
            self.next = time.monotonic() + NOTED
            print(f"\r{done} of {self.runs} runs", end="", flush=True, file=sys.stderr)
        return False

    def __exit__(self, kind: object, *rest: object) -> None:
        if kind is None:
            self.next = 0.0
            self.watch(self.runs)
        if self.bar is not None:
            self.bar.close()
        elif self.wanted:
            print(file=sys.stderr)
