#!/usr/bin/env python3
"""Makes the target meshes of the shipped scenes. Not needed to build or run: the meshes are kept beside it.

    python3 scenes/targets/make_targets.py        (writes its meshes beside this file)
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


def turned(profile, sides, radius_at=lambda angle, height: 1.0):
    """A closed surface of revolution about y: `profile` of (radius, height) from the foot on the axis to the top on it.
    `radius_at` scales the radius, so that a crown has lobes."""
    vertices, quads, rings = [(0.0, profile[0][1], 0.0)], [], []
    for radius, height in profile[1:-1]:
        rings.append(len(vertices))
        for k in range(sides):
            a = 2 * math.pi * k / sides
            r = radius * radius_at(a, height)
            vertices.append((r * math.cos(a), height, r * math.sin(a)))
    apex = len(vertices)
    vertices.append((0.0, profile[-1][1], 0.0))
    for k in range(sides):
        n = (k + 1) % sides
        quads.append((0, rings[0] + k, rings[0] + n))
        for a, b in zip(rings, rings[1:]):
            quads.append((a + k, b + k, b + n, a + n))
        quads.append((rings[-1] + k, apex, rings[-1] + n))
    return vertices, quads


def crown():
    """A tree: a stem and a round crown of five lobes."""
    profile = [(0.0, -0.8), (0.42, -0.8), (0.36, 0.0), (0.34, 0.7)]
    rise, wide, tall = 2.55, 2.05, 1.75
    for i in range(1, 16):
        t = math.pi * i / 16
        profile.append((max(wide * math.sin(t) ** 0.85, 0.34 if i < 3 else 0.0), rise - tall * math.cos(t)))
    profile.append((0.0, rise + tall))

    def lobes(angle, height):
        return 1 + 0.12 * smooth(1.0, 2.2, height) * math.cos(5 * angle + 1.1 * height)

    vertices, quads = turned(profile, 60, lobes)
    write_obj("crown.obj", "a tree: stem and crown", vertices, quads)


def canopy():
    """What grows out of the tube: a stem within it, and a flat crown above it."""
    profile = [(0.0, -0.8), (0.45, -0.8), (0.45, 1.7)]
    rise, wide, tall = 3.1, 2.4, 1.25
    for i in range(2, 20):
        t = math.pi * i / 20
        profile.append((wide * math.sin(t) ** 0.8, rise - tall * math.cos(t)))
    profile.append((0.0, rise + tall))
    vertices, quads = turned(profile, 48)
    write_obj("canopy.obj", "a stem and a flat crown above the tube", vertices, quads)


def tube():
    """An upright tube, open at both ends, around the origin."""
    inner, outer, low, high, sides = 1.15, 1.45, -0.8, 1.5, 48
    section = [(inner, low), (outer, low), (outer, high), (inner, high)]
    vertices, quads = [], []
    for k in range(sides):
        a = 2 * math.pi * k / sides
        for radius, height in section:
            vertices.append((radius * math.cos(a), height, radius * math.sin(a)))
    for k in range(sides):
        n = (k + 1) % sides
        for i in range(4):
            j = (i + 1) % 4
            quads.append((4 * k + i, 4 * k + j, 4 * n + j, 4 * n + i))
    write_obj("tube.obj", "an upright tube, to be kept clear of", vertices, quads)


def ball():
    """What a tree grows around: a ball of 1 m around the origin."""
    sides = 16
    profile = [(math.sin(math.pi * i / sides), -math.cos(math.pi * i / sides)) for i in range(sides + 1)]
    vertices, quads = turned(profile, 2 * sides)
    write_obj("ball.obj", "A ball to grow around.", vertices, quads)


def castle(name, n):
    """A castle on n x n lots of 2.2 m: four towers, walls between them, a court and a keep. Columns of cubes, and of their
    faces those between inside and outside."""
    lot = 2.2
    levels = [0.0, 1.2, 4.2, 8.0, 9.8]

    def height(i, j):
        edge_i, edge_j = min(i, n - 1 - i), min(j, n - 1 - j)
        if edge_i < 2 and edge_j < 2:
            return 3  # towers of 2 x 2 lots
        if edge_i == 0 or edge_j == 0:
            return 2  # walls of one lot
        if edge_i == (n - 1) // 2 and edge_j == (n - 1) // 2:
            return 4  # the keep
        return 1

    def inside(i, j, k):
        return 0 <= i < n and 0 <= j < n and 0 <= k < height(i, j)

    vertices, quads, numbers = [], [], {}

    def corner(i, k, j):
        if (i, k, j) not in numbers:
            numbers[i, k, j] = len(vertices)
            vertices.append((lot * (i - n / 2), levels[k], lot * (j - n / 2)))
        return numbers[i, k, j]

    for i in range(n):
        for j in range(n):
            for k in range(height(i, j)):
                faces = {(1, 0, 0): [(1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)],
                         (-1, 0, 0): [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)],
                         (0, 1, 0): [(0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)],
                         (0, -1, 0): [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)],
                         (0, 0, 1): [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
                         (0, 0, -1): [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)]}
                for (di, dk, dj), face in faces.items():
                    if not inside(i + di, j + dj, k + dk):
                        quads.append([corner(i + a, k + b, j + c) for a, b, c in face])
    write_obj(name, "a castle: towers, walls, court and keep", vertices, quads)


if __name__ == "__main__":
    ship()
    citadel()
    crown()
    ball()
    canopy()
    tube()
    castle("castle.obj", 8)
    castle("castle-odd.obj", 7)  # its middle is a lot
