"""Coding agents at work: the project's commands as tools of the Model Context Protocol, and a skill file that says how."""
