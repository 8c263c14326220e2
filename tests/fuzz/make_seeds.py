#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Makes the seeds of the whole path: make_seeds.py GEOMEND. Packs (whole_path.h) of the seeds of the readers, and of small models in
each format that GEOMEND writes, go to corpus/whole_path. Seeds that a long run found stand there, too, and stay."""
import pathlib
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
corpus = here / 'corpus'
target = corpus / 'whole_path'
program = pathlib.Path(sys.argv[1]).resolve()

# Leading bytes that choose for the target of a reader, and the extensions that tell the formats apart.
readers = {'eclipse': 1, 'gmsh': 0, 'gocad': 0, 'grdecl': 1, 'horizon': 2, 'mesh': 1, 'ringmesh': 1, 'roff': 0, 'surface': 1, 'vtk_legacy': 0, 'vtk_xml': 0, 'well': 1}
extensions = {'bgrdecl': '.bgrdecl', 'egrid': '.egrid', 'fegrid': '.fegrid', 'fgrid': '.fgrid', 'finit': '.finit', 'funrst': '.funrst',
              'grid': '.grid', 'init': '.init', 'long_count': '.egrid', 'unrst': '.unrst', 'deck': '.data', 'cps3': '.cps3',
              'cps3_lines': '.cps3lines', 'irap_grid': '.irap', 'irap_grid_binary': '.gri', 'irap_grid_binary_little': '.gri',
              'irap_points': '.irapp', 'irap_polygons': '.pol', 'petrel_points': '.petrelpoints', 'rms_points': '.rmsattr', 'zmap': '.zmap',
              'zmap_implied': '.zmap', 'binary': '.roff', 'text': '.roffasc', 'stl_text': '.stl', 'stl_binary': '.stl', 'obj': '.obj', 'ply_text': '.ply',
              'ply_little': '.ply', 'ply_big': '.ply', 'off': '.off', 'smesh': '.smesh', 'medit_binary': '.meshb',
              'abaqus': '.inp', 'parts': '.inp', 'medit': '.mesh', 'nodes': '.node',
              'zmap_lines': '.zmaplines', 'points_table': '.csv', 'ijxyz': '.ijxyz',
              'rms_wells': '.rmswell', 'petrel_path': '.dev', 'path_table': '.dev', 'resinsight_path': '.dev'}

deck = """SPECGRID
 2 2 3 1 F /
COORD
 0 0 0 0 0 10  1 0 0 1 0 10  2 0 0 2 0 10
 0 1 0 0 1 10  1 1 0 1 1 10  2 1 0 2 1 10
 0 2 0 0 2 10  1 2 0 1 2 10  2 2 0 2 2 10 /
ZCORN
 2*0 2*0.5 2*0 2*0.5 2*0 2*0.5 2*0 2*0.5
 2*1 2*1.5 2*1 2*1.5 2*1 2*1.5 2*1 2*1.5
 2*1 2*1.5 2*1 2*1.5 2*1 2*1.5 2*1 2*1.5
 2*2 2*2.5 2*2 2*2.5 2*2 2*2.5 2*2 2*2.5
 2*2 2*2.5 2*2 2*2.5 2*2 2*2.5 2*2 2*2.5
 2*3 2*3.5 2*3 2*3.5 2*3 2*3.5 2*3 2*3.5 /
ACTNUM
 11*1 0 /
PORO
 12*0.2 /
PERMX
 12*100 /
FIPNUM
 6*1 6*2 /
FAULTS
 'F' 1 1 1 2 1 3 X /
/
"""

columns = """SPECGRID
 1 1 2 1 F /
COORD
 0 0 0 0 0 10  1 0 0 1 0 10
 0 1 0 0 1 10  1 1 0 1 1 10 /
ZCORN
 4*0 4*1 4*1 4*2 /
FIPNUM
 1 2 /
"""

piece = """<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0
1 0 0
0 1 0
0 0 %s
</DataArray></Points><Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray>
</Cells><CellData><DataArray type="Int32" Name="region" format="ascii">%s</DataArray></CellData></Piece></UnstructuredGrid></VTKFile>
"""

pieces = """<VTKFile type="PUnstructuredGrid" version="1.0"><PUnstructuredGrid GhostLevel="0">
<PPoints><PDataArray type="Float64" NumberOfComponents="3"/></PPoints>
<PCellData><PDataArray type="Int32" Name="region"/></PCellData>
<Piece Source="a.vtu"/>
<Piece Source="b.vtu"/>
</PUnstructuredGrid></VTKFile>
"""

blocks = """<VTKFile type="vtkMultiBlockDataSet" version="1.0"><vtkMultiBlockDataSet>
<Block index="0" name="m"><DataSet index="0" name="A" file="a.vtu"/>
<DataSet index="1" name="B" file="b.vtu"/></Block></vtkMultiBlockDataSet></VTKFile>
"""

points = '<DataArray type="Float64" NumberOfComponents="3" format="ascii">%s</DataArray>'


def file_of(kind, whole, inner):
    return f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian"><{kind} {whole}>\n{inner}</{kind}></VTKFile>\n'


def lattice(kind, first, last):
    """A piece of a lattice of one layer of cells: columns first to last."""
    extent = f'{first} {last} 0 1 0 1'
    across = range(first, last + 1)
    values = ' '.join(str(i + 1) for i in range(4 * len(across)))
    inner = f'<Piece Extent="{extent}"><PointData><DataArray type="Float32" Name="v" format="ascii">{values}</DataArray></PointData>\n'
    axis = '<DataArray type="Float64" Name="%s" format="ascii">%s</DataArray>'
    if kind == 'StructuredGrid':
        inner += '<Points>' + points % '\n'.join(f'{i} {j} {k + 0.1 * i}' for k in (0, 1) for j in (0, 1) for i in across) + '</Points>'
    if kind == 'RectilinearGrid':
        inner += '<Coordinates>' + axis % ('x', ' '.join(str(i * i) for i in across)) + axis % ('y', '0 1') + axis % ('z', '0 2')
        inner += '</Coordinates>'
    more = ' Origin="0 0 0" Spacing="1 2 3"' if kind == 'ImageData' else ''
    return file_of(kind, f'WholeExtent="{extent}"{more}', inner + '</Piece>\n').encode()


def lattice_index(kind, extension):
    inner = '<PPointData><PDataArray type="Float32" Name="v"/></PPointData>\n'
    three = '<PDataArray type="Float64" NumberOfComponents="3"/>'
    if kind == 'StructuredGrid':
        inner += f'<PPoints>{three}</PPoints>\n'
    if kind == 'RectilinearGrid':
        inner += '<PCoordinates>' + ''.join(f'<PDataArray type="Float64" Name="{a}"/>' for a in 'xyz') + '</PCoordinates>\n'
    inner += f'<Piece Extent="0 1 0 1 0 1" Source="a.{extension}"/>\n<Piece Extent="1 3 0 1 0 1" Source="b.{extension}"/>\n'
    more = ' Origin="0 0 0" Spacing="1 2 3"' if kind == 'ImageData' else ''
    return file_of('P' + kind, f'WholeExtent="0 3 0 1 0 1" GhostLevel="0"{more}', inner).encode()


def triangle(x):
    corners = points % f'{x} 0 0\n{x + 1} 0 0\n{x} 1 0'
    cells = '<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>'
    cells += '<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>'
    inner = f'<Piece NumberOfPoints="3" NumberOfPolys="1"><Points>{corners}</Points>\n<Polys>{cells}</Polys></Piece>\n'
    return file_of('PolyData', '', inner).encode()


def pack(name, files):
    """files: [(name, bytes)], the first is the one that is read."""
    content = b'0000'
    for file_name, data in files:
        if len(content) > 4 and not content.endswith(b'\n'):
            content += b'\n'
        content += b'%%% ' + file_name.encode() + b'\n' + data
    (target / (name + '.pack')).write_bytes(content)


def pack_readers():
    for folder, skip in readers.items():
        for path in sorted((corpus / folder).iterdir()):
            if path.suffix == '.pack':  # files of an archive: the archive itself is beside it
                continue
            extension = '' if path.suffix else extensions.get(path.name, '.grdecl')
            pack(f'{folder}_{path.name}', [(path.name + extension, path.read_bytes()[skip:])])


def written(folder, source, output, options=()):
    """The files that a conversion writes, the main one first; nothing where the target cannot hold the source."""
    out = folder / output
    words = [program, 'convert', '--lossy', '--quiet', '--accept-unterminated', source, '-o', out]
    for option in options:
        words += ['--option', option]
    before = set(folder.rglob('*'))
    if subprocess.run(words, stderr=subprocess.DEVNULL).returncode != 0:
        return []
    others = sorted(p for p in set(folder.rglob('*')) - before if p.is_file() and p != out)
    return [(str(p.relative_to(folder)), p.read_bytes()) for p in [out, *others]]


def pack_written(folder):
    (folder / 'deck.grdecl').write_text(deck)
    (folder / 'columns.grdecl').write_text(columns)
    models = [('faulted', 'deck.grdecl', ['as=brep', 'horizons=1']), ('columns', 'columns.grdecl', ['as=brep', 'regions=FIPNUM'])]
    for name, source, options in models:
        pack(f'{name}.ml', written(folder, folder / source, name + '.ml', options))
    solid = folder / 'solid.so'
    solid.write_bytes((corpus / 'gocad' / 'solid.so').read_bytes())
    for extension in ('msh', 'vtm', 'vtu', 'vtp', 'so', 'ts', 'vtk'):
        for source in ('columns.ml', 'solid.so', 'deck.grdecl'):
            encoding = 'ascii' if extension in ('vtm', 'vtu', 'vtp') else 'text'
            files = written(folder, folder / source, f'{source.split(".")[0]}_as.{extension}', ['encoding=' + encoding])
            if files and sum(len(data) for _, data in files) < 20000:
                pack(f'written_{source}.{extension}', files)
    for source, extension in (('voxet.vo', 'vo'), ('well.wl', 'wl'), ('light.lso', 'lso'), ('group.gp', 'gp')):
        (folder / source).write_bytes((corpus / 'gocad' / source).read_bytes())
        pack(f'written_{extension}', written(folder, folder / source, 'w.' + extension))
    for source, extension, output in (('zmap', 'zmap', 'gs'), ('irap_polygons', 'pol', 'pl')):
        (folder / f'{source}.{extension}').write_bytes((corpus / 'horizon' / source).read_bytes()[readers['horizon']:])
        pack(f'written_{output}', written(folder, folder / f'{source}.{extension}', 'h.' + output))
    for source, outputs in (('deck.grdecl', ('egrid', 'fegrid', 'bgrdecl', 'roff', 'roffasc', 'sg', 'vts', 'data', 'init')),
                            ('../h1_grid.irap', ())):
        for extension in outputs:
            files = written(folder, folder / source, 'g.' + extension)
            if files:
                pack(f'grid_{extension}', files)


def pack_several():
    a, b = (piece % ('1', '1')).encode(), (piece % ('-1', '2')).encode()
    pack('pieces.pvtu', [('m.pvtu', pieces.encode()), ('a.vtu', a), ('b.vtu', b)])
    pack('blocks.vtm', [('m.vtm', blocks.encode()), ('a.vtu', a), ('b.vtu', b)])
    series = ('<VTKFile type="Collection" version="1.0"><Collection>\n<DataSet timestep="0" part="0" name="A" file="a.vtu"/>\n'
              '<DataSet timestep="1" part="0" file="b.vtu"/>\n</Collection></VTKFile>\n')
    pack('series.pvd', [('m.pvd', series.encode()), ('a.vtu', a), ('b.vtu', b)])
    surfaces = '<PPoints><PDataArray type="Float64" NumberOfComponents="3"/></PPoints><Piece Source="a.vtp"/>\n<Piece Source="b.vtp"/>\n'
    pack('pieces.pvtp', [('m.pvtp', file_of('PPolyData', 'GhostLevel="0"', surfaces).encode()), ('a.vtp', triangle(0)), ('b.vtp', triangle(1))])
    for kind, extension in (('StructuredGrid', 'vts'), ('ImageData', 'vti'), ('RectilinearGrid', 'vtr')):
        parts = [('a.' + extension, lattice(kind, 0, 1)), ('b.' + extension, lattice(kind, 1, 3))]
        pack('pieces.p' + extension, [('m.p' + extension, lattice_index(kind, extension)), *parts])
        pack('lattice.' + extension, [('m.' + extension, lattice(kind, 0, 3))])
    pack('tetgen.ele', [('m.ele', b'1 4 1\n1 1 2 3 4 1\n'), ('m.node', b'4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n'),
                        ('m.face', b'1 1\n1 1 2 3 2\n')])
    cut = deck.index('PORO')
    pack('include.grdecl', [('m.grdecl', (deck[:cut] + "INCLUDE\n 'p.inc' /\n").encode()), ('p.inc', deck[cut:].encode())])
    pack('include.data', [('m.data', ("RUNSPEC\nDIMENS\n 2 2 3 /\nGRID\nINCLUDE\n 'g.inc' /\nEND\n").encode()), ('g.inc', deck.encode())])


def pack_companions(folder):
    """A deck that takes its grid from a binary file, and properties beside theirs."""
    (folder / 'deck.grdecl').write_text(deck)
    egrid = written(folder, folder / 'deck.grdecl', 'G.EGRID')
    init = written(folder, folder / 'deck.grdecl', 'G.INIT')
    if egrid:
        pack('gdfile.grdecl', [('m.grdecl', b"SPECGRID\n 2 2 3 1 F /\nGDFILE\n 'G.EGRID' /\nPORO\n 12*0.2 /\n"), egrid[0]])
    if egrid and init:
        pack('grid_and_init', [init[0], egrid[0]])


def main():
    target.mkdir(exist_ok=True)
    pack_readers()
    pack_several()
    with tempfile.TemporaryDirectory() as folder:
        pack_written(pathlib.Path(folder))
    with tempfile.TemporaryDirectory() as folder:
        pack_companions(pathlib.Path(folder))
    for name in ('h1_grid.irap', 'h1_grid.zmap', 'h1_picks.vs', 'wells.wl'):
        pack('sample_' + name, [(name, (here.parent.parent / 'samples' / name).read_bytes())])


main()
