"""Fixtures of the tests of tracing."""

import pytest
from saltus.tracing import tracing


@pytest.fixture
def made(monkeypatch):
    """One entry for each function that is traced, not looked up."""
    calls = []

    class Counted(tracing.Sandbox):
        def __init__(self):
            calls.append(1)
            super().__init__()

    monkeypatch.setattr(tracing, "Sandbox", Counted)
    return calls
