"""`torch_function`: closed forms, PyTorch's own check of gradients, and what is refused."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import saltus
from saltus.errors import ModelError, SimulationError
from scenes_to_differentiate import STATE, Y0, Ball, E, G, impacts

torch = pytest.importorskip("torch")
# PyTorch itself calls what it deprecates when it first loads its forward mode
pytestmark = pytest.mark.filterwarnings("ignore:.*torch.jit.script.*:FutureWarning")
TIGHT = {"rtol": 1e-10, "atol": 1e-12}


def tensor(values, **more):
    return torch.tensor(values, dtype=torch.float64, **more)


@pytest.fixture(scope="module")
def f():
    return saltus.torch_function(
        Ball(), ["g", "e", "x[0]"], (0.0, 12.0), events={"bounce": 6}, **TIGHT
    )


@pytest.fixture
def p():
    return tensor([G, E, Y0], requires_grad=True)


def state(f):
    return lambda p: f(p).continuous_state


def test_closed_forms_in_both_directions(f, p):
    q = p.detach()
    for jacobian in (torch.func.jacrev, torch.func.jacfwd):
        found = jacobian(state(f))(q)
        np.testing.assert_allclose(found, STATE, rtol=0, atol=10 * 1e-10 * 370)
        found = jacobian(lambda p: f(p).events["bounce"])(q)
        np.testing.assert_allclose(found, impacts(6), rtol=0, atol=10 * 1e-10 * 33)


def test_gradcheck(f, p):
    """Differences of width 1e-6: errors of the run, 1e-9, over it are 1e-3."""
    values = lambda p: (f(p).continuous_state, f(p).events["bounce"])  # noqa: E731
    assert torch.autograd.gradcheck(values, (p,), atol=1e-3, check_forward_ad=True)


def test_backward_of_a_dict():
    f = saltus.torch_function(Ball(), ["e", "x[0]"], (0.0, 12.0), events={"bounce": 6}, **TIGHT)
    given = {"e": tensor(E, requires_grad=True), "x[0]": tensor(Y0, requires_grad=True)}
    f(given).events["bounce"][5].backward()
    found = [given["e"].grad, given["x[0]"].grad]
    np.testing.assert_allclose(found, impacts(6)[5, 1:], rtol=1e-9)


def test_vmap_and_threads(f, p):
    several = torch.stack([p.detach() * (1 - 1e-3 * i) for i in range(6)])
    slopes = torch.func.jacrev(state(f))
    alone = torch.stack([slopes(q) for q in several])
    assert torch.equal(torch.func.vmap(slopes)(several), alone)
    with ThreadPoolExecutor(4) as pool:
        assert torch.equal(torch.stack(list(pool.map(slopes, several))), alone)


def test_second_derivatives_are_refused(f, p):
    message = "torch_function: second derivatives of a run are not computed"
    first = torch.autograd.grad(f(p).continuous_state[0], p, create_graph=True)[0]
    with pytest.raises(ModelError, match=message):
        first.sum().backward()
    with pytest.raises(ModelError, match=message):
        torch.func.hessian(lambda p: f(p).continuous_state[0])(p.detach())


@pytest.mark.parametrize(
    "given, message",
    [
        (tensor([G, E]), r"p: expected the shape \(3,\), found \(2,\)"),
        (torch.ones(3), "p: expected float64, found torch.float32; make it with"),
        ([G, E, Y0], "p: expected a tensor of float64, found"),
        (torch.ones(3, dtype=torch.float64, device="meta"), "expected a tensor on the CPU"),
        ({"g": tensor(G), "e": tensor(E)}, r"the dict has no value of 'x\[0\]'"),
        (tensor([float("nan"), E, Y0]), "'g' is nan; give a finite value"),
    ],
)
def test_wrong_parameters(f, given, message):
    with pytest.raises(ModelError, match=message):
        f(given)


def test_fewer_events_and_gaps(f, p):
    with pytest.raises(
        SimulationError, match="torch_function: expected 6 events 'bounce', found 1"
    ):
        f(tensor([G, E, 100.0]))
    time = float(saltus.simulate(Ball(), (0.0, 3.0)).events.times("bounce")[0])
    for gaps in ("error", "nan"):
        f = saltus.torch_function(Ball(), ["g"], (0.0, time), gaps=gaps)
        g = tensor([G], requires_grad=True)
        end = f(g).continuous_state[1]
        if gaps == "nan":
            end.backward()
            assert torch.isnan(g.grad).all()
        else:
            with pytest.raises(SimulationError, match="has no derivative by 'g' from the event"):
                end.backward()
