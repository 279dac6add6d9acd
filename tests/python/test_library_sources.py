"""Sources of signals and random numbers: their law, their exact events, and the same bits again."""

import numpy as np
import pytest
import saltus
from saltus.library import *

response = saltus.response
METHODS = ["dopri5", "dop853", "radau", "bdf", "adams", "auto"]


def test_a_chirp_keeps_its_last_frequency():
    t = np.array([0.0, 1.0, 2.0, 3.0])
    phase = np.array([0.0, 1.5, 4.0, 7.0])
    y = response(Chirp(1.0, 3.0, stop_time=2.0, phi=0.5), t=t)
    np.testing.assert_allclose(y, np.cos(0.5 + phase), rtol=0, atol=1e-14)


def test_a_table_over_the_time():
    times, values = [1.0, 2.0, 4.0], [[0.0, 1.0], [3.0, 1.0], [1.0, 5.0]]
    t = [0.0, 1.5, 2.0, 3.0, 4.0, 9.0]
    y = response(DataSource(times, values), t=t)
    assert y.tolist() == [[0, 1], [1.5, 1], [3, 1], [2, 3], [1, 5], [1, 5]]
    y = response(DataSource(times, values, "zero_order_hold", "zero"), t=t)
    assert y.tolist() == [[0, 0], [0, 1], [3, 1], [3, 1], [0, 0], [0, 0]]


def test_a_table_from_a_file(tmp_path):
    path = tmp_path / "data.csv"
    path.write_text("t;u;v\n0;1;10\n2;3;30\n")
    options = {"delimiter": ";", "name": "data"}
    assert response(DataSource.from_csv(path, **options), t=1.0) == 2.0
    two = DataSource.from_csv(path, data_columns=[2, 1], **options)
    assert response(two, t=1.0).tolist() == [20.0, 2.0]
    with pytest.raises(OSError):
        DataSource.from_csv(tmp_path / "none.csv")
    for bad in [{"header_lines": 0}, {"data_columns": 7}]:
        with pytest.raises(saltus.ModelError, match=r"data\.csv.*expected numbers"):
            DataSource.from_csv(path, **options, **bad)


def integral_of(source, end, **options):
    builder = saltus.DiagramBuilder()
    x = builder.add(Integrator())
    builder.add(source)
    builder.connect(source.output(), x.input())
    return saltus.simulate(builder.build(), (0.0, end), **options).context[x].continuous_state[0]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    ("source", "end", "area"),
    [
        (lambda: Sawtooth(2.0, frequency=3.0), 10.0, 10.0),
        (lambda: DataSource(np.arange(101) / 10, np.arange(101) % 2), 10.0, 5.0),
        (lambda: DataSource([1.0, 2.0, 3.0], [1.0, 2.0, 7.0], "zero_order_hold", "zero"), 9.0, 3.0),
    ],
    ids=["Sawtooth", "DataSource", "held"],
)
def test_no_step_spans_a_jump_or_a_kink(method, source, end, area):
    """Each piece adds an error of some tolerances, 10 rtol abs(x) + atol; a step over a knot would
    add half of its length."""
    found = integral_of(source(), end, ode_solver_method=method, rtol=1e-9, atol=1e-11)
    assert found == pytest.approx(area, abs=100 * 1e-8)


@pytest.mark.parametrize(
    "source",
    [Chirp, Sawtooth, lambda: DataSource([0, 1], [0, 1])],
    ids=["Chirp", "Sawtooth", "DataSource"],
)
def test_taylor_refuses_a_choice_by_the_time(source):
    with pytest.raises(saltus.ModelError, match="'taylor'"):
        integral_of(source(), 1.0, ode_solver_method="taylor")


def test_random_numbers_repeat_and_differ():
    t = np.arange(5.0)
    one = response(RandomNumber(1.0, seed=1), t=t)
    assert one.tolist() == response(RandomNumber(1.0, seed=1), t=t).tolist()
    assert not np.any(one == response(RandomNumber(1.0, seed=2), t=t))
    assert len(set(one)) == 5
    assert response(RandomNumber(1.0, seed=1), t=3.7) == one[3]


def test_the_moments_of_random_numbers():
    """Five standard errors of the means over 4000 numbers."""
    normal = response(RandomNumber(1.0, mean=np.full(4000, 2.0), standard_deviation=3.0))
    assert normal.mean() == pytest.approx(2.0, abs=5 * 3 / 4000**0.5)
    assert normal.var() == pytest.approx(9.0, abs=5 * 9 * (2 / 4000) ** 0.5)
    lower = np.full(4000, -1.0)
    even = response(RandomNumber(1.0, "uniform", lower_limit=lower, upper_limit=3.0))
    assert even.mean() == pytest.approx(1.0, abs=5 * 4 / 12**0.5 / 4000**0.5)
    assert -1 < even.min() < -0.99 and 2.99 < even.max() < 3


def test_white_noise_has_its_power_in_every_period():
    for dt in [0.01, 0.5]:
        y = response(WhiteNoise(dt, power=np.full(4000, 2.0)))
        assert y.var() * dt == pytest.approx(2.0, abs=5 * 2 * (2 / 4000) ** 0.5)


def noisy():
    builder = saltus.DiagramBuilder()
    noise, lag = builder.add(
        WhiteNoise(0.1, name="noise"), TransferFunction([1], [1, 1], name="lag")
    )
    builder.connect(noise.output(), lag.input())
    builder.export_output(lag.output(), "y")
    return builder.build()


def test_a_resumed_run_meets_the_same_numbers():
    diagram = noisy()
    whole = saltus.simulate(diagram, (0.0, 4.0)).outputs["y"][-1]
    half = saltus.simulate(diagram, (0.0, 1.97)).context
    rest = saltus.simulate(diagram, half, (1.97, 4.0)).outputs["y"][-1]
    assert rest == pytest.approx(whole, rel=1e-9)  # the steps differ, the numbers do not


def test_a_sweep_over_seeds_has_the_bits_of_single_runs():
    diagram = noisy()
    contexts = [diagram.create_context().with_parameter("noise.seed", s) for s in range(4)]
    ends = [saltus.simulate(diagram, c, (0.0, 2.0)).outputs["y"][-1] for c in contexts]
    assert len(set(ends)) == 4
    again = [saltus.simulate(noisy(), c, (0.0, 2.0)).outputs["y"][-1] for c in reversed(contexts)]
    assert again[::-1] == ends


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Chirp(stop_time=0.0), "stop_time = 0 s"),
        (lambda: Sawtooth(frequency=-1.0), "frequency = -1 1/s"),
        (lambda: DataSource([0, 1], [1, 2, 3]), "times has 2 values, values has 3 rows"),
        (lambda: DataSource([1, 0], [1, 2]), "times that increase"),
        (lambda: DataSource([0, 1], [1, 2], "cubic"), "unknown interpolation 'cubic'"),
        (lambda: RandomNumber(1.0, "gauss"), "unknown distribution 'gauss'"),
        (lambda: RandomNumber(1.0, standard_deviation=-1), "expected a number >= 0"),
        (lambda: WhiteNoise(1.0, power=-1.0), "power = -1"),
    ],
)
def test_refusals(make, message):
    with pytest.raises(saltus.ModelError, match=message):
        make()
