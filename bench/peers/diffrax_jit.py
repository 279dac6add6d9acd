"""diffrax: the loop over events compiled by XLA; each event ends a solve and the next one begins."""

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
import optimistix
from common import main
from scenes import SCENES

jax.config.update("jax_enable_x64", True)
MOST = 256  # events
STIFF = (diffrax.Kvaerno5,)


def condition(guard, i):
    """Falls to zero where the guard fires: the side it is on is part of the arguments."""

    def g(t, y, args, **_):
        mode, sides = args
        active = True if guard.mode is None else mode == guard.mode
        return jnp.where(active, sides[i] * guard.g(jnp, t, y), 1.0)

    return g


def sides_of(scene):
    """A monitor starts on the side to which the flow leaves."""
    ahead = [x + 1e-9 * f for x, f in zip(
        scene.start, scene.flow(np, 0.0, scene.start, scene.mode), strict=True)]  # fmt: skip
    return jnp.array([
        float(-g.direction) if g.direction else np.sign(g.g(np, 0.0, ahead)) for g in scene.guards
    ])  # fmt: skip


def compiled(scene, rtol, solver):
    term = diffrax.ODETerm(lambda t, x, args: jnp.stack(scene.flow(jnp, t, x, args[0])))
    event = None
    if scene.guards:
        tests = [condition(guard, i) for i, guard in enumerate(scene.guards)]
        root = optimistix.Newton(1e-13, 1e-13)
        event = diffrax.Event(tests, root, direction=[False] * len(tests))
    control = diffrax.PIDController(rtol=rtol, atol=rtol * scene.atol)

    def piece(now):
        t, x, mode, sides, times, n = now
        done = diffrax.diffeqsolve(
            term, solver, t, scene.end, None, x, args=(mode, sides), event=event, throw=False,
            saveat=diffrax.SaveAt(t1=True), stepsize_controller=control, max_steps=10**7,
        )  # fmt: skip
        t, x = done.ts[-1], done.ys[-1]
        for i, (guard, fired) in enumerate(zip(scene.guards, done.event_mask or [], strict=True)):
            if guard.reset is None:
                sides = sides.at[i].multiply(jnp.where(fired, -1.0, 1.0))
                continue
            after, into = guard.reset(jnp, t, x)
            x, mode = jnp.where(fired, jnp.stack(after), x), jnp.where(fired, into, mode)
        return t, x, mode, sides, times.at[n].set(t), n + 1

    @jax.jit
    def run():
        start = (0.0, jnp.array(scene.start), scene.mode, sides_of(scene), jnp.zeros(MOST), 0)
        return jax.lax.while_loop(lambda now: (now[0] < scene.end) & (now[5] < MOST), piece, start)

    return run


def maker(kind):
    def make(scene, rtol):
        if scene.stiff != (kind in STIFF) or rtol < 1e-11:
            return None
        run = compiled(scene, rtol, kind())

        def answer():
            t, x, _, _, times, n = jax.block_until_ready(run())
            return np.array(times)[: n - 1], np.array(x)  # the last piece ends at the end

        return answer

    return make


if __name__ == "__main__":
    kinds = (diffrax.Tsit5, diffrax.Dopri8, diffrax.Kvaerno5)
    main("diffrax", {kind.__name__: maker(kind) for kind in kinds}, SCENES)
