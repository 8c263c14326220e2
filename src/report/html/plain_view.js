// SPDX-License-Identifier: AGPL-3.0-or-later
// The view without any library: orthographic, farthest triangles first, on a canvas. Taken where vtk.js is not in the page or
// the browser has no WebGL. Drag turns, shift or the right button moves, the wheel zooms.

const trianglesWhileTurning = 12000;

class PlainView {
  constructor(container, changed) {
    this.kind = 'plain';
    this.container = container;
    this.changed = changed;
    this.canvas = document.createElement('canvas');
    this.canvas.className = 'surfaces';
    container.append(this.canvas);
    this.context = this.canvas.getContext('2d');
    this.parts = [];
    this.stretch = 1;
    this.centre = [0, 0, 0];
    this.half = 1;  // half the height of the picture, in world units
    this.turn = -0.6;
    this.tilt = 0.5;
    this.listen();
  }

  // parts: decoded, with colour [r, g, b]; bounds: of all of them
  show(parts, bounds) {
    this.parts = parts.map((part) => ({...part, visible: true, opacity: 1, screen: new Float32Array(part.points.length)}));
    this.bounds = bounds;
    this.reset();
  }

  setLook(look) {  // {stretch, visible(part), opacityOf(part, number), pointColours}
    this.pointColours = look.pointColours;
    this.centre[2] *= look.stretch / this.stretch;
    this.stretch = look.stretch;
    this.parts.forEach((part, i) => {
      part.visible = look.visible(part);
      part.opacity = look.opacityOf(part, i);
    });
    this.render();
  }

  resize(width, height, ratio) {
    [this.width, this.height, this.ratio] = [width, height, ratio];
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.render();
  }

  reset() {
    const b = this.bounds;
    if (!(b[3] >= b[0])) return this.render();
    this.turn = -0.6;
    this.tilt = 0.5;
    const size = [b[3] - b[0], b[4] - b[1], (b[5] - b[2]) * this.stretch], {right, up} = this.axes();
    const half = (axis) => 0.5 * size.reduce((sum, v, a) => sum + Math.abs(v * axis[a]), 0);
    this.centre = [(b[0] + b[3]) / 2, (b[1] + b[4]) / 2, this.stretch * (b[2] + b[5]) / 2];
    this.half = 1.06 * Math.max(half(up), half(right) * (this.height / this.width || 1)) || 1;
    this.render();
  }

  // centre in the unstretched world, radius in the stretched one
  flyTo(centre, radius) {
    this.centre = [centre[0], centre[1], centre[2] * this.stretch];
    this.half = radius * Math.max(1, this.height / this.width || 1);
    this.render();
  }

  // What another view needs to look at the same from the same place.
  pose() { return [this.turn, this.tilt, ...this.centre, this.half]; }
  take(pose) {
    if (pose.every((v, i) => v === this.pose()[i])) return;
    [this.turn, this.tilt, this.centre[0], this.centre[1], this.centre[2], this.half] = pose;
    this.render();
  }

  axes() {
    const ct = Math.cos(this.turn), st = Math.sin(this.turn), ci = Math.cos(this.tilt), si = Math.sin(this.tilt);
    return {right: [ct, st, 0], up: [-st * si, ct * si, ci], away: [-st * ci, ct * ci, -si]};
  }

  matrix() {
    const {right, up, away} = this.axes(), wide = this.half * (this.width / this.height || 1), deep = 1e3 * this.half;
    const m = [];
    for (let a = 0; a < 3; ++a) m.push(right[a] / wide, up[a] / this.half, away[a] / deep, 0);
    const dot = (v) => v[0] * this.centre[0] + v[1] * this.centre[1] + v[2] * this.centre[2];
    return [...m, -dot(right) / wide, -dot(up) / this.half, -dot(away) / deep, 1];
  }

  render() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.paint();
      this.changed();
    });
  }

  paint() {
    const c = this.context, m = this.matrix();
    if (!(this.width > 0)) return;
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.clearRect(0, 0, this.width, this.height);
    let total = 0;
    for (const part of this.parts) {
      if (!part.visible) continue;
      this.place(part, m);
      total += part.triangles.length / 3;
    }
    this.paintTriangles(this.dragging ? Math.ceil(total / trianglesWhileTurning) || 1 : 1);
    this.paintLines();
  }

  place(part, m) {
    const p = part.points, s = part.screen;
    for (let i = 0; i + 2 < p.length; i += 3) {
      const x = p[i], y = p[i + 1], z = p[i + 2] * this.stretch;
      s[i] = (0.5 + 0.5 * (m[0] * x + m[4] * y + m[8] * z + m[12])) * this.width;
      s[i + 1] = (0.5 - 0.5 * (m[1] * x + m[5] * y + m[9] * z + m[13])) * this.height;
      s[i + 2] = m[2] * x + m[6] * y + m[10] * z + m[14];
    }
  }

  // Every step-th triangle, the farthest first: sorted into layers of depth.
  paintTriangles(step) {
    const layers = 2048, found = [];
    let low = Infinity, high = -Infinity;
    for (const part of this.parts) {
      if (!part.visible) continue;
      const t = part.triangles, s = part.screen;
      for (let i = 0; i + 2 < t.length; i += 3 * step) {
        const depth = s[3 * t[i] + 2] + s[3 * t[i + 1] + 2] + s[3 * t[i + 2] + 2];
        if (Number.isNaN(depth)) continue;
        low = Math.min(low, depth);
        high = Math.max(high, depth);
        found.push({part, at: i, depth});
      }
    }
    const sorted = Array.from({length: layers}, () => []);
    for (const one of found) sorted[high > low ? Math.min(layers - 1, Math.floor(layers * (one.depth - low) / (high - low))) : 0].push(one);
    const c = this.context;
    for (let l = layers - 1; l >= 0; --l) {
      for (const {part, at} of sorted[l]) this.paintTriangle(c, part, at);
    }
    c.globalAlpha = 1;
  }

  paintTriangle(c, part, at) {
    const t = part.triangles, s = part.screen, a = 3 * t[at], b = 3 * t[at + 1], d = 3 * t[at + 2];
    const light = this.light(part.points, a, b, d);
    const [r, g, blue] = this.colourOf(part, a, b, d).map((v) => Math.round(v * light));
    c.globalAlpha = part.opacity;
    c.fillStyle = `rgb(${r},${g},${blue})`;
    c.beginPath();
    c.moveTo(s[a], s[a + 1]);
    c.lineTo(s[b], s[b + 1]);
    c.lineTo(s[d], s[d + 1]);
    c.closePath();
    c.fill();
  }

  // From 0 to 255, unlit; where points have colours of their own their mean.
  colourOf(part, a, b, d) {
    const c = part.colours;
    if (!c || !this.pointColours) return part.colour.map((v) => 255 * v);
    return [0, 1, 2].map((k) => (c[a + k] + c[b + k] + c[d + k]) / 3);
  }

  // How bright a triangle is: by the angle between its normal and the way to the viewer.
  light(p, a, b, d) {
    const {away} = this.axes(), f = this.stretch;
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = f * (p[b + 2] - p[a + 2]);
    const vx = p[d] - p[a], vy = p[d + 1] - p[a + 1], vz = f * (p[d + 2] - p[a + 2]);
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx, length = Math.hypot(nx, ny, nz);
    return length > 0 ? 0.45 + 0.55 * Math.abs(nx * away[0] + ny * away[1] + nz * away[2]) / length : 0.7;
  }

  paintLines() {
    const c = this.context;
    for (const part of [...this.parts].sort((a, b) => Number(a.change !== '') - Number(b.change !== ''))) {
      if (!part.visible) continue;
      const s = part.screen;
      c.lineWidth = part.change ? 2 : 1;
      c.strokeStyle = part.change ? `rgb(${part.colour.map((v) => Math.round(255 * v)).join(',')})` : 'rgba(30,40,50,0.7)';
      c.beginPath();
      for (const line of part.lines) line.forEach((n, i) => c[i ? 'lineTo' : 'moveTo'](s[3 * n], s[3 * n + 1]));
      c.stroke();
      if (part.triangles.length || part.lines.length) continue;
      c.fillStyle = 'rgba(30,40,50,0.8)';
      for (let i = 0; i + 2 < s.length; i += 3) c.fillRect(s[i] - 1.5, s[i + 1] - 1.5, 3, 3);
    }
  }

  listen() {
    const at = this.canvas;
    at.addEventListener('contextmenu', (event) => event.preventDefault());
    at.addEventListener('pointerdown', (event) => {
      at.setPointerCapture(event.pointerId);
      this.dragging = {x: event.clientX, y: event.clientY, moves: event.shiftKey || event.button !== 0};
    });
    at.addEventListener('pointermove', (event) => {
      if (!this.dragging) return;
      const dx = event.clientX - this.dragging.x, dy = event.clientY - this.dragging.y;
      this.dragging.x = event.clientX;
      this.dragging.y = event.clientY;
      if (this.dragging.moves) this.move(dx, dy);
      else {
        this.turn -= 0.008 * dx;
        this.tilt = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, this.tilt + 0.008 * dy));
      }
      this.render();
    });
    const end = () => {
      this.dragging = null;
      this.render();
    };
    at.addEventListener('pointerup', end);
    at.addEventListener('pointercancel', end);
    at.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.half *= Math.exp(0.0012 * event.deltaY);
      this.render();
    }, {passive: false});
  }

  move(dx, dy) {
    const {right, up} = this.axes(), unit = 2 * this.half / this.height;
    for (let a = 0; a < 3; ++a) this.centre[a] += unit * (dy * up[a] - dx * right[a]);
  }
}
