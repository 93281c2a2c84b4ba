"""Holds flat sheets to their shapes with CalculiX, and compares the strain with ours.

Each panel is a file that `cargo xtask bend-peers` wrote: the flat outline, and where it is held at
every stop on a way on which lengths are kept. The flat sheet is divided into shells of eight nodes
with reduced integration (S8R), the border nodes are moved from stop to stop with large rotations,
and the membrane strain at the four integration points of each shell follows from the displacements
of its nodes. The strain compared is the largest principal one that 95 % of the area stays below.
Poisson's number is 0: CalculiX makes bricks of shells, which are too stiff in bending else.
"""

import math
import os
import subprocess
import sys
import time

SHARE = 0.95
PANELS = ["cylinder", "cone", "twisted", "wavy", "saddle"]
# Shells along a long side of a panel, and in all at least across it.
ALONG, ACROSS = 40, 12
# How large the inner square of a round panel is, of the way to its rim.
INNER = 0.55


class Panel:
    def __init__(self, path):
        self.corners, self.flat, self.stops, self.ours = [], [], {}, {}
        for line in open(path):
            word, *rest = line.split()
            if word == "sheet":
                self.thickness, self.modulus = map(float, rest)
            elif word == "ours":
                self.ours[int(rest[0])] = float(rest[1])
            elif word == "corners":
                self.corners = [int(n) for n in rest]
            elif word == "flat":
                self.flat.append(tuple(map(float, rest)))
            else:
                self.stops.setdefault(int(rest[0]), []).append(tuple(map(float, rest[1:])))
        self.ways = [0.0]
        for a, b in zip(self.flat, self.flat[1:] + self.flat[:1]):
            self.ways.append(self.ways[-1] + math.dist(a, b))

    def at(self, way, points):
        """The point of the outline after this way along the flat one."""
        way %= self.ways[-1]
        low, high = 0, len(self.ways) - 1
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if self.ways[middle] <= way else (low, middle)
        share = (way - self.ways[low]) / (self.ways[low + 1] - self.ways[low])
        a, b = points[low], points[(low + 1) % len(points)]
        return tuple(x + share * (y - x) for x, y in zip(a, b))


class Net:
    """Shells of eight nodes, patch by patch; nodes in one place are one."""

    def __init__(self):
        self.nodes, self.border, self.shells, self.known = [], {}, [], {}

    def node(self, point, way):
        key = (round(point[0], 5), round(point[1], 5))
        if key not in self.known:
            self.known[key] = len(self.nodes)
            self.nodes.append(point)
        if way is not None:
            self.border[self.known[key]] = way
        return self.known[key]

    def patch(self, across, along, at):
        """`at` gives the point and its way along the outline, or None, at u and v from 0 to 1."""
        grid = {}
        for i in range(2 * along + 1):
            for k in range(2 * across + 1):
                if i % 2 == 0 or k % 2 == 0:
                    grid[i, k] = self.node(*at(i / (2 * along), k / (2 * across)))
        for i in range(0, 2 * along, 2):
            for k in range(0, 2 * across, 2):
                order = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
                self.shells.append([grid[i + a, k + b] for a, b in order])


def mix(a, b, share):
    return tuple(x + share * (y - x) for x, y in zip(a, b))


def divided(panel):
    net = Net()
    if len(panel.corners) == 4:
        marks = [panel.ways[n] for n in panel.corners]
        marks.append(marks[0] + panel.ways[-1])

        def at(u, v):
            south = marks[0] + u * (marks[1] - marks[0])
            east = marks[1] + v * (marks[2] - marks[1])
            north = marks[3] + u * (marks[2] - marks[3])
            west = marks[4] + v * (marks[3] - marks[4])
            s, e, n, w = (panel.at(way, panel.flat) for way in (south, east, north, west))
            c = [panel.flat[n] for n in panel.corners]
            # A Coons patch.
            point = tuple(
                (1 - v) * s[d] + v * n[d] + (1 - u) * w[d] + u * e[d]
                - (1 - u) * (1 - v) * c[0][d] - u * (1 - v) * c[1][d]
                - u * v * c[2][d] - (1 - u) * v * c[3][d]
                for d in range(2)
            )
            way = south if v == 0 else north if v == 1 else west if u == 0 else east if u == 1 else None
            return point, way

        long = marks[1] - marks[0] > marks[2] - marks[1]
        along, across = (ALONG, ACROSS) if long else (ACROSS, ALONG)
        net.patch(across, along, at)
    else:
        middle = tuple(sum(p[d] for p in panel.flat) / len(panel.flat) for d in range(2))
        quarter = panel.ways[-1] / 4
        rim = [panel.at(k * quarter, panel.flat) for k in range(4)]
        inner = [mix(middle, p, INNER) for p in rim]
        count = ALONG // 4

        def square(u, v):
            return mix(mix(inner[0], inner[1], u), mix(inner[3], inner[2], u), v), None

        net.patch(count, count, square)
        for k in range(4):

            def ring(u, v, k=k):
                way = (k + u) * quarter
                inside = mix(inner[k], inner[(k + 1) % 4], u)
                return mix(panel.at(way, panel.flat), inside, v), way if v == 0 else None

            net.patch(count, count, ring)
    # All the same way round.
    for shell in net.shells:
        a, b, c = (net.nodes[shell[n]] for n in (0, 1, 2))
        if (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < 0:
            shell[:] = [shell[n] for n in (0, 3, 2, 1, 7, 6, 5, 4)]
    return net


def written(panel, net, path):
    with open(path, "w") as out:
        out.write("*NODE, NSET=ALL\n")
        for n, (x, y) in enumerate(net.nodes):
            out.write(f"{n + 1}, {x:.9g}, {y:.9g}, 0\n")
        out.write("*ELEMENT, TYPE=S8R, ELSET=SHEET\n")
        for n, shell in enumerate(net.shells):
            out.write(f"{n + 1}, " + ", ".join(str(v + 1) for v in shell) + "\n")
        out.write(f"*MATERIAL, NAME=M\n*ELASTIC\n{panel.modulus}, 0\n")
        out.write(f"*SHELL SECTION, ELSET=SHEET, MATERIAL=M\n{panel.thickness}\n")
        for stop in sorted(panel.stops):
            out.write("*STEP, NLGEOM, INC=400\n*STATIC\n1, 1, 1e-6\n*BOUNDARY\n")
            for n, way in sorted(net.border.items()):
                to, (x, y) = panel.at(way, panel.stops[stop]), net.nodes[n]
                for axis, moved in enumerate((to[0] - x, to[1] - y, to[2])):
                    out.write(f"{n + 1}, {axis + 1}, {axis + 1}, {moved:.12g}\n")
            # Of the shells, not of the bricks that they become; after the last increment alone.
            out.write("*NODE FILE, OUTPUT=2D, FREQUENCY=1000\nU\n*END STEP\n")


def displacements(path):
    """Those of the last increment that was written."""
    moved, inside = {}, False
    for line in open(path):
        if line.startswith(" -4  DISP"):
            moved, inside = {}, True
        elif line.startswith(" -3"):
            inside = False
        elif inside and line.startswith(" -1"):
            moved[int(line[3:13]) - 1] = [float(line[13 + 12 * k : 25 + 12 * k]) for k in range(3)]
    return moved


def slopes(r, s):
    """Those of the eight shape functions, by r and s."""
    found = []
    for a, b in [(-1, -1), (1, -1), (1, 1), (-1, 1)]:
        found.append((a * (1 + b * s) * (2 * a * r + b * s) / 4, b * (1 + a * r) * (a * r + 2 * b * s) / 4))
    for a, b in [(0, -1), (1, 0), (0, 1), (-1, 0)]:
        if a == 0:
            found.append((-r * (1 + b * s), b * (1 - r * r) / 2))
        else:
            found.append((a * (1 - s * s) / 2, -s * (1 + a * r)))
    return found


def strain(net, moved):
    places = []
    root = 1 / math.sqrt(3)
    for shell in net.shells:
        flat = [net.nodes[n] for n in shell]
        space = [(x + moved[n][0], y + moved[n][1], moved[n][2]) for n, (x, y) in zip(shell, flat)]
        for r in (-root, root):
            for s in (-root, root):
                d = slopes(r, s)
                j = [[sum(p[c] * k[a] for p, k in zip(flat, d)) for a in range(2)] for c in range(2)]
                g = [[sum(p[c] * k[a] for p, k in zip(space, d)) for a in range(2)] for c in range(3)]
                det = j[0][0] * j[1][1] - j[0][1] * j[1][0]
                back = [[j[1][1] / det, -j[0][1] / det], [-j[1][0] / det, j[0][0] / det]]
                f = [[sum(row[k] * back[k][a] for k in range(2)) for a in range(2)] for row in g]
                c = [[sum(f[k][a] * f[k][b] for k in range(3)) for b in range(2)] for a in range(2)]
                e = [(c[0][0] - 1) / 2, (c[1][1] - 1) / 2, c[0][1] / 2]
                mean, half = (e[0] + e[1]) / 2, math.hypot((e[0] - e[1]) / 2, e[2])
                places.append((abs(mean) + half, abs(det)))
    places.sort()
    wanted, below = SHARE * sum(area for _, area in places), 0.0
    for value, area in places:
        below += area
        if below >= wanted:
            return value
    return places[-1][0]


def main():
    folder, names = sys.argv[1], sys.argv[2:] or PANELS
    print("| panel | ours, 350 triangles | 2,000 | CalculiX | shells | ours over CalculiX | s |")
    print("|---|---|---|---|---|---|---|")
    for name in names:
        panel = Panel(os.path.join(folder, f"{name}.txt"))
        net = divided(panel)
        job = os.path.join(folder, name)
        written(panel, net, f"{job}.inp")
        start = time.time()
        with open(f"{job}.log", "w") as log:
            subprocess.run(["ccx", name], cwd=folder, stdout=log, stderr=log, check=True)
        if "*ERROR" in open(f"{job}.log").read():
            sys.exit(f"error: CalculiX did not come to rest: {job}.log")
        theirs = strain(net, displacements(f"{job}.frd"))
        coarse, fine = panel.ours[350], panel.ours[2000]
        print(f"| {name} | {100 * coarse:.4f} % | {100 * fine:.4f} % | {100 * theirs:.4f} % | "
              f"{len(net.shells)} | {coarse / theirs:.2f}, {fine / theirs:.2f} | "
              f"{time.time() - start:.0f} |", flush=True)


main()
