#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the figures of studies and tunings, for print.

`banyan study` and `banyan tune` leave each figure as NAME.json, which says what is drawn (docs/file-formats.md). This
file makes NAME.svg, NAME.pdf and NAME.png of it:

    python3 -m banyan.figures out/first/figures       a folder, or files; a study's own folder will do, too
    python3 figures.py out/first/figures              the same where the package banyan is not installed

It needs Python 3.9 and matplotlib 3.6 or newer and nothing else. To change a figure, change the style table below, or
draw it yourself and go on from there:

    import json
    from banyan import figures
    figure = figures.plot(json.load(open("out/first/figures/time.json")))
    figure.axes[0].set_title("without line of sight")
    figures.save(figure, "time")

What is drawn has names, in the svg too: "box-0-1-2" is that of panel 0, group 1, series 2, with "median-0-1-2" and
"missed-0-1-2"; "outliers-0-2" are all of a panel's series, and where marks and lines take the place of boxes
"whiskers-0-2", "quartiles-0-2" and "medians-0-2".
"""

from __future__ import annotations

import io
import json
import math
import os
import statistics
import sys
import unicodedata
import warnings
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Iterable, Iterator, NamedTuple, Sequence

NO_MATPLOTLIB = 3  # the exit status that says so

try:
    import matplotlib
    import matplotlib.style
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.colors import to_rgb
    from matplotlib.figure import Figure
    from matplotlib.font_manager import FontProperties
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch, Rectangle
    from matplotlib.textpath import text_to_path

    if matplotlib.__version_info__ < (3, 6):
        raise ImportError(f"{matplotlib.__version__} is too old, 3.6 or later is needed")
except ImportError as _error:
    if __name__ != "__main__":
        raise
    print(f"figures need matplotlib (Debian: python3-matplotlib; pip: matplotlib): {_error}", file=sys.stderr)
    sys.exit(NO_MATPLOTLIB)

# ------------------------------------------------------------------------------------------------------------- style --

COLUMN_IN, PAGE_IN = 3.5, 7.0  # widths, inches: a column of a paper, a page
TEXT_PT = 8.0
PNG_DPI = 300

#: A series each: its colour, how much of that a box is filled with, and the dashes of a curve. An algorithm has the
#: place that it has in the program's list. The colours are Okabe and Ito's without their yellow, which is no line on
#: white, and five more that are as far from these, and from each other, for the colour-blind too. Neighbours differ
#: in the lightness of their fill, for grey print.
SERIES = (
    ("#0072b2", 0.55, ()),
    ("#d55e00", 0.15, (5, 2)),
    ("#009e73", 0.90, (1.5, 1.5)),
    ("#cc79a7", 0.30, (5, 1.5, 1.2, 1.5)),
    ("#e69f00", 0.70, (9, 2.5)),
    ("#56b4e9", 0.20, (3, 2)),
    ("#000000", 0.00, (1, 1.2)),
    ("#882255", 0.45, (4, 1.2)),
    ("#8cb85c", 0.70, (7, 1.5, 1.5, 1.5)),
    ("#332288", 0.25, (2.2, 1)),
    ("#664400", 0.60, (5, 4)),
    ("#9966ff", 0.10, (5, 1.5, 1.2, 1.5, 1.2, 1.5)),
)
#: Variants of a colour: what is added to its fill, each far from those before it. Their marks: the same shape, open;
#: then the next shape, filled, and so on.
FILL_STEPS = (0.0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875)
MARKERS = ("o", "^", "s", "D", "v", "p")

FRAME, GRID, SEPARATOR = "#606060", "#dedede", "#b0b0b0"

#: matplotlib's settings; those of a matplotlibrc do not count, so that a figure looks the same everywhere.
STYLE = {
    "font.family": ["DejaVu Sans", "sans-serif"],  # which comes with matplotlib; an svg falls back on the reader's own
    "font.size": TEXT_PT,
    "axes.labelsize": TEXT_PT,
    "axes.titlesize": TEXT_PT,
    "xtick.labelsize": TEXT_PT,
    "ytick.labelsize": TEXT_PT,
    "legend.fontsize": TEXT_PT,
    "text.usetex": False,
    "text.parse_math": False,  # a "$" is a "$"
    "axes.unicode_minus": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": FRAME,
    "axes.linewidth": 0.5,
    "axes.axisbelow": True,
    "xtick.color": FRAME,
    "ytick.color": FRAME,
    "xtick.labelcolor": "black",
    "ytick.labelcolor": "black",
    "xtick.major.width": 0.5,
    "ytick.major.width": 0.5,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "xtick.major.pad": 3.0,
    "ytick.major.pad": 2.5,
    "grid.color": GRID,
    "grid.linewidth": 0.4,
    "lines.scale_dashes": True,
    "legend.frameon": False,
    "savefig.dpi": PNG_DPI,
    "svg.fonttype": "none",  # texts stay texts
    "svg.hashsalt": "banyan",  # the same bytes each time
    "pdf.fonttype": 42,  # which publishers ask for
}

# Sizes in points.
LINE, EDGE = 10.0, 3.0  # from line to line of text; around everything
TICK = 6.0  # a tick mark and the space before its label
GROUP_SHARE, BOX_SHARE = 0.86, 0.80  # of a group's room that its boxes fill; of a box's room that it fills
WIDEST_BOX = 18.0
THIN = 4.5  # rooms of boxes below it have a mark and a line instead of a box
SMALLEST_SLOT = 6.2  # rooms below it call for a wider figure
FLAT = 2.0  # a box of less height is hardly more than its median line
SWATCH, SAMPLE = 14.0, 22.0  # in the legend: a box, a curve
GAP = 10.0  # between columns of panels, and of the legend
ROW_GAP = 8.0
MISS_BAR = 16.0  # if all runs missed
LONGEST_LABEL = 110.0  # of a group, turned
SMALLEST_TEXT = 6.0
CURVES_HEIGHT = 135.0


class Look(NamedTuple):
    """How a series is told from the others: by colour, and in grey print by its fill, dashes and marks."""

    color: str
    fill: tuple[float, float, float]  # of a box
    dashes: tuple[float, ...]  # of a curve, in line widths; () is solid
    marker: str
    open: bool  # the mark is an outline

    def mark(self, size: float) -> dict[str, Any]:
        """A mark about `size` points wide, as keywords of a line."""
        return {
            "marker": self.marker,
            "markersize": size * (0.88 if self.marker in "sD" else 1.0),
            "markeredgecolor": self.color,
            "markeredgewidth": 0.6,
            "markerfacecolor": "white" if self.open else self.color,
        }


def look(series: int, variant: int = 0) -> Look:
    """The look of a series by its colour's place in SERIES, and of its variants."""
    color, fill, dashes = SERIES[series]
    share = (fill + FILL_STEPS[variant]) % 1.0
    red, green, blue = (1.0 - share * (1.0 - channel) for channel in to_rgb(color))
    return Look(color, (red, green, blue), dashes, MARKERS[(series + variant // 2) % len(MARKERS)], variant % 2 == 1)


# ----------------------------------------------------------------------------------------------------------- numbers --


def box_numbers(values: Sequence[float], missed: int = 0) -> dict[str, Any]:
    """What a box shows, in the words of matplotlib's Axes.bxp(): quartiles, median, whiskers and outliers.

    Whiskers reach to the last value within 1.5 times the box (Tukey). `missed` further runs count as infinite. Between
    a value and infinity lies infinity; if the lower quartile does, all values are outliers.
    """
    ascending = sorted(values)

    def quantile(share: float) -> float:  # numpy's and R's default, type 7
        at = share * (len(ascending) + missed - 1)
        below, above = math.floor(at), math.ceil(at)
        if above >= len(ascending):
            return math.inf
        return ascending[below] + (at - below) * (ascending[above] - ascending[below])

    lower, median, upper = quantile(0.25), quantile(0.5), quantile(0.75)
    numbers: dict[str, Any] = {"q1": lower, "med": median, "q3": upper}
    if math.isinf(lower):
        return {**numbers, "whislo": lower, "whishi": lower, "fliers": ascending}
    reach = 1.5 * (upper - lower)
    within = [value for value in ascending if lower - reach <= value <= upper + reach]
    # Of few values the quartiles lie between, and the last within reach can be inside the box: no whisker then.
    numbers["whislo"] = min(within[0], lower) if within else lower
    numbers["whishi"] = upper if math.isinf(upper) else max(within[-1], upper) if within else upper
    numbers["fliers"] = [value for value in ascending if value < lower - reach or value > upper + reach]
    return numbers


def wilson(hits: int, count: int, confidence: float) -> tuple[float, float]:
    """Wilson's interval of a share."""
    z = statistics.NormalDist().inv_cdf(0.5 + confidence / 2.0)
    share, square = hits / count, z * z / count
    center = (share + square / 2.0) / (1.0 + square)
    half = z / (1.0 + square) * math.sqrt(share * (1.0 - share) / count + square / (4.0 * count))
    return (0.0 if hits == 0 else center - half), (1.0 if hits == count else center + half)


def _shown_numbers(box: dict[str, Any], measure: dict[str, Any]) -> dict[str, Any]:
    confidence = measure.get("share_confidence")
    if confidence is None:
        return box_numbers(box["values"], box["missed"] if measure.get("late", True) else 0)
    hits = sum(value > 0 for value in box["values"])
    low, high = wilson(hits, len(box["values"]), confidence)
    share = hits / len(box["values"])
    return {"whislo": low, "q1": share, "med": share, "q3": share, "whishi": high, "fliers": []}


class _Axis(NamedTuple):
    low: float
    high: float
    ticks: list[tuple[float, str]]
    log: bool = False

    def label_width(self) -> float:
        return max((_width(label) for _, label in self.ticks), default=0.0)

    def part(self, value: float) -> float:
        """Where it is, from 0 at the lower end to 1 at the upper."""
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)

    def beyond(self) -> float:
        """A value well above the upper end."""
        return self.high * (self.high / self.low) if self.log else self.high + (self.high - self.low)


def _number(value: float, decimals: int | None = None) -> str:
    text = f"{value:g}" if decimals is None else f"{value:.{decimals}f}"
    return text.replace("-", "\u2212") if "e" not in text else text


def _even_ticks(low: float, high: float, most: int) -> list[tuple[float, str]]:
    """Multiples of 1, 2 or 5 times a power of ten."""
    rough = (high - low) / most
    power = 10.0 ** math.floor(math.log10(rough))
    step = next((factor * power for factor in (1.0, 2.0, 5.0) if factor * power >= rough * (1 - 1e-9)), 10.0 * power)
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    decimals = None if digits > 6 or max(abs(low), abs(high)) >= 1e6 else digits
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [(n * step, _number(n * step, decimals)) for n in range(first, last + 1)]


def _power_ticks(low: float, high: float, digits: Iterable[int], stride: int = 1) -> list[tuple[float, str]]:
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    at = [float(f"{digit}e{power}") for power in powers if power % stride == 0 for digit in digits]
    return [(value, _number(value)) for value in at if low * (1 - 1e-9) <= value <= high * (1 + 1e-9)]


def _log_ticks(low: float, high: float, most: int) -> list[tuple[float, str]]:
    fine = _power_ticks(low, high, (1, 2, 5))
    if 3 <= len(fine) <= most:
        return fine
    for stride in range(1, 700):
        powers = _power_ticks(low, high, (1,), stride)
        if len(powers) < 2:
            break
        if len(powers) <= most:
            return powers
    return _even_ticks(low, high, most)


def _linear_axis(
    values: Iterable[float], minimum: float | None, maximum: float | None, from_zero: bool, margin: float, most: int
) -> _Axis:
    """Over all values, from 0 if none is below it, with a margin; given ends are kept. Below values at 0 there is a
    little room, too."""
    finite = [value for value in values if math.isfinite(value)]
    low = minimum if minimum is not None else min(finite, default=0.0)
    high = maximum if maximum is not None else max(finite, default=1.0)
    zero = from_zero and low >= 0.0 and minimum is None and (maximum is None or maximum > 0.0)
    if zero:
        low = 0.0
    if low >= high:  # one value only, or all beyond a given end
        half = 0.5 * (abs(low) + abs(high)) or 1.0
        if minimum is None and not zero:
            low = min(low, high) - half
        if maximum is None:
            high = max(low, high) + half
    size = high - low
    low = low if minimum is not None or (zero and 0.0 not in finite) else low - (0.6 if zero else 1.0) * margin * size
    high = high if maximum is not None else high + margin * size
    return _Axis(low, high, _even_ticks(low, high, most))


def _log_axis(values: Iterable[float], minimum: float | None, maximum: float | None, most: int) -> _Axis:
    """Values of 0 lie at the lower end, at a distance from the others and labelled so."""
    values = [value for value in values if math.isfinite(value)]
    positive = [value for value in values if value > 0.0]
    low = min(positive, default=maximum / 10.0 if maximum else 1.0)
    high = max(positive, default=minimum * 10.0 if minimum else 1.0)
    low = minimum if minimum is not None else low / 1.07
    high = maximum if maximum is not None else high * 1.07
    if minimum is None and low * 1.2 > high:
        low = min(low, high) / 1.5
    if maximum is None and low * 1.2 > high:
        high = low * 1.5
    ticks = _log_ticks(low, high, max(most, 2))
    if minimum is None and len(positive) < len(values):
        low /= 1.6
        ticks.insert(0, (low, "0"))
    return _Axis(low, high, ticks, True)


# ------------------------------------------------------------------------------------------------------------- texts --


def _clean(text: str) -> str:
    """Without what XML forbids; a line break stays, a tab is a space."""
    shown = []
    for letter in text.replace("\r\n", "\n"):
        code = ord(letter)
        bad = unicodedata.category(letter) in ("Cc", "Cs") or code & 0xFFFE == 0xFFFE
        shown.append(letter if letter == "\n" or not bad else " " if letter in "\t\r" else "\ufffd")
    return "".join(shown)


@lru_cache(maxsize=4096)
def _width(line: str, size: float = TEXT_PT) -> float:
    """Of one line in DejaVu Sans, in points."""
    if not line:
        return 0.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a glyph that the font lacks
        family = FontProperties(family="DejaVu Sans", size=size)
        width = text_to_path.get_text_width_height_descent(line, family, ismath=False)[0]
    return float(width) + 0.5 * size * sum(unicodedata.east_asian_width(letter) in "WF" for letter in line)


def _shortened(line: str, room: float, size: float = TEXT_PT) -> str:
    """The line, or its beginning with an ellipsis."""
    if _width(line, size) <= room:
        return line
    fits, too_long = 0, len(line)
    while fits + 1 < too_long:
        middle = (fits + too_long) // 2
        if _width(line[:middle] + "\u2026", size) <= room:
            fits = middle
        else:
            too_long = middle
    return line[:fits] + "\u2026"


def _wrapped(text: str, room: float) -> list[str]:
    """Broken at line breaks, and at spaces where a line would be wider."""
    lines: list[str] = []
    for paragraph in text.split("\n") if text else []:
        line = ""
        for word in paragraph.split(" "):
            longer = f"{line} {word}" if line else word
            if not line or _width(longer) <= room:
                line = longer
            else:
                lines.append(line)
                line = word
        lines.append(line)
    return lines


def _fitted(text: str, room: float) -> list[str]:
    return [_shortened(line, room) for line in _wrapped(_clean(text), room)]


def _one_line(text: str) -> str:
    return _clean(text).replace("\n", " ")


# ------------------------------------------------------------------------------------------------------------- sheet --


class _Sheet:
    """A figure whose places are points from its upper left corner."""

    def __init__(self, width: float) -> None:
        self.width, self.height = width, 72.0
        self.figure = Figure(figsize=(width / 72.0, 1.0))
        self.canvas = FigureCanvasAgg(self.figure)
        self.legend: Any = None
        self.legend_height = 0.0

    def add_legend(self, handles: list[Any], names: list[str], sample: float) -> None:
        """Row by row, in as few rows as fit. None if no series has a name."""
        if not any(names):
            return
        room = self.width - 2 * EDGE
        names = [_shortened(_one_line(name), room - sample - 3.0) for name in names]

        def wide(columns: int) -> float:
            widest = [max(_width(name) for name in names[c::columns]) for c in range(columns)]
            return sum(widest) + columns * (sample + 3.0 + GAP) - GAP

        columns = next((n for n in range(len(names), 1, -1) if wide(n) <= room), 1)
        columns = math.ceil(len(names) / math.ceil(len(names) / columns))
        order = [i for c in range(columns) for i in range(c, len(names), columns)]  # matplotlib goes column by column
        self.legend = self.figure.legend(
            [handles[i] for i in order],
            ["x"] * len(order),  # matplotlib leaves out names that begin with "_"
            loc="upper center",
            ncol=columns,
            borderpad=0.0,
            borderaxespad=0.0,
            handlelength=sample / TEXT_PT,
            handleheight=0.8,
            handletextpad=3.0 / TEXT_PT,
            columnspacing=GAP / TEXT_PT,
            labelspacing=0.35,
        )
        for text, i in zip(self.legend.get_texts(), order):
            text.set_text(names[i])
        extent = self.legend.get_window_extent(self.canvas.get_renderer())
        self.legend_height = extent.height * 72.0 / self.figure.dpi

    def finish(self, height: float, legend_top: float) -> None:
        self.height = height
        self.figure.set_size_inches(self.width / 72.0, height / 72.0)
        if self.legend is not None:
            self.legend.set_bbox_to_anchor((0.5, 1.0 - legend_top / height), self.figure.transFigure)

    def text(self, x: float, y: float, text: str | list[str], **style: Any) -> Any:
        lines = text if isinstance(text, str) else "\n".join(text)
        style = {"ha": "center", "va": "center", "linespacing": 1.3, **style}
        return self.figure.text(x / self.width, 1.0 - y / self.height, lines, **style) if lines else None

    def axes(self, left: float, top: float, width: float, height: float) -> Any:
        bottom = 1.0 - (top + height) / self.height
        return self.figure.add_axes(
            (left / self.width, bottom, width / self.width, height / self.height), label=f"{left} {top}"
        )

    def title(self, lines: list[str]) -> None:
        self.text(self.width / 2, EDGE + LINE * len(lines) / 2, lines)


def _set_axis(axes: Any, letter: str, axis: _Axis, labels: bool = True) -> None:
    if axis.log:
        getattr(axes, f"set_{letter}scale")("log")
    getattr(axes, f"set_{letter}lim")(axis.low, axis.high)
    getattr(axes, f"set_{letter}ticks")(
        [at for at, _ in axis.ticks], [text if labels else "" for _, text in axis.ticks]
    )
    axes.minorticks_off()


# ------------------------------------------------------------------------------------------------------------- boxes --


def _jitter(index: int) -> float:
    """Points of one value would hide each other: the golden ratio spreads them."""
    return ((index + 0.5) * 0.61803398874989485) % 1.0 - 0.5


class _Boxes:
    """A figure of box plots: first where everything goes, from the texts and numbers, then draw()."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.data = data
        self.groups: list[str] = data["groups"]
        self.series: list[dict[str, Any]] = data["series"]
        self.measures: list[dict[str, Any]] = data["measures"]
        self.panels: list[dict[str, Any]] = data["panels"]
        self.looks = [look(one.get("color", n), one.get("variant", 0)) for n, one in enumerate(self.series)]
        self.spread = self._is_spread()
        self.any_missed = any(box["missed"] for *_, box in self._boxes())
        self._choose_width()
        shares = all(measure.get("share_confidence") is not None for measure in self.measures)
        self.thin = self.slot < THIN or shares
        self._place_misses()
        self._place_texts()

    def _boxes(self) -> Iterator[tuple[int, int, int, dict[str, Any]]]:
        """Those that have runs: panel, group, series, box."""
        for p, panel in enumerate(self.panels):
            for g, group in enumerate(panel["boxes"]):
                for s, box in enumerate(group):
                    if box["values"] or box["missed"]:
                        yield p, g, s, box

    def _is_spread(self) -> bool:
        """Whether some group has boxes of two series; else each group has one, in its middle."""
        of_group: dict[int, set[int]] = {}
        for _, g, s, _ in self._boxes():
            of_group.setdefault(g, set()).add(s)
        return any(len(series) > 1 for series in of_group.values())

    def _legend_names(self) -> list[str]:
        names = [one["name"] for one in self.series]
        # Beside groups that are called like their only series it would say the same.
        return [] if not self.spread and names == self.groups else names

    # widths

    def _axis(self, m: int, most: int) -> _Axis:
        measure = self.measures[m]
        values = [v for p, _, _, box in self._boxes() if self.panels[p]["measure"] == m for v in box["values"]]
        values += [measure["line"]] if measure.get("line") is not None else []
        ends = measure.get("minimum"), measure.get("maximum")
        if measure.get("scale") == "log":
            return _log_axis(values, *ends, most)
        if measure.get("share_confidence") is not None:
            values = [0.0, 1.0]
        return _linear_axis(values, *ends, True, 0.04, most)

    def _try_columns(self, columns: int, width: float) -> None:
        self.columns, self.rows, self.width = columns, math.ceil(len(self.panels) / columns), width
        if columns == 1:
            self.panel_height = (170.0 if width > COLUMN_IN * 72 + 1 else 125.0) if self.rows == 1 else 82.0
        else:
            self.panel_height = (135.0 if columns == 2 else 115.0) if self.rows == 1 else 88.0
        self.axes = [self._axis(m, 5 if self.panel_height < 100 else 6) for m in range(len(self.measures))]
        one = len(self.measures) == 1
        room = self.rows * self.panel_height if one else self.panel_height + 12.0
        self.y_labels = [_fitted(measure.get("label", ""), room) for measure in self.measures]
        # Panels with labels at their y axis: the first of a row, and those of another measure than their neighbour.
        of = [panel["measure"] for panel in self.panels]
        self.labelled = [p % columns == 0 or of[p] != of[p - 1] for p in range(len(of))]
        margins = [0.0] * columns
        word = _width("missed") + 3.0 if self.any_missed else 0.0
        for p, m in enumerate(of):
            if self.labelled[p]:
                lines = len(self.y_labels[m])
                ticks = self.axes[m].label_width() + TICK
                margin = (lines * LINE + 2.0 if lines else 0.0) + max(ticks, word if p % columns == 0 else 0.0)
                margins[p % columns] = max(margins[p % columns], margin)
        margins = [margin + (GAP if c else 0.0) for c, margin in enumerate(margins)]
        self.panel_width = (width - 2 * EDGE - 2.0 - sum(margins)) / columns
        self.lefts = [EDGE + sum(margins[: c + 1]) + c * self.panel_width for c in range(columns)]
        self.label_lefts = [
            left - margin + (GAP if c else 0.0) for c, (left, margin) in enumerate(zip(self.lefts, margins))
        ]
        self.pitch = self.panel_width / len(self.groups)
        self.slot = min(self.pitch * GROUP_SHARE / (len(self.series) if self.spread else 1), WIDEST_BOX / BOX_SHARE)

    def _choose_columns(self, inches: float) -> None:
        """As many as asked for, or where boxes would be too thin fewer, of full rows."""
        asked = min(self.data.get("columns", 1), len(self.panels))
        for columns in range(asked, 0, -1):
            if columns < asked and len(self.panels) % columns:
                continue
            self._try_columns(columns, inches * 72.0)
            if self.data.get("grid") or self.slot >= SMALLEST_SLOT:
                return

    def _choose_width(self) -> None:
        if self.data.get("width_in"):
            return self._choose_columns(self.data["width_in"])
        narrow = self.data.get("columns", 1) == 1 or len(self.panels) == 1
        self._choose_columns(COLUMN_IN if narrow else PAGE_IN)
        if narrow and self.slot < SMALLEST_SLOT:
            self._choose_columns(PAGE_IN)

    def center(self, group: int, series: int) -> float:
        """Of a box, in points from the left end of its panel."""
        aside = series - (len(self.series) - 1) / 2 if self.spread else 0.0
        return self.pitch * (group + 0.5) + self.slot * aside

    # misses

    def _place_misses(self) -> None:
        """The numbers above the panels, level, turned, or bars where they do not fit."""
        texts = [f"{box['missed']}/{len(box['values']) + box['missed']}" for *_, box in self._boxes() if box["missed"]]
        self.miss_kind, self.miss_size, self.miss_height = "", TEXT_PT, 0.0
        self.missed_rows = {p // self.columns for p, _, _, box in self._boxes() if box["missed"]}
        if not texts:
            return
        if self._level_fits():
            self.miss_kind, self.miss_height = "level", LINE + 3.0
        elif self.slot < SMALLEST_SLOT:
            self.miss_kind, self.miss_height = "bars", MISS_BAR + 7.0
        else:
            self.miss_kind = "turned"
            self.miss_size = min(TEXT_PT, max(SMALLEST_TEXT, math.floor(2 * (self.slot - 0.2)) / 2))
            self.miss_height = max(_width(text, self.miss_size) for text in texts) + 5.0

    def _level_fits(self) -> bool:
        taken: dict[int, float] = {}
        for p, g, s, box in self._boxes():
            if box["missed"]:
                half = _width(f"{box['missed']}/{len(box['values']) + box['missed']}") / 2
                x = self.center(g, s)
                if x - half < taken.get(p, -3.0) or x + half > self.panel_width + 3.0:
                    return False
                taken[p] = x + half + 4.0
        return True

    # texts

    def _level_labels(self) -> list[list[str]] | None:
        labels = []
        for group in map(_clean, self.groups):
            lines = _wrapped(group, self.pitch - 3.0)
            most = 1 if len(self.groups) >= 9 else max(2, 1 + group.count("\n"))
            if len(lines) > most or any(_width(line) > self.pitch - 3.0 for line in lines):
                return None
            labels.append(lines)
        return labels

    def _place_groups(self) -> None:
        level = self._level_labels()
        if level is not None:
            self.group_labels, self.degrees = ["\n".join(lines) for lines in level], 0
            lines = max(len(lines) for lines in level)
            self.group_height = 4.0 + LINE * lines if lines else 4.0
            return
        self.group_labels = [_shortened(_one_line(group), LONGEST_LABEL) for group in self.groups]
        widths = [_width(label) for label in self.group_labels]
        # Slanted labels reach to the left, which is not free in an incomplete row nor beyond the edge, and not where
        # groups are nearer to each other than lines are.
        slant = math.sqrt(0.5)
        overhang = max(width * slant + TEXT_PT / 2 - self.pitch * (g + 0.5) for g, width in enumerate(widths))
        free = len(self.panels) % self.columns == 0 and overhang <= self.lefts[0] - EDGE
        self.degrees = 45 if free and self.pitch >= LINE / slant else 90
        self.group_height = (
            8.0 + max(widths) * (slant if self.degrees == 45 else 1.0) + (3.0 if self.degrees == 45 else 0.0)
        )

    def _spans(self, level: int) -> list[SimpleNamespace]:
        """Neighbouring groups of the same label of this level, and of all levels farther out."""
        keys = [
            tuple(outer["labels"][g] for outer in self.data.get("outer", [])[level:]) for g in range(len(self.groups))
        ]
        spans: list[SimpleNamespace] = []
        for g, key in enumerate(keys):
            if g and key == keys[g - 1]:
                spans[-1].last = g
            else:
                spans.append(SimpleNamespace(first=g, last=g, text=""))
        return spans

    def _place_outer(self) -> str:
        """ "targets T = 2" below its groups where there is room for that, else "2", and the x axis names the title."""
        x_label, bare = self.data.get("x_label", ""), False
        self.outer = []
        for level, outer in enumerate(self.data.get("outer", [])):
            spans = self._spans(level)
            rooms = [self.pitch * (span.last - span.first + 1) - 4.0 for span in spans]
            full = [_one_line(outer["full"][span.first]) for span in spans]
            fits = all(_width(text) <= room for text, room in zip(full, rooms))
            for span, text, room in zip(spans, full, rooms):
                span.text = text if fits else _shortened(_one_line(outer["labels"][span.first]), room)
            if not fits:
                x_label += ("; below that, " if bare else "; below it, ") + outer["title"]
                bare = True
            self.outer.append(spans)
        return x_label

    def _place_texts(self) -> None:
        self._place_groups()
        plots = self.width - EDGE - self.lefts[0]
        self.x_label = _fitted(self._place_outer(), plots)
        self.panel_titles = [_fitted(panel.get("title", ""), self.panel_width + GAP / 2) for panel in self.panels]
        self.title = _fitted(self.data.get("title", ""), self.width - 2 * EDGE)
        counts = [len(box["values"]) + box["missed"] for *_, box in self._boxes()]
        self.note = ""
        if counts:
            span = f"{min(counts)}" if min(counts) == max(counts) else f"{min(counts)}\u2013{max(counts)}"
            self.note = f"n = {span} {self.data.get('counted', 'runs')} each"
        used = _width(self.x_label[-1]) / 2 + LINE if self.x_label else 0.0
        self.note_beside = bool(self.x_label) and plots / 2 - used >= _width(self.note)

    def _place_rows(self, sheet: _Sheet) -> None:
        legend_top = EDGE + (LINE * len(self.title) + 3.0 if self.title else 0.0)
        y = legend_top + sheet.legend_height + (6.0 if sheet.legend_height else 0.0)
        self.tops = []
        for row in range(self.rows):
            titles = self.panel_titles[row * self.columns : (row + 1) * self.columns]
            lines = max(len(title) for title in titles)
            strip = self.miss_height if row in self.missed_rows else 0.0
            y += max((lines * LINE + 3.0 if lines else 0.0) + strip, 5.0) + (ROW_GAP if row else 0.0)
            self.tops.append(y)
            y += self.panel_height
        x_label = 3.0 + LINE * len(self.x_label) if self.x_label else 0.0
        note = 0.0 if self.note_beside or not self.note else LINE + 1.0
        height = y + self.group_height + LINE * len(self.outer) + x_label + note + EDGE
        sheet.finish(math.ceil(height), legend_top)

    # drawing

    def draw(self) -> Figure:
        sheet = _Sheet(self.width)
        sheet.add_legend([self._sample(each) for each in self.looks], self._legend_names(), SWATCH)
        self._place_rows(sheet)
        self._draw_sheet(sheet)
        for p in range(len(self.panels)):
            self._draw_panel(sheet, p)
        return sheet.figure

    def _sample(self, each: Look) -> Any:
        if self.thin:
            return Line2D([], [], color=each.color, linewidth=1.6, **each.mark(4.5))
        return Patch(facecolor=each.fill, edgecolor=each.color, linewidth=0.7)

    def _draw_sheet(self, sheet: _Sheet) -> None:
        sheet.title(self.title)
        left, right = self.lefts[0], self.lefts[-1] + self.panel_width
        if len(self.measures) == 1:
            middle = (self.tops[0] + self.tops[-1] + self.panel_height) / 2
            label = self.y_labels[0]
            sheet.text(self.label_lefts[0] + LINE * len(label) / 2, middle, label, rotation=90)
        bottom = self.tops[-1] + self.panel_height + self.group_height + LINE * len(self.outer)
        sheet.text((left + right) / 2, bottom + 3.0 + LINE * len(self.x_label) / 2, self.x_label)
        y = bottom + (3.0 + LINE * (len(self.x_label) + 0.5) if self.x_label else 1.0 + LINE / 2)
        sheet.text(right, y - (LINE if self.note_beside else 0.0), self.note, ha="right")

    def _draw_panel(self, sheet: _Sheet, p: int) -> None:
        panel, column, row = self.panels[p], p % self.columns, p // self.columns
        top, left, m = self.tops[row], self.lefts[column], panel["measure"]
        if not any(box["values"] or box["missed"] for group in panel["boxes"] for box in group):
            sheet.text(left + self.panel_width / 2, top + self.panel_height / 2, "no runs")  # in a grid, beside others
            return
        axes = sheet.axes(left, top, self.panel_width, self.panel_height)
        axes.set_xlim(-0.5, len(self.groups) - 0.5)
        _set_axis(axes, "y", self.axes[m], self.labelled[p])
        axes.grid(axis="y")
        strip = self.miss_height if row in self.missed_rows else 0.0
        title = self.panel_titles[p]
        sheet.text(left + self.panel_width / 2, top - strip - 3.0 - LINE * len(title) / 2, title)
        if len(self.measures) > 1 and self.labelled[p]:
            label = self.y_labels[m]
            x = self.label_lefts[column] + LINE * len(label) / 2
            sheet.text(x, top + self.panel_height / 2, label, rotation=90)
        last = p + self.columns >= len(self.panels)  # there is no panel below
        self._draw_groups(sheet, axes, p, last)
        line = self.measures[m].get("line")
        if line is not None:
            axes.axhline(line, color=FRAME, linewidth=0.7, zorder=1.5)
        for s in range(len(self.series)):
            self._draw_series(axes, p, s)
        if row in self.missed_rows:
            self._draw_misses(sheet, axes, p)

    def _draw_groups(self, sheet: _Sheet, axes: Any, p: int, last: bool) -> None:
        turned = {"rotation": self.degrees, "ha": "right", "rotation_mode": "anchor"}
        if self.degrees == 90:
            turned["va"] = "center"
        axes.set_xticks(range(len(self.groups)), self.group_labels if last else [""] * len(self.groups))
        axes.tick_params(axis="x", length=0, pad=3.0 if self.degrees == 0 else 4.0)
        if self.degrees:
            for label in axes.get_xticklabels():
                label.set(**turned)
        else:
            for label in axes.get_xticklabels():
                label.set_linespacing(1.3)
        separate = axes.get_xaxis_transform()
        bottom = self.group_height if last else 0.0
        for spans in self.outer:
            y = bottom + LINE / 2
            bottom += LINE if last else 0.0
            for span in spans:
                if last:
                    axes.annotate(
                        span.text,
                        ((span.first + span.last) / 2, 0.0),
                        xycoords=separate,
                        xytext=(0.0, -y),
                        textcoords="offset points",
                        ha="center",
                        va="center",
                        annotation_clip=False,
                    )
                if span.first:
                    ends = [-bottom / self.panel_height, 1.0]
                    x = [span.first - 0.5] * 2
                    axes.add_line(
                        Line2D(x, ends, transform=separate, clip_on=False, color=SEPARATOR, lw=0.4, zorder=0.5)
                    )
        if not self.outer and self.spread:
            for g in range(1, len(self.groups)):
                axes.axvline(g - 0.5, color="#d0d0d0", linewidth=0.4, zorder=0.5)

    def _draw_series(self, axes: Any, p: int, s: int) -> None:
        measure, axis = self.measures[self.panels[p]["measure"]], self.axes[self.panels[p]["measure"]]

        def shown(value: float) -> float:
            """What missed is beyond the upper end, so that a box is open there; 0 is at the lower end of a log axis."""
            return axis.beyond() if math.isinf(value) else max(value, axis.low) if axis.log else value

        stats, at, names, points = [], [], [], []
        width = BOX_SHARE * self.slot / self.pitch
        for g, group in enumerate(self.panels[p]["boxes"]):
            box = group[s]
            late = measure.get("late", True) and box["missed"]
            if not box["values"] and not late:
                continue
            x = self.center(g, s) / self.pitch - 0.5
            numbers = _shown_numbers(box, measure)
            for n, value in enumerate(numbers.pop("fliers")):
                points.append((x + 0.5 * width * _jitter(n), min(max(value, axis.low), axis.high)))
            if math.isfinite(numbers["q1"]):
                stats.append({name: shown(value) for name, value in numbers.items()})
                at.append(x)
                names.append(f"{p}-{g}-{s}")
        if self.thin or measure.get("share_confidence") is not None:
            self._draw_thin(axes, self.looks[s], stats, at, f"{p}-{s}")
            return
        for numbers, median, box, name in zip(stats, *self._draw_boxes(axes, self.looks[s], stats, at, width), names):
            box.set_gid("box-" + name)
            median.set_gid("median-" + name)
            if (axis.part(numbers["q3"]) - axis.part(numbers["q1"])) * self.panel_height < FLAT:
                median.set_color(self.looks[s].color)
        if points:
            mark = {**self.looks[s].mark(2.8), "alpha": 0.6, "clip_on": False, "zorder": 2.0}
            axes.plot(*zip(*points), linestyle="none", gid=f"outliers-{p}-{s}", **mark)

    def _draw_boxes(
        self, axes: Any, each: Look, stats: list[Any], at: list[float], width: float
    ) -> tuple[list[Any], list[Any]]:
        line = {"color": each.color, "linewidth": 0.7, "solid_capstyle": "butt"}
        drawn = axes.bxp(
            stats,
            positions=at,
            widths=width,
            capwidths=width / 2,
            patch_artist=True,
            showfliers=False,
            manage_ticks=False,
            boxprops={"facecolor": each.fill, "edgecolor": each.color, "linewidth": 0.7, "zorder": 2.1},
            whiskerprops={**line, "zorder": 2.05},
            capprops={**line, "zorder": 2.05},
            medianprops={"color": "black", "linewidth": 1.2, "solid_capstyle": "butt", "zorder": 2.2},
        )
        return drawn["medians"], drawn["boxes"]

    def _draw_thin(self, axes: Any, each: Look, stats: list[Any], at: list[float], name: str) -> None:
        def column(name: str) -> list[float]:
            return [numbers[name] for numbers in stats]

        style = {"color": each.color}
        axes.vlines(at, column("whislo"), column("whishi"), linewidth=0.5, zorder=2.0, gid="whiskers-" + name, **style)
        axes.vlines(at, column("q1"), column("q3"), linewidth=1.6, zorder=2.1, gid="quartiles-" + name, **style)
        axes.plot(at, column("med"), linestyle="none", zorder=2.2, gid="medians-" + name, **each.mark(4.2))

    def _draw_misses(self, sheet: _Sheet, axes: Any, p: int) -> None:
        above = axes.get_xaxis_transform()

        def part(points: float) -> float:  # of the panel's height
            return 1.0 + points / self.panel_height

        def note(text: str, x: float, y: float, **style: Any) -> None:
            axes.text(x, part(y), text, transform=above, clip_on=False, **style)

        if p % self.columns == 0:
            word = {"ha": "right", "va": "center"}
            left, up = -0.5 - 3.0 / self.pitch, self.miss_height / 2
            note("missed", left, 2.0 + LINE / 2 if self.miss_kind == "bars" else up + 0.5, **word)
            if self.miss_kind == "bars":
                note("all", left, 2.0 + MISS_BAR, **word)
        if self.miss_kind == "bars":
            for y in (2.0, 2.0 + MISS_BAR):
                ends = [-0.5, len(self.groups) - 0.5]
                axes.add_line(Line2D(ends, [part(y)] * 2, transform=above, clip_on=False, color=SEPARATOR, lw=0.4))
        for q, g, s, box in self._boxes():
            if q != p or not box["missed"]:
                continue
            x, runs = self.center(g, s) / self.pitch - 0.5, len(box["values"]) + box["missed"]
            if self.miss_kind == "bars":
                width, height = BOX_SHARE * self.slot / self.pitch, max(0.5, MISS_BAR * box["missed"] / runs)
                bar = Rectangle((x - width / 2, part(2.0)), width, height / self.panel_height, transform=above)
                bar.set(facecolor=self.looks[s].color, linewidth=0.0, clip_on=False, gid=f"missed-{p}-{g}-{s}")
                axes.add_patch(bar)
            elif self.miss_kind == "level":
                note(f"{box['missed']}/{runs}", x, 3.0 + LINE / 2, ha="center", va="center", gid=f"missed-{p}-{g}-{s}")
                mark = Line2D(
                    [x, x], [1.0, part(2.5)], transform=above, clip_on=False, color=self.looks[s].color, lw=1.0
                )
                axes.add_line(mark)
            else:
                style = {"rotation": 90, "size": self.miss_size, "gid": f"missed-{p}-{g}-{s}"}
                note(f"{box['missed']}/{runs}", x, 2.5, ha="center", va="bottom", **style)


# ------------------------------------------------------------------------------------------------------------ curves --


def _gaps(values: Sequence[float | None]) -> list[float]:
    return [math.nan if value is None else value for value in values]


def _plot_curves(data: dict[str, Any]) -> Figure:
    curves = data["curves"]
    looks = [look(curve.get("color", n)) for n, curve in enumerate(curves)]
    numbers = [v for curve in curves for name in ("y", "low", "high") for v in _gaps(curve.get(name, []))]
    # Bare lines run from edge to edge; points must not be cut.
    margin = 0.03 if any(curve.get("points") for curve in curves) else 0.0
    x_axis = _linear_axis([x for curve in curves for x in curve["x"]], None, None, False, margin, 8)
    y_axis = _linear_axis(numbers, data.get("y_minimum"), data.get("y_maximum"), True, 0.04, 6)
    sheet = _Sheet(COLUMN_IN * 72)
    title = _fitted(data.get("title", ""), sheet.width - 2 * EDGE)
    y_label = _fitted(data.get("y_label", ""), CURVES_HEIGHT)
    left = EDGE + (LINE * len(y_label) + 2.0 if y_label else 0.0) + y_axis.label_width() + TICK
    width = sheet.width - EDGE - x_axis.label_width() / 2 - left
    x_label = _fitted(data.get("x_label", ""), width)
    handles: list[Any] = []
    for curve, each in zip(curves, looks):
        line = Line2D([], [], **_curve_style(curve, each))
        handles.append((Patch(facecolor=each.color, alpha=0.18, linewidth=0), line) if curve.get("low") else line)
    sheet.add_legend(handles, [curve.get("name", "") for curve in curves], SAMPLE)
    legend_top = EDGE + (LINE * len(title) + 3.0 if title else 0.0)
    top = legend_top + sheet.legend_height + 6.0
    below = top + CURVES_HEIGHT + 14.0
    sheet.finish(math.ceil(below + (3.0 + LINE * len(x_label) if x_label else 0.0) + EDGE), legend_top)
    sheet.title(title)
    sheet.text(EDGE + LINE * len(y_label) / 2, top + CURVES_HEIGHT / 2, y_label, rotation=90)
    sheet.text(left + width / 2, below + 3.0 + LINE * len(x_label) / 2, x_label)
    axes = sheet.axes(left, top, width, CURVES_HEIGHT)
    _set_axis(axes, "x", x_axis)
    _set_axis(axes, "y", y_axis)
    axes.grid(axis="y")
    for curve, each in zip(curves, looks):
        if curve.get("low"):
            low, high = _gaps(curve["low"]), _gaps(curve["high"])
            axes.fill_between(curve["x"], low, high, color=each.color, alpha=0.18, linewidth=0)
        axes.plot(curve["x"], _gaps(curve["y"]), **_curve_style(curve, each))
    return sheet.figure


def _curve_style(curve: dict[str, Any], each: Look) -> dict[str, Any]:
    dashes = (0, each.dashes) if each.dashes else "solid"
    style = {"color": each.color, "linewidth": 1.1, "linestyle": dashes}
    return {**style, **each.mark(4.0)} if curve.get("points") else style


# ----------------------------------------------------------------------------------------------------------- reading --


@contextmanager
def styled() -> Iterator[None]:
    """matplotlib with the settings of STYLE and no others, for drawing of your own with the look of these figures."""
    with matplotlib.style.context(STYLE, after_reset=True), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing")  # an svg shows it in the reader's font
        yield


class FigureFault(ValueError):
    """A figure that cannot be drawn: what is wrong with its JSON."""


def _require(condition: bool, what: str) -> None:
    if not condition:
        raise FigureFault(what)


def _check_numbers(values: Any, what: str, gaps: bool = False) -> None:
    def good(value: Any) -> bool:
        return (value is None and gaps) or (
            isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
        )

    _require(isinstance(values, list) and all(map(good, values)), f"{what} must be a list of numbers")


def _check_boxes(data: dict[str, Any]) -> None:
    names = ("groups", "series", "measures", "panels")
    for name in names:
        _require(isinstance(data.get(name), list) and len(data[name]) > 0, f"{name} must be a list of at least one")
    groups, series, measures, panels = (data[name] for name in names)
    for n, one in enumerate(series):
        _require(0 <= one.get("color", n) < len(SERIES), f"series[{n}].color: there are 0 to {len(SERIES) - 1}")
        _require(
            0 <= one.get("variant", 0) < len(FILL_STEPS), f"series[{n}].variant: there are 0 to {len(FILL_STEPS) - 1}"
        )
    for n, outer in enumerate(data.get("outer", [])):
        for name in ("labels", "full"):
            _require(len(outer[name]) == len(groups), f"outer[{n}].{name} must be one for each group")
    for n, measure in enumerate(measures):
        scale, where = measure.get("scale", "linear"), f"measures[{n}]"
        low, high, line = (measure.get(name) for name in ("minimum", "maximum", "line"))
        _require(scale in ("linear", "log"), f'{where}.scale is {scale!r}; allowed: "linear", "log"')
        _require(low is None or high is None or low < high, f"{where}.minimum must be below maximum")
        positive = all(value is None or value > 0.0 for value in (low, high, line))
        _require(scale == "linear" or positive, f"{where}: ends and line of a log scale must be above 0")
    for n, panel in enumerate(panels):
        where = f"panels[{n}]"
        _require(0 <= panel["measure"] < len(measures), f"{where}.measure: there are 0 to {len(measures) - 1}")
        _require(len(panel["boxes"]) == len(groups), f"{where}.boxes must be a list for each group")
        for group in panel["boxes"]:
            _require(len(group) == len(series), f"{where}.boxes must have a box for each series in each group")
            for box in group:
                _check_numbers(box["values"], f"{where}.boxes: values")


def _check_curves(data: dict[str, Any]) -> None:
    curves = data.get("curves", [])
    _require(isinstance(curves, list) and 0 < len(curves) <= len(SERIES), f"curves must be 1 to {len(SERIES)}")
    for n, curve in enumerate(curves):
        _check_numbers(curve["x"], f"curves[{n}].x")
        for name in ("y", "low", "high"):
            values = curve.get(name, [])
            _check_numbers(values, f"curves[{n}].{name}", gaps=True)
            empty = name != "y" and not values and not curve.get("low")
            _require(empty or len(values) == len(curve["x"]), f"curves[{n}].{name} must be as long as x")


def plot(data: dict[str, Any]) -> Figure:
    """A matplotlib Figure of what NAME.json holds, as json.load() returns it. FigureFault if that cannot be drawn.

    It belongs to no window and no pyplot. Change it as you like, and write it with save().
    """
    _require(
        isinstance(data, dict) and data.get("format") == "banyan.figure", 'is no figure ("format": "banyan.figure")'
    )
    version = data.get("format_version")
    _require(version == 1, f"has format version {version}; this figures.py draws version 1")
    kind = data.get("kind")
    _require(kind in ("boxes", "curves"), f'kind is {kind!r}; allowed: "boxes", "curves"')
    try:
        with styled():
            if kind == "curves":
                _check_curves(data)
                return _plot_curves(data)
            _check_boxes(data)
            return _Boxes(data).draw()
    except (KeyError, TypeError, AttributeError, IndexError) as error:
        raise FigureFault(f"is no complete figure: {type(error).__name__} {error}") from error


# ------------------------------------------------------------------------------------------------------------- files --

_METADATA = {"svg": {"Date": None, "Creator": None}, "pdf": {"CreationDate": None}, "png": {"Software": None}}


def save(figure: Figure, stem: str | os.PathLike[str], kinds: Iterable[str] = ("svg", "pdf", "png")) -> list[Path]:
    """Writes STEM.svg, STEM.pdf and STEM.png (300 pixels an inch): each whole or not at all, and only if all could be
    drawn; the same bytes for the same figure. Returns their paths."""
    pictures = []
    for kind in kinds:
        picture = io.BytesIO()
        with styled():
            figure.savefig(picture, format=kind, metadata=_METADATA.get(kind))
        pictures.append((Path(f"{os.fspath(stem)}.{kind}"), picture.getvalue()))
    for path, content in pictures:
        part = path.with_name(f".{path.name}.{os.getpid()}.part")
        try:
            with open(part, "wb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            os.replace(part, path)
        except BaseException:
            part.unlink(missing_ok=True)
            raise
    return [path for path, _ in pictures]


def draw(path: str | os.PathLike[str]) -> list[Path]:
    """Draws a figure's JSON; its pictures lie beside it. Returns their paths."""
    path = Path(path)
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise FigureFault(f"is no JSON: {error}") from error
    return save(plot(data), path.with_suffix(""))


def is_figure(path: str | os.PathLike[str]) -> bool:
    """Whether a file begins as figures do."""
    with open(path, "rb") as file:
        return b'"banyan.figure"' in file.read(100)


def find(paths: Iterable[str | os.PathLike[str]]) -> list[Path]:
    """The figures that these are: files themselves, of folders all figures in them and in their folder `figures`."""
    found: list[Path] = []
    for path in map(Path, paths):
        if not path.is_dir():
            found.append(path)
            continue
        inside = [*sorted(path.glob("*.json")), *sorted(path.glob("figures/*.json"))]
        figures = [file for file in inside if is_figure(file)]
        if not figures:
            raise FileNotFoundError(f"{path} holds no figure: no .json that banyan study or banyan tune has left")
        found += figures
    return found


def _draw_one(path: Path) -> str:
    """What went wrong."""
    try:
        draw(path)
    except (FigureFault, OSError) as error:
        return f"{path}: {error}" if str(path) not in str(error) else str(error)
    except Exception as error:  # the others are still drawn
        return f"{path}: {type(error).__name__}: {error}"
    return ""


def draw_all(paths: Sequence[Path]) -> list[str]:
    """Draws figures, several at once where there are cores; returns what went wrong, a line each."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    workers = min(cores, len(paths) // 2)
    if workers > 1:
        from concurrent.futures import ProcessPoolExecutor

        with ProcessPoolExecutor(workers) as pool:
            return [fault for fault in pool.map(_draw_one, paths) if fault]
    return [fault for fault in map(_draw_one, paths) if fault]


def main(arguments: Sequence[str] | None = None) -> int:
    """The command: figures.py FOLDER_OR_FILE..."""
    import argparse

    parser = argparse.ArgumentParser(
        description="Draws figures of studies and tunings: .svg, .pdf and .png beside each."
    )
    parser.add_argument(
        "paths", nargs="+", metavar="FOLDER", help="of a study, a tuning or figures; or a figure's .json"
    )
    try:
        faults = draw_all(find(parser.parse_args(arguments).paths))
    except OSError as error:
        faults = [str(error)]
    except KeyboardInterrupt:
        return 130
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
