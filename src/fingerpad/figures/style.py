"""How every figure looks, and how it is saved: sizes, fonts, colours, axis units, byte-stable files.

Nothing rests on colour alone: phases differ in colour, lightness and marker, dispersions in line and filling. What else
is compared has colours that the three phases of the paper do not have, and differs in filling: interfaces, kinematics,
and what acts along or into the skin.
"""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any, NamedTuple, ParamSpec, TypeVar

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import findfont, get_font
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..files import replacing
from ..scene.contact_law import Interface
from ..scene.device import Device
from ..scene.stimuli import condition_name
from ..scene.tissue_law import Kinematics
from ..words import plain, shortened

if TYPE_CHECKING:
    import pandas as pd

Arguments = ParamSpec("Arguments")
Drawn = TypeVar("Drawn")

MM = 1.0 / 25.4  # inch
NARROW, MIDDLE, WIDE = 87.0, 114.0, 178.0  # column widths [mm]; source: PNAS
TEXT, TITLE = 7.0, 8.0  # font sizes [pt]; source: 7 pt stays legible in print
THIN, LINE = 0.5, 1.0  # line widths [pt]
MARKER = 4.5  # marker size [pt]
LETTER_OFFSET = (-30.0, 4.0)  # of a panel's letter from its upper left corner [pt]
LETTER_NEAR = (-26.0, 4.0)  # the same, where the labels of ticks are short [pt]
POINTS = 72.0  # in an inch
# Widths of a letter and of what stands before a legend's label, of the font size [1]; source: measured in this font
CHARACTER, HANDLE = 0.56, 4.6
BOLD = 1.2  # width of bold letters, of plain ones [1]; source: the same
LONGEST_KEY = 40  # characters of a name in a legend
UNKNOWN = " Where an error is not known there is no bar either; notes beside the scores say why."
RESOLUTION = 300  # of PNG files [dots per inch]
PNG_LEVEL = 3  # of 9; source: half the seconds of the default, files up to a sixth larger (measured)
WRITTEN: dict[str, dict[str, Any]] = {
    "png": {"metadata": {"Software": None}, "pil_kwargs": {"compress_level": PNG_LEVEL}},
    "pdf": {"metadata": {"Creator": None, "Producer": None, "CreationDate": None}},
    "svg": {"metadata": {"Creator": None, "Date": None}},
}  # how files are written, by ending

# where nothing is said, as matplotlib comes, and not as a matplotlibrc of whoever draws has it
RC: dict[Any, Any] = {key: value for key, value in mpl.rcParamsDefault.items() if key != "backend"} | {
    "font.family": ["DejaVu Sans"],  # comes with matplotlib: the same letters on every machine
    "font.size": TEXT,
    "axes.titlesize": TITLE,
    "axes.labelsize": TEXT,
    "xtick.labelsize": TEXT,
    "ytick.labelsize": TEXT,
    "legend.fontsize": TEXT,
    "figure.titlesize": TITLE,
    "mathtext.fontset": "dejavusans",
    "axes.titleweight": "bold",
    "axes.linewidth": THIN,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.useoffset": False,
    "xtick.major.width": THIN,
    "ytick.major.width": THIN,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "lines.linewidth": LINE,
    "lines.markersize": MARKER,
    "lines.markeredgewidth": 0.9,
    "hatch.linewidth": 0.6,
    "legend.frameon": False,
    "legend.handlelength": 2.4,
    "legend.handletextpad": 0.5,
    "legend.columnspacing": 1.4,
    "figure.constrained_layout.h_pad": 1.5 * MM,
    "figure.constrained_layout.w_pad": 1.5 * MM,
    "pdf.fonttype": 42,
    "savefig.dpi": RESOLUTION,
    "svg.hashsalt": "fingerpad",  # names within a file are then not drawn by lot
}

# Okabe and Ito 2008: told apart with any colour vision; ordered so that neighbours differ in lightness as well
ORANGE, BLUE, BLACK, SKY, VERMILLION, PINK, GREEN = (
    "#E69F00",
    "#0072B2",
    "#000000",
    "#56B4E9",
    "#D55E00",
    "#CC79A7",
    "#009E73",
)
COLOURS = (ORANGE, BLUE, BLACK, SKY, VERMILLION, PINK, GREEN)
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", "*", ">", "p")  # as many as share no factor with the colours
LINES: tuple[Any, ...] = ("-", (0, (4.0, 1.5)), (0, (1.2, 1.2)), (0, (5.0, 1.5, 1.2, 1.5)))
DASHED: tuple[float, tuple[float, ...]] = (0.0, (4.0, 1.5))  # pt, shear traction of a design that is compared
FILLS: tuple[Any, ...] = ("full", "none", "left", "bottom", "top")  # as many as share no factor with the lines
HATCH = "//////"
INTERFACE_LOOK: dict[Interface, dict[str, Any]] = {
    Interface.SHEAR: {"facecolor": GREEN, "edgecolor": GREEN},
    Interface.FRICTIONLESS: {"facecolor": "white", "edgecolor": PINK, "hatch": HATCH},
}  # of bars
KINEMATICS_LOOK: dict[Kinematics, dict[str, Any]] = {
    Kinematics.SMALL: {"facecolor": SKY, "edgecolor": SKY},
    Kinematics.FINITE: {"facecolor": "white", "edgecolor": VERMILLION, "hatch": HATCH},
}  # the same
# What acts on the skin or moves along it, and into it, has no colour, as maps and phases have: a dark line or hatching,
# and a light area
ALONG, INTO, INTO_EDGE = "#000000", "#C4C4C4", "#7F7F7F"
SHADE = "#E3E3E3"  # actuators' faces behind curves
GREY = "#6E6E6E"  # what is not data: lines, notes


class Shown(NamedTuple):
    """A condition that a figure shows."""

    device: str
    condition: str
    dispersion: str
    phase_deg: float


@dataclass(frozen=True)
class Series:
    """How one condition is drawn, and what it is called: among all, and among those of its device and dispersion."""

    label: str
    short: str
    colour: str
    marker: str
    line: Any
    fill: Any


@dataclass(frozen=True)
class Styles:
    """How the conditions of some devices are drawn.

    series: by device and condition. legend, spreads: handles that explain those that are drawn, and their dispersions.
    """

    series: dict[tuple[str, str], Series]
    legend: list[Line2D]
    spreads: list[Line2D]


def styled(function: Callable[Arguments, Drawn]) -> Callable[Arguments, Drawn]:
    """Decorator of figure functions: the style holds while they run, and nothing global is left changed."""
    return mpl.rc_context(RC)(function)


def new_figure(width: float, height: float) -> Figure:
    """Empty figure of that size [mm] that lays itself out."""
    return Figure(figsize=(width * MM, height * MM), layout="constrained")


def save(figure: Figure, png: Path) -> None:
    """Write a figure as PNG, and as PDF beside it, laid out once, the same in both."""
    for path in (png, png.with_suffix(".pdf")):
        save_as(figure, path)


def save_as(figure: Figure, path: Path) -> None:
    """Write one file, in the format that its ending names, without dates and versions: same figure, same bytes."""
    suffix = path.suffix.removeprefix(".")
    with mpl.rc_context(RC), replacing(path) as part, warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing from font")  # `check` tells of them
        figure.align_ylabels([axes for axes in figure.axes if axes.get_ylabel()])  # a panel without has no say
        if engine := figure.get_layout_engine():
            engine.execute(figure)
        figure.set_layout_engine(None)
        figure.savefig(part, format=suffix, **WRITTEN[suffix])


def letters_without_a_glyph(text: str) -> str:
    """Letters of a text that figures cannot show, each once."""
    font = get_font(findfont(RC["font.family"][0]))
    return "".join(dict.fromkeys(each for each in text if not font.get_char_index(ord(each))))


def as_png(figure: Figure, resolution: float) -> bytes:
    """A figure as a picture for a screen, at a resolution [dots per inch]."""
    file = BytesIO()
    with mpl.rc_context(RC):
        figure.savefig(file, format="png", dpi=resolution, **WRITTEN["png"])
    return file.getvalue()


def conditions_of(devices: Iterable[Device]) -> list[Shown]:
    """The devices' conditions, one after the other."""
    return [Shown(d.name, c.name, c.dispersion, c.phase_deg) for d in devices for c in d.conditions]


def shown_in(scores: pd.DataFrame) -> list[Shown]:
    """The conditions of a table of scores, row by row."""
    return [Shown(*row) for row in scores[list(Shown._fields)].itertuples(index=False)]


def are_named(conditions: Iterable[Shown]) -> bool:
    """Whether some are not called by their dispersion and phase, as histories and recordings are not."""
    return any(one.condition != condition_name(one.dispersion, one.phase_deg) for one in conditions)


def condition_styles(conditions: Iterable[Shown], drawn: Collection[Shown] | None = None) -> Styles:
    """Styles of conditions, each of which may come more than once. drawn: those that are; all if not given.

    Phases share colour and marker across devices, dispersions line and filling. Where a device has a condition that is
    not called by its dispersion and phase (a history, say) each of its conditions is drawn in its own colour and called
    by its name.
    """
    shown = list(dict.fromkeys(conditions))
    by_name = {one.device for one in shown if are_named([one])}
    spreads = Counter(device for device, _ in {(one.device, one.dispersion) for one in shown})
    phases = sorted({one.phase_deg for one in shown if one.device not in by_name})
    dispersions = list(
        dict.fromkeys(one.dispersion for one in shown if one.device not in by_name and spreads[one.device] > 1)
    )
    named = [f"{one.device}: {one.condition}" for one in shown if one.device in by_name]
    keys = [*(f"{phase:g}°" for phase in phases), *named]
    series: dict[tuple[str, str], Series] = {}
    legend: dict[str, Line2D] = {}
    kinds: set[str] = set()
    for one in shown:
        by_phase, several = one.device not in by_name, spreads[one.device] > 1
        key = f"{one.phase_deg:g}°" if by_phase else f"{one.device}: {one.condition}"
        number = keys.index(key)
        kind = dispersions.index(one.dispersion) if by_phase and several else 0
        short = key if by_phase else one.condition
        look = Series(
            f"{plain(one.dispersion)}, {key}" if by_phase and several else short,
            short,
            COLOURS[number % len(COLOURS)],
            MARKERS[number % len(MARKERS)],
            LINES[kind % len(LINES)],
            FILLS[kind % len(FILLS)],
        )
        series[one.device, one.condition] = look
        if drawn is None or one in drawn:
            label = shortened(key, LONGEST_KEY)
            legend.setdefault(key, Line2D([], [], color=look.colour, marker=look.marker, label=label))
            kinds |= {one.dispersion} if by_phase and several else set()
    spread = [
        Line2D(
            [], [], color=GREY, marker="o", linestyle=LINES[number % len(LINES)], fillstyle=FILLS[number % len(FILLS)],
            label=f"{plain(name)} dispersion", markerfacecoloralt="white",
        )
        for number, name in enumerate(dispersions)
        if name in kinds
    ]  # fmt: skip
    return Styles(series, [legend[key] for key in keys if key in legend], spread)


def rows_with(table: pd.DataFrame, kinematics: str) -> pd.DataFrame:
    """Rows of a table with those kinematics."""
    return table[table["kinematics"] == kinematics]


def draw_point(axes: Axes, x: float, y: float, series: Series) -> None:
    """One marker in a condition's style."""
    axes.plot(
        [x], [y], linestyle="none", marker=series.marker, color=series.colour, fillstyle=series.fill,
        markerfacecoloralt="white", clip_on=False, zorder=3,
    )  # fmt: skip


def draw_curve(axes: Axes, x: np.ndarray, y: np.ndarray, series: Series) -> None:
    """A curve with marks at its points (n,) in a condition's style, broken where y is not a number."""
    axes.plot(
        x, y, linestyle=series.line, marker=series.marker, color=series.colour, fillstyle=series.fill,
        markerfacecoloralt="white", clip_on=False, zorder=3,
    )  # fmt: skip


def unknown_errors(scores: pd.DataFrame) -> str:
    """What a caption says of scores without a bar because their error is not known, if there are any."""
    return UNKNOWN if (scores["score"].notna() & scores["score_error"].isna()).any() else ""


def draw_errors(axes: Axes, x: np.ndarray, y: np.ndarray, error: np.ndarray, along: str, colour: str = GREY) -> None:
    """Bars of estimated error (n,) on both sides of points (n,), along the axis "x" or "y"."""
    if along == "x":
        axes.hlines(y, x - error, x + error, color=colour, linewidth=LINE, zorder=2)
    else:
        axes.vlines(x, y - error, y + error, color=colour, linewidth=LINE, zorder=2)


def legend_below(figure: Figure, handles: Sequence[Any], caption: str, below: Sequence[Any] = ()) -> None:
    """Legend under all panels, where it covers nothing, with a caption; both fit the figure's width. It is read row by
    row. below: handles that begin a row of their own where not all fit one.
    """
    width = float(figure.get_size_inches()[0]) * POINTS
    cells, columns = [*handles, *below], len(handles) + len(below)
    if _legend_width(cells, columns) > width:
        columns = max(len(handles), len(below))
        while columns > 1 and _legend_width(_in_rows(handles, below, columns), columns) > width:
            columns -= 1
        cells = _in_rows(handles, below, columns)
    figure.legend(
        handles=[cell for column in range(columns) for cell in cells[column::columns]],  # matplotlib fills columns
        loc="outside lower center",
        ncols=columns,
        title=fitted(figure, caption) or None,
        title_fontproperties={"size": TEXT},
    )


def _in_rows(handles: Sequence[Any], below: Sequence[Any], columns: int) -> list[Any]:
    """Handles in rows of so many columns, with nothing between them and those below, which begin a row."""
    nothing = [Line2D([], [], linestyle="none", label=" ")] * (-len(handles) % columns if below else 0)
    return [*handles, *nothing, *below]


def fitted(figure: Figure, text: str, size: float = TEXT, columns: float = 1.0) -> str:
    """Text broken into lines that fit one of so many columns [1] of a figure at a font size [pt]."""
    characters = int(float(figure.get_size_inches()[0]) * POINTS / columns / (CHARACTER * size))
    return "\n".join(part for line in text.splitlines() for part in wrap(line, characters))


def as_title(figure: Figure, text: str, columns: float = 1.0) -> str:
    """A title, broken into lines that fit one of so many columns [1] of a figure. Dollars in it are no mathematics."""
    return fitted(figure, text, BOLD * TITLE, columns).replace("$", r"\$")


def _legend_width(cells: Sequence[Any], columns: int) -> float:
    """Width [pt] of a legend that fills its rows with handles, one after the other."""
    labels = [len(str(cell.get_label())) for cell in cells]
    return TEXT * sum(HANDLE + CHARACTER * max(labels[column::columns]) for column in range(columns))


def as_points(handles: Iterable[Line2D]) -> list[Line2D]:
    """Legend entries without their lines, for figures that draw points alone."""
    return [
        Line2D([], [], color=h.get_color(), marker=h.get_marker(), fillstyle=h.get_fillstyle(), linestyle="none",
               markerfacecoloralt="white", label=h.get_label())
        for h in handles
    ]  # fmt: skip


def letter(axes: Axes, text: str, offset: tuple[float, float] = LETTER_OFFSET) -> None:
    """Bold letter at a panel's upper left corner."""
    axes.annotate(
        text, (0.0, 1.0), xycoords="axes fraction", xytext=offset, textcoords="offset points",
        fontsize=TITLE + 1.0, fontweight="bold", va="bottom",
    )  # fmt: skip


def note_in(axes: Axes, text: str) -> None:
    """A panel that says why it is empty."""
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", color=GREY, fontsize=TITLE)
    axes.tick_params(left=False, bottom=False, labelleft=False, labelbottom=False)


def face_handle() -> Patch:
    """Legend entry of the shaded faces."""
    return Patch(color=SHADE, label="under a face before the stimulus")


def subtitle(axes: Axes, title: str, text: str) -> None:
    """Bold title, which may be empty, with a line of plain text under it, or two."""
    if title:
        axes.set_title(title + "\n" * (text.count("\n") + 1), loc="left")
    axes.annotate(text, (0.0, 1.0), xycoords="axes fraction", xytext=(0.0, 4.0), textcoords="offset points", color=GREY)
