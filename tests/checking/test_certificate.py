"""A certificate holds for the bytes and values that it was made of, and for no others."""

import json

import pytest
import typer
from drawn import chest
from typer.testing import CliRunner

from anymesh.checking import certificate
from anymesh.checking.certificate import NAME, _text, certify, verify
from anymesh.checking.command_line import check
from anymesh.errors import InputError


@pytest.fixture
def certified(tmp_path):
    """Return a folder with a certificate, made without engines, and a file that it does not bind."""
    chest(tmp_path)
    (tmp_path / "timing.json").write_text("{}")
    assert certify(tmp_path, engines=())[1] == tmp_path / NAME
    return tmp_path


def test_it_is_the_same_twice_and_names_no_place(certified) -> None:
    first = (certified / NAME).read_bytes()
    certify(certified, engines=())
    assert (certified / NAME).read_bytes() == first
    assert str(certified).encode() not in first
    (certified / "timing.json").write_text('{"load": 1}')
    (certified / ".hidden").write_text("")
    assert verify(certified)[0] == []
    assert verify(certified)[1].endswith("checked again")


def test_every_byte_of_the_asset_counts(certified) -> None:
    files = [p for p in certified.rglob("*") if p.is_file() and p.name not in (NAME, "timing.json")]
    assert len(files) >= 4
    for file in files:
        data = file.read_bytes()
        file.write_bytes(data + b" ")
        assert verify(certified)[0] == [f"{file.relative_to(certified).as_posix()} was changed"]
        file.write_bytes(data)
    (certified / "meshes" / "new.obj").write_text("")
    assert verify(certified)[0] == ["meshes/new.obj was added"]
    (certified / "meshes" / "new.obj").unlink()
    (certified / "meshes" / "case.obj").rename(certified / "meshes" / "body.obj")
    assert verify(certified)[0] == ["meshes/body.obj was added", "meshes/case.obj is missing"]


def test_every_byte_of_the_certificate_counts(certified) -> None:
    place = certified / NAME
    data = place.read_bytes()
    for at in range(0, len(data), 1 + len(data) // 97):
        place.write_bytes(data[:at] + bytes([data[at] ^ 1]) + data[at + 1 :])
        assert verify(certified)[0], data[at - 20 : at + 20]
    for other in (
        data + b"\n",
        data[:-1],
        data.replace(b'"certificate": 1', b'"certificate":  1'),
        b"[]",
        b"[" * 100_000,
        b"\xff",
    ):
        place.write_bytes(other)
        assert verify(certified)[0] == [f"{NAME} was changed: it does not match its own sha256"]


@pytest.mark.parametrize("key", ["failures", "warnings", "findings", "certificate"])
def test_a_value_with_a_fitting_digest_is_told_by_checking_again(certified, key) -> None:
    record = json.loads((certified / NAME).read_bytes())
    record[key] = 7
    (certified / NAME).write_text(_text(record))
    assert verify(certified)[0] == [f"the check gives other {key} than the certificate states"]


def test_other_rules_are_told_and_not_checked_again(certified, monkeypatch) -> None:
    monkeypatch.setattr(certificate, "_rules", lambda: {"articulate-anymesh": "9"})
    assert verify(certified) == ([], verify(certified)[1])
    assert "rules or libraries differ" in verify(certified)[1]


def test_the_figures_of_an_engine_are_bound(tmp_path) -> None:
    chest(tmp_path)
    report, place = certify(tmp_path)
    record = json.loads(place.read_bytes())
    assert record["engines"]["ran"][0].startswith("mujoco ")
    assert record["figures"] == json.loads(json.dumps(report.as_json()["sweeps"]))
    assert record["figures"][0]["joints"][0]["reached_upper"] > 0
    assert verify(tmp_path)[0] == []


def test_what_cannot_be_certified(tmp_path) -> None:
    path = chest(tmp_path, ('axis xyz="0 -1 0"', 'axis xyz="0 0 0"'))
    assert certify(path, engines=())[1] is None
    with pytest.raises(InputError, match="--certificate` writes one"):
        verify(path)
    chest(tmp_path)
    (tmp_path / "meshes" / "secret").symlink_to("/etc/hostname")
    with pytest.raises(InputError, match="secret is no plain file"):
        certify(path, engines=())


def test_the_command(tmp_path) -> None:
    chest(tmp_path)

    def run(*words):
        app = typer.Typer()
        app.command()(check)
        return CliRunner().invoke(app, [str(tmp_path), *words])

    assert isinstance(run("--verify").exception, InputError)
    assert f"wrote {tmp_path / NAME}" in run("--certificate").stdout
    assert "its certificate holds" in run("--verify").stdout
    (tmp_path / "meshes" / "case.obj").write_text("# none\n")
    result = run("--verify", "--json")
    assert result.exit_code == 8
    assert json.loads(result.stdout)["problems"] == ["meshes/case.obj was changed"]
