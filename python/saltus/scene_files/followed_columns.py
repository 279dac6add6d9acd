"""The values of a context that follow from parameters of a scene, for the runs of a sweep."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from saltus.ensemble.table import Column, entry
from saltus.errors import ModelError
from saltus.scene_files.followed import Followed
from saltus.scene_files.maker import tree_with
from saltus.scene_files.systems import parameters_of
from saltus.scene_files.wrong import Wrong

__all__ = ["FollowedColumns"]


class FollowedColumns:
    """The values of a context that follow from parameters of a scene, row by row."""

    def __init__(self, tree: dict[str, Any], values: Followed, own: frozenset[str]):
        self.tree, self.own, self.followed = tree, own, values
        self._rows: dict[str, dict[str, np.ndarray]] = {}

    def __call__(self, columns: Mapping[str, Column]) -> dict[str, Column]:
        runs = len(next(iter(columns.values())))
        rows = [self.row({n: entry(columns[n], i) for n in self.own}) for i in range(runs)]
        made = {name: np.array([row[name] for row in rows]) for name in rows[0]}
        return made | {name: c for name, c in columns.items() if name not in self.own}

    def row(self, given: dict[str, Any]) -> dict[str, np.ndarray]:
        """The values for these parameters. ModelError for one that the file does not allow, and
        ValueError for one that is not finite.
        """
        key = repr(given)  # a sweep asks for the columns of a row more than once
        if key not in self._rows:
            try:
                values = parameters_of((), tree_with(self.tree, given), {})
                found = list(self.followed.entries(values))
            except Wrong as wrong:
                raise ModelError(wrong.message) from None
            made = {name: np.asarray(value, dtype=float) for name, value in found}
            if not all(np.isfinite(value).all() for value in made.values()):
                raise ValueError("a value that is not finite")
            self._rows[key] = made
        return self._rows[key]
