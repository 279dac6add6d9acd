"""Cases of the SBML test suite, where there are any: a zip of them beside the checkout, or the
folder or zip that SALTUS_SBML_CASES names. They are no part of this project.
"""

import os
import sys
import zipfile
from pathlib import Path

import pytest

pytest.importorskip("libsbml", reason="python-libsbml reads the models")

ROOT = Path(__file__).parents[3]
sys.path.insert(0, str(ROOT / "bench" / "sbml"))

from suite import cases_of, is_flux_balance, outcome_of, saltus_run  # noqa: E402

CASES = Path(os.environ.get("SALTUS_SBML_CASES", ROOT.parent / "shared" / "sbml" / "cases.zip"))
REASONS = ("is fast", "a delay of a value")


@pytest.mark.skipif(not CASES.exists(), reason=f"no cases of the SBML test suite at {CASES}")
@pytest.mark.filterwarnings("ignore:.*units do not fit")
def test_every_case_passes_or_is_refused_by_name(tmp_path):
    folder = CASES
    if CASES.suffix == ".zip":
        with zipfile.ZipFile(CASES) as archive:
            archive.extractall(tmp_path)
        folder = tmp_path
    run = saltus_run()
    found = [outcome_of(case, run) for case in cases_of(folder) if not is_flux_balance(case)]
    bad = [
        f"{one.case} {one.status}: {one.reason}"
        for one in found
        if one.status == "wrong"
        or (one.status == "refused" and not any(words in one.reason for words in REASONS))
    ]
    assert found and not bad, "\n".join(bad)
