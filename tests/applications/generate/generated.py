"""Requests for a storage box, and what generation records of them."""

import json
from pathlib import Path

BOX = Path(__file__).parents[3] / "examples" / "meshes" / "storage_box.glb"
PROMPT = "a Retro storage box!"
FAST = {"completer": "off", "formats": "urdf"}


def record(out: Path) -> dict:
    return json.loads((out / "generation.json").read_text())
