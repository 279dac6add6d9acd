"""A wide diagram of a file is the same diagram as one of Python."""

import saltus
from file_models import bits
from saltus.library import Adder, Clock, Constant, Gain, Integrator, Saturate, Sine
from saltus.scene_files import loads

GROUPS = 125  # of 8 blocks


def text():
    wires, blocks = [], []
    for i in range(GROUPS):
        wires += [f"t -> a{i}", f"a{i} -> b{i}", f"b{i} -> c{i}", f"c{i} -> f{i}.in_0"]
        wires += [f"d{i} -> f{i}.in_1", f"f{i} -> g{i}", f"g{i} -> h{i}"]
        blocks += [
            f'a{i} = {{ block = "Gain", gain = "k * {i}" }}',
            f'b{i} = {{ block = "Integrator", initial_state = {i} }}',
            f'c{i} = {{ block = "Saturate", lower_limit = -1, upper_limit = {i + 1}.5 }}',
            f'd{i} = {{ block = "Sine", frequency = {i}.5 }}',
            f'e{i} = {{ block = "Constant", value = {i} }}',
            f'f{i} = {{ block = "Adder", operators = "+-" }}',
            f'g{i} = {{ block = "Integrator" }}',
            f'h{i} = {{ block = "Gain", gain = 2 }}',
        ]
    listed = ",\n".join(f'"{wire}"' for wire in wires)
    blocks.insert(0, 't = { block = "Clock" }')
    return (
        f"version = 1\nwires = [{listed}]\n[parameters]\nk = 0.1\n[blocks]\n"
        + "\n".join(blocks)
        + "\n[outputs]\n"
        + "\n".join(f'y{i} = "h{i}.out"' for i in range(GROUPS))
        + "\n[run]\nuntil = 1.0\n"
    )


def diagram():
    builder = saltus.DiagramBuilder()
    builder.add(Clock(name="t"))
    for i in range(GROUPS):
        builder.add(
            Gain(0.1 * i, name=f"a{i}"), Integrator(i, name=f"b{i}"),
            Saturate(-1, i + 1.5, name=f"c{i}"), Sine(frequency=i + 0.5, name=f"d{i}"),
            Constant(i, name=f"e{i}"), Adder("+-", name=f"f{i}"), Integrator(name=f"g{i}"),
            Gain(2, name=f"h{i}"),
        )  # fmt: skip
        for source, end in (("a", "b"), ("b", "c"), ("f", "g"), ("g", "h")):
            builder.connect(f"{source}{i}.out", f"{end}{i}.in")
        builder.connect("t.out", f"a{i}.in")
        builder.connect(f"c{i}.out", f"f{i}.in_0")
        builder.connect(f"d{i}.out", f"f{i}.in_1")
    for i in range(GROUPS):
        builder.export_output(f"h{i}.out", f"y{i}")
    return builder.build()


def test_a_thousand_mixed_blocks_of_a_file_have_the_bits_of_python():
    scene, whole = loads(text()), diagram()
    assert len(scene.system.blocks) == 1001
    expected = saltus.simulate(whole, whole.create_context(), (0.0, 1.0))
    assert bits(scene.simulate()) == bits(expected)
