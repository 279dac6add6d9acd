"""Models in SBML: `load` makes a system of one, `time_course` a table.

python-libsbml reads the model: ``pip install 'saltus[sbml]'``.
"""

from saltus.sbml.course import time_course
from saltus.sbml.system import Model, load

__all__ = ["Model", "load", "time_course"]
