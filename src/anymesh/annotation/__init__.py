"""Annotation of whole collections of meshes: many objects, many processes, one ledger."""
