"""`Drawn`: a system as text and as a picture."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, cast

from saltus.ports import OutputPort

if TYPE_CHECKING:
    from saltus.system.system import System

__all__ = ["Drawn"]


class Drawn:
    """The part of `System` that shows its blocks and wires.

    Examples
    --------
    >>> from saltus.library import Gain
    >>> Gain(2.0, name="double").pprint()
    double  Gain  (in) -> (out)
    """

    def pprint(self, output: Callable[[str], object] = print) -> None:
        """Prints the blocks of the system as a tree, each with its class and its ports.

        Parameters
        ----------
        output
            The function that takes the text in place of `print`.

        Examples
        --------
        >>> from saltus.library import Gain
        >>> Gain(2.0, name="double").pprint()
        double  Gain  (in) -> (out)
        """
        from saltus._tree import tree_of

        output("\n".join(tree_of(_system(self))))

    def to_dot(
        self,
        *,
        recorded_signals: Mapping[str, OutputPort | str] | Sequence[str] | None = None,
        max_depth: int | None = None,
    ) -> str:
        """The system as a picture in the language of Graphviz.

        Inner diagrams are clusters. Colours tell continuous from held signals, grey blocks are
        folded by the engine (constant, computed once) or dropped (nothing reads them), a dashed
        wire is read
        at events only, such as the trigger of a reset; a legend says so. Ports show their names if
        these say something, wires of more than one number their width, blocks their states, zero
        crossings and time events. A system that does not compile is drawn with the reason.

        Parameters
        ----------
        recorded_signals
            The outputs that a run would record, by name, as for `simulate`. By default every
            output of the system.
        max_depth
            Inner diagrams deeper than this many levels are one block each.

        Returns
        -------
        str
            A `digraph`; `dot -Tsvg` or `dot -Tpdf` draws it.

        Raises
        ------
        ModelError
            If a recorded signal belongs to another system.

        Examples
        --------
        >>> from saltus.library import Gain
        >>> print(Gain(2.0, name="double").to_dot().splitlines()[0])
        digraph "double" {
        """
        from saltus import _picture

        return _picture.to_dot(_system(self), recorded_signals, max_depth)

    def to_mermaid(
        self,
        what: str = "blocks",
        *,
        recorded_signals: Mapping[str, OutputPort | str] | Sequence[str] | None = None,
        max_depth: int | None = None,
    ) -> str:
        """The system as a picture in the language of Mermaid, which GitHub, GitLab, JupyterLab and
        most tools for documentation draw.

        Parameters
        ----------
        what
            "blocks": a flowchart that shows what `to_dot` does. "modes": a state diagram of the
            modes of a block, with the zero crossings that lead from one to another.
        recorded_signals, max_depth
            As for `to_dot`; they apply to "blocks" only.

        Returns
        -------
        str
            The text that belongs between the marks of a ``mermaid`` fence.

        Raises
        ------
        ModelError
            If "modes" is asked of a system without modes, and as for `to_dot`.

        Examples
        --------
        >>> from saltus.library import Gain
        >>> print(Gain(2.0, name="double").to_mermaid().splitlines()[1].strip())
        b0["<b>double</b><br/>Gain"]:::continuous
        """
        from saltus import _picture

        return _picture.to_mermaid(_system(self), what, recorded_signals, max_depth)

    def _repr_svg_(self) -> str | None:
        from saltus import _picture

        return _picture.in_svg(_system(self))

    def _repr_markdown_(self) -> str | None:
        from saltus import _picture

        return _picture.in_markdown(_system(self))


def _system(part: Drawn) -> System:
    return cast("System", part)
