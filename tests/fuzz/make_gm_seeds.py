#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Makes the seeds of the target ringmesh: make_gm_seeds.py. A tetrahedron of two regions, as an archive and as a pack of its files."""
import io
import pathlib
import struct
import zipfile

corpus = pathlib.Path(__file__).resolve().parent / 'corpus' / 'ringmesh'
corners = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2), (1, 0, 0)]
lines = [(4, 2), (2, 3), (3, 4), (0, 4), (4, 1), (0, 2), (1, 2), (0, 3), (1, 3)]
faces = [(4, 2, 3), (0, 2, 4), (0, 4, 3), (0, 3, 2), (4, 2, 1), (4, 1, 3), (1, 2, 3)]
cells = [(0, 4, 2, 3), (4, 1, 2, 3)]


def text(word):
    return struct.pack('<I', len(word)) + word.encode()


def chunk(kind, content):
    return kind + struct.pack('<Q', len(content)) + content


def column(of, name, kind, size, dimension, content):
    return chunk(b'ATTR', text(of) + text(name) + text(kind) + struct.pack('<II', size, dimension) + content)


def mesh(points, edges=(), triangles=(), tetrahedra=()):
    data = chunk(b'HEAD', text('GEOGRAM') + text('1.0'))
    for of, items, name, kind in (('vertices', points, 'point', 'd'), ('edges', edges, 'GEO::Mesh::edges::edge_vertex', 'I')):
        if items:
            flat = [x for item in items for x in item]
            data += chunk(b'ATTS', text('GEO::Mesh::' + of) + struct.pack('<I', len(items)))
            word, size = ('double', 8) if kind == 'd' else ('index_t', 4)
            data += column('GEO::Mesh::' + of, name, word, size, len(items[0]), struct.pack(f'<{len(flat)}{kind}', *flat))
    for of, items in (('facet', triangles), ('cell', tetrahedra)):
        if items:
            flat = [x for item in items for x in item]
            data += chunk(b'ATTS', text(f'GEO::Mesh::{of}s') + struct.pack('<I', len(items)))
            data += chunk(b'ATTS', text(f'GEO::Mesh::{of}_corners') + struct.pack('<I', len(flat)))
            data += column(f'GEO::Mesh::{of}_corners', f'GEO::Mesh::{of}_corners::corner_vertex', 'index_t', 4, 1,
                           struct.pack(f'<{len(flat)}I', *flat))
    return data


def files(filled):
    entities = 'Version 2\nGeoModel name halves\n'
    for kind, items in (('Corner', corners), ('Line', lines), ('Surface', faces), ('Region', cells)):
        entities += f'Nb {kind} {len(items)}\n'
    result = []
    for kind, word, items in (('Corner', 'PointSet', corners), ('Line', 'Line', lines), ('Surface', 'Surface', faces)):
        for i, item in enumerate(items):
            entities += f'{kind} {i} No_name Geogram{word}Mesh\nboundary {" ".join(map(str, item)) if kind == "Line" else ""}\n'
            points = [item] if kind == 'Corner' else [corners[k] for k in item]
            result.append((f'{kind}_{i}.geogram', mesh(points, [(0, 1)] if kind == 'Line' else (), [(0, 1, 2)] if kind == 'Surface' else ())))
    entities += 'Region 0 west GeogramVolumeMesh\n-0 -1 -2 -3\nRegion 1 east GeogramVolumeMesh\n+0 -4 -5 -6\nUniverse\n+1 +2 +3 +4 +5 +6\n'
    if filled:
        result += [(f'Region_{i}.geogram', mesh([corners[k] for k in cell], (), (), [(0, 1, 2, 3)])) for i, cell in enumerate(cells)]
    geology = 'Nb Interface 2\nNb Layer 1\nInterface 0 bed top\n0\nInterface 1 box boundary\n1 2 3 4 5 6\nLayer 0 all none\n0 1\n'
    return [('mesh_entities.txt', entities.encode()), ('geological_entities.txt', geology.encode()), *result]


def archive(contents):
    bytes_of = io.BytesIO()
    with zipfile.ZipFile(bytes_of, 'w', zipfile.ZIP_DEFLATED) as out:
        for name, content in contents:
            out.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED)
    return bytes_of.getvalue()


corpus.mkdir(exist_ok=True)
for name, filled in (('surfaces', False), ('cells', True)):
    (corpus / (name + '.gm')).write_bytes(b'0' + archive(files(filled)))
    (corpus / (name + '.pack')).write_bytes(b'1' + b''.join(b'%%% ' + n.encode() + b'\n' + c for n, c in files(filled)))
