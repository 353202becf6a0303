"""`burmester`, and `python -m burmester`: the command, with its signals handled from the start."""

import gc

import burmester.signals as signals  # noqa: PLR0402  `from` would load importlib first

# A start makes tens of thousands of objects that stay; Python would look through all of them
# again and again for cycles, a tenth of the time.  Of these cycles there are few, and none large.
OBJECTS_BEFORE_CYCLES_ARE_SOUGHT = 100_000


def main() -> None:
    """Run the command and exit, without a traceback also where it is stopped while it loads."""
    gc.set_threshold(OBJECTS_BEFORE_CYCLES_ARE_SOUGHT)
    try:
        with signals.handled():
            from burmester.cli import main as run  # noqa: PLC0415  it takes a while

            run()
    except BaseException as error:
        # Whoever stops it while it loads need not be told.
        code = error.code if isinstance(error, SystemExit) else signals.exit_code()
        if not isinstance(code, int):
            raise
        signals.end(code)


if __name__ == "__main__":
    main()
