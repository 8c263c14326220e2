// SPDX-License-Identifier: AGPL-3.0-or-later
// Arrays of numbers as they stand in the page: base64 of little-endian values.

function bytesOf(text) {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes;
}

function numbersOf(text, size, read, Kind) {
  const bytes = bytesOf(text || '');
  const view = new DataView(bytes.buffer);
  const numbers = new Kind(bytes.length / size);
  for (let i = 0; i < numbers.length; ++i) numbers[i] = read(view, size * i);
  return numbers;
}

const floatsOf = (text) => numbersOf(text, 4, (view, at) => view.getFloat32(at, true), Float32Array);
const countsOf = (text) => numbersOf(text, 4, (view, at) => view.getUint32(at, true), Uint32Array);

// A part of the scene with its arrays; lines are arrays of point numbers.
function decodedPart(part) {
  const flat = countsOf(part.lines), lengths = part.lengths || [], lines = [];
  let at = 0;
  for (const length of lengths) lines.push(flat.subarray(at, at += length));
  return {kind: part.kind, name: part.name, id: part.id, role: part.role,
          points: floatsOf(part.points), triangles: countsOf(part.triangles), lines, change: part.change || '',
          moved: part.moved ? floatsOf(part.moved) : null};
}

// A finding's mark: points, lines and outlines (arrays of xyz each), triangles (nine numbers each).
function decodedMark(mark) {
  if (!mark) return null;
  const cut = (text, lengths) => {
    const flat = floatsOf(text), pieces = [];
    let at = 0;
    for (const length of lengths || []) pieces.push(flat.subarray(3 * at, 3 * (at += length)));
    return pieces;
  };
  return {points: floatsOf(mark.points), lines: cut(mark.lines, mark.lengths),
          outlines: cut(mark.outlines, mark.outline_lengths), triangles: floatsOf(mark.triangles)};
}

// Grows [xmin, ymin, zmin, xmax, ymax, zmax] by the points of an array of xyz.
function grow(bounds, xyz) {
  for (let i = 0; i + 2 < xyz.length; i += 3) {
    for (let a = 0; a < 3; ++a) {
      if (xyz[i + a] < bounds[a]) bounds[a] = xyz[i + a];
      if (xyz[i + a] > bounds[3 + a]) bounds[3 + a] = xyz[i + a];
    }
  }
  return bounds;
}
const noBounds = () => [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];

function boundsOfMark(mark) {
  const bounds = noBounds();
  for (const xyz of [mark.points, mark.triangles, ...mark.lines, ...mark.outlines]) grow(bounds, xyz);
  return bounds;
}
