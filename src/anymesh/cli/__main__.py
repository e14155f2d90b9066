"""Run the command line with `python -m anymesh.cli`."""

from anymesh.cli.app import main

main()
