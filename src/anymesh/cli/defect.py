"""The report of an internal error, written for the user to send."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from anymesh.defects import defect_record


def write_defect(error: BaseException, command: str, options: Mapping[str, Any]) -> Path | None:
    """Write the report beside the command's output, else to the temporary folder; return None if both fail."""
    text = json.dumps(defect_record(error, command, options), indent=2) + "\n"
    for path in _places(command, options):
        try:
            path.write_text(text, encoding="utf-8")
        except OSError:
            continue
        return path
    return None


def _places(command: str, options: Mapping[str, Any]) -> Iterator[Path]:
    out, name = options.get("out") or options.get("folder"), f"anymesh-{command}.defect.json"
    try:
        beside = Path(out).absolute() if out else Path.cwd() / f"anymesh-{command}"
    except OSError:  # the working folder is gone
        beside = None
    if beside is not None:
        name = f"{beside.name or 'anymesh'}.defect.json"
        yield beside.parent / name
    yield Path(tempfile.gettempdir()) / name
