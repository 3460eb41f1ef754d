# SPDX-License-Identifier: MIT
"""What figures.py draws: the numbers of the study's table, all that a figure says, and no half files."""

import copy
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np
import pytest

import banyan

from banyan import figures

SCRIPT = Path(figures.__file__)
STUDY = {
    "name": "drawn",
    "scenario": "scenarios/three-targets.toml",
    "seeds": "1-9",
    "set": {"mission": {"time_limit_s": 30.0}},  # convoy is in time, others are not always
    "axes": [
        {"key": "mission.algorithm", "values": ["convoy", "inwards", "outwards"], "name": "algorithm"},
        {"key": "radio.line_of_sight", "values": [False, True], "labels": ["off", "on"], "name": "los"},
        {"key": "swarm.redundancy", "values": [2, 3], "name": "k"},
    ],
    "figures": [
        {"name": "time", "metric": "completion_time_s", "x": "k", "series": "algorithm", "panels": "los"},
        {
            "name": "ratio",
            "metric": "disconnected_time_ratio",
            "y_scale": "ratio",
            "ratio_to": "inwards",
            "series": "algorithm",
            "x": "k",
            "where": {"los": "on"},
        },
        {"name": "done", "metric": "complete", "series": "algorithm", "x": ["los", "k"]},
    ],
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A study's folder, drawn."""
    os.chdir(Path(__file__).resolve().parents[3])
    out = tmp_path_factory.mktemp("studies") / "drawn"
    banyan.study(STUDY, out=out, progress=False, pandas=False)
    return out


@pytest.fixture(scope="module")
def table(folder):
    with open(folder / "runs.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def of(folder, name):
    return json.loads((folder / "figures" / f"{name}.json").read_text(encoding="utf-8"))


def artists(figure, pattern):
    """By what their names end with: {(panel, ..., series): artist}."""
    found = {}
    for artist in figure.findobj(lambda each: re.fullmatch(pattern + r"-[\d-]+", each.get_gid() or "")):
        found[tuple(map(int, artist.get_gid()[len(pattern) + 1 :].split("-")))] = artist
    return found


def ends(box):
    """Of a box, or of a line: its lowest and highest y."""
    y = box.get_path().vertices[:, 1]
    return y.min(), y.max()


def small(**changes):
    """A figure of two panels, two groups and two series."""
    box = {"values": [1.0, 2.0, 3.0, 4.0], "missed": 0}
    boxes = [[copy.deepcopy(box) for _ in range(2)] for _ in range(2)]
    figure = {
        "format": "banyan.figure",
        "format_version": 1,
        "kind": "boxes",
        "groups": ["1", "2"],
        "series": [{"name": "a"}, {"name": "b"}],
        "measures": [{"label": "time"}],
        "columns": 2,
        "panels": [
            {"title": "left", "measure": 0, "boxes": boxes},
            {"title": "right", "measure": 0, "boxes": copy.deepcopy(boxes)},
        ],
    }
    return {**figure, **changes}


def curves(**changes):
    curve = {"name": "best", "x": [0, 1, 2], "y": [0.5, None, 0.75], "low": [0.4, 0.5, 0.6], "high": [0.6, 0.7, 0.9]}
    figure = {
        "format": "banyan.figure",
        "format_version": 1,
        "kind": "curves",
        "x_label": "generation",
        "y_label": "fitness",
    }
    return {**figure, "curves": [curve, {"name": "mean", "x": [0, 2], "y": [0.1, 0.2], "points": True}], **changes}


def texts(figure):
    return [text.get_text() for text in figure.findobj(figures.matplotlib.text.Text) if text.get_text()]


# ------------------------------------------------------------------------------------------------- numbers of the table


def test_boxes_are_the_quartiles_of_the_table(folder, table):
    data = of(folder, "time")
    figure = figures.plot(data)
    boxes, medians, missed = (artists(figure, name) for name in ("box", "median", "missed"))
    drawn = misses = opened = 0
    for p, los in enumerate(("false", "true")):
        top = figure.axes[p].get_ylim()[1]
        for g, k in enumerate(data["groups"]):
            for s, series in enumerate(data["series"]):
                rows = [
                    r
                    for r in table
                    if (r["line_of_sight"], r["algorithm"]) == (los, series["name"]) and float(r["k"]) == float(k)
                ]
                assert len(rows) == 9
                late = sum(r["complete"] == "false" for r in rows)
                times = np.array(
                    [float(r["completion_time_s"]) for r in rows if r["complete"] == "true"] + [1e12] * late
                )
                lower, median, upper = np.quantile(times, (0.25, 0.5, 0.75))
                if late:
                    assert missed[p, g, s].get_text() == f"{late}/9"
                    misses += 1
                else:
                    assert (p, g, s) not in missed
                if lower > 1e6:
                    assert (p, g, s) not in boxes
                    continue
                drawn += 1
                low, high = ends(boxes[p, g, s])
                assert low == pytest.approx(lower)
                if upper > 1e6:
                    assert high > top  # open
                    opened += 1
                else:
                    assert high == pytest.approx(upper)
                at = medians[p, g, s].get_ydata()
                assert at[0] == at[1] and (at[0] > top if median > 1e6 else at[0] == pytest.approx(median))
    assert len(boxes) == drawn >= 6 and misses >= 3 and opened >= 1
    assert len(missed) == misses and "missed" in texts(figure)


def test_outliers_and_whiskers_are_tukeys():
    values = [7, 100, 3, 1, 10, 5, 2, 8, 4, 6, 9]  # R: quantile(c(1:10, 100), c(.25, .5, .75)) is 3.5, 6, 8.5
    data = small()
    data["panels"][0]["boxes"][0][0]["values"] = values
    figure = figures.plot(data)
    assert list(artists(figure, "outliers")[0, 0].get_ydata()) == [100]
    assert ends(artists(figure, "box")[0, 0, 0]) == (3.5, 8.5)
    numbers = figures.box_numbers(values)
    assert (numbers["whislo"], numbers["med"], numbers["whishi"]) == (1, 6, 10)
    tops = {line.get_ydata()[-1] for line in figure.axes[0].lines if line.get_linewidth() == pytest.approx(0.7)}
    assert {1, 10} <= tops
    assert figures.box_numbers([0, 1, 2, 3, 6])["fliers"] == []  # on the reach
    assert figures.box_numbers([1, 2], 8)["fliers"] == [1, 2]  # without a box
    random = np.random.default_rng(1)
    for n in range(1, 60):
        values = list(random.random(n) ** 6)
        numbers = figures.box_numbers(values)
        assert [numbers[name] for name in ("q1", "med", "q3")] == pytest.approx(
            list(np.quantile(values, (0.25, 0.5, 0.75)))
        )
        reach = 1.5 * (numbers["q3"] - numbers["q1"])
        beyond = [value for value in values if not numbers["q1"] - reach <= value <= numbers["q3"] + reach]
        assert numbers["fliers"] == sorted(beyond)
        late = figures.box_numbers(values, 5)
        far = np.quantile(values + [1e12] * 5, (0.25, 0.5, 0.75))
        for name, value in zip(("q1", "med", "q3"), far):
            assert late[name] == (np.inf if value > 1e6 else pytest.approx(value))


def test_shares_have_wilsons_interval(folder, table):
    data = of(folder, "done")
    figure = figures.plot(data)
    assert data["measures"][0]["share_confidence"] == 0.95 and not artists(figure, "box")
    for s, series in enumerate(data["series"]):
        marks = artists(figure, "medians")[0, s].get_ydata()
        whiskers = [line[:, 1] for line in artists(figure, "whiskers")[0, s].get_segments()]
        for g, (los, k) in enumerate((los, k) for los in ("false", "true") for k in (2, 3)):
            done = [
                r["complete"] == "true"
                for r in table
                if (r["algorithm"], r["line_of_sight"]) == (series["name"], los) and float(r["k"]) == k
            ]
            assert marks[g] == pytest.approx(np.mean(done))
            assert whiskers[g][0] <= marks[g] <= whiskers[g][1]
    # R: prop.test(9, 10, correct = FALSE)
    assert figures.wilson(9, 10, 0.95) == pytest.approx((0.59585, 0.98212), abs=1e-5)
    assert {"los off", "los on"} <= set(texts(figure)) and "n = 9 runs each" in texts(figure)


def test_ratios_are_of_pairs(folder, table):
    data = of(folder, "ratio")
    figure = figures.plot(data)
    axes = figure.axes[0]
    assert axes.get_yscale() == "log" and [series["name"] for series in data["series"]] == ["convoy", "outwards"]
    assert [1.0, 1.0] in [list(line.get_ydata()) for line in axes.lines]
    value = {
        (r["algorithm"], float(r["k"]), r["seed"]): float(r["disconnected_time_ratio"])
        for r in table
        if r["line_of_sight"] == "true"
    }
    for g, k in enumerate((2.0, 3.0)):
        ratios = [
            value["outwards", k, str(n)] / value["inwards", k, str(n)]
            for n in range(1, 10)
            if value["inwards", k, str(n)]
        ]
        assert ends(artists(figure, "box")[0, g, 1]) == pytest.approx(
            tuple(np.quantile(ratios, (0.25, 0.75))), rel=1e-4
        )
    assert any("pairs each" in text for text in texts(figure))


def test_curves_hold_their_data_and_gaps():
    figure = figures.plot(curves())
    best, mean = figure.axes[0].lines
    assert np.array_equal(best.get_ydata(), [0.5, np.nan, 0.75], equal_nan=True) and list(best.get_xdata()) == [0, 1, 2]
    assert list(mean.get_ydata()) == [0.1, 0.2] and best.get_marker() == "None" and mean.get_marker() == "^"
    band = figure.axes[0].collections[0].get_paths()[0].vertices
    assert {0.4, 0.9} <= set(band[:, 1])
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["best", "mean"]
    assert {"generation", "fitness"} <= set(texts(figure))


# ----------------------------------------------------------------------------------------------------------- the layout


def test_all_is_said_once():
    data = small(
        title="Times", x_label="redundancy k", outer=[{"title": "T", "labels": ["4", "5"], "full": ["T = 4", "T = 5"]}]
    )
    figure = figures.plot(data)
    said = texts(figure)
    for text in ("Times", "redundancy k", "left", "right", "a", "b", "time", "n = 4 runs each"):
        assert said.count(text) == 1, text
    assert said.count("T = 4") == said.count("T = 5") == 2  # in each panel
    assert [round(side, 3) for side in figure.get_size_inches()][0] == 7.0
    assert figures.plot(small(columns=1)).get_size_inches()[0] == 3.5
    assert figures.plot(small(width_in=3.5)).get_size_inches()[0] == 3.5


def test_the_legend_goes_row_by_row_and_takes_any_name():
    names = ["_first", "$2", "third of a rather long name", "4", "fifth of a rather long name", "6", "7", "8"]
    data = small(series=[{"name": name} for name in names], columns=1)
    for panel in data["panels"]:
        panel["boxes"] = [[{"values": [n + 1.0], "missed": 0} for n in range(8)] for _ in range(2)]
    figure = figures.plot(data)
    figure.canvas.draw()
    shown = [text.get_text() for text in figure.legends[0].get_texts()]
    handles = dict(zip(shown, figure.legends[0].get_patches()))
    assert sorted(handles) == sorted(names)
    where = {name: handle.get_window_extent() for name, handle in handles.items()}
    assert sorted(names, key=lambda name: (-round(where[name].y0 / 9), where[name].x0)) == names
    assert where["_first"].y0 > where["8"].y1
    for n, name in enumerate(names):
        assert handles[name].get_edgecolor()[:3] == pytest.approx(figures.to_rgb(figures.SERIES[n][0]))


def test_names_below_the_boxes_replace_the_legend():
    data = small(groups=["a", "b"])
    for panel in data["panels"]:
        panel["boxes"][0][1]["values"] = panel["boxes"][1][0]["values"] = []
    figure = figures.plot(data)
    assert not figure.legends
    x = artists(figure, "box")[0, 1, 1].get_path().vertices[:, 0]
    assert (x.min() + x.max()) / 2 == pytest.approx(1.0)  # in the middle of its group


def test_a_log_axis_shows_zeros_at_its_end():
    data = small(measures=[{"label": "time", "scale": "log"}])
    assert "0" not in texts(figures.plot(data))
    data["panels"][0]["boxes"][0][0]["values"] = [0.0, 0.0, 2.0]
    figure = figures.plot(data)
    axes = figure.axes[0]
    assert axes.get_yscale() == "log" and "0" in texts(figure)
    assert ends(artists(figure, "box")[0, 0, 0]) == (axes.get_ylim()[0], 1.0)


def test_thin_boxes_are_marks_and_lines():
    data = small(groups=[f"g{n}" for n in range(60)], columns=1)
    for panel in data["panels"]:
        panel["boxes"] = [[{"values": [1.0, 2.0, 4.0], "missed": 7}, {"values": [3.0], "missed": 0}] for _ in range(60)]
    data["measures"][0]["late"] = False
    figure = figures.plot(data)
    assert not artists(figure, "box")
    assert list(artists(figure, "medians")[0, 0].get_ydata()) == [2.0] * 60
    assert artists(figure, "quartiles")[0, 0].get_segments()[0][:, 1].tolist() == [1.5, 3.0]
    bars = artists(figure, "missed")
    assert len(bars) == 120  # there is no room for numbers
    height = bars[0, 0, 0].get_height() * figure.axes[0].get_position().height * figure.get_size_inches()[1] * 72
    assert height == pytest.approx(0.7 * figures.MISS_BAR)


def test_runs_that_missed_but_are_not_late_are_in_no_box():
    data = small()
    data["panels"][0]["boxes"][0][0]["missed"] = 12
    assert (0, 0, 0) not in artists(figures.plot(data), "box")
    data["measures"][0]["late"] = False
    figure = figures.plot(data)
    assert ends(artists(figure, "box")[0, 0, 0]) == (1.75, 3.25)
    assert artists(figure, "missed")[0, 0, 0].get_text() == "12/16" and "n = 4\u201316 runs each" in texts(figure)


def test_there_are_no_empty_panels():
    data = small(grid=True)
    for group in data["panels"][1]["boxes"]:
        for box in group:
            box["values"] = []
    figure = figures.plot(data)
    assert len(figure.axes) == 1 and texts(figure).count("no runs") == 1


TEXTS = [
    "it's $x_1$ \\alpha 50% {a}^b",
    "_under",
    "a\x01\x1b\ud800b\tc",
    "<b> & &amp; \u03bb\u2082 \u4e2d\u6587",
    "two\nlines",
    "word " * 80,
    "x" * 500,
    "",
]


@pytest.mark.parametrize("text", TEXTS)
def test_texts_are_shown_as_they_are(text, tmp_path):
    data = small(
        title=text,
        x_label=text,
        groups=[text, text + "2"],
        outer=[{"title": text, "labels": [text] * 2, "full": [text] * 2}],
    )
    data["series"] = [{"name": text}, {"name": text + "b"}]
    data["measures"] = [{"label": text}]
    for panel in data["panels"]:
        panel["title"] = text
    figures.save(figures.plot(data), tmp_path / "odd")
    written = "\n".join(each.text or "" for each in xml.parse(tmp_path / "odd.svg").iter() if each.tag.endswith("text"))
    if len(text) < 40:
        for line in text.replace("\t", " ").split("\n"):
            assert re.sub("[\x00-\x1f\ud800-\udfff]", "\ufffd", line) in written, written
    else:
        assert text[:10] in written
    assert not [name for name in os.listdir(tmp_path) if name.startswith(".")]


def test_long_texts_stay_within():
    for text in ("word " * 80, "x" * 500):
        data = small(title=text, x_label=text, groups=[text, text + "2"])
        data["series"] = [{"name": text}, {"name": text + "b"}]
        data["measures"] = [{"label": text}]
        figure = figures.plot(data)
        figure.set_dpi(figures.PNG_DPI)  # as it is saved: letters on coarser pixels are wider
        width, height = figure.canvas.get_width_height()
        for said, a in pieces(figure):
            assert a.x0 >= -2 and a.y0 >= -2 and a.x1 <= width + 2 and a.y1 <= height + 2, said


def pieces(figure):
    """All texts and where they are."""
    figure.canvas.draw()
    return [
        (t.get_text(), t.get_window_extent())
        for t in figure.findobj(figures.matplotlib.text.Text)
        if t.get_text() and t.get_visible()
    ]


@pytest.mark.parametrize(
    "panels, groups, series, name, missed, columns",
    [
        (3, 9, 2, "T = 2, k = ", 0, 3),
        (9, 3, 3, "", 0, 3),
        (5, 4, 8, "two obstacles ", 0, 3),
        (1, 2, 1, "a very long name of one group that is far too long ", 0, 1),
        (2, 30, 3, "g", 1, 2),
        (3, 4, 2, "", 3, 3),
        (1, 4, 7, "", 30, 1),
        (2, 3, 12, "group ", 12, 2),
        (2, 3, 1, "", 3, 1),
        (1, 6, 1, "a label that is rather long ", 0, 1),
        (1, 8, 1, "longer ", 0, 1),
    ],
)
def test_texts_stay_apart_and_within(panels, groups, series, name, missed, columns):
    data = small(
        title="A title that says at some length what is shown here, and for which algorithms",
        x_label="targets and redundancy",
        groups=[f"{name}{g + 1}" for g in range(groups)],
        series=[{"name": f"algorithm {s}"} for s in range(series)],
        columns=columns,
        panels=[
            {
                "title": f"communication range r = {p} m, with obstacles",
                "measure": 0,
                "boxes": [
                    [{"values": [0.1 * g + s + 1.0, 1.0], "missed": missed} for s in range(series)]
                    for g in range(groups)
                ],
            }
            for p in range(panels)
        ],
    )
    figure = figures.plot(data)
    width, height = figure.canvas.get_width_height()
    found = pieces(figure)
    assert len(found) > 5
    slanted = any(label.get_rotation() == 45 for axes in figure.axes for label in axes.get_xticklabels())
    for n, (text, a) in enumerate(found):
        assert a.x0 >= -1 and a.y0 >= -1 and a.x1 <= width + 1 and a.y1 <= height + 1, text
        for other, b in found[:n]:
            both = {text, other} <= set(data["groups"])
            if not (slanted and both):  # whose corners overlap though their letters do not
                apart = a.x1 <= b.x0 + 1 or b.x1 <= a.x0 + 1 or a.y1 <= b.y0 + 1.5 or b.y1 <= a.y0 + 1.5
                assert apart, (text, other)


# ------------------------------------------------------------------------------------------------------------ the looks


def seen_by():
    """What all, protanopes, deuteranopes and tritanopes see (Machado, Oliveira, Fernandes 2009, severity 1)."""
    return (
        np.eye(3),
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
    )


def lab(rgb):
    """CIE L*a*b* under D65, of linear rgb."""
    to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    t = np.maximum(0.0, to_xyz @ np.asarray(rgb) / [0.9505, 1.0, 1.089])
    x, y, z = np.where(t > 0.008856, np.cbrt(t), 7.787 * t + 16.0 / 116.0)
    return np.array([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)])


def test_colours_can_be_told_apart_by_all():
    srgb = np.array([figures.to_rgb(color) for color, *_ in figures.SERIES])
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    for sight in seen_by():
        seen = [lab(np.asarray(sight) @ color) for color in linear]
        assert min(np.linalg.norm(a - b) for n, a in enumerate(seen) for b in seen[:n]) > 15.0  # 2.3 is just noticeable
    assert max(lab(color)[0] for color in linear) < 75.0  # dark enough for lines on white


def test_no_two_looks_are_the_same():
    assert (len(figures.SERIES), len(figures.FILL_STEPS)) == (12, 8)  # as in study/include/banyan/study/figure.hpp
    looks = [[figures.look(s, v) for v in range(8)] for s in range(12)]
    assert len({(one.color, one.marker, one.open) for series in looks for one in series}) == 96
    for series in looks:
        assert len({one.color for one in series}) == 1
        assert len({one.fill for one in series}) == (8 if series[0].color != "#ffffff" else 1)


# ------------------------------------------------------------------------------------------------------------ the files


def test_files_are_the_same_bytes_each_time(tmp_path):
    for name in ("one", "two"):
        figures.save(figures.plot(small()), tmp_path / name)
    for kind in ("svg", "pdf", "png"):
        one = (tmp_path / f"one.{kind}").read_bytes()
        assert one == (tmp_path / f"two.{kind}").read_bytes()
    import struct

    assert struct.unpack(">I", (tmp_path / "one.png").read_bytes()[16:20]) == (2100,)  # 300 pixels an inch
    assert (
        b"CreationDate" not in (tmp_path / "one.pdf").read_bytes() and "date" not in (tmp_path / "one.svg").read_text()
    )


def test_no_half_file_is_left(tmp_path, monkeypatch):
    path = tmp_path / "f.json"
    path.write_text(json.dumps(small()))
    figures.draw(path)
    before = {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)}
    assert set(before) == {"f.json", "f.svg", "f.pdf", "f.png"}
    path.write_text(json.dumps(small(title="another")))

    def full(descriptor):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(figures.os, "fsync", full)
    with pytest.raises(OSError, match="No space"):
        figures.draw(path)
    monkeypatch.undo()
    monkeypatch.setattr(figures.Figure, "savefig", lambda *_, **__: 1 / 0)  # drawing fails before anything is written
    assert "ZeroDivisionError" in figures.draw_all([path])[0]
    for name in ("f.svg", "f.pdf", "f.png"):
        assert (tmp_path / name).read_bytes() == before[name], name
    assert set(os.listdir(tmp_path)) == set(before)


@pytest.mark.parametrize(
    "change, says",
    [
        ({"format": "banyan.tune"}, "is no figure"),
        ({"format_version": 2}, "format version 2"),
        ({"kind": "pie"}, 'allowed: "boxes", "curves"'),
        ({"panels": []}, "panels must be a list of at least one"),
        ({"measures": [{"scale": "cubic"}]}, 'allowed: "linear", "log"'),
        ({"measures": [{"scale": "log", "minimum": 0}]}, "must be above 0"),
        ({"series": [{"name": "a", "color": 12}, {"name": "b"}]}, "there are 0 to 11"),
        ({"series": [{"name": "a"}]}, "a box for each series"),
        ({"groups": ["1"]}, "a list for each group"),
        ({"panels": [{"measure": 0, "boxes": [[{"values": ["1"], "missed": 0}] * 2] * 2}]}, "a list of numbers"),
        ({"panels": [{"boxes": []}]}, "no complete figure"),
    ],
)
def test_what_cannot_be_drawn_is_said(change, says):
    with pytest.raises(figures.FigureFault, match=re.escape(says)):
        figures.plot(small(**change))


def test_the_program_leaves_what_the_script_draws(folder):
    for name in ("time", "ratio", "done"):
        pictures = [folder / "figures" / f"{name}.{kind}" for kind in ("svg", "pdf", "png")]
        assert all(picture.is_file() for picture in pictures)
    assert (folder / "figures" / "time.svg").read_bytes().count(b"box-") >= 6


def test_the_script_needs_no_package(folder, tmp_path):
    """As on a machine where only this one file of Banyan is."""
    shutil.copy(SCRIPT, tmp_path / "figures.py")
    shutil.copytree(folder, tmp_path / "study")
    drawn = tmp_path / "study" / "figures"
    for picture in drawn.glob("*.svg"):
        picture.unlink()
    (drawn / "broken.json").write_text('{"format": "banyan.figure"')
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

    def call(*arguments):
        command = [sys.executable, str(tmp_path / "figures.py"), *map(str, arguments)]
        return subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)

    done = call("study")
    assert done.returncode == 1 and done.stderr.count("\n") == 1 and "broken.json: is no JSON" in done.stderr
    for name in ("time", "ratio", "done"):  # the others are drawn
        assert (drawn / f"{name}.svg").read_bytes() == (folder / "figures" / f"{name}.svg").read_bytes()
    (tmp_path / "empty").mkdir()
    done = call("empty")
    assert done.returncode == 1 and "empty holds no figure" in done.stderr
    # Without matplotlib.
    (tmp_path / "matplotlib.py").write_text("raise ImportError('none here')")
    done = call("study")
    assert done.returncode == figures.NO_MATPLOTLIB and "python3-matplotlib" in done.stderr


def test_a_study_goes_on_without_pictures(tmp_path, monkeypatch):
    monkeypatch.setattr(banyan.studies.sys, "executable", str(tmp_path / "no-python"))
    study = {
        **STUDY,
        "seeds": [1],
        "axes": STUDY["axes"][:1],
        "figures": [{"metric": "completion_time_s", "series": "algorithm"}],
    }
    with pytest.warns(UserWarning, match="python3-matplotlib.*to draw them: .*figures.py"):
        table = banyan.study(study, out=tmp_path / "s", progress=False, pandas=False)
    assert len(table) == 3 and (tmp_path / "s" / "study.json").is_file()
    assert os.listdir(tmp_path / "s" / "figures") == ["completion_time_s.json"]
