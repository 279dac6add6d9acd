"""The ports of blocks that a diagram makes its own."""

from __future__ import annotations

from saltus.diagram.parts import BuilderParts, port_in_core
from saltus.system import InputPort, OutputPort

__all__ = ["ExportsPorts"]


class ExportsPorts(BuilderParts):
    """Makes inputs and outputs of blocks those of the diagram."""

    def export_input(self, port: InputPort | str, name: str | None = None) -> int:
        """Makes an input of a block one of the diagram.

        Parameters
        ----------
        port
            An input of a block that was added, without a source; or its path, "block.in".
        name
            The name of the port of the diagram; by default 'block_port'.

        Returns
        -------
        int
            Its position among the inputs of the diagram.

        Examples
        --------
        >>> from saltus.library import Gain
        >>> builder = saltus.DiagramBuilder()
        >>> gain = builder.add(Gain(2.0, name="gain"))
        >>> builder.export_input(gain.input(), "u")
        0
        >>> builder.build().input_names
        ['u']
        """
        own = self._input("export_input", port)
        return self._core.export_input(*port_in_core(own, InputPort), name or "")

    def export_output(self, port: OutputPort | str, name: str | None = None) -> int:
        """Makes an output of a block one of the diagram.

        Parameters
        ----------
        port
            An output of a block that was added; or its path, "block.out".
        name
            The name of the port of the diagram; by default 'block_port'.

        Returns
        -------
        int
            Its position among the outputs of the diagram.

        Examples
        --------
        >>> from saltus.library import Clock
        >>> builder = saltus.DiagramBuilder()
        >>> clock = builder.add(Clock(name="clock"))
        >>> builder.export_output(clock.output())
        0
        >>> builder.build().output_names
        ['clock_out']
        """
        own = self._output("export_output", port)
        position = self._core.export_output(*port_in_core(own, OutputPort), name or "")
        self._exported.append(own)
        return position
