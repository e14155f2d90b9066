"""Articulated objects from text and images (paper, 4.2): a 3D generator, the pipeline and stage C."""

from typing import TYPE_CHECKING

from anymesh.entry_points import on_first_use

if TYPE_CHECKING:
    from anymesh.applications.generate.run import Explanation, explain_generation, generate

__all__ = ["Explanation", "explain_generation", "generate"]
__getattr__ = on_first_use(__name__, dict.fromkeys(__all__, "run"))
