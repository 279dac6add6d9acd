"""A ball wired up from blocks, over a floor that falls away: it comes to rest on it by infinitely
many bounces.
"""

import matplotlib.pyplot as plt
import numpy as np
import saltus
from saltus.library import *
from saltus.simulation import SimulatorOptions


def ball_over(floor, gravity, restitution):
    builder = saltus.DiagramBuilder()
    velocity, height = (
        builder.add(
            Integrator(
                initial_state=0.0,
                enable_reset=True,
                enable_external_reset=True,
                name=name,
                zeno_tolerance=1e-6,
            )
        )
        for name in ("velocity", "height")
    )
    weight = builder.add(Constant(-gravity, name="weight"))
    below = builder.add(ReduceBlock(2, lambda x: x[0] < x[1], name="below"))
    rebound = builder.add(Gain(-restitution, name="rebound"))
    builder.add(floor)
    builder.connect(weight.output_ports[0], velocity.input_ports[0])
    builder.connect(velocity.output_ports[0], height.input_ports[0])
    builder.connect(height.output_ports[0], below.input_ports[0])
    builder.connect(floor.output_ports[0], below.input_ports[1])
    builder.connect(below.output_ports[0], velocity.input_ports[1])
    builder.connect(below.output_ports[0], height.input_ports[1])
    builder.connect(velocity.output_ports[0], rebound.input_ports[0])
    builder.connect(rebound.output_ports[0], velocity.input_ports[2])
    builder.connect(floor.output_ports[0], height.input_ports[2])
    return builder.build()


def run(floor, height, restitution, end, steps):
    diagram = ball_over(floor, 9.81, restitution)
    context = diagram.create_context()
    block = diagram["height"].system_id
    context = context.with_subcontext(block, context[block].with_continuous_state(height))
    options = SimulatorOptions(
        max_major_steps=steps,
        atol=1e-8,
        rtol=1e-6,
        max_major_step_length=1e-1,
        max_minor_step_size=1e-3,
    )
    recorded = {"y": diagram["height"].output_ports[0], "v": diagram["velocity"].output_ports[0]}
    return saltus.simulate(diagram, context, (0.0, end), options=options, recorded_signals=recorded)


def draw(results):
    figure, axes = plt.subplots(1, 1, figsize=(8, 2))
    axes.plot(results.time, results.outputs["y"])
    plt.close(figure)


small = Step(start_value=np.array(0.0), end_value=-1e-3, step_time=1.0, name="floor")
scene3 = run(small, 1e-3, 0.8, 1.1, 1000)
draw(scene3)
large = Step(start_value=5.0, end_value=0.0, step_time=10.0, name="floor")
scene4 = run(large, 10.0, 0.9, 40.0, 10000)
draw(scene4)
