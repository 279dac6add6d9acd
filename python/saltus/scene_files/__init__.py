"""Scenes as files: TOML for people, JSON of the same tables for machines.

Nothing in a file executes code: expressions are parsed, checked, and traced.
"""

from saltus.errors import SceneError
from saltus.scene_files.files import dumps, load, loads, schema
from saltus.scene_files.first import first_scene
from saltus.scene_files.scene import FileScene

__all__ = ["FileScene", "SceneError", "dumps", "first_scene", "load", "loads", "schema"]
