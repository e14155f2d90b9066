"""Boxes, cases, bottles and cans."""
