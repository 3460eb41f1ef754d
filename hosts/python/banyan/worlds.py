# SPDX-License-Identifier: MIT
"""A world that you step yourself."""

from __future__ import annotations

import json
import os
import tempfile
from typing import Any, Mapping

import numpy as np

from . import _core
from .recordings import film
from .runs import Scenario, scenario_of


class World(_core.World):
    """A simulated world: step it, read it, copy it, interfere. Thousands live in one process.

    scenario  and the keywords of Scenario
    measure   keep the account of the run: metrics, result(), finished

    Arrays over the N robots; those marked * are the world's own memory, read-only: they show the present after every
    step, cost nothing, and keep the world alive. Copy what you keep.

    positions*, headings*  (N, 2) float64, m; unit vectors
    roles*                 (N,) uint8: spare 0, connector 1, worker 2, root 3
    parents*, old_parents*, serves*, roots*  (N,) int16, -1: nobody (uint16 above 32,767 robots)
    alive*                 (N,) bool
    links                  (L, 2) int32: pairs i < j that hear each other
    targets                (T, 2) float64, m

    step() lets other threads run. A world is for one thread at a time: while it is stepped, calls are refused, and
    its arrays are in motion.
    """

    def __init__(
        self,
        scenario: str | os.PathLike[str] | Mapping[str, Any] | Scenario,
        *,
        algorithm: str | None = None,
        seed: int | None = None,
        parameters: Mapping[str, float] | None = None,
        set: Mapping[str, Any] | None = None,
        with_files: Any = (),
        controller: Any = None,
        controllers: Mapping[str, Any] | None = None,
        measure: bool = False,
    ) -> None:
        keys = dict(
            algorithm=algorithm,
            seed=seed,
            parameters=parameters,
            set=set,
            with_files=with_files,
            controller=controller,
            controllers=controllers,
        )
        made = scenario_of(scenario, keys)
        self._own = made._own
        super().__init__(made._core, measure)

    def copy(self) -> "World":
        """The same world once more, its controllers' memory included. Both go on alike, bit for bit. The copy is
        not measured: measures are about a run from its start."""
        twin = World.__new__(World)
        _core.World.__init__(twin, self)
        twin._own = self._own
        return twin

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> "World":
        return self.copy()

    @property
    def scenario(self) -> Scenario:
        """With all interventions so far as events: a world made of it comes to the same state."""
        return Scenario._of(self.core_scenario, self._own)

    def intervene(self, kind: str, **keys: Any) -> None:
        """An event of a scenario, now: intervene("kill", of="root"), intervene("set_loss", loss=0.3),
        intervene("move_target", target=0, position_m=[3, 1]). docs/scenarios.md lists them."""
        for key in ("time_s", "when"):
            if key in keys:
                raise _core.ScenarioError(f"{key}: an intervention happens now")
        self.intervene_json(json.dumps({"kind": kind, **keys}, default=lambda value: value.tolist()))

    @property
    def metrics(self) -> dict[str, Any]:
        """Of the last tick (measure=True); the columns of a series."""
        return self.metrics_row()

    def result(self) -> dict[str, Any]:
        """The row of the run so far (measure=True)."""
        return self.result_row()

    def message(self, robot: int) -> dict[str, Any]:
        """All fields of what a robot broadcast last."""
        return json.loads(self.message_json(robot))

    @property
    def edges(self) -> np.ndarray:
        """(E, 2): each robot that has a parent, and the parent."""
        children = np.flatnonzero(self.parents != (-1 if self.parents.dtype == np.int16 else 65535))
        return np.stack([children, self.parents[children]], axis=-1)

    def film(self, path: str | os.PathLike[str], *, until_s: float | None = None, **look: Any) -> str:
        """What a copy of this world does from now on, to the end of its mission or to `until_s`, as a film."""
        with tempfile.TemporaryDirectory() as folder:
            recording = os.path.join(folder, "run.mcap")
            self.copy().record(recording, float("inf") if until_s is None else float(until_s))
            return film(recording, path, **look)

    def __repr__(self) -> str:
        scenario = self.core_scenario
        return f"<banyan.World {scenario.name}: {len(self)} robots, {scenario.algorithm}, {self.time_s:g} s>"

    def _repr_svg_(self) -> str:
        return self.svg()
