"""Flattens a mesh with libigl and with ours, in turn, and prints a table of times and errors.

Errors are relative length errors of all sides, every side counting the same. The lengths of libigl's
results are compared after the scale that minimises their mean error, since a conformal map has no
scale of its own; ours are taken as they are. Times are the least of three runs, from vertices and
triangles in memory to the flat points; ours include the search for overlaps.
"""

import subprocess
import sys
import time

import igl
import numpy as np

RUNS = 3


def read(path):
    vertices, triangles = [], []
    with open(path) as lines:
        for line in lines:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(word) for word in words[1:4]])
            elif words[:1] == ["f"]:
                triangles.append([int(word.split("/")[0]) - 1 for word in words[1:4]])
    return np.array(vertices), np.array(triangles, dtype=np.int64)


V, F = read(sys.argv[1])
SIDES = np.unique(np.sort(np.vstack([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1), axis=0)
LENGTHS = np.linalg.norm(V[SIDES[:, 0]] - V[SIDES[:, 1]], axis=1)


def errors(flat):
    lengths = np.linalg.norm(flat[SIDES[:, 0]] - flat[SIDES[:, 1]], axis=1)
    # Σ |s·l/L − 1| is least where s is a median of L/l weighed by l/L.
    ratios = LENGTHS / lengths
    order = np.argsort(ratios)
    weights = np.cumsum(1 / ratios[order])
    scale = ratios[order][np.searchsorted(weights, weights[-1] / 2)]
    error = np.abs(scale * lengths / LENGTHS - 1)
    a, b, c = (flat[F[:, k]] for k in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    areas = ux * vy - uy * vx
    if areas.sum() < 0:
        areas = -areas
    return error.mean(), error.max(), int((areas <= 0).sum())


def lscm():
    border = np.asarray(igl.boundary_loop(F)).ravel()
    held = np.array([border[0], border[len(border) // 2]], dtype=np.int64)
    flat, _ = igl.lscm(V, F, held, np.array([[0.0, 0.0], [1.0, 0.0]]))
    # To the scale of the surface, as the isometric methods want it.
    lengths = np.linalg.norm(flat[SIDES[:, 0]] - flat[SIDES[:, 1]], axis=1)
    return flat * np.median(LENGTHS / lengths)


def arap(steps):
    flat = lscm()
    data = igl.ARAPData()
    data.max_iter = steps
    igl.arap_precomputation(V, F, 2, np.zeros(0, dtype=np.int32), data)
    return igl.arap_solve(np.zeros((0, 2)), data, flat)


def slim(steps):
    flat = lscm()
    # SLIM wants the triangles the right way up.
    a, b, c = (flat[F[:, k]] for k in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    if (ux * vy - uy * vx).sum() < 0:
        flat = flat * [1.0, -1.0]
    data = igl.slim_precompute(
        np.asfortranarray(V),
        np.asfortranarray(F.astype(np.int32)),
        np.asfortranarray(flat),
        igl.MappingEnergyType.SYMMETRIC_DIRICHLET,
        np.zeros(0, dtype=np.int32),
        np.asfortranarray(np.zeros((0, 2))),
        0.0,
    )
    return igl.slim_solve(data, steps)


def timed(work):
    least, flat = float("inf"), None
    for _ in range(RUNS):
        start = time.perf_counter()
        flat = work()
        least = min(least, time.perf_counter() - start)
    return (least, *errors(np.asarray(flat)))


def ours():
    command = ["cargo", "bench", "--quiet", "--package", "sheetwright", "--bench", "flatten", "--"]
    said = subprocess.run([*command, sys.argv[1]], check=True, capture_output=True, text=True)
    rows = []
    for line in said.stdout.splitlines():
        if not line.startswith("#"):
            name, seconds, mean, most, flipped, *_ = line.split()
            rows.append((f"Sheetwright, {name}", float(seconds), float(mean), float(most), int(flipped)))
    return rows


rows = [
    ("libigl LSCM", *timed(lscm)),
    ("libigl ARAP, 10 steps", *timed(lambda: arap(10))),
    ("libigl ARAP, 100 steps", *timed(lambda: arap(100))),
    ("libigl SLIM, 50 steps", *timed(lambda: slim(50))),
    *ours(),
]
base = next(row for row in rows if "10 steps" in row[0])
print(f"{len(V)} vertices, {len(F)} triangles; ratios to libigl's ARAP of 10 steps\n")
print("| program | seconds | mean error | largest error | turned over | time | mean | largest |")
print("|---|---|---|---|---|---|---|---|")
for name, seconds, mean, most, flipped in rows:
    ratios = f"{seconds / base[1]:.2f} | {mean / base[2]:.2f} | {most / base[3]:.2f}"
    print(f"| {name} | {seconds:.3f} | {mean:.6f} | {most:.5f} | {flipped} | {ratios} |")
