"""Interfaces for coding agents: the project's commands as tools of the Model Context Protocol, and a skill file."""
