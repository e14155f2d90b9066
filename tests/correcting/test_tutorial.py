"""The tutorial on corrections runs as it is written, and the drill is right afterwards."""

import re
import shlex
from pathlib import Path

import pytest

import anymesh
from anymesh.cli import run

ROOT = Path(__file__).parents[2]
BLOCK = re.compile(r"^```(bash|python)\n(.*?)^```", re.M | re.S)


@pytest.mark.slow
def test_every_block_of_the_tutorial_runs_in_order(tmp_path, monkeypatch, capsys):
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    blocks = BLOCK.findall((ROOT / "docs" / "tutorials" / "correct-a-joint.md").read_text(encoding="utf-8"))
    assert [kind for kind, _ in blocks] == ["bash", "bash", "python", "bash", "bash"]
    for kind, text in blocks:
        if kind == "python":
            exec(compile(text, "correct-a-joint.md", "exec"), {})
        else:
            for line in text.splitlines():
                program, *arguments = shlex.split(line)
                assert (program, run(arguments)) == ("anymesh", 0), (line, capsys.readouterr().err)
    assert "passed, 0 failures, 0 warnings" in capsys.readouterr().out
    asset = anymesh.load("out/drill")
    trigger, chuck = asset.joint("trigger_joint"), asset.joint("chuck")
    assert (trigger.label, trigger.limits, chuck.label) == ("trigger", (0.0, 0.006), "chuck")
    assert trigger.axis[1] > 0.99  # inwards
    assert len(str(asset).splitlines()) <= 10
