"""Systems: a block or a diagram, with its ports."""

from saltus.ports import InputPort, OutputPort
from saltus.system.living import remember, system_of
from saltus.system.system import System

__all__ = ["InputPort", "OutputPort", "System", "remember", "system_of"]
