"""Pages about runs."""

from saltus.viewing.view import view, view_results

__all__ = ["view", "view_results"]
