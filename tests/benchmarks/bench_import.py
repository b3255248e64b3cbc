"""Measure the cost of `import robokin` relative to `import numpy`.

    python tests/benchmarks/bench_import.py

New processes run the two imports in turn, so that a busy machine slows both equally. Aim: a ratio
of at most 1.15.
"""

import os
import statistics
import subprocess
import sys
import tempfile

RUNS = 20
TIMED = "import time; start = time.perf_counter(); import {}; print(time.perf_counter() - start)"


def seconds(module, cache):
    # Write byte code, as on a student's machine, even if the environment forbids it.
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    done = subprocess.run(
        [sys.executable, "-c", TIMED.format(module)],
        text=True,
        capture_output=True,
        check=True,
        env=environment | {"PYTHONPYCACHEPREFIX": cache},
    )
    return float(done.stdout)


def main():
    with tempfile.TemporaryDirectory() as cache:
        seconds("numpy", cache), seconds("robokin", cache)  # this run writes the byte code
        pairs = [(seconds("numpy", cache), seconds("robokin", cache)) for _ in range(RUNS)]
    numpy, robokin = (statistics.median(times) for times in zip(*pairs, strict=True))
    # the runs that were least disturbed by other processes
    fastest = [min(times) for times in zip(*pairs, strict=True)]
    ratio = robokin / numpy
    print(
        f"import numpy {numpy * 1e3:.1f} ms, import robokin {robokin * 1e3:.1f} ms (medians of "
        f"{RUNS}): "
        f"ratio {ratio:.3f} (of the fastest: {fastest[1] / fastest[0]:.3f})"
    )
    return 0 if ratio <= 1.15 else 1


if __name__ == "__main__":
    sys.exit(main())
