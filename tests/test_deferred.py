"""Deferred modules: a stand-in during the imports of others, the module itself at first use."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from anymesh.deferred import deferred


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    package = tmp_path / "seldom_package"
    package.mkdir()
    (package / "__init__.py").write_text("def __getattr__(name):\n    import seldom_package.heavy as heavy\n    return heavy\n")
    (package / "heavy.py").write_text("VALUE = 7\n")
    (tmp_path / "user_of_seldom.py").write_text("import seldom_package\nheavy = seldom_package.heavy\n")
    monkeypatch.syspath_prepend(tmp_path)
    yield "seldom_package.heavy"
    for name in ("seldom_package", "seldom_package.heavy", "user_of_seldom"):
        sys.modules.pop(name, None)


def test_a_module_is_imported_at_its_first_use(library: str) -> None:
    with deferred(library):
        import user_of_seldom  # ty: ignore[import-not-found]
    assert library not in sys.modules
    assert user_of_seldom.heavy.VALUE == 7
    assert library in sys.modules
    with pytest.raises(AttributeError):
        _ = user_of_seldom.heavy.MISSING


def test_a_module_used_during_the_imports_is_imported_then(library: str) -> None:
    with deferred(library):
        import user_of_seldom  # ty: ignore[import-not-found]

        assert user_of_seldom.heavy.VALUE == 7
    assert sys.modules[library].VALUE == 7
    assert sys.modules["seldom_package"].heavy is sys.modules[library]


def test_a_missing_module_stays_missing() -> None:
    with deferred("no_such_module_at_all"), pytest.raises(ImportError):
        import no_such_module_at_all  # noqa: F401  # ty: ignore[import-not-found]


def test_the_pipeline_leaves_out_what_it_does_not_use() -> None:
    program = (
        "import sys, anymesh; anymesh.articulate; from anymesh.mujoco_ import load_mujoco; load_mujoco().Renderer;"
        "print(*(m for m in ('networkx', 'numpy.f2py', 'glfw', 'scipy.optimize') if m in sys.modules));"
        "import numpy, numpy.f2py; assert numpy.f2py.get_include and numpy.f2py is sys.modules['numpy.f2py']"
    )
    told = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True)
    assert told.stdout.strip() == ""
