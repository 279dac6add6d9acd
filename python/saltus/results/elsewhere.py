"""Names of results in SciPy and similar tools, and where each is here."""

from __future__ import annotations

__all__ = ["INSTEAD"]

STATE = "a recorded signal is results['name'], and the final state results.context.continuous_state"
INSTEAD = {
    **dict.fromkeys(("t", "ts", "times"), "the times of the rows are results.time"),
    **dict.fromkeys(("x", "xs", "y", "ys", "state", "states", "continuous_state"), STATE),
    **dict.fromkeys(
        ("signals", "recorded_signals", "data"), "recorded signals are results.outputs"
    ),
    **dict.fromkeys(("df", "to_dataframe", "to_df", "dataframe"), "it is results.to_pandas()"),
    **dict.fromkeys(("to_file", "write", "dump"), "results.save(path), or results.to_csv(path)"),
    "keys": "the names of the recorded signals are list(results)",
    "sol": "values at any time are results(t), with the option dense_output=True",
    "success": "a run came to its end if results.status == 'reached_end'",
    "t_events": "the times of an event are results.events.times('name')",
    "y_events": "the states at an event are results.events[0].before and .after",
    "nfev": "it is results.statistics.right_hand_side_calls",
    "njev": "it is results.statistics.jacobian_calls",
    "nlu": "it is results.statistics.linear_setups",
    "final_context": "it is results.context",
    "parameters": "they are those of results.context",
}
"""names of results in SciPy and similar tools -> where it is here"""
