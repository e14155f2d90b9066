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
NONE_OPEN = "no question is open; run the command that asks them again to resume"
ENDED = "the run that waited has ended, or is still at work: look at its output"
QuestionsPath = Annotated[
    Path, typer.Argument(metavar="FOLDER", help="The folder of --answerer files:FOLDER, or of one question in it.")
]
Values = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="[VALUE [FOLDER VALUE]...]",
        help="JSON; short, such as '1=2 2=0'; geometry to leave it; @FILE; or - for standard input. Several: FOLDER VALUE.",
    ),
]


ProbedModel = Annotated[
    str | None,
    typer.Option(metavar="MODEL", help="Ask a model ten questions with known answers, and keep the result for its runs."),
]
PicturesOption = Annotated[str, typer.Option("--pictures", help="With --probe: many or few, as for articulate.")]


def answer(folder: QuestionsPath, values: Values = None, json_: Json = False, quiet: Quiet = False) -> None:
    """Show the open question in FOLDER, or answer it with VALUE, which is checked immediately.

    If a run waits for the answer (--wait), the next question is shown as soon as it is there.
    """
    from anymesh.prompted.answerers.file_answerer import next_question, open_in, record_answers
    from anymesh.prompted.answerers.question_files import is_occupied

    saved = record_answers(_pairs(folder, values)) if values else []
    places = list(dict.fromkeys(s.question.path.parent for s in saved)) or [folder]
    waited = [place for place in places if is_occupied(place)]
    followed = [] if quiet else [q for place in waited if (q := next_question(place)) is not None]
    questions = followed if saved else open_in(folder) or followed
    if json_:
        answered = [{"answered": str(s.question.path), "checked": s.whole, "open": s.left} for s in saved]
        shown = [question_record(q) for q in questions]
        record: dict[str, Any] = answered[0] if len(answered) == 1 else {"answers": answered} if saved else {"open": shown}
        record |= {"next": shown} if saved and waited else {}
        typer.echo(json.dumps(record, indent=2))
    elif not quiet:
        lines = [s.words(waited=s.question.path.parent in waited) for s in saved]
        lines += [_shown(questions)] if questions else [ENDED] if waited else [] if saved else [NONE_OPEN]
        typer.echo("\n".join(plain(line) for text in lines for line in text.split("\n")))


def _pairs(folder: Path, values: list[str]) -> list[tuple[Path, str]]:
    """Return each answer with the folder of its question."""
    from anymesh.errors import OptionError

    if len(values) % 2 == 0:
        raise OptionError(
            f"found {len(values) + 1} arguments; valid are FOLDER VALUE, once or more (a VALUE with spaces stands in quotes)"
        )
    folders = [folder, *map(Path, values[1::2])]
    return [(place, _read(value)) for place, value in zip(folders, values[::2], strict=True)]


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
    return "\n".join(lines)


def _read(value: str) -> str:
    from anymesh.errors import InputError

    try:
        if value == "-":
            return sys.stdin.read()
        return Path(value[1:]).read_text(encoding="utf-8-sig") if value.startswith("@") else value
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{value[1:]} cannot be read as an answer ({type(error).__name__})") from None


def models(probe: ProbedModel = None, pictures: PicturesOption = "many", json_: Json = False) -> None:
    """List the models available on this machine, and which keys are set (without their values).

    With --probe, ask a model ten questions with known answers instead.
    """
    from anymesh.prompted.models.servers import KEYS, SERVERS, probe_servers

    if probe is not None:
        typer.echo(_probed(probe, pictures, json_=json_))
        return
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


def _probed(model: str, pictures: str, *, json_: bool) -> str:
    """Return what a probe of a model finds; its result is kept for the runs that use the model."""
    from anymesh.export.asset_json import usage
    from anymesh.prompted.models.reliability import interval, keep_probe
    from anymesh.prompted.probe import probe_model

    result = probe_model(model, pictures)
    path = keep_probe(model, pictures, result.counts)
    spent = usage(result.exchanges)
    if json_:
        questions = [dict(zip(("question", "object", "right", "asked"), row, strict=True)) for row in result.rows]
        kinds = [
            {"question": kind, "right": right, "asked": asked, "interval": interval(right, asked)}
            for kind, right, asked, _ in result.counts
        ]
        record = {"model": model, "pictures": pictures, "right": result.right, "questions": questions, "kinds": kinds}
        return json.dumps(record | {"usage": spent, "kept": str(path)}, indent=2)
    cost = "" if spent["cost_usd"] is None else f", {spent['cost_usd']:.3f} USD"
    lines = [f"{model}: {result.right} of {len(result.rows)} questions right ({spent['calls']} calls{cost})", ""]
    lines += [f"  {kind:<10} {about:<8} {right} of {asked} right" for kind, about, right, asked in result.rows]
    lines += ["", "by kind of answer, with the 95 % interval of the share that is right:"]
    for kind, right, asked, _ in result.counts:
        low, high = interval(right, asked)
        lines.append(f"  {kind:<10} {right} of {asked}   {100 * low:.0f} to {100 * high:.0f} %")
    kept = f"From now on the answers of this model are weighed accordingly, except with --cache off ({path})."
    return "\n".join(map(plain, [*lines, "", kept]))
