"""Articulated objects from words and pictures (paper, 4.2): a 3D generator, then the pipeline, then stage C."""

from anymesh.applications.generate.explain import Explanation, explain_generation
from anymesh.applications.generate.run import generate

__all__ = ["Explanation", "explain_generation", "generate"]
