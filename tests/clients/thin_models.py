# SPDX-License-Identifier: AGPL-3.0-or-later
"""Sealed models with thin parts, as files of Gocad surfaces."""

import math


def surface(name, points, triangles):
    text = f"GOCAD TSurf 1\nHEADER {{\nname:{name}\n}}\nTFACE\n"
    text += "".join(f"VRTX {n + 1} {p[0]!r} {p[1]!r} {p[2]!r}\n" for n, p in enumerate(points))
    return text + "".join(f"TRGL {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles) + "END\n"


def octahedron_cut(cuts):
    """Points of the unit sphere and triangles: those of an octahedron, each cut in four so many times."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    triangles = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(cuts):
        middles, smaller = {}, []

        def middle(a, b, known=middles):
            key = (min(a, b), max(a, b))
            if key not in known:
                known[key] = len(points)
                p = [x + y for x, y in zip(points[a], points[b])]
                points.append(tuple(x / math.hypot(*p) for x in p))
            return known[key]

        for a, b, c in triangles:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            smaller += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = smaller
    return points, triangles


def nested_spheres(cuts, radii):
    points, triangles = octahedron_cut(cuts)
    return "".join(surface(f"sphere{r}", [tuple(r * x for x in p) for p in points], triangles) for r in radii)


def sheet(name, xs, ys, place):
    """Squares between parameters, each of two triangles, or of one where two corners are the same."""
    number, triangles = {}, []
    for y, beyond in zip(ys, ys[1:]):
        for x, right in zip(xs, xs[1:]):
            corners = [number.setdefault(place(*at), len(number)) for at in ((x, y), (right, y), (right, beyond), (x, beyond))]
            triangles += [t for t in ((corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])) if len(set(t)) == 3]
    return surface(name, list(number), triangles)


def pinched_layer():
    """A box of 1000 x 800 x 600 with a layer at 200 that is 35 thick at x = 0 and ends at x = 700, as does its top."""
    xs, thin, ys, sides = [50.0 * i for i in range(21)], [50.0 * i for i in range(15)], [50.0 * j for j in range(17)], [0, 1]

    def height(k, x):
        return (0.0, 200.0, 200.0 + 0.05 * max(0.0, 700.0 - x), 600.0)[k]

    text = "".join(sheet(f"h{k}", thin if k == 2 else xs, ys, lambda x, y, k=k: (x, y, height(k, x))) for k in range(4))
    for k in range(3):
        along = thin if k == 1 else xs
        for y in (0.0, 800.0):
            text += sheet(f"side{k}_{y:g}", along, sides, lambda x, s, k=k, y=y: (x, y, height(k + s, x)))
        for x in (0.0,) if k == 1 else (0.0, 1000.0):
            text += sheet(f"end{k}_{x:g}", ys, sides, lambda y, s, k=k, x=x: (x, y, height(k + s, x)))
    return text
