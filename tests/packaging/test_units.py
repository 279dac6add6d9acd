"""Each header that decides something has unit tests; each tuning number names its test."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
HEADERS = ROOT / "include" / "saltus"
UNIT = ROOT / "tests" / "unit"
LAYERS = ("model", "plan", "solver", "simulation")
INCLUDE = re.compile(r'^#include "saltus/([^"]+)"', re.M)
# Headers without a file of their own, and where their decisions are tested; None: they decide
# nothing, because they declare, or hold values.
ELSEWHERE = {
    "model/detail/context_data": "unit/context_test.cpp",
    "model/detail/names": "errors/model_errors_test.cpp",
    "model/detail/sound": "unit/context_json_test.cpp",
    "model/detail/soundness": "unit/diagram_builder_test.cpp",
    "model/detail/wiring_errors": "errors/model_errors_test.cpp",
    "model/detail/shape_guess": "python/errors/test_shapes_that_are_guesses.py",
    "plan/detail/arguments": None,
    "plan/detail/calls": None,
    "plan/detail/carried_memory": "unit/contact_guards_test.cpp",
    "plan/detail/controls": "unit/library_subsystems_test.cpp",
    "plan/detail/fixed_inputs": "unit/evaluate_test.cpp",
    "plan/detail/flow_divisors": "laws/poles_test.cpp",
    "plan/detail/flow_graph": "unit/series_kinks_test.cpp",
    "plan/detail/flow_series": "unit/taylor_test.cpp",
    "plan/detail/flow_variables": None,
    "plan/detail/guard_waves": "laws/resting_waves_test.cpp",
    "solver/detail/wave_looks": "laws/resting_waves_test.cpp",
    "plan/detail/kept": None,
    "plan/detail/leaf_function": "unit/linearize_test.cpp",
    "plan/detail/memory": None,
    "plan/detail/passes": "unit/islands_test.cpp",
    "simulation/detail/called_derivatives": "unit/declared_derivatives_test.cpp",
    "simulation/detail/called_tangents": "laws/sensitivities_test.cpp",
    "simulation/detail/chain_rule": "unit/linearize_test.cpp",
    "simulation/detail/kinks": "unit/computed_derivatives_test.cpp",
    "simulation/detail/parameter_moves": None,
    "simulation/detail/collector": "unit/instant_test.cpp",
    "simulation/detail/effects": "unit/transition_test.cpp",
    "simulation/detail/dense_tangents": "unit/dense_sensitivities_test.cpp",
    "simulation/detail/deliveries": "semantics/event_wires_delay_test.cpp",
    "simulation/detail/endings": "errors/chattering_errors_test.cpp",
    "simulation/detail/executions": "semantics/queue_schedule_test.cpp",
    "simulation/detail/first_time": "laws/fast_effects_test.cpp",
    "simulation/detail/flow_chain": "unit/declared_derivatives_test.cpp",
    "simulation/detail/flow_jumps": "laws/sensitivities_test.cpp",
    "simulation/detail/flow_probe": "unit/departure_test.cpp",
    "simulation/detail/flow_switches": "laws/moved_jumps_test.cpp",
    "simulation/detail/flow_terms": "laws/stage_tangents_test.cpp",
    "simulation/detail/given_inputs": "unit/linearize_test.cpp",
    "simulation/detail/guard_sides": "unit/instant_test.cpp",
    "simulation/detail/guard_looks": "unit/departure_test.cpp",
    "simulation/detail/histories": "unit/library_transport_delay_test.cpp",
    "simulation/detail/instant_parts": "semantics/results_resume_test.cpp",
    "simulation/detail/instant_rows": "semantics/rows_count_test.cpp",
    "simulation/detail/integration": None,
    "simulation/detail/inputs_before": "unit/library_subsystems_test.cpp",
    "simulation/detail/island_contexts": "laws/island_runs_test.cpp",
    "simulation/detail/island_merger": "laws/island_runs_test.cpp",
    "simulation/detail/island_progress": "laws/island_runs_test.cpp",
    "simulation/detail/island_runs": "laws/island_runs_test.cpp",
    "simulation/detail/guards_at_zero": "python/sensitivity/test_no_derivative.py",
    "simulation/detail/held_tangents": "laws/sensitivities_test.cpp",
    "simulation/detail/guarded": None,
    "simulation/detail/island_schedule": "laws/island_wires_test.cpp",
    "simulation/detail/island_tangents": "laws/island_sensitivities_test.cpp",
    "simulation/detail/monitor_log": "laws/jumped_signals_test.cpp",
    "simulation/detail/nodal_values": "unit/trajectory_test.cpp",
    "simulation/detail/option_table": "unit/options_test.cpp",
    "simulation/detail/other_truth": "python/sensitivity/test_no_derivative.py",
    "simulation/detail/pass_tangents": "laws/sensitivities_test.cpp",
    "simulation/detail/poles": "laws/poles_test.cpp",
    "simulation/detail/resting_kinks": "python/sensitivity/test_no_derivative.py",
    "simulation/detail/recorded_under": "unit/dense_output_test.cpp",
    "simulation/detail/rows": "laws/rows_test.cpp",
    "simulation/detail/run": "semantics/results_resume_test.cpp",
    "simulation/detail/run_by_steps": "laws/island_wires_test.cpp",
    "simulation/detail/run_loop": "semantics/results_resume_test.cpp",
    "simulation/detail/side_by_side": "laws/island_threads_test.cpp",
    "simulation/detail/signal_tangents": "unit/dense_sensitivities_test.cpp",
    "simulation/detail/state_parts": "unit/holds_test.cpp",
    "simulation/detail/state_writes": "unit/transition_test.cpp",
    "simulation/detail/stop_crossings": "semantics/instant_ties_test.cpp",
    "simulation/detail/standstill": "unit/evaluate_test.cpp",
    "simulation/detail/one_sided": "laws/sensitivities_test.cpp",
    "simulation/detail/stage_tangents": "laws/stage_tangents_test.cpp",
    "simulation/detail/stage_accuracy": "laws/stage_tangents_test.cpp",
    "simulation/detail/stage_step": "laws/stage_tangents_test.cpp",
    "simulation/detail/step_tangents": "laws/stage_tangents_test.cpp",
    "simulation/detail/tangent_columns": None,
    "simulation/detail/tangent_events": "laws/sensitivities_test.cpp",
    "simulation/detail/tangent_flow": "laws/sensitivities_test.cpp",
    "simulation/detail/tangent_probe": "laws/sensitivities_test.cpp",
    "simulation/detail/tangent_rows": "laws/sensitivities_test.cpp",
    "simulation/detail/tangent_start": "laws/sensitivities_test.cpp",
    "simulation/detail/tangent_waits": "laws/waiting_sensitivities_test.cpp",
    "simulation/detail/tangent_times": "laws/sensitivities_test.cpp",
    "simulation/detail/tangent_trajectory": "unit/dense_sensitivities_test.cpp",
    "simulation/detail/tangents": "laws/sensitivities_test.cpp",
    "simulation/detail/thresholds": None,
    "simulation/detail/waiting_tangents": "laws/waiting_sensitivities_test.cpp",
    "simulation/detail/waiting_queues": "semantics/queue_schedule_test.cpp",
    "simulation/detail/time_jumps": "laws/moved_jumps_test.cpp",
    "simulation/detail/trajectory_reader": "unit/dense_output_test.cpp",
    "solver/detail/column_steps": "laws/stage_tangents_test.cpp",
    "solver/detail/cvode": None,
    "solver/detail/cvode_thresholds": None,
    "solver/detail/followed_guards": "unit/guard_set_test.cpp",
    "solver/detail/explicit_step": "unit/dopri5_test.cpp",
    "solver/detail/kernels": None,
    "solver/detail/look_points": None,
    "solver/detail/matrix_cost": None,
    "solver/detail/one_step": None,
    "solver/detail/paced_search": "laws/fast_guards_test.cpp",
    "solver/detail/piece_search": "unit/locate_test.cpp",
    "solver/detail/radau/scheme": None,
    "solver/detail/radau/tables": None,
    "solver/detail/radau/tuning": None,
    "solver/detail/search_thresholds": None,
    "solver/detail/solver": None,
    "solver/detail/step_polynomial": "unit/dop853_test.cpp",
    "solver/detail/step_solver": "unit/locate_test.cpp",
    "solver/detail/stiff_methods": "unit/stiff_choice_test.cpp",
    "solver/detail/stiff_thresholds": None,
    "solver/detail/tangent_step": "laws/domain_edges_test.cpp",
    "solver/detail/stretch_log": "unit/auto_solver_test.cpp",
    "solver/detail/tableau": None,
    "solver/detail/thresholds": None,
    "solver/detail/timed_search": "laws/timed_guards_test.cpp",
    "solver/detail/taylor/tuning": None,
}
TUNING = (
    "analysis/detail/thresholds.hpp",
    "simulation/detail/thresholds.hpp",
    "solver/detail/cvode_thresholds.hpp",
    "solver/detail/linear_thresholds.hpp",
    "solver/detail/search_thresholds.hpp",
    "solver/detail/stiff_thresholds.hpp",
    "solver/detail/thresholds.hpp",
    "solver/detail/radau/tuning.hpp",
    "solver/detail/taylor/tuning.hpp",
)


def deciding_headers():
    found = (path for layer in LAYERS for path in (HEADERS / layer / "detail").rglob("*.hpp"))
    return [str(path.relative_to(HEADERS).with_suffix("")) for path in found]


INCLUDED = {name[:-4] for file in UNIT.glob("*.?pp") for name in INCLUDE.findall(file.read_text())}


def has_units(header):
    return header in INCLUDED or (UNIT / f"{Path(header).name}_test.cpp").exists()


def test_each_header_has_units_or_says_where_it_is_tested():
    assert [
        name for name in deciding_headers() if not has_units(name) and name not in ELSEWHERE
    ] == []


def test_the_table_has_no_rows_that_are_not_needed():
    missing = [name for name in deciding_headers() if not has_units(name)]
    assert sorted(set(ELSEWHERE) - set(missing)) == []
    assert [
        file for file in ELSEWHERE.values() if file and not (ROOT / "tests" / file).exists()
    ] == []


@pytest.mark.parametrize("file", TUNING)
def test_the_tests_that_tuning_numbers_name_exist(file):
    names = re.findall(r"\btests/[\w/]+(?:\.cpp)?", (HEADERS / file).read_text())
    assert names and [name for name in names if not (ROOT / name).exists()] == []


@pytest.mark.parametrize("file", TUNING)
def test_a_tuning_number_names_its_test_or_is_named_as_having_none(file):
    text = (HEADERS / file).read_text()
    head = " ".join(line.removeprefix("// ") for line in text.split("#pragma")[0].splitlines())
    without = re.search(r"No test holds (.*?)\.", head)
    without = set(re.findall(r"\w+", without[1])) if without else set()
    doc = section = ""
    untested = set()
    before = ""
    for line in text.splitlines():
        if line.startswith("// ---"):
            section = line
        if line.startswith("///"):
            doc = line if not before.startswith("///") else doc + line
        names = re.findall(r"\b([a-z_0-9]+) =", line) if "inline constexpr" in line else []
        if "tests/" not in doc + section:
            untested |= set(names)
        before = line
    assert sorted(untested - without - {"eps", "time_of_change"}) == []  # the second is a quotient
