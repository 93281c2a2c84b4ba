"""Folds flat patterns hit by hit, as `brake.csv` says, and compares them with their surfaces.

    python .ci/brake.py DIR...

Each DIR holds brake.csv, surface.obj and a DXF a part, of parts without holes. The outline in the DXF
is cut along the bend lines into flat facets; each is turned about its line by the angle of the hit,
after all those before it. What comes out is laid on the samples of surface.obj as well as a rigid
motion can (Kabsch), and no sample may lie farther from its place than the sagitta that the steps
allow: of a step of width p and angle a, p * a / 8. Also checks that lines end on the outline, that
running angles add up and that each gauge reaches the outline. Shares no code with the program. Ends
with a line `N passed, N failed`, and with status 1 if anything failed or nothing could be checked.
"""

import csv
import sys
from pathlib import Path

import ezdxf
import numpy as np

# The digits of the table, and a little for their sums, mm and degrees.
ROUNDED = 0.002


def surface(path):
    """The samples of each part, in space and on the pattern, in order."""
    parts, name = {}, None
    for line in path.read_text(encoding="utf-8").splitlines():
        word, *rest = line.split()
        if word == "g":
            name = rest[0]
            parts[name] = ([], [])
        elif word in ("v", "vt"):
            parts[name][word == "vt"].append([float(x) for x in rest])
    return {name: tuple(map(np.array, lists)) for name, lists in parts.items()}


def outline(path):
    cut = [e for e in ezdxf.readfile(path).modelspace() if e.dxf.layer == "cut"]
    assert len(cut) == 1, f"{path.name}: {len(cut)} loops"
    return np.array([tuple(vertex.dxf.location)[:2] for vertex in cut[0].vertices])


class Loop:
    """A closed line, by the way along it."""

    def __init__(self, points):
        self.points = points
        self.sides = np.roll(points, -1, axis=0) - points
        self.lengths = np.linalg.norm(self.sides, axis=1)
        self.at = np.concatenate([[0], np.cumsum(self.lengths)])

    def nearest(self, point):
        """How far along the nearest point lies, and how far away it is."""
        off = point - self.points
        share = np.einsum("ij,ij->i", off, self.sides) / self.lengths**2
        share = np.clip(share, 0, 1)
        away = np.linalg.norm(off - share[:, None] * self.sides, axis=1)
        side = int(np.argmin(away))
        return self.at[side] + share[side] * self.lengths[side], away[side]


def turn(axis_from, axis_to, angle):
    """The motion x -> R x + t that turns about a line of the plane z = 0."""
    x, y, z = np.append(axis_to - axis_from, 0) / np.linalg.norm(axis_to - axis_from)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    rotation = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    origin = np.append(axis_from, 0)
    return rotation, origin - rotation @ origin


def folded(points, loop, hits):
    """The points of the outline after all hits."""
    whole = loop.at[-1]
    arcs = []
    for hit in hits:
        left, right = (loop.nearest(end)[0] for end in hit["ends"])
        # The outline runs counter-clockwise, so what lies ahead of a line begins at its right end.
        arcs.append((right, (left - right) % whole))
    out = []
    for point, at in zip(points, loop.at):
        ahead = [n for n, (start, length) in enumerate(arcs) if (at - start) % whole < length]
        # From the first line on: the sheet ahead of it holds that ahead of all others.
        ahead.sort(key=lambda n: -arcs[n][1])
        place = np.append(point, 0)
        for n in reversed(ahead):
            rotation, shift = turn(*hits[n]["ends"], hits[n]["angle"])
            place = rotation @ place + shift
        out.append(place)
    return np.array(out)


def distances(a, b):
    """How far the points of a lie from those of b after the best rigid motion."""
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    u, _, v = np.linalg.svd(a.T @ b)
    flip = np.diag([1, 1, np.sign(np.linalg.det(u @ v))])
    return np.linalg.norm(a @ (u @ flip @ v) - b, axis=1)


def read(path):
    parts = {}
    with path.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            given = {key: value for key, value in row.items() if key.endswith(("_mm", "_deg"))}
            # No bend but a sharp fold has an inner radius.
            number = {key: float(value) for key, value in given.items() if value}
            sign = {"up": 1, "down": -1}[row["direction"]]
            parts.setdefault(row["part"], []).append({
                **row, **number,
                "ends": [np.array([number[f"x{n}_mm"], number[f"y{n}_mm"]]) for n in (1, 2)],
                "angle": sign * np.radians(number["angle_deg"]),
            })
    return parts


def check(folder):
    passed = failed = 0

    def that(what, holds, found=""):
        nonlocal passed, failed
        passed, failed = passed + bool(holds), failed + (not holds)
        if not holds:
            print(f"FAILED {folder.name}, {what}: {found}")

    of_surface = surface(folder / "surface.obj")
    for part, hits in read(folder / "brake.csv").items():
        space, flat = of_surface[part.replace(" ", "_")]
        points = outline(folder / f"{part}.dxf")
        loop = Loop(points)
        running = 0.0
        for n, hit in enumerate(hits):
            name = f"{part}, hit {n + 1}"
            away = [loop.nearest(end)[1] for end in hit["ends"]]
            that(f"{name}: ends on the outline", max(away) < ROUNDED, away)
            running += np.degrees(hit["angle"])
            off = abs(running - hit["running_deg"])
            that(f"{name}: running angle", off < ROUNDED * (n + 1), (running, hit["running_deg"]))
            left, right = hit["ends"]
            along = (right - left) / np.linalg.norm(right - left)
            for side in ("left", "right"):
                at = left + along * hit[f"finger_{side}_mm"]
                gauge = hit[f"gauge_{side}_mm"]
                if hit["reference"] == "base line":
                    off = abs(at[1] - gauge)
                else:
                    square = np.array([-along[1], along[0]])
                    off = min(loop.nearest(at + way * gauge * square)[1] for way in (1, -1))
                that(f"{name}: gauge {side}", off < 10 * ROUNDED, off)
        # The samples in the order of the outline, whose corners they are, digit by digit.
        numbers = {tuple(point): n for n, point in enumerate(flat)}
        order = [numbers[tuple(point)] for point in points]
        # A sample on a seam has two places on the pattern, and so two of its numbers in the file.
        corners = corner_positions(folder / "surface.obj", part.replace(" ", "_"))
        wanted = np.array([space[corners[n]] for n in order])
        sagitta = max(
            max(hit["pitch_left_mm"], hit["pitch_right_mm"]) * abs(hit["angle"]) / 8 for hit in hits
        )
        far = distances(folded(points, loop, hits), wanted).max()
        that(f"{part}: within the sagitta", far <= sagitta, (far, sagitta))
        print(
            f"{folder.name}, {part}: {len(hits)} hits, folded {far:.3f} mm from the surface, "
            f"sagitta {sagitta:.3f} mm"
        )
    return passed, failed


def corner_positions(path, part):
    """For each flat place of a part the number of its sample, both from 0 in the part."""
    counts, first, found, name = [0, 0], None, {}, None
    for line in path.read_text(encoding="utf-8").splitlines():
        word, *rest = line.split()
        if word == "g":
            name, first = rest[0], list(counts)
        elif word in ("v", "vt"):
            counts[word == "vt"] += 1
        elif word == "f" and name == part:
            for corner in rest:
                sample, place = (int(x) - 1 for x in corner.split("/")[:2])
                found[place - first[1]] = sample - first[0]
    return found


def main(folders):
    results = [check(Path(folder)) for folder in folders]
    passed, failed = (sum(counts) for counts in zip(*results)) if results else (0, 0)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
