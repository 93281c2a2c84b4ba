"""How long many panels take: one by one, by threads, and on Ray. Prints a line for docs/python.md.

    python bench/python/many.py [PANELS] [--ray]

Panels have 200 samples and differ; verdicts come from the formula. Prints elapsed seconds and the
core-seconds of all processes.
"""

import os
import resource
import sys
import time

import numpy as np
import pysheetwright as sw


def panels(count: int) -> np.ndarray:
    """Loops round an ellipse, bent and twisted a little, of shape (count, 200, 3)."""
    t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    a, b = np.meshgrid(np.linspace(10, 80, count), t, indexing="ij")
    x, y = 300 * np.cos(b), 150 * np.sin(b)
    return np.stack([x, y, a * np.cos(b) ** 2 + 0.05 * a * np.cos(b) * np.sin(b)], axis=2)


def told(name: str, count: int, work: object) -> None:
    """Time some work and print it."""
    who = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    cores = lambda: sum(u.ru_utime + u.ru_stime for u in map(resource.getrusage, who))  # noqa: E731
    begun, used = time.perf_counter(), cores()
    work()
    took, used = time.perf_counter() - begun, cores() - used
    print(f"{name:28} {took:6.1f} s, {1e3 * took / count:6.2f} ms a panel, {used:6.1f} core-s")


def main() -> None:
    """Run it."""
    count = int(next((a for a in sys.argv[1:] if a.isdigit()), "4000"))
    loops = panels(count)
    few = min(count, 500)
    told("solve, each alone", few, lambda: [sw.solve(p, verdict="quick") for p in loops[:few]])
    for threads in (1, 2):
        told(f"solve_many, threads={threads}", count, lambda: sw.solve_many(loops, threads=threads))
    told("solve_many, exact, threads=2", few, lambda: sw.solve_many(loops[:few], verdict="exact"))
    if "--ray" in sys.argv:
        on_ray(loops)


def on_ray(loops: np.ndarray) -> None:
    """The same on two workers, with batches of several sizes, and rows that cost nothing."""
    import pyarrow as pa
    import ray
    from pysheetwright.ray import solve_dataset

    os.environ["RAY_USAGE_STATS_ENABLED"] = "0"
    begun = time.perf_counter()
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    print(f"Ray started in {time.perf_counter() - begun:.1f} s")
    ray.data.DataContext.get_current().enable_progress_bars = False
    table = pa.table({"boundary": loops.reshape(len(loops), -1).tolist()})
    data = ray.data.from_arrow(table).repartition(8).materialize()
    warm = solve_dataset(data.limit(10))
    told("Ray, the first ten", 10, warm.materialize)
    for size in (100, 500, 1000, 2000):
        step = solve_dataset(data, batch_size=size)
        told(f"Ray, batches of {size}", len(loops), step.materialize)
    told("Ray, rows passed on", len(loops), data.map_batches(lambda b: b, batch_size=500).materialize)


main()
