"""Annotation of whole collections of meshes: many objects and processes, with one ledger."""
