"""Which objects an INPUT names: folders with links in circles, odd names, patterns, tables, ids."""

from __future__ import annotations

import errno
import gzip
import json
import os
from pathlib import Path
from urllib.error import ContentTooShortError, URLError

import pytest

from anymesh.applications.annotate.inputs import ObjectRequest, find_objects, object_folder
from anymesh.applications.annotate.objaverse_ import HubError, fetch
from anymesh.applications.annotate.states import Result
from anymesh.applications.annotate.work import failure
from anymesh.errors import InputError, OptionError

ODD = [
    "a b.glb", "Tür 扉 🚪.glb", "it's \"quoted\".glb", "two\nlines.glb", "tab\t.glb", "-rf.glb", ".hidden.glb", "%2e%2e.glb",
    "semi;colon&|`$(x).glb", "x" * 251 + ".glb", "<b>bold.glb", "a\\b.glb",
]  # fmt: skip


def found(source: object, without: Path = Path("/nonexistent")) -> list[ObjectRequest]:
    return list(find_objects(str(source), without=without))


def names(source: object) -> list[str]:
    return [r.name for r in found(source)]


def test_odd_names_stay_and_their_folders_are_legal_everywhere_and_differ(tmp_path) -> None:
    for name in ODD:
        (tmp_path / name).write_text("x")
    requests = found(tmp_path)
    assert sorted(r.name for r in requests) == sorted(ODD)
    assert all(Path(r.source).read_text() == "x" for r in requests)
    folders = [r.folder for r in requests]
    assert len({f.lower() for f in folders}) == len(ODD)
    assert all(set(f) <= set("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-/") for f in folders)
    assert max(map(len, folders)) < 90


def test_a_path_of_thousands_of_characters(tmp_path) -> None:
    deep = tmp_path.joinpath(*["d" * 200] * 6)
    deep.mkdir(parents=True)
    (deep / "a.glb").write_text("x")
    (request,) = found(tmp_path)
    assert len(request.name) > 1200
    assert len(request.folder) < 90


def test_a_name_that_is_no_text_is_refused_alone(tmp_path) -> None:
    (tmp_path / "good.glb").write_text("x")
    try:
        Path(os.fsdecode(os.fsencode(tmp_path) + b"/bad\xff.glb")).write_text("x")
    except OSError:
        pytest.skip("this file system takes only UTF-8")
    bad, good = found(tmp_path)
    assert "not valid UTF-8" in bad.refusal
    assert bad.name == "bad\\xff.glb"
    assert not good.refusal


def test_links_in_a_circle_are_read_once_and_links_elsewhere_are_followed(tmp_path) -> None:
    (tmp_path / "in" / "a" / "b").mkdir(parents=True)
    (tmp_path / "other").mkdir()
    (tmp_path / "in" / "a" / "x.glb").write_text("x")
    (tmp_path / "other" / "y.glb").write_text("y")
    (tmp_path / "in" / "a" / "b" / "up").symlink_to(tmp_path / "in")
    (tmp_path / "in" / "self").symlink_to("self")
    (tmp_path / "in" / "linked").symlink_to(tmp_path / "other")
    (tmp_path / "in" / "gone.glb").symlink_to("nowhere.glb")
    assert names(tmp_path / "in") == ["a/x.glb", "linked/y.glb"]
    assert names(f"{tmp_path}/in/**/*.glb") == ["a/x.glb", "linked/y.glb"]


def test_patterns(tmp_path) -> None:
    for name in ("a.glb", "b.obj", "c1.glb", "sub/d.glb", "sub/deep/e.glb", "f[1].glb"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("x")
    assert names(f"{tmp_path}/*.glb") == ["a.glb", "c1.glb", "f[1].glb"]
    assert names(f"{tmp_path}/*/*.glb") == ["sub/d.glb"]
    assert names(f"{tmp_path}/**/*.glb") == ["a.glb", "c1.glb", "f[1].glb", "sub/d.glb", "sub/deep/e.glb"]
    assert names(f"{tmp_path}/**") == ["a.glb", "b.obj", "c1.glb", "f[1].glb", "sub/d.glb", "sub/deep/e.glb"]
    assert names(f"{tmp_path}/[!a-b]?.glb") == ["c1.glb"]
    assert names(f"{tmp_path}/f[[]1].glb") == ["f[1].glb"]
    with pytest.raises(InputError, match="where the pattern"):
        found(f"{tmp_path}/none/*.glb")


def test_what_holds_nothing_is_one_error(tmp_path) -> None:
    with pytest.raises(InputError, match="holds no object"):
        found(tmp_path)
    with pytest.raises(InputError, match="valid are a folder, a pattern, a table"):
        found(tmp_path / "none")


def test_a_table_gives_each_object_its_options(tmp_path, caplog) -> None:
    (tmp_path / "m").mkdir()
    (tmp_path / "m" / "a.glb").write_text("x")
    text = 'path,name,scale,seed,note\nm/a.glb,"first\nobject",0.5:z,3,hello\nm/a.glb,second,,,\nm/gone.glb,,,,\n'
    (tmp_path / "list.csv").write_text(text)
    first, second, gone = found(tmp_path / "list.csv")
    assert (first.name, dict(first.options)) == ("first\nobject", {"scale": "0.5:z", "seed": 3})
    assert (second.name, dict(second.options), second.size) == ("second", {}, 1)
    assert "cannot be opened" in gone.refusal
    assert "the columns note are ignored" in caplog.text


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("file\na.glb\n", "must be `path` or `uid`"),
        ("path,seed\na.glb,many\n", "row 2: found seed 'many'; valid is an integer"),
        ("path,name\n,x\n", "neither a path nor a uid"),
        ("path\n\xff\n", "not a valid CSV table in UTF-8"),
        ("path\n" + "x" * 200_000 + "\n", "not a valid CSV"),
    ],
)
def test_a_table_that_is_not_valid_is_one_error(tmp_path, text, told) -> None:
    (tmp_path / "list.csv").write_bytes(text.encode("latin-1"))
    with pytest.raises(InputError, match=told):
        found(tmp_path / "list.csv")


def test_a_parquet_table_is_read_as_a_csv_is(tmp_path) -> None:
    arrow = pytest.importorskip("pyarrow")
    import pyarrow.parquet

    (tmp_path / "a.glb").write_text("x")
    table = arrow.table({"path": ["a.glb", "b.glb"], "seed": [4, None], "category": [None, "fridge"]})
    pyarrow.parquet.write_table(table, tmp_path / "list.parquet")
    first, second = found(tmp_path / "list.parquet")
    assert (first.size, dict(first.options), dict(second.options)) == (1, {"seed": 4}, {"category": "fridge"})
    (tmp_path / "bad.parquet").write_bytes(b"PAR1 not")
    with pytest.raises(InputError, match="not a valid Parquet"):
        found(tmp_path / "bad.parquet")


def test_ids_of_objaverse(tmp_path) -> None:
    ids = ["0" * 32, "a" * 32]
    assert [r.source for r in found(f"objaverse:{ids[0]},{ids[1]},{ids[0]}")] == [f"objaverse:{i}" for i in ids]
    (tmp_path / "ids.txt").write_text("\n".join(ids) + "\n")
    assert names(f"objaverse:{tmp_path / 'ids.txt'}") == ids
    with pytest.raises(OptionError, match="32 hexadecimal digits"):
        found("objaverse:../../etc/passwd")


def test_folders_hang_on_the_name_alone() -> None:
    assert object_folder("a/b c.glb") == object_folder("a/b c.glb") != object_folder("b c.glb")


UID, OTHER = "0" * 32, "f" * 32
INDEX = {UID: f"glbs/000-000/{UID}.glb", OTHER: "../../../secret.glb"}


class Hub:
    """The hub, in the place of the network: what it does with each address in turn, else the whole file."""

    def __init__(self) -> None:
        self.turns: list[Exception | bytes] = []
        self.asked = 0

    def urlretrieve(self, address: str, path: str) -> None:
        self.asked += 1
        turn = self.turns.pop(0) if self.turns else None
        if isinstance(turn, Exception):
            raise turn
        whole = gzip.compress(json.dumps(INDEX).encode()) if "object-paths" in address else b"glTF whole"
        Path(path).write_bytes(whole if turn is None else turn)


@pytest.fixture
def hub(tmp_path, monkeypatch) -> Hub:
    objaverse, made = pytest.importorskip("objaverse"), Hub()
    monkeypatch.setattr(objaverse, "_VERSIONED_PATH", str(tmp_path / "hub"))
    monkeypatch.setattr(objaverse.urllib.request, "urlretrieve", made.urlretrieve)
    return made


def test_a_mesh_is_fetched_once(hub) -> None:
    assert fetch(UID).read_bytes() == b"glTF whole"
    assert fetch(UID).read_bytes() == b"glTF whole"
    assert hub.asked == 2  # the index and the mesh


@pytest.mark.parametrize(
    "error", [URLError("unreachable"), ContentTooShortError("cut off", (b"", None)), TimeoutError(), ConnectionResetError()]
)
def test_a_hub_that_cannot_be_reached_is_waited_for(hub, error) -> None:
    hub.turns = [error]
    with pytest.raises(HubError) as caught:
        fetch(UID)
    assert failure(caught.value).result is Result.OUTAGE
    assert fetch(UID).exists()
    hub.turns = [error]


def test_a_mesh_that_is_cut_off_is_not_taken_for_one(hub) -> None:
    fetch(UID).unlink()
    hub.turns = [ContentTooShortError("cut off", (b"", None))]
    with pytest.raises(HubError):
        fetch(UID)
    assert fetch(UID).read_bytes() == b"glTF whole"


def test_an_index_that_was_cut_off_is_fetched_anew(hub) -> None:
    hub.turns = [gzip.compress(json.dumps(INDEX).encode())[:40]]
    assert fetch(UID).exists()


def test_a_full_disk_is_no_outage_of_the_hub(hub) -> None:
    hub.turns = [OSError(errno.ENOSPC, "full")]
    with pytest.raises(OSError, match="full") as caught:
        fetch(UID)
    assert failure(caught.value).result is Result.STORAGE


def test_ids_that_are_not_there_or_lead_elsewhere_are_refused(hub) -> None:
    for uid in ("1" * 32, OTHER):
        with pytest.raises(InputError, match="found no object with the id"):
            fetch(uid)
