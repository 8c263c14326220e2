#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Makes the sample models of this folder: python3 make_samples.py [FOLDER]

Everything comes from one lattice of nodes: a box of 1000 x 800 x 1000 m, cut by a fault that dips to the east, with two
horizons that stand 100 m lower behind the fault. Nodes are rounded to millimetres once and used by all surfaces, so
that contacts are equal bit by bit. Same Python or not, the files come out the same, byte by byte.
"""

import math
import os
import sys

LENGTH, WIDTH, HEIGHT = 1000.0, 800.0, 1000.0
WEST_LEVELS = [0.0, -300.0, -700.0, -HEIGHT]  # top, H1, H2, bottom, west of the fault
THROW = 100.0
# The fault meets five strips: the horizons of both blocks cut it at these indices.
WEST_ROWS = [0, 1, 3, 5]
EAST_ROWS = [0, 2, 4, 5]
ROWS = 5


def text(value):
    """A number without needless digits."""
    if value == int(value):
        return str(int(value))
    return repr(value)


class Lattice:
    """Nodes (i, j, k): i to the east, i == west on the fault; j to the north; k downwards."""

    def __init__(self, west, east, north):
        self.west, self.east, self.north = west, east, north

    def columns(self):
        return self.west + self.east

    def _level(self, block, number, u, v):
        """Height of a horizon, u from 0 at the box's end to 1 at the fault, v from south to north."""
        level = WEST_LEVELS[number]
        if number in (0, 3):
            return level
        waves = 20.0 * math.sin(math.pi * u) * math.cos(math.pi * v) + 15.0 * v
        return level + waves - (THROW if block == "east" else 0.0)

    def _fault_level(self, row, v):
        for block, rows in (("west", WEST_ROWS), ("east", EAST_ROWS)):
            if row in rows:
                return self._level(block, rows.index(row), 1.0, v)
        raise ValueError(row)

    def node(self, i, j, k):
        v = j / self.north
        if i == self.west:
            z = round(self._fault_level(k, v), 3)
            return (round(450.0 - 0.1 * z, 3), round(v * WIDTH, 3), z)
        block, rows = ("west", WEST_ROWS) if i < self.west else ("east", EAST_ROWS)
        u = i / self.west if block == "west" else (self.columns() - i) / self.east
        number = max(n for n in range(3) if rows[n] <= k)
        share = (k - rows[number]) / (rows[number + 1] - rows[number])
        upper, lower = self._level(block, number, u, v), self._level(block, number + 1, u, v)
        z = round(upper + share * (lower - upper), 3)
        fault = 450.0 - 0.1 * z
        x = u * fault if block == "west" else LENGTH - u * (LENGTH - fault)
        return (round(x, 3), round(v * WIDTH, 3), z)


class Patch:
    """One face of the model: triangles over lattice nodes, normals up, east or north."""

    def __init__(self, interface, front, behind):
        self.interface, self.front, self.behind = interface, front, behind  # region names, or Universe
        self.triangles = []

    def nodes(self):
        seen = {}
        for triangle in self.triangles:
            for node in triangle:
                seen.setdefault(node, len(seen))
        return list(seen)


def add_quad(patch, low, side, across, far):
    """The diagonal runs from the lowest to the highest corner, as in the tetrahedra."""
    patch.triangles += [(low, side, far), (low, far, across)]


def region_name(block, layer):
    return "%s_%d" % (block, layer + 1)


def region_at(lattice, i, k):
    """Region of the cell whose lowest indices are i and k."""
    if i < 0 or i >= lattice.columns() or k < 0 or k >= ROWS:
        return "Universe"
    block, rows = ("west", WEST_ROWS) if i < lattice.west else ("east", EAST_ROWS)
    return region_name(block, max(n for n in range(3) if rows[n] <= k))


def patches_of(lattice):
    """All faces of the model, by interface."""
    made = {}

    def patch(interface, front, behind):
        return made.setdefault((interface, front, behind), Patch(interface, front, behind))

    columns, north = lattice.columns(), lattice.north
    for k in range(ROWS + 1):  # horizons, top and bottom: normals up, so i before j
        for i in range(columns):
            above, below = region_at(lattice, i, k - 1), region_at(lattice, i, k)
            if above == below:
                continue
            rows = WEST_ROWS if i < lattice.west else EAST_ROWS
            name = ["top", "H1", "H2", "bottom"][rows.index(k)]
            for j in range(north):
                add_quad(patch(name, above, below), (i, j, k), (i + 1, j, k), (i, j + 1, k), (i + 1, j + 1, k))
    for i in (0, lattice.west, columns):  # sides and fault: normals to the east; k runs down, so k before j
        name = {0: "west", lattice.west: "fault", columns: "east"}[i]
        for k in range(ROWS):
            front, behind = region_at(lattice, i, k), region_at(lattice, i - 1, k)
            for j in range(north):
                add_quad(patch(name, front, behind), (i, j, k), (i, j, k + 1), (i, j + 1, k), (i, j + 1, k + 1))
                # The diagonal must not depend on the order of the axes: (j, k) low to (j, k) high, as it is.
    for j in (0, north):  # normals to the north
        name = "south" if j == 0 else "north"
        for k in range(ROWS):
            for i in range(columns):
                inside = region_at(lattice, i, k)
                front, behind = (inside, "Universe") if j == 0 else ("Universe", inside)
                add_quad(patch(name, front, behind), (i, j, k), (i + 1, j, k), (i, j, k + 1), (i + 1, j, k + 1))
    return orient(lattice, list(made.values()))


def normal(a, b, c):
    u = [b[n] - a[n] for n in range(3)]
    v = [c[n] - a[n] for n in range(3)]
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def orient(lattice, patches):
    """Turns the triangles whose normals do not look up, east or north."""
    axis = {"top": 2, "H1": 2, "H2": 2, "bottom": 2, "west": 0, "fault": 0, "east": 0, "south": 1, "north": 1}
    for patch in patches:
        turned = []
        for a, b, c in patch.triangles:
            n = normal(*(lattice.node(*p) for p in (a, b, c)))
            turned.append((a, b, c) if n[axis[patch.interface]] > 0 else (a, c, b))
        patch.triangles = turned
    order = list(ROLES)
    patches.sort(key=lambda p: order.index(p.interface))
    return patches


ROLES = {"top": "topographic", "H1": "top", "H2": "top", "bottom": "boundary", "fault": "normal_fault",
         "west": "boundary", "east": "boundary", "south": "boundary", "north": "boundary"}

REGIONS = [region_name(block, layer) for layer in range(3) for block in ("west", "east")]


def six_volumes(lattice, patches, region):
    """Six times the volume by the divergence theorem: back sides as they are, front sides turned."""
    total = 0.0
    for patch in patches:
        for side, sign in ((patch.front, -1.0), (patch.behind, 1.0)):
            if side != region:
                continue
            for triangle in patch.triangles:
                a, b, c = (lattice.node(*p) for p in triangle)
                n = normal((0.0, 0.0, 0.0), b, c)
                total += sign * (a[0] * n[0] + a[1] * n[1] + a[2] * n[2])
    return total


def check_sealed(lattice, patches):
    """Every edge of a region's skin is used once each way; volumes are positive and add up to the box."""
    for region in REGIONS:
        edges = {}
        for patch in patches:
            for side, turned in ((patch.front, True), (patch.behind, False)):
                if side != region:
                    continue
                for a, b, c in patch.triangles:
                    for edge in ((a, b), (b, c), (c, a)):
                        edge = edge[::-1] if turned else edge
                        assert edge not in edges, (region, edge)
                        edges[edge] = True
        assert all(edge[::-1] in edges for edge in edges), region
    volumes = [six_volumes(lattice, patches, region) / 6 for region in REGIONS]
    box = LENGTH * WIDTH * HEIGHT
    assert min(volumes) > 0
    assert abs(sum(volumes) - box) < 1e-9 * box, volumes
    assert abs(six_volumes(lattice, patches, "Universe") / 6 + box) < 1e-9 * box
    return dict(zip(REGIONS, volumes))


# ---------------------------------------------------------------------------------------------- Gocad

COORDINATES = """GOCAD_ORIGINAL_COORDINATE_SYSTEM
NAME Default
PROJECTION Unknown
DATUM Unknown
AXIS_NAME X Y Z
AXIS_UNIT m m m
ZPOSITIVE Elevation
END_ORIGINAL_COORDINATE_SYSTEM
"""


def properties(entries, prefix=""):
    """Parallel lists of property declarations: (name, unit) pairs."""
    names = " ".join(name for name, _ in entries)
    lines = ["PROPERTIES " + names,
             "PROP_LEGAL_RANGES " + " ".join("**none** **none**" for _ in entries),
             "NO_DATA_VALUES " + " ".join("-99999" for _ in entries),
             "PROPERTY_CLASSES " + names.lower(),
             "PROPERTY_KINDS " + " ".join("unknown" for _ in entries),
             "PROPERTY_SUBCLASSES " + " ".join("QUANTITY Float" for _ in entries),
             "ESIZES " + " ".join("1" for _ in entries),
             "UNITS " + " ".join(unit for _, unit in entries)]
    return "".join(prefix + line + "\n" for line in lines)


def place(point):
    return " ".join(text(c) for c in point)


def surface_object(name, patches, position, feature=None, extra=None):
    """A TSurf with a TFACE per patch; nodes that parts share are atoms. Horizons carry their distance to the fault."""
    has_property = ROLES[patches[0].interface] == "top"
    out = ["GOCAD TSurf 1\nHEADER {\nname:%s\n*solid*color:%s\n}\n" % (name, COLOURS[patches[0].interface]), COORDINATES]
    out.append("GEOLOGICAL_FEATURE %s\nGEOLOGICAL_TYPE %s\n" % (feature or name, ROLES[patches[0].interface]))
    if has_property:
        out.append(properties([("fault_distance", "m")]))
    ids, number = {}, 0
    for patch in patches:
        out.append("TFACE\n")
        local = {}
        for node in patch.nodes():
            number += 1
            local[node] = number
            point = position(patch, node)
            value = " " + text(round(abs(point[0] - (450.0 - 0.1 * point[2])), 3)) if has_property else ""
            letter = "P" if has_property else ""
            known = ids.get(point)
            if known is None:
                ids[point] = number
                out.append("%sVRTX %d %s%s\n" % (letter, number, place(point), value))
            else:
                out.append("%sATOM %d %d%s\n" % (letter, number, known, value))
        triangles = patch.triangles + (extra(patch) if extra else [])
        out += ["TRGL %d %d %d\n" % tuple(local[node] for node in triangle) for triangle in triangles]
    out.append("END\n")
    return "".join(out)


COLOURS = {"top": "#7fb26b", "H1": "#d9a441", "H2": "#b5652b", "bottom": "#7a6a5a", "fault": "#c03030",
           "west": "#9aa5b1", "east": "#9aa5b1", "south": "#9aa5b1", "north": "#9aa5b1"}


def by_interface(patches):
    return [(name, [p for p in patches if p.interface == name]) for name in ROLES]


def signed_list(entries):
    lines = []
    for first in range(0, len(entries), 5):
        lines.append("  " + "  ".join(entries[first:first + 5]) + "\n")
    return "".join(lines)


def model3d(name, lattice, patches, position, extra=None):
    out = ["GOCAD Model3d 1\nHEADER {\nname:%s\n}\n" % name, COORDINATES]
    groups = by_interface(patches)
    out += ["TSURF %s\n" % interface for interface, _ in groups]
    numbers, count = {}, 0
    for interface, members in groups:
        for patch in members:
            count += 1
            numbers[patch] = count
            out.append("TFACE %d  %s %s\n" % (count, ROLES[interface], interface))
            out += ["  %s\n" % place(position(patch, node)) for node in patch.triangles[0]]
    for region in ["Universe"] + REGIONS:
        count += 1
        numbers[region] = count
        sides = ["+%d" % numbers[p] for p in numbers if isinstance(p, Patch) and p.front == region]
        sides += ["-%d" % numbers[p] for p in numbers if isinstance(p, Patch) and p.behind == region]
        out.append("REGION %d  %s\n" % (count, region) + signed_list(sides + ["0"]))
    for interface, members in groups:
        out.append("SURFACE %s\n" % interface + signed_list([str(numbers[p]) for p in members] + ["0"]))
    for layer in range(3):
        inside = [str(numbers[region_name(block, layer)]) for block in ("west", "east")]
        out.append("LAYER layer_%d\n" % (layer + 1) + signed_list(inside + ["0"]))
    for block in ("west", "east"):
        inside = [str(numbers[region_name(block, layer)]) for layer in range(3)]
        out.append("FAULT_BLOCK %s\n" % block + signed_list(inside + ["0"]))
    out.append("END\n")
    out += [surface_object(interface, members, position, extra=extra) for interface, members in groups]
    return "".join(out)


def sealed_box(lattice, patches):
    return model3d("layered_box", lattice, patches, lambda patch, node: lattice.node(*node))


def loose_box(lattice, patches):
    """Each surface for itself: every node is a little off, by another distance for each surface."""
    def position(patch, node):
        x, y, z = lattice.node(*node)
        seed = list(ROLES).index(patch.interface) * 7919 + node[0] * 104729 + node[1] * 1299709 + node[2] * 15485863
        shifts = []
        for _ in range(3):
            seed = (seed * 1103515245 + 12345) % 2147483648
            shifts.append((seed // 65536 % 1001 - 500) / 1000.0)
        return tuple(round(c + s, 3) for c, s in zip((x, y, z), shifts))

    return "".join(surface_object(name, members, position) for name, members in by_interface(patches))


def box_with_gap(lattice, patches):
    """The western H1 ends 5 m before the fault."""
    def position(patch, node):
        x, y, z = lattice.node(*node)
        pulled = patch.interface == "H1" and patch.front == "west_1" and node[0] == lattice.west
        return (round(x - 5.0, 3), y, z) if pulled else (x, y, z)

    return model3d("layered_box_gap", lattice, patches, position)


def box_with_bad_triangles(lattice, patches):
    """Two triangles twice (one turned, one shifted), two with the same node twice, one on three nodes in a row."""
    def extra(patch):
        if patch.interface == "H2" and patch.front == "east_2":
            (a, b, c), (d, e, f) = patch.triangles[0], patch.triangles[1]
            return [(b, c, a), (d, f, e)]
        if patch.interface == "top" and patch.behind == "west_1":
            (a, b, c) = patch.triangles[0]
            return [(a, a, b), (c, b, c), ((0, 0, 0), (0, 1, 0), (0, 2, 0))]
        return []

    return model3d("layered_box_bad_triangles", lattice, patches, lambda patch, node: lattice.node(*node), extra)


# ---------------------------------------------------------------------------------------------- solid

def tetrahedra(lattice):
    """Six per cell along its long diagonal, so that cells fit together; all of positive volume."""
    paths = [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]
    for k in range(ROWS):
        for j in range(lattice.north):
            for i in range(lattice.columns()):
                for path in paths:
                    corner = [i, j, k]
                    corners = [tuple(corner)]
                    for axis in path:
                        corner[axis] += 1
                        corners.append(tuple(corner))
                    a, b, c, d = (lattice.node(*p) for p in corners)
                    n = normal(a, b, c)
                    if sum(n[m] * (d[m] - a[m]) for m in range(3)) < 0:
                        corners[2], corners[3] = corners[3], corners[2]
                    yield region_at(lattice, i, k), corners


def porosity(point):
    return round(0.30 + point[2] / 5000.0, 4)


PERMEABILITY = {"1": 250.0, "2": 40.0, "3": 5.0}


def solid(lattice, patches):
    facets = {}
    for patch in patches:
        for triangle in patch.triangles:
            facets[frozenset(triangle)] = (patch, triangle)
    by_region = {region: [] for region in REGIONS}
    for region, corners in tetrahedra(lattice):
        by_region[region].append(corners)

    out = ["GOCAD TSolid 1\nHEADER {\nname:layered_box_solid\n}\n", COORDINATES]
    out.append(properties([("porosity", "none")]) + properties([("permeability", "mD")], "TETRA_"))
    primary, number, matched = {}, 0, 0
    for region in REGIONS:
        out.append("TVOLUME %s\n" % region)
        local = {}
        for corners in by_region[region]:
            for node in corners:
                if node in local:
                    continue
                number += 1
                local[node] = number
                point = lattice.node(*node)
                if node in primary:
                    out.append("PATOM %d %d %s\n" % (number, primary[node], text(porosity(point))))
                else:
                    primary[node] = number
                    out.append("PVRTX %d %s %s\n" % (number, place(point), text(porosity(point))))
        for corners in by_region[region]:
            out.append("TETRA %s %s\n" % (" ".join(str(local[n]) for n in corners), text(PERMEABILITY[region[-1]])))
            tags = []
            for opposite in range(4):
                found = facets.get(frozenset(n for m, n in enumerate(corners) if m != opposite))
                if found is None:
                    tags.append("none")
                    continue
                matched += 1
                # Plus says that the tetrahedron lies behind the triangle.
                tags.append(("+" if found[0].behind == region else "-") + found[0].interface)
            out.append("# CTETRA %s %s\n" % (region, " ".join(tags)))
    # Each triangle inside the box is a facet of two tetrahedra, each one on its skin of one.
    assert matched == sum(2 - (p.front == "Universe") - (p.behind == "Universe") for p in patches for _ in p.triangles)

    out.append("MODEL\n")
    count, region_face = 0, {}
    for interface, members in by_interface(patches):
        out.append("SURFACE %s\n" % interface)
        for patch in members:
            count += 1
            region_face.setdefault(patch.front, "+%d" % count)
            region_face.setdefault(patch.behind, "-%d" % count)
            ids = [" ".join(str(primary[n]) for n in triangle) for triangle in patch.triangles]
            out.append("TFACE %d\nKEYVERTICES %s\n" % (count, ids[0]) + "".join("TRGL %s\n" % three for three in ids))
    out += ["MODEL_REGION %s %s\n" % (region, region_face[region]) for region in REGIONS]
    out.append("END\n")
    volume = 0.0
    for corners in (c for region in REGIONS for c in by_region[region]):
        a, b, c, d = (lattice.node(*p) for p in corners)
        volume += abs(sum(n * (e - f) for n, e, f in zip(normal(a, b, c), d, a))) / 6
    assert abs(volume - LENGTH * WIDTH * HEIGHT) < 1e-6 * volume
    return "".join(out)


# ---------------------------------------------------------------------------------------------- points, wells, grids

def point_set():
    """Picks of H1, some without a confidence."""
    lattice = Lattice(3, 3, 3)
    out = ["GOCAD VSet 1\nHEADER {\nname:H1_picks\n*atoms*color:#d9a441\n}\n", COORDINATES,
           "GEOLOGICAL_FEATURE H1\nGEOLOGICAL_TYPE top\n", properties([("confidence", "none"), ("two_way_time", "ms")])]
    number = 0
    for j in range(4):
        for i in (0, 1, 2, 4, 5, 6):
            number += 1
            point = lattice.node(i, j, 1 if i < 3 else 2)
            confidence = "-99999" if (i + j) % 5 == 0 else text(round(1.0 - 0.05 * (i + j), 2))
            out.append("PVRTX %d %s %s %s\n" % (number, place(point), confidence, text(round(-point[2] / 1.25, 3))))
    return "".join(out) + "END\n"


def well(name, head, kelly_bushing, stations, markers, zones, log):
    """Stations are (measured depth, elevation, dx, dy)."""
    out = ["GOCAD Well 1\nHEADER {\nname:%s\n}\n" % name, COORDINATES, "PATH_ZM_UNIT m\nWREF %s\n" % place(head),
           "DATUM KellyBushing\nKB %s\n" % text(kelly_bushing)]
    out += ["PATH %s\n" % " ".join(text(v) for v in station) for station in stations]
    for marker, depth in markers:
        out.append("MRKR %s 1 %s\nFEATURE %s\n" % (marker, text(depth), marker))
    out += ["ZONE %s %s %s %d\n" % (zone, text(top), text(base), n + 1) for n, (zone, top, base) in enumerate(zones)]
    out.append("WELL_CURVE\nPROPERTY gamma_ray\nPROP_UNIT API\nPROP_NO_DATA_VALUE -999.25\nZM_UNIT m\n")
    out += ["REC %s %s\n" % (text(depth), text(value)) for depth, value in log]
    out.append("END_CURVE\nEND\n")
    return "".join(out)


def wells():
    straight = [(float(md), 25.0 - md, 0.0, 0.0) for md in range(0, 901, 100)]
    log = [(float(md), -999.25 if md == 400 else round(60.0 + 30.0 * math.sin(md / 90.0), 2)) for md in range(100, 900, 50)]
    first = well("W-1", (200.0, 400.0, 25.0), 25.0, straight, [("H1", 317.5), ("H2", 717.5)],
                 [("layer_1", 25.0, 317.5), ("layer_2", 317.5, 717.5)], log)
    # Down to 300 m, then 300 m east for each 400 m down: a 3-4-5 triangle, so that lengths are whole numbers.
    deviated = [(0.0, 25.0, 0.0, 0.0), (300.0, -275.0, 0.0, 0.0), (550.0, -475.0, 150.0, 0.0), (800.0, -675.0, 300.0, 0.0)]
    second = well("W-2", (600.0, 300.0, 25.0), 25.0, deviated, [("H1", 440.3)], [("layer_1", 25.0, 440.3)],
                  [(float(md), round(45.0 + md / 20.0, 2)) for md in range(100, 800, 100)])
    return first + second


def horizon_height(x, y):
    return round(-300.0 + 20.0 * math.sin(x / 150.0) - y / 40.0, 3)


def irap_grid():
    """7 x 5 nodes, turned by 30 degrees; two nodes are missing."""
    columns, rows, step, angle, x0, y0 = 7, 5, 100.0, 30.0, 300.0, 50.0
    out = ["-996 %d %s %s\n" % (rows, text(step), text(step)),
           "%s %s %s %s\n" % (text(x0), text(x0 + (columns - 1) * step), text(y0), text(y0 + (rows - 1) * step)),
           "%d %s %s %s\n" % (columns, text(angle), text(x0), text(y0)), "0 0 0 0 0 0 0\n"]
    heights = []
    for j in range(rows):
        for i in range(columns):
            missing = (i, j) in ((6, 4), (0, 0))
            heights.append("9999900.0" if missing else text(horizon_height(i * step, j * step)))
    out += [" ".join(heights[n:n + 6]) + "\n" for n in range(0, len(heights), 6)]
    return "".join(out)


def two_maps(base):
    """A map of 41 x 31 nodes, 25 m apart; depths. A fault dips to the east at x = 500 or so and dies out at y = 100 and y = 600; the
    torn part of the map rises evenly from one side to the other."""
    columns, rows, step = 41, 31, 25.0
    out = ["-996 %d %s %s\n" % (rows, text(step), text(step)), "0.0 %s 0.0 %s\n" % (text((columns - 1) * step), text((rows - 1) * step)),
           "%d 0.0 0.0 0.0\n" % columns, "0 0 0 0 0 0 0\n"]
    depths = []
    for j in range(rows):
        for i in range(columns):
            x, y = i * step, j * step
            half = 20.0 * (1.0 - ((y - 350.0) / 250.0) ** 2)  # of the torn part
            throw = 40.0 * half / 20.0 if half > 0.0 else 0.0
            share = 0.5 if half <= 0.0 else min(1.0, max(0.0, (x - 500.0 - 0.1 * (y - 350.0) + half) / (2.0 * half)))
            depths.append(text(round(1500.0 + x / 50.0 + y / 40.0 + throw * (share - 0.5) + (60.0 + x / 100.0 if base else 0.0), 3)))
    out += [" ".join(depths[n:n + 6]) + "\n" for n in range(0, len(depths), 6)]
    return "".join(out)


def fault_polygon():
    """The ring around the torn part of the two maps: IRAP polygons."""
    def side(sign):
        rows = [100.0 + 50.0 * n for n in range(11)]
        return [(500.0 + 0.1 * (y - 350.0) + sign * 20.0 * (1.0 - ((y - 350.0) / 250.0) ** 2), y) for y in rows]
    ring = side(-1.0) + side(1.0)[-2:0:-1]
    ring.append(ring[0])
    lines = ["%s %s %s\n" % (text(round(x, 3)), text(y), text(round(1500.0 + x / 50.0 + y / 40.0, 3))) for x, y in ring]
    return "".join(lines) + "999.0 999.0 999.0\n"


def zmap_grid():
    """4 rows and 6 columns; fields of ten characters, without blanks between the missing ones."""
    rows, columns = 4, 6
    out = ["! H1 as a ZMAP+ grid: columns from west to east, each from north to south\n", "@H1 HEADER, GRID, 3\n",
           "10, -99999.999, , 3, 1\n", "%d, %d, 0.0, 1000.0, 0.0, 600.0\n" % (rows, columns), "0.0, 0.0, 0.0\n", "@\n"]
    for i in range(columns):
        fields = []
        for j in reversed(range(rows)):
            height = -99999.999 if i == 5 and j < 3 else horizon_height(i * 200.0, j * 200.0)
            fields.append("%10.3f" % height)
        out += ["".join(fields[n:n + 3]) + "\n" for n in range(0, rows, 3)]
    return "".join(out)


# ------------------------------------------------------------------------------------------------- corner-point grid

def numbers(keyword, values, per_line=8):
    """A keyword of a deck with its values, equal neighbours as repeats."""
    words, n = [], 0
    while n < len(values):
        end = n
        while end < len(values) and values[end] == values[n]:
            end += 1
        words.append(text(values[n]) if end == n + 1 else "%d*%s" % (end - n, text(values[n])))
        n = end
    lines = [" ".join(words[n:n + per_line]) for n in range(0, len(words), per_line)]
    return keyword + "\n" + "\n".join(lines) + " /\n\n"


def pillar_grid():
    """8 x 5 x 4 cells of 100 x 100 m: a fault with 24 m of throw, layer 2 pinched out in the north-east, pillars that
    lean to the east, one cell inactive."""
    nx, ny, nz = 8, 5, 4
    thick = [12.0, 8.0, 15.0, 10.0]
    coord, zcorn = [], []
    for j in range(ny + 1):
        for i in range(nx + 1):
            coord += [100.0 * i, 100.0 * j, 1900.0, 100.0 * i + 30.0, 100.0 * j, 2100.0]

    def depth(i, j, k, east, south, below):
        """Depth of one corner of cell (i, j, k)."""
        u, v = i + east, j + south
        z = 1950.0 + 0.5 * (u - 3) * (u - 3) + 3.0 * v + (24.0 if i >= 4 else 0.0)
        for layer in range(k + below):
            pinched = layer == 1 and u >= 6 and v >= 2
            z += 0.0 if pinched else thick[layer]
        return round(z, 3)

    for k in range(nz):
        for below in (0, 1):
            for j in range(ny):
                for south in (0, 1):
                    for i in range(nx):
                        zcorn += [depth(i, j, k, 0, south, below), depth(i, j, k, 1, south, below)]
    cells = [(i, j, k) for k in range(nz) for j in range(ny) for i in range(nx)]
    out = ["-- A small faulted corner-point grid: see samples/README.md\n\nSPECGRID\n%d %d %d 1 F /\n\n" % (nx, ny, nz),
           "MAPUNITS\nMETRES /\n\nMAPAXES\n451000 5933500 451000 5933000 451800 5933000 /\n\nGRIDUNIT\nMETRES /\n\n",
           numbers("COORD", coord, 6), numbers("ZCORN", zcorn),
           numbers("ACTNUM", [0 if c == (0, 0, 0) else 1 for c in cells]),
           numbers("PORO", [round(0.15 + 0.02 * k + 0.005 * ((i + j) % 3), 3) for i, j, k in cells]),
           numbers("PERMX", [float(50 + 40 * k + 10 * (i % 4)) for i, j, k in cells]),
           numbers("PERMZ", [float(5 + 4 * k) for i, j, k in cells]),
           numbers("FIPNUM", [1 if k < 2 else 2 for i, j, k in cells]),
           "FAULTS\n'MAIN' 4 4 1 5 1 4 X /\n/\n\nMULTFLT\n'MAIN' 0.1 /\n/\n"]
    return "".join(out)


def plain_surface(name, role, points, triangles):
    """A TSurf by itself."""
    lines = ["GOCAD TSurf 1\nHEADER {\nname: %s\n}\nGEOLOGICAL_TYPE %s\nTFACE\n" % (name, role)]
    lines += ["VRTX %d %g %g %g\n" % ((i + 1,) + tuple(p)) for i, p in enumerate(points)]
    lines += ["TRGL %d %d %d\n" % tuple(v + 1 for v in t) for t in triangles]
    return "".join(lines) + "END\n"


def crossing_sheets():
    """A box of six loose sides with a horizon and a fault that stick out of it and cross: nothing is cut."""
    corners = [(x, y, z) for z in (0, 4) for y in (0, 8) for x in (0, 10)]
    sides = {"base": (0, 2, 3, 1), "top": (4, 5, 7, 6), "south": (0, 1, 5, 4), "north": (2, 6, 7, 3), "west": (0, 4, 6, 2),
             "east": (1, 3, 7, 5)}
    halves = [(0, 1, 2), (0, 2, 3)]
    out = [plain_surface(name, "boundary", [corners[c] for c in ring], halves) for name, ring in sides.items()]
    out.append(plain_surface("H1", "top", [(-0.5, -0.5, 1.9), (10.5, -0.5, 2.1), (10.5, 8.5, 2.3), (-0.5, 8.5, 2.1)], halves))
    out.append(plain_surface("F1", "fault", [(4, -0.4, -0.2), (4, 8.4, -0.2), (6, 8.4, 4.2), (6, -0.4, 4.2)], halves))
    return "".join(out)


def open_layers():
    """Two wavy horizons without sides."""
    n = 6
    triangles = []
    for a in (j * (n + 1) + i for j in range(n) for i in range(n)):
        triangles += [(a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1)]
    out = []
    for h in range(2):
        points = [(100 * i / n, 80 * j / n, round(-10 * h + 2 * math.sin(i / 2) + math.cos(j / 2), 3)) for j in range(n + 1) for i in range(n + 1)]
        out.append(plain_surface("H%d" % (h + 1), "top", points, triangles))
    return "".join(out)


def main(folder):
    lattice = Lattice(3, 3, 3)
    patches = patches_of(lattice)
    volumes = check_sealed(lattice, patches)
    coarse = Lattice(2, 2, 2)
    coarse_patches = patches_of(coarse)
    check_sealed(coarse, coarse_patches)
    files = {
        "layered_box.ml": sealed_box(lattice, patches),
        "layered_box_loose.ts": loose_box(lattice, patches),
        "layered_box_gap.ml": box_with_gap(lattice, patches),
        "layered_box_bad_triangles.ml": box_with_bad_triangles(lattice, patches),
        "layered_box.so": solid(coarse, coarse_patches),
        "h1_picks.vs": point_set(),
        "wells.wl": wells(),
        "h1_grid.irap": irap_grid(),
        "h1_grid.zmap": zmap_grid(),
        "top_map.irap": two_maps(False),
        "base_map.irap": two_maps(True),
        "top_faults.pol": fault_polygon(),
        "faulted_grid.grdecl": pillar_grid(),
        "crossing_sheets.ts": crossing_sheets(),
        "open_layers.ts": open_layers(),
    }
    for name, content in files.items():
        with open(os.path.join(folder, name), "w", encoding="ascii", newline="\n") as file:
            file.write(content)
    for region, volume in volumes.items():
        print("%-7s %.6g m3" % (region, volume))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__)))
