"""required(): each choice of modelling left out or made simpler, one at a time."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial, reduce
from typing import Any

import numpy as np

from seacrane._core import State
from seacrane.answers.choices import Choice, choices_of, missing_from
from seacrane.answers.requirements import Loss, Requirements
from seacrane.description.channels import unit_of
from seacrane.description.given import given_vessels
from seacrane.description.suspension import hung_loads
from seacrane.ensembles.kept import Kept
from seacrane.errors import SceneError, SeacraneError
from seacrane.inputs.caller import silently
from seacrane.inputs.checked import positive_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.result import Result
from seacrane.run.method import Method, Start, settled
from seacrane.run.outputs import Outputs
from seacrane.run.stage import Stage
from seacrane.scene.scene import Scene
from seacrane.simulation import simulate

Ask = Callable[[Any], float]
Run = Callable[[Scene], Any]


def usual(scene: Scene) -> dict[str, Any]:
    """The peak of each hook load, the heave of each load and the roll of a vessel."""
    out: dict[str, Any] = {}
    for hung in hung_loads(scene):
        one = hung.suspension
        if one.channel == one.name:
            out[f"hook_load[{one.name}].max"] = f"hook_load[{one.name}].max"
        else:
            out[f"hook load of {one.name}, N"] = partial(_lower_end, load=hung.load)
        out[f"position[{hung.load}, z].std"] = f"position[{hung.load}, z].std"
    if len(scene.vessels) == 1 and not given_vessels(scene):
        out["roll.std"] = "roll.std"
    return out


def _lower_end(result: Any, load: str) -> float:
    """The peak at the lower end of a line with mass, in however many segments."""
    names = [hung.suspension.channel for hung in hung_loads(result.scene) if hung.load == load]
    text = f"hook_load[{names[0]}].max"
    return _single(text, Kept.of_text(text))(result)


def asked(scene: Scene, keep: Mapping[str, Any] | None) -> tuple[dict[str, Ask], dict[str, str]]:
    """The functions that give the numbers that are asked, or the usual ones, and their units, by name."""
    found = usual(scene) if keep is None else keep
    if keep is None and not found:
        raise SceneError(
            f'required: nothing hangs or floats in scene {scene.name!r}; give keep={{"z": '
            '"position[<body>, z].max"}'
        )
    if not isinstance(found, Mapping) or not found:
        raise SceneError(f'required: keep is {shown(found)}; give {{"peak": "hook_load.max"}}')
    asks, units = {}, {}
    for name, what in found.items():
        kept = Kept.of_text(what) if isinstance(what, str) else what
        if isinstance(kept, Kept):
            asks[name], units[name] = _single(name, kept), unit_of(kept.channel, kept.names.values())
        elif callable(kept):
            asks[name], units[name] = kept, ""
        else:
            raise SceneError(f'required: {name!r} is {shown(what)}; give a text such as "hook_load.max"')
    return asks, units


def _single(name: str, kept: Kept) -> Ask:
    if kept.what == "series":
        raise SceneError(f"required: {name!r} is a series; ask for one number of it, such as its .max")

    def ask(result: Any) -> float:
        found = kept.of(result)
        values = found.values
        if values.size != 1:
            names = ", ".join(str(one) for along in found.coords.values() for one in along)
            raise SceneError(
                f"required: {name!r} is {values.size} numbers of a run, of {names}; ask for one of them"
            )
        return float(values.reshape(-1)[0])

    return ask


@dataclass(frozen=True, kw_only=True)
class Told:
    """What one run says, and its cost."""

    values: Mapping[str, float]  # by the name of what is asked
    cpu_s: float  # processor time, s
    evaluations: int  # of the equations of motion; 0 where what was run does not count them


@dataclass(kw_only=True)
class Bench:
    """Runs scenes and counts what that costs."""

    run: Run  # what is done with a scene
    asked: Mapping[str, Ask]  # numbers of what it returns
    runs: int = 0  # made by now

    def told(self, scene: Scene, run: Run | None = None) -> Told:
        """Of one run; what it warns of was told for the scene as it stands, or is a row's own."""
        with silently():
            begun = time.process_time()
            found = (self.run if run is None else run)(scene)
            cpu = time.process_time() - begun
        self.runs += 1
        if isinstance(found, Result) and found.interrupted:
            raise KeyboardInterrupt
        values = {name: self._number(name, ask, found) for name, ask in self.asked.items()}
        evaluations = int(found.stats["evaluations"]) if isinstance(found, Result) else 0
        return Told(values=values, cpu_s=cpu, evaluations=evaluations)

    def _number(self, name: str, ask: Ask, found: Any) -> float:
        try:
            value = float(ask(found))
        except KeyError as error:  # the part went with which the channel came
            raise SceneError(f"required: {name!r} is gone: {error.args[0]}") from error
        if not np.isfinite(value):
            raise SceneError(f"required: {name!r} is {value:g}; ask for a number that the scene has")
        return value

    def beside(self, full: Scene, other: Scene, times: int) -> tuple[Told, list[float], float]:
        """What the other says, its costs over the full one's in runs by turns, and the last one's share
        of evaluations.

        The first run of the other is not timed: it compiles, finds its rest, and tells whether it runs.
        """
        first = self.told(other)
        shares = []
        for _ in range(times):
            one, two = self.told(full), self.told(other)
            shares.append(two.cpu_s / max(one.cpu_s, 1e-9))
            counted = two.evaluations / one.evaluations if one.evaluations else np.nan
        return first, shares, counted


TIGHTER = 1e-2  # times the tolerance, of the run that tells how well the numbers are known
SHORTER = 0.5  # times the step, likewise
TWICE = 2.0  # both of two runs err
SAVES = 0.03  # share of the cost that is worth a choice


@named
def required(
    scene: Scene,
    t_end: float = 100.0,
    *,
    stages: Sequence[Stage] = (),
    start: Start | Callable[[Scene], State] = None,
    method: Method | None = None,
    outputs: Outputs | None = None,
    keep: Mapping[str, Any] | None = None,
    within: float | Mapping[str, float] = 0.01,
    run: Callable[[Scene], Any] | None = None,
    choices: Iterable[Choice] | None = None,
    repeats: int = 2,
    progress: bool = False,
    **shorthand: Any,
) -> Requirements:
    """What a scene requires: what each choice of modelling costs, and what leaving it out would change.

    Each choice is made simpler by itself (slings and block as one with the load, the rungs of lines, wave
    components, fluid memory, coupling of vessels, damping, waves of parts in water, oil, controlled drives,
    contacts), run beside the scene as it stands by turns, and told with its share of the processor time and
    the change of the numbers that are asked. What saves most, and whose changes together stay within what is
    asked, is then run as one set. What the scene leaves out, and would matter, is run likewise.

    Parameters
    ----------
    scene : Scene
    t_end, stages, start, method, outputs, **shorthand
        As of `simulate`. `start` may be a function of the scene, as of
        `ensemble`: what leaves states out does not run from the state of the scene as it stands.
    keep : mapping, optional
        Single numbers of a run by name, as of `ensemble`: ``{"peak": "hook_load.max"}``, or functions of the
        result. Default: the largest hook load, the scatter of each load's height, and of roll.
    within : float or mapping of str to float
        Largest change that is accepted: a share of each number (0.01), or by name, in its unit.
    run : callable, optional
        In place of a simulation: from a scene to what `keep` takes its numbers from, such as
        ``lambda scene: allowable_hs(scene, ...)``.
    choices : iterable of Choice, optional
        To try; default: `seacrane.answers.choices_of` the scene.
    repeats : int
        Timed runs of each, by turns with the scene as it stands.
    progress : bool
        Tell the price beforehand, and show a progress bar.

    Returns
    -------
    Requirements
        Prints as a table, with the least set and its lines of script.

    Raises
    ------
    SceneError
        For what is asked and is no single number, limits that are none, and a scene that does not run.
    """
    from tqdm.auto import tqdm

    asks, units = asked(scene, keep)
    method, outputs = settled(method, outputs, shorthand)
    begun = time.process_time()

    def simulated(other: Scene, by: Method = method) -> Any:
        own = start(other) if callable(start) else start
        return simulate(other, stages or t_end, start=own, method=by, outputs=outputs)

    bench = Bench(run=run or simulated, asked=asks)
    cold, full = bench.told(scene), bench.told(scene)  # what is found of a scene once belongs to no choice
    tight = None if run is not None else bench.told(scene, partial(simulated, by=tighter(method)))
    limits = _limits(within, full.values)
    tried = choices_of(scene) if choices is None else list(choices)
    missing = missing_from(scene)
    count = len(tried) + len(missing)
    price = count * cold.cpu_s + (2 * repeats * (len(tried) + 1) + len(missing) + 4) * full.cpu_s
    if progress:
        tqdm.write(f"required: takes about {price:.2g} s of CPU, fits of a memory aside", file=sys.stderr)
    with tqdm(total=count, desc="required", unit="row", disable=not progress) as bar:
        tick = bar.update
        rows = [_row(bench, scene, full, choice, repeats, tick) for choice in tried]
        lacks = [_row(bench, scene, full, choice, 0, tick) for choice in missing]
        noise = {
            name: math.nan if tight is None else TWICE * abs(tight.values[name] - value)
            for name, value in full.values.items()
        }
        chosen = least_of(rows, limits, noise)
        least, taken = _run_together(bench, scene, full, chosen, limits, repeats)
    return Requirements(
        scene=scene.name, full=full.values, units=units, limits=limits, noise=noise, cpu_s=full.cpu_s,
        rows=tuple(rows), missing=tuple(lacks), least=least, taken=tuple(taken), told_s=price,
        took_s=time.process_time() - begun, runs=bench.runs,
    )  # fmt: skip


def tighter(method: Method) -> Method:
    """The same method at a far smaller tolerance or step."""
    if method.dt is not None:
        return replace(method, dt=SHORTER * method.dt)
    return replace(method, rtol=TIGHTER * (1e-6 if method.rtol is None else method.rtol))


def _limits(within: float | Mapping[str, float], values: Mapping[str, float]) -> dict[str, float]:
    """Largest change of each number, in its unit; one that is not named has none."""
    if not isinstance(within, Mapping):
        share = positive_of("required: within", within)
        return {name: share * abs(value) for name, value in values.items()}
    for name in within:
        if name not in values:
            raise SceneError(f"required: within has {name!r}, which is not asked; {', '.join(values)} are")
    return {name: positive_of(f"required: within: {name}", limit) for name, limit in within.items()}


def _row(
    bench: Bench, scene: Scene, full: Told, choice: Choice, repeats: int, tick: Callable[[], Any]
) -> Loss:
    """Of one choice; what does not run is a row that says why."""
    row = Loss(name=choice.name, script=choice.script, of=choice.of, choice=choice)
    try:
        made = choice.made(scene)
        if repeats:
            told, shares, counted = bench.beside(scene, made, repeats)
            row = replace(row, shares=tuple(shares), evaluations=counted)
        else:
            told = bench.told(made)
            row = replace(row, shares=(bench.told(made).cpu_s / max(full.cpu_s, 1e-9),))
    except (SeacraneError, ValueError) as error:
        text = " ".join(str(error).split())
        kind = "" if isinstance(error, SeacraneError) else f"{type(error).__name__}: "
        return replace(row, message=f"{kind}{text}")
    finally:
        tick()
    return replace(row, changes={name: told.values[name] - value for name, value in full.values.items()})


def _run_together(
    bench: Bench, scene: Scene, full: Told, chosen: Sequence[Loss], limits: Mapping[str, float], repeats: int
) -> tuple[Loss | None, Sequence[Loss]]:
    """The chosen set, run against the full scene; what changes most goes while it is beyond a limit."""
    taken = list(chosen)
    while taken:
        both = Choice(
            name="all of these", script="\n".join(one.script for one in taken), of="",
            made=partial(reduce, lambda made, one: one.choice.made(made), tuple(taken)),
        )  # fmt: skip
        row = _row(bench, scene, full, both, repeats, lambda: None)
        if row.stable and all(abs(row.changes[name]) <= limit for name, limit in limits.items()):
            return (row, taken) if row.share < 1.0 - SAVES else (None, ())
        taken.remove(max(taken, key=lambda one: max(one.used(*limit) for limit in limits.items())))
    return None, ()


def least_of(rows: Sequence[Loss], limits: Mapping[str, float], noise: Mapping[str, float]) -> list[Loss]:
    """What saves most, one about each thing, as long as the sizes of changes together keep the limits."""
    taken: dict[str, Loss] = {}
    used = dict.fromkeys(limits, 0.0)
    for row in sorted((one for one in rows if one.stable), key=lambda one: one.share):
        more = {name: used[name] + row.used(name, limits[name], noise.get(name, 0.0)) for name in limits}
        saves = row.share < 1.0 - max(SAVES, row.spread)
        if saves and row.of not in taken and all(share <= 1.0 for share in more.values()):
            taken[row.of], used = row, more
    return [*taken.values()]
