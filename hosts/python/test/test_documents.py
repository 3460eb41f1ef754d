# SPDX-License-Identifier: MIT
"""What docs/python.md shows runs, in its order; type hints name what there is; examples are as short as they say."""

import ast
import re
from pathlib import Path

import banyan
from banyan import _core

HOUSE = Path(__file__).resolve().parents[3]


def test_the_page_runs(tmp_path, monkeypatch, capsys):
    for folder in ("scenarios", "studies", "examples"):
        (tmp_path / folder).symlink_to(HOUSE / folder)
    monkeypatch.chdir(tmp_path)
    page = (HOUSE / "docs" / "python.md").read_text(encoding="utf-8")
    blocks = [
        (page[: found.start()].count("\n") + 2, found[1])
        for found in re.finditer(r"```python\n(.*?)```", page, re.DOTALL)
    ]
    assert len(blocks) >= 8
    names: dict = {}
    for line, block in blocks:
        exec(compile("\n" * (line - 1) + block, "docs/python.md", "exec"), names)  # noqa: S102: the page is ours
        printed = re.findall(r"# prints (.*)", block)
        said = capsys.readouterr().out
        for words in printed:
            assert words in said, (line, words, said)


def test_hints_name_what_there_is():
    tree = ast.parse((HOUSE / "hosts/python/banyan/_core.pyi").read_text(encoding="utf-8"))
    hinted: dict = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            hinted[node.name] = {of.name for of in node.body if isinstance(of, ast.FunctionDef)}
        elif isinstance(node, ast.FunctionDef):
            hinted[node.name] = set()
        elif isinstance(node, ast.AnnAssign):
            hinted[node.target.id] = set()
    there = {name for name in dir(_core) if not name.startswith("__")}
    assert set(hinted) == there
    for name, members in hinted.items():
        thing = getattr(_core, name)
        if isinstance(thing, type) and not issubclass(thing, Exception):
            of_class = {member for member in vars(thing) if not member.startswith(("__", "_pybind11"))}
            assert {member for member in members if not member.startswith("__")} == of_class, name


def test_everything_public_is_explained():
    for name in banyan.__all__:
        thing = getattr(banyan, name)
        if name not in ("algorithms", "FileError", "ScenarioError", "Frame"):
            assert thing.__doc__ and len(thing.__doc__) > 30, name
    observed = banyan.Observations.__doc__
    for field in banyan.Observations.fields:
        assert re.search(rf"\b{field}\b", observed), field


def test_the_controller_is_as_short_as_promised():
    lines = (HOUSE / "examples/05_own_controller.py").read_text(encoding="utf-8").splitlines()
    begin = next(k for k, text in enumerate(lines) if text.startswith("class "))
    end = next(k for k, text in enumerate(lines) if text.startswith("if __name__"))
    assert len([text for text in lines[begin:end] if text.strip()]) <= 30
