"""`anymesh generate` on the command line."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from meshy_wire import refuses

from anymesh.cli import run


def test_a_dry_run_needs_no_key_and_writes_nothing(tmp_path, capsys, monkeypatch) -> None:
    monkeypatch.delenv("MESHY_API_KEY", raising=False)
    monkeypatch.chdir(tmp_path)
    assert run(["generate", "a retro fridge", "-o", "out", "--dry-run"]) == 0
    told = capsys.readouterr().out
    assert "1. pay Meshy for a text-to-3D preview (/openapi/v2/text-to-3d); the prompt is sent - about 20 credits" in told
    assert "find parts and joints" in told
    assert "in all about 30 credits; nothing was sent, paid or written" in told
    assert (
        run(["generate", "a contraption", "--generator", "command:run {prompt} {out}", "-o", "out", "--dry-run", "--json"]) == 0
    )
    found = json.loads(capsys.readouterr().out)
    assert found["credits"] == 0
    assert found["steps"][0]["what"] == "run a program, for at most 1800 s: run 'a contraption' contraption.glb"
    assert "give --scale" in found["warnings"][0]
    assert list(tmp_path.iterdir()) == []


def test_a_picture_becomes_an_asset(server, quick, tmp_path, capsys) -> None:
    picture = tmp_path / "box.png"
    picture.write_bytes(b"\x89PNG\r\n\x1a\n picture")
    command = ["generate", "--image", str(picture), "-o", str(tmp_path / "out"), "--formats", "urdf", "--completer", "off"]
    assert run([*command, "--up", "y", "--at-least", "1", "--time-limit", "300", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [joint["type"] for joint in found["joints"]] == ["revolute"]
    told = quick[0]
    assert {k: told[k] for k in ("up", "at_least", "time_limit", "formats", "answerer")} == {
        "up": "y",
        "at_least": 1,
        "time_limit": 300.0,
        "formats": "urdf",
        "answerer": "geometry",
    }
    assert (tmp_path / "out" / "generation.json").is_file()


def test_what_goes_wrong_has_an_exit_code(server, quick, tmp_path, capsys) -> None:
    out = ["-o", str(tmp_path / "out")]
    assert run(["generate", *out]) == 2
    assert run(["generate", "a box", *out, "--scale", "big"]) == 2
    assert run(["generate", "--mesh", str(tmp_path / "no.glb"), *out]) == 3
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine").write_text("")
    assert run(["generate", "a box", "-o", str(tmp_path / "full")]) == 4
    server.fails("create", refuses(401))
    assert run(["generate", "a box", *out]) == 6
    assert run(["generate", "a box", *out, "--max-calls", "1", "--json"]) == 7
    assert json.loads(capsys.readouterr().out)["kind"] == "BudgetError"
    assert server.tasks == {}


@pytest.mark.slow
def test_a_signal_ends_the_program_too(tmp_path) -> None:
    """SIGTERM, by which schedulers end a job, reaches what the program started."""
    program = Path(__file__).parent / "small_generator.py"
    name = f"command:'{sys.executable}' '{program}' --prompt {{prompt}} --out {{out}} --fault hang"
    command = [sys.executable, "-m", "anymesh.cli", "generate", "box", "-o", str(tmp_path / "out"), "--generator", name]
    running = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    pids, end = tmp_path / ".out.generate" / "box.pids", time.monotonic() + 60
    while not (pids.exists() and len(pids.read_text().split()) == 2) and time.monotonic() < end:
        time.sleep(0.05)
    started = [int(p) for p in pids.read_text().split()]
    running.send_signal(signal.SIGTERM)
    assert running.communicate(timeout=30)[1].endswith("interrupted\n")
    assert running.returncode == 130
    end = time.monotonic() + 10
    while any(map(alive, started)) and time.monotonic() < end:
        time.sleep(0.05)
    assert not any(map(alive, started))
    assert not (tmp_path / "out").exists()


def alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().split(")")[1].split()[0] != "Z"
    except OSError:
        return False
