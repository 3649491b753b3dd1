"""required(): each choice of modelling left out or made simpler, one at a time."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import partial, reduce
from typing import Any

from seacrane._core import State
from seacrane.errors import SceneError, SeacraneError
from seacrane.inputs.checked import positive_of
from seacrane.inputs.keywords import named
from seacrane.needs.answer import Loss, Requirements
from seacrane.needs.bench import Bench, Told, asked
from seacrane.needs.choices import Choice, choices_of, missing_from
from seacrane.run.method import Method, Start, settled
from seacrane.run.outputs import Outputs
from seacrane.run.stage import Stage
from seacrane.scene.scene import Scene
from seacrane.simulation import simulate

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
    contacts), run beside the scene as it stands by turns, and told with its share of
    the processor time and the change of the numbers that are asked. The cheapest set whose changes together
    stay within what is asked is then run once. What the scene leaves out, and would matter, is run likewise.

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
        To try; default: `seacrane.needs.choices_of` the scene.
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
    with _bar(progress, price, count) as tick:
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
    bench: Bench, scene: Scene, full: Told, choice: Choice, repeats: int, tick: Callable[[], None]
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


@contextmanager
def _bar(progress: bool, price: float, rows: int) -> Iterator[Callable[[], None]]:
    """The price, then a bar; nothing where no progress is asked."""
    if not progress:
        yield lambda: None
        return
    from tqdm.auto import tqdm

    tqdm.write(f"required: takes about {price:.2g} s of CPU, fits of a memory aside", file=sys.stderr)
    with tqdm(total=rows, desc="required", unit="row") as bar:
        yield lambda: bar.update() and None


def least_of(rows: Sequence[Loss], limits: Mapping[str, float], noise: Mapping[str, float]) -> list[Loss]:
    """Of the choices about one thing at most one; changes add by their sizes, costs multiply."""
    about: dict[str, list[tuple[float, dict[str, float], Loss]]] = {}
    for row in rows:
        if row.stable and row.share < 1.0 - max(SAVES, row.spread):
            used = {name: row.used(name, limit, noise.get(name, 0.0)) for name, limit in limits.items()}
            about.setdefault(row.of, []).append((-math.log(row.share), used, row))
    most = {of: max(saved for saved, _, _ in group) for of, group in about.items()}
    groups = sorted(about, key=lambda of: -most[of])
    ahead = [sum(most[of] for of in groups[i:]) for i in range(len(groups) + 1)]
    best: tuple[float, list[Loss]] = (0.0, [])

    def look(at: int, saved: float, taken: list[Loss], used: dict[str, float]) -> None:
        nonlocal best
        if saved > best[0]:
            best = (saved, taken)
        if at == len(groups) or saved + ahead[at] <= best[0]:
            return
        for own, takes, row in about[groups[at]]:
            more = {name: used[name] + takes[name] for name in limits}
            if all(share <= 1.0 for share in more.values()):
                look(at + 1, saved + own, [*taken, row], more)
        look(at + 1, saved, taken, used)

    look(0, 0.0, [], dict.fromkeys(limits, 0.0))
    return best[1]
