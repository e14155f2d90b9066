"""A program makes a mesh without a shell, within its time, and what it started ends with it."""

import json
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from meshy_wire import refuses

from anymesh.applications.generate.generators import CommandGenerator, log_tail, open_generator
from anymesh.applications.generate.protocol import MeshRequest
from anymesh.cli import run
from anymesh.errors import ModelError, OptionError
from anymesh.loading import load_mesh
from anymesh.runtime import silent


def opened(name: str, time_limit: float = 60.0) -> CommandGenerator:
    found = open_generator(name, time_limit=time_limit)
    assert isinstance(found, CommandGenerator)
    return found


def alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().split(")")[1].split()[0] != "Z"
    except OSError:
        return False


def ended(pids: list[int]) -> bool:
    end = time.monotonic() + 10
    while any(map(alive, pids)) and time.monotonic() < end:
        time.sleep(0.05)
    return not any(map(alive, pids))


def test_a_mesh_comes_back_and_no_shell_reads_the_prompt(program, tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", "sk-marker")
    monkeypatch.setenv("MESHY_API_KEY", "msy_marker")
    monkeypatch.setenv("OTHER_API_KEY", "its own")
    prompt = f"a 'retro' fridge; touch {tmp_path}/owned $(id) {{out}}"
    picture = tmp_path / "my fridge.png"
    picture.write_bytes(b"picture")
    name = program(f"--prompt={{prompt}} --image {{image}} --seed {{seed}} --out {{out}} --notes {tmp_path}/notes.json")
    seen = []
    made = opened(name).make(MeshRequest(prompt, picture, 5), tmp_path, lambda *told: seen.append(told))
    assert len(load_mesh(made.path).mesh.faces) > 100
    assert made.path.parent == tmp_path
    assert made.tasks == ()
    told = json.loads((tmp_path / "notes.json").read_text())
    assert told["arguments"][:6] == [f"--prompt={prompt}", "--image", str(picture), "--seed", "5", "--out"]
    assert told["keys"] == ["OTHER_API_KEY"]
    assert not (tmp_path / "owned").exists()
    assert seen
    assert seen[0][0] == "generate"


def test_a_program_that_hangs_is_ended_with_what_it_started(program, tmp_path) -> None:
    hanging = opened(program("--prompt {prompt} --out {out} --fault hang"), time_limit=1.5)
    with pytest.raises(ModelError, match=r"was ended: it took longer than 1\.5 s; the end of its output: step 1 of 50"):
        hanging.make(MeshRequest("box"), tmp_path, silent)
    pids = [int(p) for p in (tmp_path / "box.pids").read_text().split()]
    assert len(pids) == 2
    assert ended(pids)


def test_an_interrupt_ends_the_program_with_what_it_started(program, tmp_path) -> None:
    def interrupts(*_: object) -> None:
        if (tmp_path / "box.pids").exists() and (tmp_path / "box.pids").stat().st_size:
            raise KeyboardInterrupt

    hanging = opened(program("--prompt {prompt} --out {out} --fault hang"))
    with pytest.raises(KeyboardInterrupt):
        hanging.make(MeshRequest("box"), tmp_path, interrupts)
    assert ended([int(p) for p in (tmp_path / "box.pids").read_text().split()])


def test_a_crash_says_its_last_words_without_what_looks_like_a_key(program, tmp_path) -> None:
    with pytest.raises(ModelError) as failed:
        opened(program("--prompt {prompt} --out {out} --fault crash")).make(MeshRequest("box"), tmp_path, silent)
    assert "ended with status 3; the end of its output: CUDA out of memory: tried to allocate 20 GiB | token [removed]" in str(
        failed.value
    )


def test_a_long_output_is_quoted_from_its_first_whole_line(tmp_path) -> None:
    """The last 4000 bytes begin within a key, whose rest is too short to be recognized as one."""
    key, log = "sk-" + 40 * "a", tmp_path / "log"
    log.write_text(f"start {key}\n" + (4000 - 11) * "." + "\nlast one\n")
    assert log_tail(log).endswith("last one")
    assert "aaa" not in log_tail(log)
    log.write_text(5000 * "a")
    assert log_tail(log) == ""


@pytest.mark.parametrize(
    ("fault", "told"),
    [
        ("nothing", r"ended and wrote no file at \{out\}; the end of its output: done, or so it says"),
        ("garbage", "wrote a file that is not a usable mesh"),
    ],
)
def test_what_is_no_mesh_is_told(program, tmp_path, fault, told) -> None:
    (tmp_path / "box.glb").write_bytes(b"of an earlier run")
    with pytest.raises(ModelError, match=told):
        opened(program(f"--prompt {{prompt}} --out {{out}} --fault {fault}")).make(MeshRequest("box"), tmp_path, silent)


def test_a_program_that_is_not_there_is_told(tmp_path) -> None:
    missing = opened("command:no-such-program {prompt} {out}")
    with pytest.raises(ModelError, match="found no program 'no-such-program'"):
        missing.check()
    with pytest.raises(ModelError, match="no-such-program cannot be run: No such file"):
        missing.make(MeshRequest("box"), tmp_path, silent)
    opened(f"command:{sys.executable} {{prompt}} {{out}}").check()


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("trellis", r"found 'trellis'; valid are meshy, meshy:untextured, command:PROGRAM"),
        ("command:", "found the command ''"),
        ("command:run --image {image}", "found the command"),
        ("command:run --out {out}", "found the command"),
        ("command:run '{prompt} {out}", "cannot be split into words"),
        ("command:run {prompt} {out} {path}", r"found the placeholders \['path'\]; valid are \{prompt\}"),
    ],
)
def test_names_that_are_not_valid(name, told) -> None:
    with pytest.raises(OptionError, match=told):
        open_generator(name)
    with pytest.raises(OptionError, match="more than 0 s"):
        open_generator("command:run {prompt} {out}", time_limit=0.0)


def test_a_command_takes_what_was_given_and_leaves_braces_of_others() -> None:
    request = MeshRequest("box")
    with pytest.raises(OptionError, match=r"the command takes \{image\}, and none was given"):
        opened("command:run {image} {out}").steps(request)
    [step] = opened("""command:run '{"steps": 50}' {prompt} {out}""").steps(request)
    assert step.what.endswith("""run '{"steps": 50}' box box.glb""")
    assert step.credits == 0


def test_settings_tell_commands_apart_and_hold_no_key_and_no_folder() -> None:
    one = opened("command:/opt/a/run.py --token hf_short --out {out} {prompt}")
    two = opened("command:/opt/b/run.py --token hf_short --out {out} {prompt}")
    request = MeshRequest("box", seed=3)
    assert one.settings(request) != two.settings(request)
    assert one.settings(request)["command"] == "run.py --token [removed] --out '{out}' '{prompt}'"
    assert one.name == "command:run.py"
    assert "seed" not in one.settings(request)
    assert opened("command:run {seed} {prompt} {out}").settings(request)["seed"] == 3


def test_two_programs_do_not_wait_for_each_other(program, tmp_path) -> None:
    """Each has a process group of its own: ending one leaves the other."""
    results: dict[str, object] = {}

    def make(name: str, fault: str, limit: float) -> None:
        folder = tmp_path / name
        folder.mkdir()
        try:
            generator = opened(program(f"--prompt {{prompt}} --out {{out}} --fault {fault}"), time_limit=limit)
            results[name] = generator.make(MeshRequest("box"), folder, silent)
        except ModelError as error:
            results[name] = error

    threads = [threading.Thread(target=make, args=a) for a in (("hangs", "hang", 1.0), ("works", "none", 60.0))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert isinstance(results["hangs"], ModelError)
    assert not isinstance(results["works"], ModelError)


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
    assert running.communicate(timeout=30)[1].endswith("interrupted; the same command resumes\n")
    assert running.returncode == 130
    end = time.monotonic() + 10
    while any(map(alive, started)) and time.monotonic() < end:
        time.sleep(0.05)
    assert not any(map(alive, started))
    assert not (tmp_path / "out").exists()
