# SPDX-License-Identifier: MIT
"""What tells a controller from another one of the same name, so that a study never takes the results of one for those
of the other. Not a proof: what a controller reads from files, or imports inside of a function, is not looked at."""

from __future__ import annotations

import copyreg
import dis
import hashlib
import sys
import sysconfig
from collections.abc import Iterator
from pathlib import Path
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

_plain = (type(None), type(...), bool, int, float, complex, str, bytes)
_not_behaviour = {"__annotations__", "__dict__", "__doc__", "__firstlineno__", "__module__", "__name__", "__qualname__"}
_not_behaviour |= {"__static_attributes__", "__weakref__"}
_library = {Path(sysconfig.get_path(name)) for name in ("stdlib", "platstdlib")}
_installed = {"site-packages", "dist-packages"}


def fingerprint(controller: Any, like: Any) -> str:
    """16 hexadecimal digits, the same in every process of one version of Python. `controller` as users hand it over,
    `like`: what it makes, if it is a function."""
    kind = like if isinstance(like, type) else type(like)
    try:
        return _Reader(kind.__module__.partition(".")[0]).whole((controller, like))[:16]
    except RecursionError:
        raise ValueError(f"{kind.__qualname__} cannot be told from its other versions: it holds tuples or sets that are "
                         "nested too deeply, or a set that contains itself; keep such data outside of it") from None


class _Reader:
    """Goes through everything that a value consists of. Code counts as Python executes it: without comments and line
    numbers, but with the functions, classes and data that it names. Data count by value. What belongs to Banyan, to
    Python or to an installed package counts by its name."""

    def __init__(self, package: str) -> None:
        self.package = package
        self.digest = hashlib.sha256()
        self.met: list[Any] = []  # what is read once
        self.numbers: dict[int, int] = {}  # by id, where it stands among these

    def whole(self, value: Any) -> str:
        self.read(value)
        for met in self.met:  # grows meanwhile
            self._read_once(met)
        return self.digest.hexdigest()

    def write(self, *words: Any) -> None:
        for word in words:
            raw = word if isinstance(word, bytes) else str(word).encode("utf-8", "surrogatepass")
            self.digest.update(b"%d:" % len(raw) + raw)

    def read(self, value: Any) -> None:
        kind = type(value)
        if kind in _plain:
            self.write(kind.__name__, repr(value))
        elif isinstance(value, (np.generic, np.ndarray)) and kind.__module__ == "numpy" and not value.dtype.hasobject:
            self.write("array", repr(value.dtype), value.shape, value.tobytes())
        elif kind is tuple:
            self.write("tuple", len(value))
            for item in value:
                self.read(item)
        elif kind in (set, frozenset):
            self.write("set", *sorted(_Reader(self.package).whole(item) for item in value))
        else:
            number = self.numbers.setdefault(id(value), len(self.met))
            if number == len(self.met):
                self.met.append(value)
            self.write("met", number)

    def _read_once(self, value: Any) -> None:
        if isinstance(value, ModuleType):
            self.write("module", value.__name__)
        elif isinstance(value, (type, FunctionType, BuiltinFunctionType)) and self._is_of_others(value):
            self.write("named", value.__module__, value.__qualname__)
        elif isinstance(value, FunctionType):
            self._function(value)
        elif isinstance(value, CodeType):
            self._code(value)
        elif isinstance(value, type):
            self.write("class")
            self.read((type(value), value.__bases__))
            self._items(dict(sorted(vars(value).items())))
        elif type(value) is dict:
            self._items(value)
        elif type(value) is list:
            self.read(tuple(value))
        else:
            self._object(value)

    def _items(self, items: dict[Any, Any]) -> None:
        self.write("items")
        for item in items.items():
            if item[0] not in _not_behaviour:
                self.read(item)
        self.write("end")

    def _function(self, function: FunctionType) -> None:
        self.write("function")
        self.read((function.__code__, function.__defaults__, function.__kwdefaults__, vars(function)))
        for cell in function.__closure__ or ():
            try:
                self.read(cell.cell_contents)
            except ValueError:
                self.write("empty")
        for name, value in _named(function.__code__, function.__globals__):
            self.write(name)
            self.read(value)
            if isinstance(value, ModuleType) and not self._is_module_of_others(value.__name__):
                for attribute in _attributes(function.__code__):
                    if attribute in vars(value):
                        self.write(attribute)
                        self.read(vars(value)[attribute])

    def _code(self, code: CodeType) -> None:
        self.write("code", code.co_code, code.co_flags, code.co_exceptiontable)
        self.write(code.co_argcount, code.co_posonlyargcount, code.co_kwonlyargcount)
        self.read((code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars, code.co_consts))

    def _object(self, value: Any) -> None:
        """As copy.deepcopy takes it apart. Of what refuses that, what can be got at counts: of a lock, its type."""
        self.write("object")
        self.read(type(value))
        if isinstance(value, getattr(sys.modules.get("torch"), "Tensor", ())):  # the parts have addresses
            self.write(value.dtype)
            self.read(np.asarray(value.detach().cpu().tolist()))
            return
        if hasattr(value, "py_func"):  # of numba.jit: the parts have random numbers
            self.read(value.py_func)
            return
        taken = copyreg.dispatch_table.get(type(value))
        try:
            parts = taken(value) if taken else value.__reduce_ex__(4)
        except Exception:
            parts = ""
        if isinstance(parts, str):
            inside = ("__wrapped__", "fget", "fset", "fdel", "__dict__")  # of functions in disguise, of properties
            parts = (parts, *(getattr(value, name, None) for name in inside))
        for part in parts:
            self.read(list(part) if isinstance(part, Iterator) else part)

    def _is_of_others(self, value: Any) -> bool:
        """Whether it is what that name means in a module of others; not so if it was made in one, say by exec."""
        found: Any = sys.modules.get(value.__module__ or "")
        for name in value.__qualname__.split("."):
            found = getattr(found, name, None)
        return found is value and self._is_module_of_others(value.__module__)

    def _is_module_of_others(self, name: str) -> bool:
        package = name.partition(".")[0]
        if package in ("banyan", "builtins"):
            return True
        if package == self.package:
            return False
        file = getattr(sys.modules.get(name), "__file__", None)
        if file is None:
            return name in sys.builtin_module_names
        return not (_library.isdisjoint(Path(file).parents) and _installed.isdisjoint(Path(file).parts))


def _codes(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _codes(constant)


def _named(code: CodeType, space: dict[str, Any]) -> list[tuple[str, Any]]:
    """The module's variables that code uses, functions defined within it included."""
    steps = (step for each in _codes(code) for step in dis.get_instructions(each))
    names = {step.argval for step in steps if step.opname in ("LOAD_GLOBAL", "LOAD_NAME")}
    return [(name, space[name]) for name in sorted(names) if name in space]


def _attributes(code: CodeType) -> list[str]:
    return sorted({name for each in _codes(code) for name in each.co_names})
