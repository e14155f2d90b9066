"""Scenes of several objects: found, articulated one by one, and written as a whole."""

from typing import TYPE_CHECKING

from anymesh.entry_points import on_first_use

if TYPE_CHECKING:
    from anymesh.applications.scenes.splitting import articulate_scene

__all__ = ["articulate_scene"]
__getattr__ = on_first_use(__name__, {"articulate_scene": "splitting"})
