"""Stores of the parts of an ensemble made into one, which is that of one run to the bit."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from seacrane.ensembles.ensemble import Ensemble
from seacrane.ensembles.growing import growth_in, members_in
from seacrane.ensembles.object_store import claimed_store, opened_store
from seacrane.ensembles.parts import ENGINE, KNOWN, PART, Part, part_of
from seacrane.ensembles.store import Folder
from seacrane.ensembles.study_folder import study_in
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.keywords import named

VERSION = "version"


@named
def merge_parts(parts: Sequence[str | os.PathLike[str]], store: str | os.PathLike[str]) -> Ensemble:
    """Make one store of those of all parts of an ensemble, in any order.

    It is, to the bit, the store of one run, and the same ensemble without `part` goes on with it.

    Parameters
    ----------
    parts : sequence of path
        The stores of ``ensemble(part=(1, n), store=...)`` to ``part=(n, n)``.
    store : path
        The folder to be written. A call that was killed goes on.

    Returns
    -------
    Ensemble

    Raises
    ------
    SceneError
        For a part that is missing, not complete, or there twice, for one of another study, or one that was
        run by another engine; nothing is written then.
    FileFormatError
        For a folder that is no store, or damaged.
    OSError
        If the store cannot be written.
    """
    if isinstance(parts, str | os.PathLike) or not parts:
        raise SceneError("merge: no parts are given; give the folders of all of them")
    folders = [str(one) for one in parts]
    stores = [opened_store(one) for one in parts]
    data = [study_in(one.path) for one in stores]
    numbered = [_part_in(folder, one) for folder, one in zip(folders, data, strict=True)]
    for folder, one in zip(folders, data, strict=True):
        _require_alike(folders[0], data[0]["identity"], folder, one["identity"])
    _require_all(folders, numbered)
    packs = (_grown if "growth" in data[0] else _packs)(folders, stores, numbered, data)
    identity = {name: told for name, told in data[0]["identity"].items() if name not in (PART, ENGINE)}
    of_all = {name: told for name, told in data[0].items() if name != KNOWN} | {"identity": identity}
    with claimed_store(store, of_all) as whole:
        for number, part in sorted(packs.items()):
            whole[number] = part[number]
    return Ensemble.load(store)


def _part_in(folder: str, data: Mapping[str, Any]) -> Part:
    identity = data.get("identity")
    if not isinstance(identity, dict) or PART not in identity:
        raise SceneError(f"merge: {folder} is no part of an ensemble; give folders that were run as parts")
    return part_of(identity[PART])


def _require_alike(first: str, known: Mapping[str, Any], folder: str, identity: Mapping[str, Any]) -> None:
    other = [name for name in {**known, **identity} if name != PART and known.get(name) != identity.get(name)]
    if not other:
        return
    ran = [name for name in (ENGINE, VERSION) if name in other]
    name = (ran or other)[0]
    told = f"{str(identity.get(name))[:200]} there, {str(known.get(name))[:200]} in {first}"
    if ran:
        raise SceneError(f"merge: {folder} was run by another engine ({told}); run its part on the same kind")
    raise SceneError(
        f"merge: {folder} is of another study than {first}: {', '.join(other)} differ ({name}: {told})"
    )


def _require_all(folders: Sequence[str], numbered: Sequence[Part]) -> None:
    """Raise SceneError where a part is there twice, or missing."""
    first = numbered[0]
    for place, (folder, part) in enumerate(zip(folders, numbered, strict=True)):
        if part.of != first.of:
            raise SceneError(f"merge: {folders[0]} is part {first}, {folder} is part {part}; parts overlap")
        earlier = numbered.index(part)
        if earlier < place:
            raise SceneError(
                f"merge: part {part} is there twice, in {folders[earlier]} and {folder}; leave one out"
            )
    missing = sorted({*range(1, first.of + 1)} - {part.number for part in numbered})
    if missing:
        told = ", ".join(f"{number}/{first.of}" for number in missing[:12]) + ", ..." * (len(missing) > 12)
        raise SceneError(f"merge: {len(missing)} of {first.of} parts are missing: {told}; run them first")


def _packs(
    folders: Sequence[str], stores: Sequence[Folder], numbered: Sequence[Part],
    data: Sequence[Mapping[str, Any]],
) -> dict[int, Folder]:  # fmt: skip
    """Where each pack is; raises SceneError where one is missing, or a member is not there once."""
    members, size = members_in(stores[0], data[0]), data[0]["identity"].get("members in a pack")
    if type(size) is not int or size < 1:
        raise FileFormatError(f"{folders[0]}: its study tells no members in a pack")
    packs: dict[int, Folder] = {}
    seen = Counter[int]()
    for folder, store, part in zip(folders, stores, numbered, strict=True):
        own = part.numbers(-(-len(members) // size))
        _require_there(folder, store, part, own)
        packs |= dict.fromkeys(own, store)
        seen.update(one.index for number in own for one in store[number])
    if seen != Counter(range(len(members))):
        raise FileFormatError("merge: the packs do not hold each member once; run the damaged part anew")
    return packs


def _grown(
    folders: Sequence[str], stores: Sequence[Folder], numbered: Sequence[Part],
    data: Sequence[Mapping[str, Any]],
) -> dict[int, Folder]:  # fmt: skip
    """As `_packs`, of an ensemble that grows: of each cell whole batches, until it is known."""
    known: list[Any] = [one.get(KNOWN) for one in data]
    packs: dict[int, Folder] = {}
    for folder, store, part, one, told in zip(folders, stores, numbered, data, known, strict=True):
        if told is None:
            raise SceneError(
                f"merge: part {part} in {folder} is not complete, not all of its cells are known; give the "
                "same command again, which goes on with it"
            )
        if any(told[name] != known[0][name] for name in ("until", "seeds")):
            raise SceneError(
                f"merge: {folder} has grown until {told['until']} of {told['seeds']} seeds, and "
                f"{folders[0]} until {known[0]['until']} of {known[0]['seeds']}; run both with the same"
            )
        growth = growth_in(store, one, told["seeds"])
        assert growth is not None
        there, expected = {*store}, dict[int, Sequence[int]]()
        for cell in part.numbers(growth.cells, "cells"):
            batch = 0
            while batch < growth.batches and there & (own := growth.packs(batch, cell)).keys():
                expected |= own
                batch += 1
        _require_there(folder, store, part, expected)
        held = {number: [one.index for one in store[number]] for number in store}
        if held != {number: [*own] for number, own in expected.items()} or len(held) != told["packs"]:
            raise FileFormatError(f"merge: {folder} holds other members than part {part}; run it anew")
        packs |= dict.fromkeys(expected, store)
    return packs


def _require_there(folder: str, store: Folder, part: Part, own: Collection[int]) -> None:
    """Raise SceneError where a pack of a part is missing."""
    left = {*own} - {*store}
    if left:
        raise SceneError(
            f"merge: part {part} in {folder} is not complete, {len(left)} of its {len(own)} packs are "
            "missing; give the same command again, which goes on with it"
        )
