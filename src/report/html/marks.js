// SPDX-License-Identifier: AGPL-3.0-or-later
// The marks of findings, on a canvas of their own above either view: always visible, also behind surfaces, and picked here.
// A view gives matrix() (column by column: world, with heights stretched by `stretch`, to clip space).

const severityColours = {error: '#d6003c', warning: '#f08000', info: '#0a6cff'};
const selectedColour = '#111111';
const manyPrimitives = 60000;  // beyond, only findings that are selected are drawn in full

class Marks {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.shown = [];
    this.selected = null;
    this.stretch = 1;
  }

  // list: [{row, severity, code, mark}] in the order in which they are drawn.
  show(list) {
    this.shown = list;
    this.primitives = 0;
    for (const {mark} of list) {
      this.primitives += mark.points.length / 3 + mark.triangles.length / 9;
      for (const line of mark.lines) this.primitives += line.length / 3;
      for (const line of mark.outlines) this.primitives += line.length / 3;
    }
  }

  resize(width, height, ratio) {
    this.width = width;
    this.height = height;
    this.ratio = ratio;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
  }

  // [x, y, depth] in pixels for each xyz; NaN behind the eye.
  project(xyz, m) {
    const out = new Float32Array(xyz.length);
    for (let i = 0; i + 2 < xyz.length; i += 3) {
      const x = xyz[i], y = xyz[i + 1], z = xyz[i + 2] * this.stretch;
      const w = m[3] * x + m[7] * y + m[11] * z + m[15];
      const seen = w > 0;
      out[i] = seen ? (0.5 + 0.5 * (m[0] * x + m[4] * y + m[8] * z + m[12]) / w) * this.width : NaN;
      out[i + 1] = seen ? (0.5 - 0.5 * (m[1] * x + m[5] * y + m[9] * z + m[13]) / w) * this.height : NaN;
      out[i + 2] = seen ? (m[2] * x + m[6] * y + m[10] * z + m[14]) / w : NaN;
    }
    return out;
  }

  draw(matrix) {
    const c = this.context;
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.clearRect(0, 0, this.width, this.height);
    c.lineJoin = c.lineCap = 'round';
    const many = this.primitives > manyPrimitives;
    this.faint = this.selected ? 0.4 : 1;
    for (const one of this.shown) {
      if (one.row !== this.selected) this.drawOne(one, matrix, false, many);
    }
    for (const one of this.shown) {
      if (one.row === this.selected) this.drawOne(one, matrix, true, false);
    }
  }

  drawOne(one, matrix, selected, onlyAnchor) {
    const c = this.context, colour = severityColours[one.severity];
    const faint = selected ? 1 : this.faint;
    if (onlyAnchor) return this.discs([one.anchor], matrix, colour, 3, faint);
    c.strokeStyle = c.fillStyle = colour;
    const small = this.fillTriangles(one.mark.triangles, matrix, selected ? 0.55 : 0.3 * faint);
    if (selected) {
      c.globalAlpha = 0.5;
      this.strokeLines(one.mark.outlines, matrix, selectedColour, 3);
      this.strokeLines(one.mark.lines, matrix, selectedColour, 6);
    }
    c.globalAlpha = selected ? 1 : 0.8 * faint;
    this.strokeLines(one.mark.outlines, matrix, colour, selected ? 1.5 : 1);
    this.strokeLines(one.mark.lines, matrix, colour, selected ? 3.5 : 2.5);
    this.discs(small, null, colour, selected ? 4 : 2.5, faint);
    this.discs([one.mark.points], matrix, colour, selected ? 6 : 4, faint);
    if (selected) this.label(one, matrix);
  }

  // Fills triangles; gives the places of those that are too small to be seen.
  fillTriangles(xyz, matrix, alpha) {
    const c = this.context, p = this.project(xyz, matrix), small = [];
    c.globalAlpha = alpha;
    c.beginPath();
    for (let i = 0; i + 8 < p.length; i += 9) {
      const ax = p[i], ay = p[i + 1], bx = p[i + 3], by = p[i + 4], cx = p[i + 6], cy = p[i + 7];
      const turn = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
      if (Number.isNaN(turn)) continue;
      if (Math.max(Math.abs(bx - ax), Math.abs(cx - ax), Math.abs(by - ay), Math.abs(cy - ay)) < 4) small.push(p.subarray(i, i + 3));
      // All the same way round, so that what overlaps is filled once.
      c.moveTo(ax, ay);
      c.lineTo(turn > 0 ? bx : cx, turn > 0 ? by : cy);
      c.lineTo(turn > 0 ? cx : bx, turn > 0 ? cy : by);
      c.closePath();
    }
    c.fill();
    c.globalAlpha = 1;
    return small;
  }

  strokeLines(lines, matrix, colour, width) {
    const c = this.context;
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.beginPath();
    for (const line of lines) {
      const p = this.project(line, matrix);
      let drawing = false;
      for (let i = 0; i + 2 < p.length; i += 3) {
        const seen = !Number.isNaN(p[i]);
        if (seen && drawing) c.lineTo(p[i], p[i + 1]);
        else if (seen) c.moveTo(p[i], p[i + 1]);
        drawing = seen;
      }
    }
    c.stroke();
  }

  // Discs at arrays of xyz, or of pixels where no matrix is given.
  discs(arrays, matrix, colour, radius, alpha) {
    const c = this.context;
    c.globalAlpha = alpha;
    c.fillStyle = colour;
    c.strokeStyle = '#ffffff';
    c.lineWidth = 1.25;
    for (const xyz of arrays) {
      const p = matrix ? this.project(xyz, matrix) : xyz;
      for (let i = 0; i + 1 < p.length; i += 3) {
        if (Number.isNaN(p[i])) continue;
        c.beginPath();
        c.arc(p[i], p[i + 1], radius, 0, 2 * Math.PI);
        c.fill();
        c.stroke();
      }
    }
  }

  label(one, matrix) {
    const c = this.context, p = this.project(one.anchor, matrix);
    if (Number.isNaN(p[0])) return;
    c.font = '600 12px system-ui, sans-serif';
    const width = c.measureText(one.code).width + 12, x = p[0] + 12, y = p[1] - 30;
    c.strokeStyle = selectedColour;
    c.lineWidth = 1.5;
    c.beginPath();
    c.moveTo(p[0], p[1]);
    c.lineTo(x + 6, y + 20);
    c.stroke();
    c.fillStyle = selectedColour;
    c.fillRect(x, y, width, 20);
    c.fillStyle = '#ffffff';
    c.fillText(one.code, x + 6, y + 14);
  }

  // The row whose mark is nearest to a pixel, at most 9 pixels away; of those that cover it the one in front.
  pick(x, y, matrix) {
    let best = null, nearest = 9, front = Infinity;
    const take = (row, distance, depth) => {
      if (distance > nearest || (distance === nearest && depth >= front)) return;
      [best, nearest, front] = [row, distance, depth];
    };
    for (const {row, mark} of this.shown) {
      const points = this.project(mark.points, matrix), t = this.project(mark.triangles, matrix);
      // What is drawn above areas is also picked before them.
      for (let i = 0; i + 2 < points.length; i += 3)
        take(row, Math.max(0, Math.hypot(points[i] - x, points[i + 1] - y) - 4), -1 + 1e-6 * points[i + 2]);
      for (const line of mark.lines) {
        const p = this.project(line, matrix);
        for (let i = 0; i + 5 < p.length; i += 3) take(row, Math.max(0, fromSegment(x, y, p, i) - 2), p[i + 2]);
      }
      for (let i = 0; i + 8 < t.length; i += 9) {
        const distance = inTriangle(x, y, t, i) ? 0 : Math.min(fromSegment(x, y, t, i), fromSegment(x, y, t, i + 3));
        take(row, distance, (t[i + 2] + t[i + 5] + t[i + 8]) / 3);
      }
    }
    return best;
  }
}

// Distance of a pixel from the segment between points i and i + 3 of an array.
function fromSegment(x, y, p, i) {
  const dx = p[i + 3] - p[i], dy = p[i + 4] - p[i + 1], square = dx * dx + dy * dy;
  const along = square > 0 ? Math.min(1, Math.max(0, ((x - p[i]) * dx + (y - p[i + 1]) * dy) / square)) : 0;
  return Math.hypot(p[i] + along * dx - x, p[i + 1] + along * dy - y);
}

function inTriangle(x, y, p, i) {
  let left = 0, right = 0;
  for (let a = 0; a < 3; ++a) {
    const from = i + 3 * a, to = i + 3 * ((a + 1) % 3);
    const side = (p[to] - p[from]) * (y - p[from + 1]) - (p[to + 1] - p[from + 1]) * (x - p[from]);
    if (side > 0) ++left;
    else if (side < 0) ++right;
    else if (Number.isNaN(side)) return false;
  }
  return left === 0 || right === 0 ? left + right > 0 : false;
}
