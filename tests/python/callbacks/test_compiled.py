"""Compiled functions: every kind of pointer, one signature."""

import ctypes
import shutil
import subprocess
import sys

import numpy as np
import pytest
import saltus
from saltus.library import Constant

from models import end, leaf

SOURCE = r"""
#include <math.h>
#include <stddef.h>
int decay(double t, const double* x, const double* u, const double* p, double* out, void* data) {
  out[0] = -p[0] * x[0] * (data ? *(double*)data : 1.0);
  return 0;
}
int fall(double t, const double* x, const double* u, const double* p, double* out, void* data) {
  out[0] = x[1], out[1] = -9.81;
  return 0;
}
int height(double t, const double* x, const double* u, const double* p, double* out, void* data) {
  out[0] = x[0];
  return 0;
}
int bounce(double t, const double* x, const double* u, const double* p, double* out, void* data) {
  out[0] = fabs(x[0]), out[1] = -0.9 * x[1], out[2] = x[2] + 1.0;
  return 0;
}
int sum(double t, const double* x, const double* u, const double* p, double* out, void* data) {
  out[0] = u[0] + 10.0 * u[1] + 100.0 * u[2];
  return 0;
}
int minus(double t, const double* x, const double* u, const double* p, double* out, void* data) {
  out[0] = -1.0, out[1] = 2.0, out[2] = 0.0, out[3] = -1e4;
  return 0;
}
int fails(double t, const double* x, const double* u, const double* p, double* out, void* data) {
  out[0] = -1.0;
  return t > 0.5 ? 7 : 0;
}
int tick(double t, const double* x, const double* u, const double* p, double* out, void* data) {
  out[0] = x[0] + 1.0;
  return 0;
}
"""
DOUBLES = ctypes.POINTER(ctypes.c_double)
KIND = ctypes.CFUNCTYPE(
    ctypes.c_int, ctypes.c_double, DOUBLES, DOUBLES, DOUBLES, DOUBLES, ctypes.c_void_p
)


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        pytest.skip("no C compiler")
    folder = tmp_path_factory.mktemp("compiled")
    (folder / "functions.c").write_text(SOURCE)
    command = [compiler, "-shared", "-fPIC", "-O2", "-o", "functions.so", "functions.c", "-lm"]
    subprocess.run(command, cwd=folder, check=True)
    return ctypes.CDLL(str(folder / "functions.so"))


def address(function):
    return ctypes.cast(function, ctypes.c_void_p).value


def capsule(function, name=None, context=None):
    new = ctypes.pythonapi.PyCapsule_New
    new.restype = ctypes.py_object
    new.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p]
    made = new(address(function), name, None)
    if context is not None:
        put = ctypes.pythonapi.PyCapsule_SetContext
        put.argtypes = [ctypes.py_object, ctypes.c_void_p]
        put(made, context)
    return made


@pytest.mark.parametrize("kind", ["ctypes", "address", "capsule", "prototype"])
def test_pointers(library, kind):
    ode = {
        "ctypes": lambda f: f,
        "address": lambda f: saltus.compiled(address(f)),
        "capsule": capsule,
        "prototype": lambda f: KIND(("decay", library)),
    }[kind](library.decay)
    block = leaf(ode, k=2.0)
    assert [(r.callback, r.runs) for r in block.explain()] == [("ode", "compiled")]
    assert end(block)[0] == pytest.approx(np.exp(-2.0), rel=1e-4)


def test_user_data(library):
    twice = ctypes.c_double(2.0)
    block = leaf(saltus.compiled(library.decay, ctypes.pointer(twice)), k=1.0)
    assert end(block)[0] == pytest.approx(np.exp(-2.0), rel=1e-4)
    block = leaf(capsule(library.decay, context=ctypes.addressof(twice)), k=1.0)
    assert end(block)[0] == pytest.approx(np.exp(-2.0), rel=1e-4)


def test_guard_reset_and_mode(library):
    block = saltus.LeafSystem(name="ball")
    block.declare_default_mode(3)
    block.declare_continuous_state(default_value=[1.0, 0.0], ode=library.fall)
    block.declare_zero_crossing(
        library.height, library.bounce, name="bounce", direction="positive_then_non_positive"
    )
    results = saltus.simulate(block, block.create_context(), (0.0, 1.0))
    assert results.context.mode == 4  # the height of 1 m is fallen in 0.45 s, then up for 0.81 s
    t = 1.0 - np.sqrt(2.0 / 9.81)
    v = 0.9 * np.sqrt(2.0 * 9.81)
    expected = [v * t - 0.5 * 9.81 * t**2, v - 9.81 * t]
    np.testing.assert_allclose(results.context.continuous_state, expected, atol=1e-9)


def test_output_and_inputs(library):
    block = saltus.LeafSystem(name="block")
    block.declare_input_port(), block.declare_input_port(), block.declare_input_port()
    block.declare_output_port(library.sum, name="y", shape=(), requires_inputs=[2, 0])
    builder = saltus.DiagramBuilder()
    builder.add(block)
    for i, value in enumerate([[1.0], 5.0, [2.0, 3.0]]):
        builder.connect(builder.add(Constant(value)).output(), block.input(i))
    diagram = builder.build()
    results = saltus.simulate(
        diagram, diagram.create_context(), (0.0, 1.0), recorded_signals={"y": block.output("y")}
    )
    assert results.outputs["y"][-1] == 2.0 + 30.0 + 100.0


def test_an_output_says_its_shape(library):
    block = saltus.LeafSystem(name="block")
    with pytest.raises(saltus.ModelError, match=r"fills memory, so say how much"):
        block.declare_output_port(library.sum)


def test_jacobian_row_by_row(library):
    block = saltus.LeafSystem(name="block")
    matrix = np.array([[-1.0, 2.0], [0.0, -1e4]])
    block.declare_continuous_state(
        default_value=[1.0, 1.0],
        ode=lambda t, s: matrix @ s.continuous_state,
        jacobian=library.minus,
    )
    results = saltus.simulate(
        block, block.create_context(), (0.0, 1.0), ode_solver_method="bdf", rtol=1e-8
    )
    assert results.statistics.jacobian_calls > 0
    # x' = -x + 2 exp(-1e4 t): x(1) = e^-1 (1 + 2 / (1e4 - 1))
    expected = np.exp(-1.0) * (1.0 + 2.0 / 9999.0)
    assert results.context.continuous_state[0] == pytest.approx(expected, rel=1e-5)


def test_update(library):
    block = saltus.LeafSystem(name="block")
    block.declare_discrete_state([0.0])
    block.declare_periodic_update(library.tick, 0.3)
    results = saltus.simulate(block, block.create_context(), (0.0, 1.0))
    assert results.context.discrete_state.tolist() == [4.0]  # at 0, 0.3, 0.6, 0.9


def test_a_failure_says_its_number(library):
    with pytest.raises(
        saltus.SimulationError, match=r"'block': ode: the compiled function returned 7, expected 0"
    ):
        end(leaf(library.fails))


def test_what_is_no_pointer_is_refused():
    for wrong in (3.0, "f", True, None, object()):
        with pytest.raises(saltus.ModelError, match="compiled: expected an address"):
            saltus.compiled(wrong)
    with pytest.raises(saltus.ModelError, match="not the address"):
        saltus.compiled(0)
    with pytest.raises(saltus.ModelError, match="expected a function"):
        leaf(12345)


def test_another_signature_is_refused(library):
    two = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double)(abs)
    with pytest.raises(saltus.ModelError, match=r"1 arguments that returns c_double"):
        leaf(two)
    with pytest.raises(saltus.ModelError, match=r"found 'double \(double\)'"):
        leaf(capsule(library.decay, b"double (double)"))


def test_a_signature_with_const_and_names_is_the_same(library):
    name = b"int (double t, const double *x, double const *, double *, double *out, void *)"
    assert end(leaf(capsule(library.decay, name), k=1.0))[0] == pytest.approx(0.3679, rel=1e-3)


def test_a_callback_of_python_goes_through_c():
    """What ctypes makes of a Python function is a pointer like any other, and is kept alive."""

    def block():
        @KIND
        def ode(t, x, u, p, out, data):
            out[0] = -x[0]
            return 0

        return leaf(ode)

    assert end(block())[0] == pytest.approx(np.exp(-1.0), rel=1e-4)


def test_scipy_low_level_callable(library):
    scipy = pytest.importorskip("scipy")
    function = KIND(("decay", library))
    ode = scipy.LowLevelCallable(function)
    assert end(leaf(ode, k=1.0))[0] == pytest.approx(np.exp(-1.0), rel=1e-4)


def test_cffi(library):
    cffi = pytest.importorskip("cffi")
    ffi = cffi.FFI()
    ode = ffi.cast("int (*)(double, double*, double*, double*, double*, void*)",
                   address(library.decay))  # fmt: skip
    assert end(leaf(ode, k=1.0))[0] == pytest.approx(np.exp(-1.0), rel=1e-4)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.skipif(sys.version_info >= (3, 15), reason="no numba yet")
def test_numba_cfunc():
    numba = pytest.importorskip("numba")
    numbers, types = numba.types.CPointer(numba.types.double), numba.types

    @numba.cfunc(
        types.int32(types.double, numbers, numbers, numbers, numbers, types.voidptr), cache=False
    )
    def ode(t, x, u, p, out, data):
        out[0] = -x[0]
        return 0

    assert end(leaf(ode))[0] == pytest.approx(np.exp(-1.0), rel=1e-4)
