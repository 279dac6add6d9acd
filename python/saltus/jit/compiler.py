"""LLVM, through llvmlite: modules become object code for this processor, and then functions."""

from __future__ import annotations

import functools
import hashlib
import itertools
from typing import Any

import llvmlite
import llvmlite.binding as llvm

from saltus import _core

__all__ = ["compiled", "key_of", "linked"]

OPTIMISATION = 2
"""level of the code generator. The passes over the intermediate form are left out: the graph of a
tape is simplified already, its vectors and loops are written as such, and the passes would take
2 to 20 ms
"""

_numbers = itertools.count()  # each library needs a name of its own


@functools.cache
def _machine() -> Any:
    """The compiler for this processor."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    return llvm.Target.from_default_triple().create_target_machine(
        cpu=llvm.get_host_cpu_name(),
        features=llvm.get_host_cpu_features().flatten(),
        opt=OPTIMISATION,
        reloc="pic",
        jit=True,
    )


@functools.cache
def _linker() -> Any:
    _machine()  # initializes LLVM
    return llvm.create_lljit_compiler()


@functools.cache
def _here() -> str:
    """The facts on which the object code of a module depends, beside its text."""
    machine = _machine()
    features = llvm.get_host_cpu_features().flatten()
    return "\n".join(
        [
            llvmlite.__version__,
            str(llvm.llvm_version_info),
            machine.triple,
            llvm.get_host_cpu_name(),
            features,
            str(OPTIMISATION),
        ]
    )


def key_of(module: str) -> str:
    """A name for the object code of a module on this processor."""
    return hashlib.sha256(f"{_here()}\n{module}".encode()).hexdigest()


def compiled(module: str) -> bytes:
    """The object code of a module."""
    parsed = llvm.parse_assembly(module)
    machine = _machine()
    parsed.triple = machine.triple
    parsed.data_layout = str(machine.target_data)
    code: bytes = machine.emit_object(parsed)
    return code


def linked(key: str, object_code: bytes, count: int) -> Any:
    """The functions of some object code, by name; they last as long as the result."""
    builder = llvm.JITLibraryBuilder().add_object_img(object_code)
    for name, address in _core.called_functions().items():
        builder.import_symbol(name, address)
    for i in range(count):
        builder.export_symbol(f"saltus_tape_{i}")
    return builder.link(_linker(), f"{key}-{next(_numbers)}")
