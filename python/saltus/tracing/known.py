"""`Known`: a function that says itself how it runs, so it is neither traced nor searched."""

from __future__ import annotations

from saltus.tracing.signature import Refused, Traced

__all__ = ["Known"]


class Known:
    """A callback made by this package: a tape, or a function that writes nothing but the state
    that it returns.
    """

    def outcome(self) -> Traced | Refused:
        """The answer that `trace` would give."""
        raise NotImplementedError
