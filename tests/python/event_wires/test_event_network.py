"""A network of integrate-and-fire cells against a reference with exact propagation."""

import heapq

import numpy as np
import pytest
import saltus
from cells import TAU, Cell

N, TARGETS = 1000, 100
DELAY = 0.0015  # [s]
END = 0.02  # [s]


def draw():
    random = np.random.default_rng(9)
    currents = random.uniform(1.5, 3.0, N) / TAU  # v' at the threshold is at least 0.5 / TAU
    start = random.uniform(0.0, 1.0, N)
    targets = np.array([random.choice(N, TARGETS, replace=False) for _ in range(N)])
    weights = random.uniform(-0.02, 0.03, (N, TARGETS))
    return currents, start, targets, weights


def reference(currents, v, targets, weights):
    """Spikes (time, cell), and the least distance from the threshold after a jump.

    Between events v is a exp(-t / TAU) + CURRENT TAU (1 - exp(-t / TAU)), so that the time to the
    threshold is a logarithm.
    """
    rest, v = currents * TAU, v.copy()
    t, margin, queue, spikes = 0.0, np.inf, [], []
    while True:
        wait = TAU * np.log((rest - v) / (rest - 1.0))
        cell = int(np.argmin(wait))
        arrival = queue[0][0] if queue else np.inf
        now = min(t + wait[cell], arrival)
        if now > END:
            return spikes, margin
        v = rest + (v - rest) * np.exp(-(now - t) / TAU)
        t = now
        fired = [cell]
        if arrival <= now:  # all that arrive at one time, and then the threshold
            reached = set()
            while queue and queue[0][0] == now:
                _, source = heapq.heappop(queue)
                v[targets[source]] += weights[source]
                reached.update(targets[source].tolist())
            reached = sorted(reached)
            margin = min(margin, np.abs(v[reached] - 1.0).min())
            fired = [k for k in reached if v[k] >= 1.0]
        for k in fired:
            v[k] = 0.0
            spikes.append((t, k))
            heapq.heappush(queue, (t + DELAY, k))


def network(currents, start, targets, weights):
    builder = saltus.DiagramBuilder()
    cells = [Cell(f"c{k}", currents[k], start[k]) for k in range(N)]
    builder.add(*cells)
    sources = [cell.event_output("fire") for cell in cells]
    synapses = [cell.event_input("synapse") for cell in cells]
    for k, source in enumerate(sources):
        for target, weight in zip(targets[k], weights[k], strict=True):
            builder.connect_event(source, synapses[target], weight, DELAY)
    return builder.build()


@pytest.mark.parametrize("islands", [False, True])
def test_spikes_of_a_thousand_cells_are_those_of_exact_propagation(islands):
    """The engine's v is wrong by 1e-8, some ten times atol, since the last spike of a cell. Its
    spike time is then wrong by 1e-8 TAU / 0.5, and each spike of another cell moves v by w times
    that over TAU, at most 1e-9 for each. A few generations of spikes double it: 1e-7 s is far
    above. The order of spikes is that of the reference if no jump ends as close to the threshold
    as the error of v.
    """
    drawn = draw()
    spikes, margin = reference(*drawn)
    assert len(spikes) > N and margin > 5e-6
    results = saltus.simulate(
        network(*drawn), time_span=(0.0, END), rtol=1e-8, atol=1e-9, islands=islands
    )
    assert len(results.events) == len(spikes)
    for k in range(N):
        mine = [t for t, cell in spikes if cell == k]
        np.testing.assert_allclose(results.events.times(f"c{k}.fire"), mine, atol=1e-7)
