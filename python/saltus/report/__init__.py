"""Error against run time: `work_precision` measures it, `WorkPrecision` is the table it gives.

`python -m saltus.report FILE.json ... --out DIR` draws charts of reports that were written before,
by this module or by the examples in C++.
"""

from saltus.report.measure import work_precision
from saltus.report.table import WorkPrecision

__all__ = ["WorkPrecision", "work_precision"]
