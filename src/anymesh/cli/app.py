"""The command line. Heavy modules are imported inside the commands, so that help and completion are fast."""

from __future__ import annotations

import atexit
import gc
import json
import logging
import os
import sys
import warnings
from collections.abc import Generator
from contextlib import contextmanager
from typing import Annotated, Any

import typer
from typer.core import TyperCommand

from anymesh import __version__
from anymesh.cli.output import plain
from anymesh.entry_points import COMMANDS, RESUMED, resolve
from anymesh.errors import DEFECT, RESUMES, AnymeshError, OpenQuestionError

OWN = "anymesh"
REPORTS_LEAKS = {"ompl"}  # of nanobind, whose report is switched on: it prints "leaked 2 instances!" of what is not collected
VARIABLE = "PYTHONWARNINGS"  # passes the warning filter to Python child processes
EXIT_CODES = (
    "Exit codes: 0 done; 2 a wrong option; 3 the mesh cannot be used; 4 the output folder exists or "
    "cannot be written; 5 an optional dependency is missing; 6 a model cannot be used; 7 the budget is spent; "
    "8 a check failed; 9 a question is open; 70 an internal defect, with a report to send; 130 interrupted."
)


class _Once(logging.Handler):
    """Handler that writes each warning of this package to stderr, as one line, the first time that it occurs."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self._shown: set[str] = set()

    def emit(self, record: logging.LogRecord) -> None:
        text = plain(" ".join(record.getMessage().split()))
        if text not in self._shown:
            self._shown.add(text)
            sys.stderr.write(f"warning: {text}\n")


@contextmanager
def quiet_libraries() -> Generator[None]:
    """Silence Python warnings, also of child processes, and log records of libraries; for the command line only.

    Warnings that the user requested (`python -W`, PYTHONWARNINGS) are kept.
    """
    root, own = logging.getLogger(), logging.getLogger(OWN)
    sink, handler = logging.NullHandler(), _Once()  # records without any handler would go to stderr
    asked, before = bool(sys.warnoptions), os.environ.get(VARIABLE)
    root.addHandler(sink)
    own.addHandler(handler)
    try:
        with warnings.catch_warnings():
            if not asked:
                warnings.simplefilter("ignore")
                os.environ[VARIABLE] = "ignore"
            yield
    finally:
        root.removeHandler(sink)
        own.removeHandler(handler)
        os.environ.pop(VARIABLE, None)
        if before is not None:
            os.environ[VARIABLE] = before


class _Command(TyperCommand):
    """Command that wraps unexpected errors with their command and options, before the library converts two of them."""

    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except (AnymeshError, typer.Exit, typer.Abort):
            raise
        except (KeyboardInterrupt, Exception) as error:
            if hasattr(error, "format_message") or isinstance(error, BrokenPipeError):
                raise
            raise _HandedError(error, str(ctx.info_name), dict(ctx.params)) from error


class _HandedError(Exception):
    def __init__(self, error: BaseException, command: str, options: dict[str, Any]) -> None:
        self.error, self.command, self.options = error, command, options


def make_app(*names: str, listed: bool = False) -> typer.Typer:
    """Return the command line with some of its commands, all of them by default.

    A command's module is only imported here, so that a run reads what it needs. listed: for the list of them, without options.
    """
    app = typer.Typer(
        help="Any rigid 3D mesh in, a simulation-ready articulated asset out.",
        epilog=EXIT_CODES,
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    app.callback()(_main)
    for name, command in ((name, resolve(COMMANDS[name])) for name in names or COMMANDS):
        app.command(name, cls=_Command, epilog=EXIT_CODES, help=command.__doc__)((lambda: None) if listed else command)
    return app


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"anymesh {__version__}")
        raise typer.Exit


def _main(
    version: Annotated[bool | None, typer.Option("--version", callback=_version, is_eager=True, help="Print it.")] = False,
    debug: Annotated[bool, typer.Option("--debug", help="Show the traceback of an unexpected error.")] = False,
) -> None: ...


def main(arguments: list[str] | None = None) -> None:
    """Run the command line and end the process with its exit code."""
    atexit.register(_skip_collection)
    os.environ.setdefault("MUJOCO_GL", "disable")  # no command draws by MuJoCo, and GLFW takes .1 s to import
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # others would wait in loops; and one thread may fork
    sys.exit(run(sys.argv[1:] if arguments is None else arguments))


def _skip_collection() -> None:
    """Skip the search for cycles at the end of the process, which takes 0.2 s, unless a library would report them as leaks."""
    if not REPORTS_LEAKS & sys.modules.keys():
        gc.freeze()


def run(arguments: list[str]) -> int:
    """Run the command line; return the exit code."""
    # a stream is None if the process was started with it closed
    sys.stdout, sys.stderr = (stream or open(os.devnull, "w") for stream in (sys.stdout, sys.stderr))  # noqa: SIM115, PTH123
    with quiet_libraries():
        return _run(arguments)


def _run(arguments: list[str]) -> int:
    command = next((a for a in arguments if not a.startswith("-")), "")
    try:
        app = make_app(command) if command in COMMANDS else make_app(listed=arguments in (["-h"], ["--help"]))
        code = app(arguments, standalone_mode=False)
        return code if isinstance(code, int) else 0
    except (typer.Exit, SystemExit) as stop:
        return int(getattr(stop, "exit_code", getattr(stop, "code", 0)) or 0)
    except (KeyboardInterrupt, typer.Abort) as error:
        return _interrupted(arguments, command, error)
    except _HandedError as handed:
        if isinstance(handed.error, KeyboardInterrupt):
            return _interrupted(arguments, command, handed.error)
        return _defect(arguments, handed)
    except Exception as error:
        if isinstance(error, AnymeshError):
            waiting = [str(f) for f in error.folders] if isinstance(error, OpenQuestionError) else None
            return _fail(arguments, error, str(error), error.exit_code, **({} if waiting is None else {"questions": waiting}))
        if hasattr(error, "format_message"):  # a usage error of the command line itself
            return _fail(arguments, error, str(error.format_message()), 2) if arguments else 2  # ty: ignore[not-callable]
        return _defect(arguments, _HandedError(error, "", {}))


def _defect(arguments: list[str], handed: _HandedError) -> int:
    """Report an unexpected error, and the location of its report."""
    from anymesh.cli.defect import write_defect

    error = handed.error
    if "--debug" in arguments:
        raise error
    report = write_defect(error, handed.command, handed.options)
    where = "" if report is None else f"; please report it with {report} (versions, options, traceback; no mesh, no keys)"
    message = f"internal defect, {type(error).__name__}: {error}{where}; --debug before the command shows the traceback"
    return _fail(arguments, error, message, DEFECT, report=None if report is None else str(report))


def _interrupted(arguments: list[str], command: str, error: BaseException) -> int:
    resumes = command in RESUMED or "--batch" in arguments or RESUMES in getattr(error, "__notes__", ())
    if "--json" in arguments:
        typer.echo(json.dumps({"error": "interrupted", "kind": "KeyboardInterrupt", "exit_code": 130, "resumes": resumes}))
    typer.echo(f"interrupted; {RESUMES if resumes else 'nothing was written'}", err=True)
    return 130


def _fail(arguments: list[str], error: BaseException, message: str, code: int, **more: str | list[str] | None) -> int:
    message = plain(" ".join(message.split()))
    if "--json" in arguments:
        typer.echo(json.dumps({"error": message, "kind": type(error).__name__, "exit_code": code, **more}))
    typer.echo(f"error: {message}", err=True)
    return code
