"""What libraries say stays off the terminal of the command line; importing the package changes no filter."""

import logging
import os
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
import trimesh

from anymesh.cli.app import quiet_libraries

LINE = "v 0 0 2\nv 1 0 2\nv 2 0 2\nf 9 10 11\nf 9 9 10\n"  # faces without an area
OPTIONS = ["--up", "z", "--scale", "1", "--formats", "urdf,mjcf,sdf,glb"]


def command(*arguments: str, folder: Path, **environment: str) -> subprocess.CompletedProcess:
    clean = {key: value for key, value in os.environ.items() if key not in ("PYTHONWARNINGS", "PYTHONDEVMODE")}
    return subprocess.run(
        [sys.executable, *arguments], cwd=folder, env=clean | environment, capture_output=True, text=True, timeout=300
    )


def write_mesh(folder: Path) -> None:
    box = trimesh.creation.box()
    rows = [f"v {a} {b} {c}" for a, b, c in box.vertices] + [f"f {a} {b} {c}" for a, b, c in box.faces + 1]
    (folder / "x.obj").write_text("mtllib gone.mtl\n" + "\n".join(rows) + "\ng line\n" + LINE)


def test_a_run_warns_of_nothing_and_computes_nothing_that_libraries_warn_of(tmp_path) -> None:
    write_mesh(tmp_path)
    run = ["-m", "anymesh.cli", "articulate", "x.obj", "-o", "out", *OPTIONS]
    strict = command("-W", "error::RuntimeWarning", *run, folder=tmp_path)
    assert (strict.returncode, strict.stderr) == (0, "")
    assert strict.stdout.count("'gone.mtl' left out") == 1
    usual = command(*run, "--force", folder=tmp_path)
    assert (usual.returncode, usual.stderr, usual.stdout) == (0, "", strict.stdout)


TALKATIVE = """
import logging, subprocess, sys, warnings
import numpy as np
from anymesh import cli, pipeline

def talk(*_, **__):
    np.zeros(1) / 0
    warnings.warn("from a library")
    for name in ("trimesh", "anymesh", "anymesh"):
        logging.getLogger(name).warning("%s \\x1b logs", name)
    subprocess.run([sys.executable, "-c", "import warnings; warnings.warn('from a child')"])
    raise SystemExit(0)

pipeline.articulate = talk
cli.main(["articulate", "x.obj", "-o", "out"])
"""


def test_the_package_runs_as_a_module(tmp_path: Path) -> None:
    run = command("-m", "anymesh", "--version", folder=tmp_path)
    assert run.returncode == 0
    assert run.stdout.startswith("anymesh ")


def test_libraries_are_silent_and_we_speak_once(tmp_path) -> None:
    done = command("-c", TALKATIVE, folder=tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "warning: anymesh ? logs\n")
    asked = command("-c", TALKATIVE, folder=tmp_path, PYTHONWARNINGS="default")
    for told in ("divide", "from a library", "from a child"):
        assert told in asked.stderr


def test_filters_and_handlers_are_as_before_afterwards() -> None:
    before = (list(warnings.filters), list(logging.getLogger().handlers), os.environ.get("PYTHONWARNINGS"))
    with quiet_libraries(), np.errstate(all="warn"):
        np.zeros(1) / 0
    assert (list(warnings.filters), list(logging.getLogger().handlers), os.environ.get("PYTHONWARNINGS")) == before
    assert not logging.getLogger("anymesh").handlers


def test_importing_the_package_changes_no_filter(tmp_path) -> None:
    code = "import warnings, logging; b = list(warnings.filters); import anymesh.pipeline; print(b == warnings.filters)"
    lines = command("-c", f"import numpy, scipy.sparse, trimesh, embreex, PIL.Image\n{code}", folder=tmp_path)
    assert lines.stdout == "True\n", lines.stderr


def test_a_library_that_reports_leaks_has_none_to_report(tmp_path) -> None:
    pytest.importorskip("ompl")
    code = "from ompl import base; base.RealVectorStateSpace(2); from anymesh.cli import main; main(['--version'])"
    ended = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, timeout=100)
    assert (ended.returncode, ended.stderr) == (0, "")
