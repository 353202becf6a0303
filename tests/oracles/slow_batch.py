"""A run whose parts take a minute, and whose workers say their numbers."""

import os
import sys
import time

from burmester import signals
from burmester.batch.dispatch import Dispatch
from burmester.batch.engines import Processes
from burmester.batch.job import stopping
from burmester.batch.parts import Part
from tests.oracles.batches import Numbers


def slow(part, plan, left_out):
    os.write(1, f"{os.getpid()}\n".encode())
    time.sleep(60)


def main():
    with signals.handled(), stopping() as stopped:
        engine = Processes(2)
        try:
            parts = (Part(k, Numbers((k,)), 1.0) for k in range(9))
            Dispatch(engine, slow, None, print, stopped=stopped).run(parts)
        except KeyboardInterrupt:
            sys.exit(130)
        finally:
            engine.close()


if __name__ == "__main__":
    main()
