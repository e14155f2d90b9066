"""Stage C on one asset, with any completer and retexturer (paper, 3.4)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Unpack

import numpy as np

from anymesh.errors import ModelError, OptionError, OutputError
from anymesh.export import ExportOptions
from anymesh.finishing.bake import Baked
from anymesh.finishing.complete import complete
from anymesh.finishing.holopart import VALID, HoloPart, open_holopart
from anymesh.finishing.meshy import Meshy, check_prompt
from anymesh.finishing.meshy_api import read_key
from anymesh.finishing.protocol import Completer, Finished, ShapeConfig
from anymesh.finishing.retexture import Remote
from anymesh.finishing.texture import Carried, Retexturer
from anymesh.pipeline.options import Writing
from anymesh.pipeline.results import CompletionResult
from anymesh.pipeline.run_folder import LAST, RunFolder
from anymesh.pipeline.stage_files import COMPLETION, stage_key
from anymesh.pipeline.stages import write_files
from anymesh.runtime import DEFAULT_SECONDS, Deadline, Progress, read_json, silent
from anymesh.types import Asset

TEXTURES = "builtin, bake, bake:PIXELS, meshy or meshy:PROMPT"


def open_completer(name: str, *, timeout: float = 1800.0) -> Completer | None:
    """Open the completer to use before the built-in one: HoloPart, or None for `builtin` and `off`. timeout: [s].

    Raise OptionError for an invalid name or checkout.
    """
    kind, _, where = name.partition(":")
    if name in ("builtin", "off"):
        return None
    if kind != "holopart":
        raise OptionError(f"--completer: found {name!r}; valid are builtin, off, {VALID}")
    return HoloPart(open_holopart(where, timeout=timeout).complete)


def open_retexturer(
    name: str, *, state: Path, max_calls: int | None = None, max_cost: float | None = None, timeout: float = 60.0
) -> Retexturer:
    """Open the retexturer. state: file that stores the id of a paid task; timeout: [s] of one call.

    Raise OptionError for an invalid name or limit, ModelError without a key.
    """
    kind, colon, rest = name.partition(":")
    match kind:
        case "builtin" if not colon:
            return Carried()
        case "bake" if not colon:
            return Baked()
        case "bake" if rest.isdecimal():
            return Baked(size=int(rest))
        case "meshy" if rest.strip() or not colon:
            if max_cost is not None:
                raise OptionError("--max-cost needs a known price, and Meshy counts in credits: use --max-calls")
            read_key()  # fail now rather than after the shapes
            prompt = check_prompt(rest) if colon else None
            return Remote(Meshy(state, max_calls=max_calls, timeout=timeout), prompt)
        case _:
            raise OptionError(f"--texture: found {name!r}; valid are {TEXTURES}")


def finish_asset(
    asset: Asset,
    *,
    shapes: bool,
    completer: Completer | None,
    retexturer: Retexturer,
    config: ShapeConfig,
    deadline: Deadline | None = None,
) -> CompletionResult:
    """Return the mesh of an asset with completed shapes and textures.

    shapes: if False, shapes stay unchanged. completer: used first, None for none; the built-in completer handles the parts that
    it omits or that disagree with the visible surface. deadline: past it, further surfaces stay open.
    """
    deadline = deadline or Deadline()
    finished = Finished(asset, np.arange(len(asset.mesh.faces)))
    notes: list[str] = []
    if shapes:
        finished, notes = _completed(asset, completer, config, deadline)
    painted = retexturer.retexture(finished)
    segmentation = painted.asset.segmentation
    return CompletionResult(
        painted.asset.mesh, segmentation.face_part, finished.source_face, (*notes, *deadline.warnings(), *painted.notes)
    )


def _completed(
    asset: Asset, completer: Completer | None, config: ShapeConfig, deadline: Deadline
) -> tuple[Finished, list[str]]:
    try:
        finished = complete(asset, config, completer=completer, deadline=deadline)
        return finished, list(_note_lines(finished))
    except ModelError as error:
        if completer is None:
            raise
        finished = complete(asset, config, deadline=deadline)
        return finished, [f"{completer.name}: {error}; the built-in completer did all parts", *_note_lines(finished)]


def _note_lines(finished: Finished) -> Iterator[str]:
    for part, notes in finished.notes.items():
        for note, times in Counter(notes).items():
            yield f"{part}: {note}" + (f" ({times} times)" if times > 1 else "")


def finish(
    folder: str | Path,
    out: str | Path,
    *,
    completer: str = "builtin",
    texture: str = "builtin",
    watertight: bool = True,
    max_calls: int | None = None,
    force: bool = False,
    time_limit: float = DEFAULT_SECONDS,
    progress: Progress = silent,
    **writing: Unpack[Writing],
) -> Asset:
    """Run Stage C: complete shapes and textures of the asset in `folder`, an output of `articulate`, and write it to `out`.

    completer: builtin, off, holopart:FOLDER[#PYTHON] or holopart:URL; texture: builtin, bake, bake:PIXELS, meshy or
    meshy:PROMPT, with at most `max_calls` paid tasks; watertight: also close surfaces that no motion uncovers; time_limit: [s],
    as for `articulate`; writing: likewise, where what is not given is as in `folder`.
    Raise OptionError, OutputError, ModelError or BudgetError; a paid task that was started is resumed by the next run.
    """
    how = ExportOptions.parse(writing, before=read_json(Path(folder) / LAST) or {})
    deadline, out = Deadline(time_limit), Path(out)
    state = out.parent / f".{out.name}.meshy.json"
    first, retexturer = open_completer(completer), open_retexturer(texture, state=state, max_calls=max_calls)
    if (Path(folder) / LAST).is_file() and Path(folder).absolute() in out.absolute().parents:
        raise OutputError(f"{out} lies in the asset {folder}, which is not changed; choose another folder")
    with RunFolder.create(out, source=Path(folder) / LAST, force=force) as run:
        run.take_over(Path(folder))
        progress("finish", completer, 0, 1)
        settings = {"by": completer, "texture": texture, "tight": watertight, "limit": deadline.limit}
        key = stage_key(COMPLETION, previous=run.last_key(), config=settings)
        if run.load(COMPLETION, key) is None:
            with run.timed("finish"):
                completion = finish_asset(
                    run.asset(),
                    shapes=completer != "off",
                    completer=first,
                    retexturer=retexturer,
                    config=ShapeConfig(watertight=watertight),
                    deadline=deadline,
                )
            run.save(COMPLETION, key, completion)
        return write_files(run, how, deadline, progress)
