"""declare_time_event: a list of times, a period, an end, a count."""

import math

import numpy as np
import pytest
import saltus


class Counter(saltus.LeafSystem):
    """Counts its ticks."""

    def __init__(self, **times):
        super().__init__(name="counter")
        self.declare_discrete_state([0.0])
        self.declare_time_event(self.tick, name="tick", **times)

    def tick(self, time, state):
        return state.discrete_state + 1.0


def ticks(span=(0.0, 10.0), **times):
    counter = Counter(**times)
    results = saltus.simulate(counter, counter.create_context(), span)
    at = results.events.times("tick", "time")
    assert results.context.discrete_state[0] == len(at)
    return at.tolist()


@pytest.mark.parametrize(
    ("times", "expected"),
    [
        ({"times": [0.5, 1.0, 7.25]}, [0.5, 1.0, 7.25]),
        ({"times": np.array([0.0, 10.0])}, [0.0, 10.0]),
        ({"times": range(1, 4)}, [1.0, 2.0, 3.0]),
        ({"times": []}, []),
        ({"times": [-3.0, -1.0, 4.0, 40.0]}, [4.0]),
        ({"times": [1.0, 2.0, 3.0], "end": 2.0}, [1.0, 2.0]),
        ({"times": [1.0, 2.0, 3.0], "count": 2}, [1.0, 2.0]),
        ({"times": [1.0, 2.0, 3.0], "end": 0.5}, []),
        ({"period": 4.0}, [0.0, 4.0, 8.0]),
        ({"period": 4.0, "offset": 1.0}, [1.0, 5.0, 9.0]),
        ({"period": 1.0, "end": 2.0}, [0.0, 1.0, 2.0]),
        ({"period": 0.1, "end": 0.3}, [0.0, 0.1, 0.2, 3 * 0.1]),
        ({"period": 1.0, "offset": 2.0, "count": 2}, [2.0, 3.0]),
        ({"period": 1.0, "offset": 2.0, "end": 3.5, "count": 9}, [2.0, 3.0]),
        ({"period": 1.0, "offset": -3.0, "count": 5}, [0.0, 1.0]),
        ({"period": 1.0, "offset": 3.0, "end": 2.0}, []),
        ({"offset": 2.5}, [2.5]),
        ({"offset": 2.5, "end": 2.0}, []),
        ({"period": 3.0, "end": math.inf, "count": None}, [0.0, 3.0, 6.0, 9.0]),
    ],
)
def test_when_it_ticks(times, expected):
    assert ticks(**times) == expected


@pytest.mark.parametrize(
    "times",
    [{"times": [0.25, 0.5, 1.5, 2.0]}, {"period": 0.5, "end": 2.0}, {"period": 1.0, "count": 3}],
)
@pytest.mark.parametrize("cut", [0.3, 0.5, 1.0, 2.0, 2.5])
def test_a_run_in_two_parts_neither_repeats_nor_loses_a_tick(times, cut):
    counter = Counter(**times)
    whole = saltus.simulate(counter, counter.create_context(), (0.0, 3.0))
    first = saltus.simulate(counter, counter.create_context(), (0.0, cut))
    second = saltus.simulate(counter, first.context, (cut, 3.0))
    assert second.context.discrete_state == whole.context.discrete_state
    both = [*first.events.times("tick", "time"), *second.events.times("tick", "time")]
    assert both == whole.events.times("tick", "time").tolist()


def test_doses_reset_the_continuous_state():
    """x' = -x with a dose of 1 at 0, 1 and 2 s: a sum of three exponentials."""

    class Drug(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="drug")
            self.declare_continuous_state([0.0], ode=lambda t, s: -s.continuous_state)
            self.declare_time_event(
                lambda t, s: s.with_continuous_state(s.continuous_state + 1.0), times=[0, 1, 2]
            )

    drug = Drug()
    end = saltus.simulate(drug, drug.create_context(), (0.0, 3.0), rtol=1e-9, atol=1e-11).context
    # ten tolerances for each of the three flights
    assert end.continuous_state[0] == pytest.approx(np.exp([-3, -2, -1]).sum(), abs=3e-8)


def test_without_a_callback_it_is_a_stop():
    class Stop(saltus.LeafSystem):
        def __init__(self):
            super().__init__(name="stop")
            self.declare_continuous_state([0.0], ode=lambda t, s: [1.0])
            self.declare_continuous_state_output("x")
            self.declare_time_event(times=[0.125, 0.375])

    stop = Stop()
    recorded = {"x": stop.output("x")}
    rows = saltus.simulate(stop, stop.create_context(), (0, 1), recorded_signals=recorded).time
    assert {0.125, 0.375} <= set(rows.tolist())


@pytest.mark.parametrize(
    ("times", "message"),
    [
        ({"times": [1.0, 0.5]}, "expected increasing times .s., found 0.5 after 1"),
        ({"times": [1.0, 1.0]}, "expected increasing times .s., found 1 after 1"),
        ({"times": [1.0, np.nan]}, "expected finite times .s., found nan"),
        ({"times": [np.inf]}, "expected finite times .s., found inf"),
        ({"times": [1.0], "period": 1.0}, "it has times and a period or an offset"),
        ({"times": [1.0], "offset": 1.0}, "it has times and a period or an offset"),
        ({"times": ["soon"]}, "expected times .s., found .'soon'."),
        ({"times": 3.0}, "expected times .s., found 3.0"),
        ({"period": 0.0}, "period 0 s, offset 0 s; expected period > 0 and a finite offset"),
        ({"period": 1.0, "offset": np.nan}, "expected period > 0 and a finite offset"),
        ({"period": 1.0, "count": 0}, "expected a count of 1 or more, found 0"),
        ({"period": 1.0, "end": np.nan}, "expected a time .s. as its end, found nan"),
    ],
)
def test_what_makes_no_sense_is_refused(times, message):
    with pytest.raises(saltus.ModelError, match=f"block 'counter': time event.*{message}"):
        Counter(**times)


def test_a_picture_shows_the_times():
    listed = Counter(times=[0.5, 1, 2, 3, 4], end=3.5).to_dot()
    assert "tick at t = 0.5, 1, 2, 3, ... s to t = 3.5 s" in listed
    assert "tick every 0.5 s, 3 at most" in Counter(period=0.5, count=3).to_dot()
