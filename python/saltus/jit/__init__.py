"""Machine code from tapes, by llvmlite: the extra ``saltus[jit]``.

Nothing here is needed to run a model, and `import saltus` does not import it. The engine calls
`functions` when a run has shown that machine code pays, see the option `machine_code`.
"""

from saltus.jit.disk import cache_directory
from saltus.jit.library import functions, is_installed, require_installed

__all__ = ["cache_directory", "functions", "is_installed", "require_installed"]
