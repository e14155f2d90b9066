"""Test the errors of the command line: one line on stderr, an exit code, and nothing written."""

import json
from pathlib import Path

import numpy as np
import pytest
from called import FACES, PARTS, called, contents

from anymesh.cli import run
from anymesh.cli.defect import write_defect
from anymesh.errors import MissingExtraError
from anymesh.pipeline import solving


def faulty_calls() -> dict[str, tuple[int, list[str], str]]:
    """What is wrong -> exit code, arguments, a word of the message."""
    make = ["segment", "cabinet.glb", "-o", "out"]
    return {
        "no output": (2, ["segment", "cabinet.glb"], "--out"),
        "unknown command": (2, ["fold", "cabinet.glb"], "fold"),
        "unknown option": (2, [*make, "--colour", "red"], "--colour"),
        "seed": (2, [*make, "--seed", "x"], "--seed"),
        "a seed below 0": (2, [*make, "--seed", "-1"], "found -1"),
        "a seed of joints below 0": (2, ["joints", "old", "--seed", "-1"], "found -1"),
        "up": (2, [*make, "--up", "w"], "auto, infer, x, y, z"),
        "scale": (2, [*make, "--scale", "-1"], "METRES:AXIS"),
        "scale 0": (2, [*make, "--scale", "0"], "found '0'"),
        "scale nan": (2, [*make, "--scale", "nan"], "found 'nan'"),
        "a huge scale": (2, [*make, "--scale", "1e300"], "1e-06 to 1e+06 m"),
        "a tiny scale": (2, [*make, "--scale", "1e-300"], "1e-06 to 1e+06 m"),
        "empty parts": (2, [*make, "--parts", "empty.npy"], "an empty file"),
        "deep parts": (2, [*make, "--parts", "deep.json"], "nested too deep"),
        "parts with a long name": (2, [*make, "--parts", f"{'a' * 300}.npy"], "cannot be opened"),
        "parts": (2, [*make, "--parts", "none.npy"], "none.npy"),
        "answerer": (2, [*make, "--answerer", "oracle"], "valid are geometry"),
        "answerer of the whole job": (2, ["articulate", *make[1:], "--answerer", "oracle"], "'oracle'"),
        "answerer of joints": (2, ["joints", "old", "--answerer", "oracle"], "'oracle'"),
        "a port above 65535": (2, ["view", "old", "--port", "99999"], "--port"),
        "no mesh": (3, ["segment", "none.glb", "-o", "out"], "none.glb"),
        "a broken mesh": (3, ["segment", "broken.glb", "-o", "out"], "broken.glb"),
        "another format": (3, ["segment", "notes.txt", "-o", "out"], ".glb, .gltf, .obj"),
        "an output that exists": (4, ["segment", "cabinet.glb", "-o", "old"], "--force"),
        "a folder of others": (4, ["segment", "cabinet.glb", "-o", "foreign", "--force"], "not replaced"),
        "a file as output": (4, ["segment", "cabinet.glb", "-o", "notes.txt"], "is a file"),
        "the source within": (4, ["segment", "cabinet.glb", "-o", "."], "source mesh"),
        "joints of nothing": (4, ["joints", "none"], "anymesh segment"),
        "export before joints": (4, ["export", "old"], "'joints'"),
    }


@pytest.fixture
def crowded(mesh, capfd) -> Path:
    """The working folder with an older output, files of others, and files that are no mesh."""
    assert called(capfd, "segment", mesh, "-o", "old", *PARTS, "-q")[0] == 0
    Path("foreign").mkdir()
    for name in ("foreign/thesis.txt", "notes.txt"):
        Path(name).write_text("mine")
    Path("empty.npy").touch()
    Path("deep.json").write_text("[" * 200_000)
    Path("broken.glb").write_bytes(mesh.read_bytes()[:200])
    return Path.cwd()


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("name", faulty_calls())
def test_an_error_is_one_line_on_stderr_and_nothing_is_written(name: str, crowded, capfd) -> None:
    expected, arguments, word = faulty_calls()[name]
    before = contents(crowded)
    code, out, err = called(capfd, *arguments)
    assert (code, out) == (expected, "")
    assert err.startswith("error: ")
    assert word in err
    assert (err.count("\n"), err[-1]) == (1, "\n")
    assert contents(crowded) == before
    if arguments[0] not in ("fold", "view"):
        code, out, _ = called(capfd, *arguments, "--json")
        assert json.loads(out)["exit_code"] == code == expected
        assert f"error: {json.loads(out)['error']}\n" == err


def test_force_replaces_an_output_of_this_program(crowded, capfd) -> None:
    np.save("labels.npy", np.arange(FACES) // (FACES // 2))
    assert called(capfd, "segment", "cabinet.glb", "-o", "old", "--parts", "labels.npy", "--force", "-q")[0] == 0
    assert called(capfd, "joints", "old", "--json")[0] == 0


@pytest.mark.parametrize(
    ("raised", "code", "word"),
    [
        (MissingExtraError("needs the extra [sim]"), 5, "[sim]"),
        (RuntimeError("two\nlines\x1b[31m"), 70, "--debug"),
        (EOFError("cut"), 70, "internal defect, EOFError: cut"),
        (KeyboardInterrupt(), 130, "interrupted; the same command resumes\n"),
    ],
)
def test_other_ends(raised, code: int, word: str, mesh, monkeypatch, capfd) -> None:
    def fails(*_, **__):
        raise raised

    monkeypatch.setattr(solving, "segment_parts", fails)
    before = contents(Path.cwd())
    found, out, err = called(capfd, "articulate", mesh, "-o", "out")
    assert (found, out) == (code, "")
    assert (err.count("\n"), err[-1]) == (1, "\n")
    assert word in err
    assert "\x1b" not in err
    if code not in (70, 130):
        assert contents(Path.cwd()) == before
    elif code == 70:
        assert Path("out.defect.json").exists()
        assert not Path("out").exists()
        with pytest.raises(type(raised)):
            run(["--debug", "articulate", str(mesh), "-o", "out"])


def test_closed_streams_and_a_missing_working_folder_are_no_defects(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr("sys.stdout", None)
    monkeypatch.setattr("sys.stderr", None)
    assert run(["articulate", str(tmp_path / "lost.obj"), "-o", str(tmp_path / "out")]) == 3
    monkeypatch.setattr("pathlib.Path.cwd", lambda: (_ for _ in ()).throw(FileNotFoundError("gone")))
    assert write_defect(ValueError("x"), "articulate", {}) is not None
