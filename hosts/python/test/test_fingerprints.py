# SPDX-License-Identifier: MIT
"""What tells controllers apart: all of their code and data, and nothing else."""

import functools
import importlib
import os
import random
import subprocess
import sys
import textwrap
import threading
import types

import numpy as np
import pytest

import banyan
from banyan.controllers import described


def fingerprint(controller):
    return described(controller, "mine", told_apart=True)[-1]


def made(source, name="Mine"):
    """What a notebook or exec makes: there is no file to read the source from."""
    space = {"banyan": banyan, "np": np, "__name__": "__main__"}
    exec(textwrap.dedent(source), space)
    return space[name]


POLICY = """
import functools, math
from dataclasses import dataclass

GAIN = 0.3
TABLE = {"near": [1, 2], "names": {"a", "b", "c", "d"}}
weights = np.arange(6.0).reshape(2, 3)

def far(x):
    return TABLE["near"][0] * x

def helper(x):
    return far(x) + GAIN + math.cos(x)

def twice(f):
    @functools.wraps(f)
    def g(*xs):
        return f(*xs) * 2
    return g

@dataclass
class Plan:
    depth: int = 3

class Base(banyan.Policy):
    message_floats = 1

    @property
    def much(self):
        return 5

    @staticmethod
    def little():
        return 6

    def begin(self):
        return [x + 1 for x in range(7)]

class Mine(Base):
    '''drives'''
    gain = 0.5
    plan = Plan()
    turned = np.float32(0.25)

    def __init__(self, speed=1.0):
        super().__init__()
        self.speed, self.weights = speed, weights

    @twice
    def step(self, seen, names=("x", "y")):
        if seen in {"p", "q", "r", "s"}:
            return None
        return helper(seen) + sum(map(lambda x: x + 8, names))
"""

CHANGES = {
    "its own method": ("return None", "return 1"),
    "a constant in a set": ('"s"}', '"t"}'),
    "a lambda": ("x + 8", "x + 9"),
    "a default": ('"y")', '"z")'),
    "an attribute": ("gain = 0.5", "gain = 0.6"),
    "an attribute of numpy's": ("np.float32(0.25)", "np.float32(0.5)"),
    "an attribute's type": ("np.float32(0.25)", "np.float64(0.25)"),
    "an attribute of an attribute": ("depth: int = 3", "depth: int = 4"),
    "what a message has": ("message_floats = 1", "message_floats = 2"),
    "a property of its base": ("return 5", "return 55"),
    "a static method of its base": ("return 6", "return 66"),
    "a method of its base": ("range(7)", "range(70)"),
    "its base": ("class Base(banyan.Policy)", "class Base(banyan.Controller)"),
    "a function that it calls": ("math.cos(x)", "math.sin(x)"),
    "a function that this one calls": ('["near"][0]', '["near"][1]'),
    "a decorator": ("* 2", "* 3"),
    "a number of the module": ("GAIN = 0.3", "GAIN = 0.4"),
    "a table of the module": ("[1, 2]", "[1, 3]"),
    "a set of the module": ('"d"}', '"e"}'),
    "an array of the module": ("arange(6.0)", "arange(1, 7.0)"),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_change_shows(change):
    before, after = CHANGES[change]
    assert POLICY.count(before) == 1
    assert fingerprint(made(POLICY.replace(before, after))) != fingerprint(made(POLICY))


def test_what_is_no_change_does_not_show():
    mark = fingerprint(made(POLICY))
    assert len(mark) == 16 and int(mark, 16) >= 0
    assert fingerprint(made(POLICY)) == mark
    assert fingerprint(made("\n\n# a comment\n" + POLICY.replace("GAIN = 0.3", "GAIN = 0.3  # m/s"))) == mark
    assert fingerprint(made(POLICY + "\n    # the end\n\nclass Other(Mine):\n    gain = 3\n")) == mark


def test_it_is_the_same_in_every_process(tmp_path):
    (tmp_path / "lab").mkdir()
    (tmp_path / "lab" / "mine.py").write_text("import numpy as np, banyan\n" + POLICY)
    script = f"""
import functools
from banyan.controllers import described
from lab.mine import Mine
junk = [object() for _ in range({{}})]
print(*(described(each, "mine", told_apart=True)[-1] for each in (
    Mine, Mine(2.0), lambda: Mine(3.0), functools.partial(Mine, 4.0))))
"""
    found = set()
    for seed in ("0", "1", "4711"):
        path = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
        keys = {**os.environ, "PYTHONPATH": path, "PYTHONHASHSEED": seed}
        done = subprocess.run(
            [sys.executable, "-c", script.format(int(seed) + 5)], env=keys, capture_output=True, text=True, check=True
        )
        found.add(done.stdout)
    prints = found.pop().split()
    assert not found and len(set(prints)) == 4
    assert prints[0] == fingerprint(made(POLICY))  # of a module or of a notebook: the same code


def test_objects_by_their_attributes():
    Mine = made(POLICY)
    mine = Mine()
    mark = fingerprint(mine)
    assert fingerprint(Mine()) == mark != fingerprint(Mine)
    mine.speed = 2.0
    assert fingerprint(mine) == fingerprint(Mine(2.0)) != mark
    mine.speed, mine.weights = 1.0, mine.weights.copy()
    assert fingerprint(mine) == mark
    mine.weights[1, 2] += 1e-12
    assert fingerprint(mine) != mark
    for value in (1, 1.0, True, "1", b"1", [1], (1,), {1}, {1: 1}, None, np.arange(1), np.zeros(1), Mine, mine):
        mine.extra = value
        changed = fingerprint(mine)
        assert changed != mark
        mark = changed
    # Random numbers by the state of their generator; a cycle, a text of numpy and what cannot be copied do no harm.
    for generator in (np.random.default_rng, random.Random):
        mine.extra = generator(1)
        mark = fingerprint(mine)
        mine.extra = generator(1)
        assert fingerprint(mine) == mark
        mine.extra = generator(2)
        assert fingerprint(mine) != mark
    mine.extra = [mine, np.array(["a", None, 3], object), threading.Lock(), sys.stdout]
    assert fingerprint(mine) == fingerprint(mine)
    mine.extra = None
    for _ in range(10_000):
        mine.extra = [mine.extra]
    assert fingerprint(mine) == fingerprint(mine)


def test_tensors_by_value(monkeypatch):
    class Tensor:  # what of PyTorch's matters here
        dtype = "torch.float32"

        def __init__(self, *numbers):
            self.numbers = numbers

        detach = cpu = lambda self: self

        def tolist(self):
            return list(self.numbers)

        def __reduce_ex__(self, protocol):
            return Tensor, (str(id(self)),)

    monkeypatch.setitem(sys.modules, "torch", types.SimpleNamespace(Tensor=Tensor))
    mine = made(POLICY)()
    prints = []
    for numbers in ((1.0, 2.0), (1.0, 2.0), (1.0, 3.0)):
        mine.network = {"first": Tensor(*numbers)}
        prints.append(fingerprint(mine))
    assert prints[0] == prints[1] != prints[2]


def test_methods_and_functions_in_disguise_by_what_they_hold():
    Mine = made(POLICY)
    marks = set()
    for speed in (1.0, 2.0):
        part = functools.partial(Mine, speed)
        disguised = functools.update_wrapper(functools.partial(Mine, speed), Mine.begin)
        for call in (Mine(speed).step, part, disguised, functools.lru_cache(lambda: speed), np.vectorize(lambda x: speed)):
            mine = Mine()
            mine.call = call
            marks.add(fingerprint(mine))
            assert fingerprint(mine) in marks
    assert len(marks) == 10


def test_functions_by_what_they_hold_and_make():
    Mine = made(POLICY)

    def factory(speed):
        return lambda: Mine(speed)

    assert fingerprint(factory(1.0)) == fingerprint(factory(1.0)) != fingerprint(factory(2.0))
    read = {"speed": 1.0}  # not seen in its code, as if it were read from a file

    class File:
        def __call__(self):
            return Mine(os.environ and read["speed"])

    mark = fingerprint(File())
    read["speed"] = 2.0
    assert fingerprint(File()) != mark


def test_modules_beside_it_count_and_installed_ones_do_not(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.syspath_prepend(tmp_path / "site-packages")
    (tmp_path / "site-packages").mkdir()
    prints = []
    for k, (beside, installed) in enumerate([(1, 1), (2, 1), (1, 2)]):
        for folder, value in ((tmp_path, beside), (tmp_path / "site-packages", installed)):
            name = "fp_beside" if folder == tmp_path else "fp_installed"
            (folder / f"{name}.py").write_text(f"N = {value}\ndef f(x):\n    return {value}\nclass B: n = {value}\n")
            sys.modules.pop(name, None)
            importlib.invalidate_caches()
        source = """
            import fp_beside, fp_installed
            from fp_installed import f

            class Mine(fp_installed.B, fp_beside.B):
                def step(self, seen):
                    return fp_beside.f(1) + fp_beside.N + fp_installed.f(1) + fp_installed.N + f(2)
        """
        prints.append(fingerprint(made(source)))
    assert prints[0] != prints[1] and prints[0] == prints[2]


def test_what_is_nested_too_deeply_is_refused_in_words():
    class Deep(banyan.Policy):
        data = ()

        def step(self, observation):
            return banyan.Action()

    for _ in range(3000):
        Deep.data = (Deep.data,)
    with pytest.raises(ValueError, match="Deep cannot be told from its other versions"):
        importlib.import_module("banyan.fingerprints").fingerprint(Deep, Deep)
