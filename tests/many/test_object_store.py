"""Stores of ensembles in object stores, through fsspec: they are what a folder is."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import named
import pytest

from seacrane import SceneError, ensemble
from seacrane.ensembles import Ensemble, ensemble_price, merge_parts
from seacrane.ensembles.job import stepped
from seacrane.errors import FileFormatError

HEIGHT: dict[str, Any] = {"keep": {"low": "position[bob, z].min"}, "t_end": 0.2}


@pytest.fixture(params=["memory", "s3"])
def objects(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """The URL of a store in this process, or in an S3 server on loopback."""
    fsspec = pytest.importorskip("fsspec")
    with contextlib.ExitStack() as stack:
        if request.param == "s3":
            pytest.importorskip("s3fs")
            server = pytest.importorskip("moto.server").ThreadedMotoServer(ip_address="127.0.0.1", port=0)
            server.start()
            stack.callback(server.stop)
            monkeypatch.setenv("AWS_ENDPOINT_URL", "http://{}:{}".format(*server.get_host_and_port()))
            for name in ("AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY"):
                monkeypatch.setenv(name, "any")
        files = fsspec.filesystem(request.param)
        files.mkdir("bucket")
        yield f"{request.param}://bucket/storms"
        files.rm("bucket", recursive=True)
        files.clear_instance_cache()  # of the server that is gone


def test_a_store_of_objects_is_a_folder(objects: str, monkeypatch: pytest.MonkeyPatch) -> None:
    given: dict[str, Any] = {"over": {"mass": [1.0, 2.0, 3.0, 4.0, 5.0]}, "pack": 2, **HEIGHT}
    whole = ensemble(named.pendulum, **given)
    assert ensemble_price(named.pendulum, **given, store=objects)
    left = int((Ensemble.load(objects).dataset.failure != "").sum())
    ran: list[int] = []
    monkeypatch.setattr("seacrane.ensembles.job.stepped", counted(ran))
    assert ensemble(named.pendulum, **given, store=objects).dataset.identical(whole.dataset)
    assert len(ran) == left  # what was there is not run again
    assert Ensemble.load(objects).dataset.identical(whole.dataset)
    with pytest.raises(SceneError, match=r"another study.*t_end"):
        ensemble(named.pendulum, **given | {"t_end": 0.3}, store=objects)


def counted(ran: list[int]) -> Any:
    def run(*given: Any) -> Any:
        ran.append(1)
        return stepped(*given)

    return run


def test_parts_of_objects_are_merged(objects: str, tmp_path: Path) -> None:
    given: dict[str, Any] = {"over": {"mass": [1.0, 2.0, 3.0]}, "pack": 1, **HEIGHT}
    for number in (1, 2):
        ensemble(named.pendulum, **given, part=(number, 2), store=f"{objects}/{number}")
    merged = merge_parts([f"{objects}/{number}" for number in (2, 1)], f"{objects}/all")
    assert merged.dataset.identical(ensemble(named.pendulum, **given, store=tmp_path / "here").dataset)


@pytest.mark.parametrize(
    ("store", "message"), [("memory://bucket/none", "is no ensemble"), ("nowhere://bucket", "nowhere")]
)
def test_a_url_that_is_no_store(store: str, message: str) -> None:
    pytest.importorskip("fsspec")
    with pytest.raises((FileFormatError, SceneError), match=message):
        Ensemble.load(store)
