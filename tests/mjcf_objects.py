"""Small objects with exact joints as MJCF files, for the tests of planning and of policies."""

from pathlib import Path


def mjcf(model: str, bodies: str, before: str = "") -> str:
    """Wrap bodies as one model, with angles in radians. before: elements that precede the world body."""
    return f'<mujoco model="{model}"><compiler angle="radian"/>{before}<worldbody>{bodies}</worldbody></mujoco>'


def write_objects(folder: Path, *texts: str) -> Path:
    """Write each model into a file of its name, and return the folder."""
    for text in texts:
        name = text.split('"', 2)[1]
        (folder / f"{name}.xml").write_text(text, encoding="utf-8")
    return folder
