"""The commands `anymesh answer` and `anymesh models`."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from anymesh.cli.options import Json, Quiet
from anymesh.cli.output import plain

if TYPE_CHECKING:
    from anymesh.prompted.answerers.question_files import QuestionFolder
QuestionsPath = Annotated[
    Path, typer.Argument(metavar="FOLDER", help="The folder of --answerer files:FOLDER, or of one question in it.")
]
Value = Annotated[
    str | None,
    typer.Argument(
        metavar="VALUE", help="JSON; short, such as '1=2 2=0'; geometry to leave it; @FILE; or - for standard input."
    ),
]


def answer(folder: QuestionsPath, value: Value = None, json_: Json = False, quiet: Quiet = False) -> None:
    """Show the open question in FOLDER, or answer it with VALUE, which is checked immediately."""
    from anymesh.prompted.answerers.file_answerer import open_in, record_answer

    if value is not None:
        saved = record_answer(folder, _read(value))
        if json_:
            typer.echo(json.dumps({"answered": str(saved.question.path), "checked": saved.whole, "open": saved.left}, indent=2))
        elif not quiet:
            typer.echo(plain(saved.words()))
        return
    questions = open_in(folder)
    if json_:
        typer.echo(json.dumps({"open": [question_record(q) for q in questions]}, indent=2))
    elif questions:
        typer.echo(_shown(questions))
    else:
        typer.echo("no question is open; run the command that asks them again to resume")


def question_record(question: QuestionFolder) -> dict[str, Any]:
    """Return everything that an agent needs to answer a question."""
    from anymesh.prompted.answerers.question_files import SHEET

    pictures = [{"path": str(question.path / p["file"]), "caption": p["caption"]} for p in question.record["pictures"]]
    return {
        "question": str(question.path),
        "kind": question.kind,
        "system": question.record["system"],
        "text": question.record["text"],
        "sheet": str(question.path / SHEET) if pictures else None,
        "pictures": pictures,
        "schema": question.schema,
        "refused": question.refusal(),
    }


def _shown(questions: list[QuestionFolder]) -> str:
    from anymesh.prompted.answerers.question_files import SHEET, example_answer, explain_schema

    first, record = questions[0], questions[0].record
    lines = [f"{first.path}: {first.kind}", "", record["text"], ""]
    if record["pictures"]:
        lines.append(f"all pictures: {first.path / SHEET}")
    lines += [f"{first.path / p['file']}  {p['caption']}".rstrip() for p in record["pictures"]]
    lines += ["", "answer: one JSON object with", explain_schema(first.schema), ""]
    lines.append(f"for example, in form only: {json.dumps(example_answer(first.schema))}")
    lines += [first.refusal() or ""] * (first.refusal() is not None)
    lines += [f"also open: {q.path}" for q in questions[1:]]
    return "\n".join(plain(line) for text in lines for line in text.split("\n"))


def _read(value: str) -> str:
    from anymesh.errors import InputError

    try:
        if value == "-":
            return sys.stdin.read()
        return Path(value[1:]).read_text(encoding="utf-8-sig") if value.startswith("@") else value
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{value[1:]} cannot be read as an answer ({type(error).__name__})") from None


def models(json_: Json = False) -> None:
    """List the models available on this machine, and which keys are set (without their values)."""
    from anymesh.prompted.models.servers import KEYS, SERVERS, probe_servers

    probes = probe_servers()
    keys = [
        {"provider": provider, "variable": name, "set": bool(os.environ.get(name, "").strip())}
        for provider, names in KEYS.items()
        for name in names
    ]
    record: dict[str, Any] = {
        "servers": [
            {
                "server": f.server,
                "url": f.url,
                "answers": f.models is not None,
                "note": f.note,
                "models": list(f.models or ()),
            }
            for f in probes
        ],
        "keys": keys,
    }
    if json_:
        typer.echo(json.dumps(record, indent=2))
        return
    for f in probes:
        typer.echo(plain(f"{f.server} at {f.url or 'no address'}: {f.note or f'{len(f.models or ())} models'}"))
        for m in f.models or ():
            typer.echo(plain(f"  {m}"))
        if f.models is None:
            typer.echo(f"  to use another address, set {' or '.join(SERVERS[f.server].variables)}")
    variables = {k["variable"]: k["set"] for k in keys}  # several providers may use one key
    typer.echo("keys: " + ", ".join(f"{name} {'is set' if is_set else 'is not set'}" for name, is_set in variables.items()))
    typer.echo("choose a model that accepts pictures; without one, you or your agent can answer: --answerer files:FOLDER")
