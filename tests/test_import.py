"""Importing the package and its help read no heavy library."""

import subprocess
import sys
from pathlib import Path

import pytest

import anymesh
from anymesh import entry_points

HEAVY = {"trimesh", "scipy", "PIL", "numpy", "mujoco", "embreex"}


@pytest.mark.parametrize(
    "program",
    ["import anymesh", "from anymesh.cli import run; run(['--help'])", "from anymesh.cli import run; run(['view', '-h'])"],
)
def test_import_and_help_read_nothing_heavy(program: str) -> None:
    done = [sys.executable, "-c", f"import sys; {program}; print('MODULES', *sys.modules)"]
    told = subprocess.run(done, check=True, capture_output=True, text=True)
    read = set(told.stdout.partition("MODULES")[2].split())
    assert not HEAVY & read
    assert "view" in program or "importlib.metadata" not in read  # a tenth of the help's time


def test_no_public_name_is_hidden_by_a_package() -> None:
    """Importing a subpackage sets an attribute of the package, which would replace a function of the same name."""
    packages = {path.stem for path in Path(anymesh.__file__).parent.iterdir() if path.is_dir() or path.suffix == ".py"}
    assert not packages & set(anymesh.__all__)


def test_every_place_that_is_found_by_name_is_there() -> None:
    single = [place for name, place in vars(entry_points).items() if name.isupper() and isinstance(place, str)]
    api = [f"{module}:{name}" for name, module in entry_points.API.items()]
    assert {*entry_points.API} | {"AnymeshError", "__version__"} <= {*anymesh.__all__}
    for place in (*single, *api, *entry_points.COMMANDS.values()):
        assert callable(entry_points.resolve(place)), place
