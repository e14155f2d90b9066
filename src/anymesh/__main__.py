"""Let `python -m anymesh` run the command line."""

from anymesh.cli import main

if __name__ == "__main__":
    main()
