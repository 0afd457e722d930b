#!/usr/bin/env python3
"""Makes the target meshes of the shipped scenes. Not needed to build or run: the meshes are kept beside it.

    python3 scenes/targets/make_targets.py        (writes ship.obj and citadel.obj beside this file)
"""
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))


def smooth(a, b, t):
    t = min(max((t - a) / (b - a), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def bump(centre, width, t):
    return math.exp(-((t - centre) / width) ** 2)


def write_obj(name, comment, vertices, quads):
    with open(os.path.join(HERE, name), "w", encoding="ascii") as out:
        out.write(f"# {comment}\n# made by scenes/targets/make_targets.py\n")
        for v in vertices:
            out.write("v {:.4f} {:.4f} {:.4f}\n".format(*v))
        for q in quads:
            out.write("f " + " ".join(str(i + 1) for i in q) + "\n")


def ship():
    """A cruiser seen from above: a long hull along +z, swept wings, a bridge. Two sheets over the plan, closed at the rim."""
    length, rows, columns = 9.0, 72, 41

    def half_width(z):
        hull = 0.62 * smooth(-0.9, 1.2, z) * (1 - 0.72 * smooth(4.5, 9.3, z))
        wings = 2.5 * smooth(0.55, 1.25, z) * (1 - smooth(1.5, 4.4, z))
        return hull + wings

    def body_half_width(z):
        return 0.74 * smooth(-1.2, 1.5, z) * (1 - 0.68 * smooth(4.0, 9.3, z))

    def top(x, z):
        across = abs(x) / body_half_width(z)
        hull = 0.58 * (1 - 0.55 * smooth(4.5, 9.2, z)) * max(1 - across ** 4, 0.0) ** 0.5
        bridge = 0.62 * bump(2.6, 1.15, z) * max(1 - (x / 0.42) ** 4, 0.0) ** 0.5
        return max(0.13, hull) + bridge

    def bottom(x, z):
        across = abs(x) / body_half_width(z)
        hull = 0.46 * (1 - 0.5 * smooth(4.5, 9.2, z)) * max(1 - across ** 4, 0.0) ** 0.5
        return -max(0.13, hull)

    vertices, quads = [], []
    upper, lower = {}, {}
    for i in range(rows):
        z = length * i / (rows - 1)
        for j in range(columns):
            x = half_width(z) * (2 * j / (columns - 1) - 1)
            upper[i, j] = len(vertices)
            vertices.append((x, top(x, z), z))
            lower[i, j] = len(vertices)
            vertices.append((x, bottom(x, z), z))
    for i in range(rows - 1):
        for j in range(columns - 1):
            quads.append((upper[i, j], upper[i + 1, j], upper[i + 1, j + 1], upper[i, j + 1]))
            quads.append((lower[i, j], lower[i, j + 1], lower[i + 1, j + 1], lower[i + 1, j]))
        quads.append((upper[i, 0], lower[i, 0], lower[i + 1, 0], upper[i + 1, 0]))
        j = columns - 1
        quads.append((upper[i, j], upper[i + 1, j], lower[i + 1, j], lower[i, j]))
    for j in range(columns - 1):
        quads.append((upper[0, j], upper[0, j + 1], lower[0, j + 1], lower[0, j]))
        i = rows - 1
        quads.append((upper[i, j], lower[i, j], lower[i, j + 1], upper[i, j + 1]))
    write_obj("ship.obj", "a cruiser: hull, swept wings, bridge", vertices, quads)


def citadel():
    """A town on a rock: terraces that step inwards and a high spire in the middle. A closed surface of revolution."""
    profile = [(0.0, 0.0), (7.0, 0.0), (7.0, 1.4), (5.2, 1.8), (5.0, 3.4), (3.6, 3.8), (3.4, 5.8), (2.1, 6.2), (1.9, 8.6),
               (1.1, 9.2), (0.0, 13.0)]
    sides = 48
    vertices = [(0.0, 0.0, 0.0)]
    rings = []
    for radius, height in profile[1:-1]:
        rings.append(len(vertices))
        for k in range(sides):
            a = 2 * math.pi * k / sides
            vertices.append((radius * math.cos(a), height, radius * math.sin(a)))
    apex = len(vertices)
    vertices.append((0.0, profile[-1][1], 0.0))
    quads = []
    for k in range(sides):
        n = (k + 1) % sides
        quads.append((0, rings[0] + k, rings[0] + n))
        for a, b in zip(rings, rings[1:]):
            quads.append((a + k, b + k, b + n, a + n))
        quads.append((rings[-1] + k, apex, rings[-1] + n))
    write_obj("citadel.obj", "a town on a rock: terraces and a spire", vertices, quads)


if __name__ == "__main__":
    ship()
    citadel()
