"""Whole runs, and all that they say."""

import saltus

SPAN = (0.0, 2.0)


def bits(results):
    """All that a run says, for comparison."""
    statistics = vars(results.statistics) | {"wall_time": 0.0}
    events = [(e.time, e.name, e.before.tolist(), e.after.tolist()) for e in results.events]
    outputs = {name: array.tobytes() for name, array in results.outputs.items()}
    x = results.context.continuous_state.tobytes()
    return (results.time.tobytes(), outputs, x, events, results.status, statistics)


def run(system, values=None, span=SPAN, outputs=("state",), **options):
    context = system.create_context() if values is None else values(system.create_context())
    recorded = {name: system.output(name) for name in outputs}
    return saltus.simulate(system, context, span, recorded_signals=recorded, **options)
