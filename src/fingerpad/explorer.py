"""Sliders for a design in a notebook: every change draws pressure, receptor strain and scores again."""

from __future__ import annotations

from functools import lru_cache
from html import escape
from math import floor, log10
from time import perf_counter, process_time
from typing import Any

import ipywidgets
from threadpoolctl import threadpool_limits

from .errors import ContactError, FingerpadError
from .figures.design import DesignPicture
from .prediction.design import Answer, Pad, PressedRow, answer, condense_pad, pins_at_rest, press_row
from .scene.scene import Model

PINS, EDGE_RADIUS = 4, 0.1  # number [1] and edges [mm] of a row's pins; Device 2
# smallest, largest value and step of each slider, in the unit that its label names
LIMITS = {
    "pitch": (1.4, 3.0, 0.1),
    "width": (0.4, 1.2, 0.1),
    "friction": (0.0, 1.0, 0.05),
    "phase": (0.0, 180.0, 15.0),
    "amplitude": (0.005, 0.05, 0.005),
}
LABELS = {
    "pitch": "pitch [mm]",
    "width": "pin width [mm]",
    "friction": "friction [1]",
    "phase": "phase [°]",
    "amplitude": "amplitude [mm]",
}
START = {"pitch": 2.5, "width": 1.0, "friction": 0.6, "phase": 180.0, "amplitude": 0.02}  # Device 2
STYLE = {"description_width": "9em"}  # of controls: labels are whole
LAYOUT = {"width": "29em"}  # of controls: two are as wide as the picture
ROWS = 3  # of controls: what a pin is, and how it moves; a laptop shows them and the picture at once
KEPT = 32  # pressed rows that are remembered [1]: moving a slider back takes no time


def explored_pad(model: Model) -> Pad:
    """A finger condensed to all skin under any row that the sliders allow. Raises SceneError, MeshError,
    CondensationError.
    """
    scene = pins_at_rest(model, PINS, START["pitch"], START["width"], EDGE_RADIUS)
    return condense_pad(scene, (PINS - 1) / 2.0 * LIMITS["pitch"][1] + LIMITS["width"][1] / 2.0)


class Explorer:
    """Sliders, picture and message; `view` shows them. The answer that is shown stands, in grey, beside the next.

    seconds, processor_seconds: of the last redrawing, by the clock and of this process.
    """

    def __init__(self, pad: Pad) -> None:
        self._pressed = lru_cache(maxsize=KEPT)(lambda *row: press_row(pad, *row))
        self._drawing = DesignPicture(len(pad.scene.device.actuators.positions))
        self._shown: Answer | None = None
        self.seconds = self.processor_seconds = 0.0
        self.sliders: dict[str, Any] = {
            name: ipywidgets.FloatSlider(
                value=START[name], min=low, max=high, step=step, description=LABELS[name], continuous_update=False,
                readout_format=f".{max(0, -floor(log10(step)))}f", style=STYLE, layout=LAYOUT,
            )
            for name, (low, high, step) in LIMITS.items()
        }  # fmt: skip
        self.direction: Any = ipywidgets.Dropdown(
            options=["lateral", "normal"], description="motion", style=STYLE, layout=LAYOUT
        )
        self.picture: Any = ipywidgets.Image(format="png", layout={"align_self": "flex-start"})  # in its own size
        self.message: Any = ipywidgets.HTML()
        controls = [*self.sliders.values(), self.direction]
        columns = [ipywidgets.VBox(controls[:ROWS]), ipywidgets.VBox(controls[ROWS:])]
        self.view: Any = ipywidgets.VBox([ipywidgets.HBox(columns), self.message, self.picture])
        for control in controls:
            control.observe(lambda _: self.redraw(), names="value")
        self.redraw()

    def redraw(self) -> None:
        """Answer the design that the sliders show and draw it; a message tells its caveats, or why it has no answer."""
        start, processor_start = perf_counter(), process_time()
        values = {name: slider.value for name, slider in self.sliders.items()}
        try:
            with threadpool_limits(1):  # two threads take longer (decision 14), and results depend on their number
                found = self._answer(**values)
        except FingerpadError as error:
            self.message.value = f"No answer: {escape(str(error))}. The picture is that of the previous design."
        else:
            self._drawing.show(found, self._shown)
            self.picture.value = self._drawing.png()
            self._shown = found
            told = {"Errors are unknown": found.unknown, "Beware": found.rows[0]["note"]}
            self.message.value = " ".join(f"{what}: {escape(why)}." for what, why in told.items() if why)
        self.seconds, self.processor_seconds = perf_counter() - start, process_time() - processor_start

    def _answer(self, pitch: float, width: float, friction: float, phase: float, amplitude: float) -> Answer:
        pressed: tuple[PressedRow, PressedRow | ContactError] = self._pressed(pitch, width, friction)
        return answer(pressed, amplitude, phase, self.direction.value == "lateral")
