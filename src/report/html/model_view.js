// SPDX-License-Identifier: AGPL-3.0-or-later
// The right side of the page: one of the two views with the model of one file, the marks above it, legend and sliders.

class ModelView {
  constructor(report, rows, picked) {
    this.report = report;
    this.rows = rows;
    this.picked = picked;
    this.file = -1;
    this.hidden = new Set();  // roles, or 'lines'
    this.strong = new Set();  // part numbers
    this.shown = [];
    document.body.classList.toggle('flat', !report.files.some((file) => file.scene));
    if (document.body.classList.contains('flat')) return;
    this.marks = new Marks($('marks'));
    this.view = this.makeView();
    this.listen();
    new ResizeObserver(() => this.resize()).observe($('view'));
    this.resize();
  }

  // vtk.js where it is in the page and the browser can do with it, else the plain view.
  makeView() {
    const changed = () => this.drawMarks();
    if (typeof GeomendVtkView !== 'undefined' && location.hash !== '#plain') {
      try {
        return new GeomendVtkView.VtkView($('view'), changed);
      } catch (error) {
        $('view').replaceChildren();
        console.info(`the plain view is taken: ${error.message}`);
      }
    }
    return new PlainView($('view'), changed);
  }

  kind() { return this.view ? this.view.kind : 'none'; }

  resize() {
    const box = $('view').getBoundingClientRect();
    if (!(box.width > 0 && box.height > 0)) return;
    this.view.resize(box.width, box.height, window.devicePixelRatio || 1);
    this.marks.resize(box.width, box.height, window.devicePixelRatio || 1);
    this.drawMarks();
  }

  showFile(index) {
    if (!this.view || index === this.file) return;
    this.file = index;
    const scene = this.report.files[index].scene;
    if (scene && !scene.decoded) scene.decoded = scene.parts.map(decodedPart);
    this.parts = scene ? scene.decoded : [];
    for (const part of this.parts) part.group = part.triangles.length ? part.role : 'lines';
    this.partBounds = this.parts.map((part) => grow(noBounds(), part.points));
    this.bounds = noBounds();
    for (const b of this.partBounds) if (b[3] >= b[0]) grow(this.bounds, b);
    if (!(this.bounds[3] >= this.bounds[0])) {
      for (const row of this.rows) if (row.fileIndex === index && this.markOf(row)) grow(this.bounds, row.bounds);
    }
    this.strong.clear();
    this.view.show(this.parts.map((part) => ({...part, colour: roleColours[part.role] || roleColours.unknown})), this.bounds);
    this.stretchLimit();
    this.drawLegend();
    this.drawNote(scene);
    this.look();
    this.view.reset();
  }

  // Once the page around it has its size.
  fit() {
    if (!this.view) return;
    this.resize();
    this.view.reset();
  }

  // The slider's right end: heights as large as half the width, at least tenfold.
  stretchLimit() {
    const b = this.bounds, wide = Math.hypot(b[3] - b[0], b[4] - b[1]), high = b[5] - b[2];
    this.mostStretch = high > 0 && wide > 0 ? Math.min(1000, Math.max(10, 0.5 * wide / high)) : 1;
  }

  stretch() { return this.mostStretch > 1 ? Math.pow(this.mostStretch, Number($('stretch').value) / 100) : 1; }

  look() {
    const stretch = this.stretch();
    $('stretched').textContent = `×${stretch < 10 ? Number(stretch.toFixed(1)) : Math.round(stretch)}`;
    this.marks.stretch = stretch;
    const opacity = Number($('opacity').value) / 100;
    // The box around a model must not hide what is in it, nor anything what is chosen.
    const opacityOf = (part, i) => {
      if (this.strong.has(i)) return Math.max(opacity, 0.8);
      return (part.role === 'boundary' ? opacity * opacity : opacity) * (this.strong.size ? 0.4 : 1);
    };
    this.view.setLook({stretch, opacityOf, visible: (part) => !this.hidden.has(part.group)});
  }

  drawLegend() {
    const found = new Map();
    for (const part of this.parts) found.set(part.group, (found.get(part.group) || 0) + 1);
    const roles = Object.keys(groupColours).filter((role) => found.has(role));
    $('legend').replaceChildren(...roles.map((role) => {
      const box = make('input', {type: 'checkbox'}), patch = make('i', {});
      box.checked = !this.hidden.has(role);
      patch.style.background = `rgb(${groupColours[role].map((v) => Math.round(255 * v)).join(',')})`;
      box.addEventListener('change', () => {
        if (box.checked) this.hidden.delete(role);
        else this.hidden.add(role);
        this.look();
      });
      return make('label', {}, box, patch, {unknown: 'no role', lines: 'lines and points'}[role] || role, make('small', {}, grouped(found.get(role))));
    }));
  }

  drawNote(scene) {
    const notes = [];
    if (!scene) notes.push('There is nothing to draw of this file.');
    else if (scene.simplified) notes.push(`Surfaces are drawn simplified: ${grouped(scene.drawn)} of ${grouped(scene.triangles)} triangles. Marks are exact.`);
    if (scene && scene.unmarked) notes.push(`${counted(scene.unmarked, ['finding is', 'findings are'])} not marked: there are too many.`);
    $('note').textContent = notes.join(' ');
  }

  // ---- marks

  markOf(row) {
    if (row.mark === undefined) {
      row.mark = decodedMark(row.finding.mark);
      row.bounds = row.mark ? boundsOfMark(row.mark) : null;
      if (row.mark && !(row.bounds[3] >= row.bounds[0])) row.mark = null;
    }
    return row.mark;
  }

  // The first place of a mark: a point, the middle of a line, the centre of a triangle.
  anchorOf(mark) {
    if (mark.points.length) return mark.points.subarray(0, 3);
    const line = mark.lines.find((l) => l.length);
    if (line) {
      const middle = 3 * Math.floor(line.length / 6);
      return line.subarray(middle, middle + 3);
    }
    const t = mark.triangles.length ? mark.triangles : mark.outlines.find((l) => l.length), n = mark.triangles.length ? 3 : 1;
    const centre = new Float32Array(3);
    for (let i = 0; i < 3 * n; ++i) centre[i % 3] += t[i] / n;
    return centre;
  }

  showMarks(rows) {
    if (!this.view) return;
    this.shown = rows.filter((row) => row.fileIndex === this.file && this.markOf(row));
    // The worst are drawn last, above the others.
    const list = this.shown.map((row) => ({row, severity: row.finding.severity, code: row.finding.code, mark: row.mark, anchor: this.anchorOf(row.mark)}));
    list.sort((a, b) => severities.indexOf(b.severity) - severities.indexOf(a.severity));
    this.marks.show(list);
    this.drawMarks();
  }

  drawMarks() {
    if (this.waiting || !this.marks || !this.view) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = 0;
      if (this.marks.width > 0) this.marks.draw(this.view.matrix());
    });
  }

  // ---- choosing

  partsOf(row) {
    const found = [];
    if (row.fileIndex !== this.file) return found;
    for (const e of row.finding.entities) {
      this.parts.forEach((part, i) => {
        if (part.kind === e.kind && (e.id !== undefined && part.id !== undefined ? part.id === e.id : part.name === e.name)) found.push(i);
      });
    }
    return found;
  }

  canFlyTo(row) { return Boolean(this.view && (this.markOf(row) || this.partsOf(row).length)); }

  choose(row, fly) {
    if (!this.view) return;
    if (row && row.fileIndex !== this.file) {
      this.showFile(row.fileIndex);
      this.showMarks(state.shown);
      drawDetail();
    }
    this.strong = new Set(row ? this.partsOf(row) : []);
    this.marks.selected = row;
    this.look();
    if (row && fly) this.flyTo(row);
    this.drawMarks();
  }

  boundsOf(row) {
    if (this.markOf(row)) return row.bounds;
    const bounds = noBounds();
    for (const i of this.partsOf(row)) if (this.partBounds[i][3] >= this.partBounds[i][0]) grow(bounds, this.partBounds[i]);
    return bounds;
  }

  flyTo(row) {
    const b = this.boundsOf(row), f = this.stretch();
    if (!(b[3] >= b[0])) return;
    const whole = this.bounds, size = 0.5 * Math.hypot(whole[3] - whole[0], whole[4] - whole[1], f * (whole[5] - whole[2])) || 1;
    const radius = Math.max(1.4 * 0.5 * Math.hypot(b[3] - b[0], b[4] - b[1], f * (b[5] - b[2])), 0.06 * size);
    this.view.flyTo([(b[0] + b[3]) / 2, (b[1] + b[4]) / 2, (b[2] + b[5]) / 2], radius);
  }

  // Where a row's mark stands on the page, in pixels; null where it has none.
  placeOf(row) {
    if (!this.view || !this.markOf(row) || row.fileIndex !== this.file) return null;
    const box = $('view').getBoundingClientRect(), p = this.marks.project(this.anchorOf(row.mark), this.view.matrix());
    return [box.left + p[0], box.top + p[1]];
  }
  settled() { return !this.view || !this.view.flying; }

  // ---- mouse and sliders

  listen() {
    let down = null;
    $('view').addEventListener('pointerdown', (event) => { down = [event.clientX, event.clientY]; }, true);
    $('view').addEventListener('pointerup', (event) => {
      const still = down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4;
      down = null;
      if (!still || event.button !== 0) return;
      const box = $('view').getBoundingClientRect();
      const row = this.marks.pick(event.clientX - box.left, event.clientY - box.top, this.view.matrix());
      if (row) this.picked(row);
    }, true);
    $('opacity').addEventListener('input', () => this.look());
    $('stretch').addEventListener('input', () => this.look());
    $('reset').addEventListener('click', () => this.view.reset());
  }
}
