"""Masks of pictures by SAM, and how masks of many views become parts (PartSlip++)."""
