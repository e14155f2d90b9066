"""Articulated objects from text and images (paper, 4.2): a 3D generator, the pipeline and stage C."""

from anymesh.applications.generate.run import Explanation, explain_generation, generate

__all__ = ["Explanation", "explain_generation", "generate"]
