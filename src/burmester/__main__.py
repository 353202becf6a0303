"""`python -m burmester` is the command `burmester`."""

from burmester.cli import main

main()
