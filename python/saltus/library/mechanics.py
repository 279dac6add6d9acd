"""Parts of machines: play and friction."""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = ["Backlash", "MassWithFriction", "RigidBody"]


class Backlash(Block, _core.Backlash):
    """y follows u through a play: it rests until u reaches one end of the play, and then moves with
    it until u turns. y = u - width / 2 while u drives it upward, u + width / 2 downward.

    Inputs: `in`, u, and `in_rate`, du/dt. Outputs: `out`, y, and `out_rate`, dy/dt, which is 0 or
    du/dt. u is continuous, such as the angle of a shaft, and `in_rate` its speed: the contact ends
    where it changes its sign. The contact and the turn are located as events. A run ends with a
    SimulationError where u is back at the place of its contact and `in_rate` has not changed its
    sign: then it is not the rate of u, or u jumps.

    Parameters
    ----------
    width
        The whole play, > 0, in the unit of u. It is a parameter of the context.
    initial_output
        y at the start; if u is beyond the play around it, the run starts in contact, and y moves.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the width is not above 0.

    Examples
    --------
    >>> from saltus.library import Backlash, Sine
    >>> u, rate = Sine(2.0), Sine(2.0, phase=np.pi / 2)
    >>> y, _ = saltus.response(Backlash(1.0), u, rate, t=[0.1, np.pi / 2, 2.0, 3 * np.pi / 2])
    >>> y.round(6)
    array([ 0. ,  1.5,  1.5, -1.5])
    """

    def __init__(self, width: float, initial_output: float = 0.0, *, name: str | None = None):
        super().__init__(self._named(name), width, initial_output)


class MassWithFriction(Block, _core.MassWithFriction):
    """mass dv/dt = u - viscous v - coulomb sign(v), dx/dt = v: a body that sticks at v = 0 while
    the force u is not beyond the static friction.

    Outputs: `x`, the position, and `v`, the velocity. In stick v is exactly 0: x does not creep.
    Where v reaches 0 the body stops, and goes on only if the force exceeds the static friction.
    Both are located as events.

    Parameters
    ----------
    mass
        [kg] > 0
    coulomb
        [N] >= 0, the friction while it slides.
    static
        [N] >= coulomb, the largest friction while it sticks; by default `coulomb`.
    viscous
        [N s/m] >= 0. All four are parameters of the context.
    initial_position, initial_velocity
        [m], [m/s] Where a run starts is the continuous state of its context.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the mass is not above 0, a friction is below 0, or static is below coulomb.

    Examples
    --------
    A body of 1 kg with 2 m/s under a friction of 1 N stops after 2 s and 2 m:

    >>> from saltus.library import MassWithFriction
    >>> x, v = saltus.response(MassWithFriction(initial_velocity=2.0), 0.0, t=[1.0, 2.5, 9.0])
    >>> x.round(6), v.round(6)
    (array([1.5, 2. , 2. ]), array([1., 0., 0.]))
    """

    def __init__(
        self,
        mass: float = 1.0,
        coulomb: float = 1.0,
        static: float | None = None,
        viscous: float = 0.0,
        initial_position: float = 0.0,
        initial_velocity: float = 0.0,
        *,
        name: str | None = None,
    ):
        super().__init__(
            self._named(name), mass, coulomb, static, viscous, initial_position, initial_velocity
        )


class RigidBody(Block, _core.RigidBody):
    """dp/dt = v, mass dv/dt = F + mass g, dq/dt = q (0, w) / 2, J dw/dt = T - w x J w: a rigid body
    with six degrees of freedom.

    Inputs: `force`, F [N] in the axes of the world, and `torque`, T [N m] in the axes of the body,
    3 each. Outputs: `position` p [m] and `velocity` v [m/s] in the axes of the world, 3 each;
    `orientation`, the quaternion q (w, x, y, z) that turns vectors of the body into those of the
    world, 4; `rates`, w [rad/s] in the axes of the body, 3. A term (1 - q.q) q / 2 of dq/dt, 0 for
    a unit quaternion, draws the norm of q back to 1 at the rate of 1 /s, so that errors of the
    solver do not add up in it. Euler's equations: Goldstein, Classical Mechanics, section 5.5.

    Parameters
    ----------
    mass
        [kg] > 0, a parameter of the context.
    inertia
        J [kg m^2] about the centre of mass, a symmetric, positive definite matrix, 3 x 3; by
        default the unit matrix.
    gravity
        g [m/s^2] in the axes of the world, 3, a parameter of the context.
    initial_position, initial_velocity, initial_orientation, initial_rates
        The state at the start. The quaternion is made a unit one.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the mass or the inertia is not positive, the inertia not symmetric, or a size is wrong.

    Examples
    --------
    A body thrown up at 20 m/s:

    >>> from saltus.library import RigidBody
    >>> body = RigidBody(gravity=[0, 0, -10], initial_velocity=[0, 0, 20])
    >>> p, v, q, w = saltus.response(body, [0, 0, 0], [0, 0, 0], t=[1.0, 2.0])
    >>> p[:, 2].round(6)
    array([15., 20.])
    """

    def __init__(
        self,
        mass: float = 1.0,
        inertia: ArrayLike = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
        *,
        gravity: ArrayLike = (0.0, 0.0, 0.0),
        initial_position: ArrayLike = (0.0, 0.0, 0.0),
        initial_velocity: ArrayLike = (0.0, 0.0, 0.0),
        initial_orientation: ArrayLike = (1.0, 0.0, 0.0, 0.0),
        initial_rates: ArrayLike = (0.0, 0.0, 0.0),
        name: str | None = None,
    ):
        super().__init__(
            self._named(name),
            mass,
            inertia,
            gravity,
            initial_position,
            initial_velocity,
            initial_orientation,
            initial_rates,
        )
