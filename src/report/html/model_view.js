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
    this.views = [];
    document.body.classList.toggle('flat', !report.files.some((file) => file.scene));
    if (document.body.classList.contains('flat')) return;
    this.changes = report.files.length === 1 ? report.files[0].changes : undefined;  // of a repair: before and after
    this.marks = new Marks($('marks'));
    $('before').hidden = !this.changes;
    document.body.classList.toggle('repair', Boolean(this.changes));
    this.view = this.makeView($('view'), () => {
      this.drawMarks();
      this.follow(this.view, this.other);
    });
    if (this.changes) this.other = this.makeView($('before-view'), () => this.follow(this.other, this.view));
    this.views = [this.view, this.other].filter((view) => view);
    this.listen();
    new ResizeObserver(() => this.resize()).observe($('view'));
    this.resize();
  }

  // vtk.js where it is in the page and the browser can do with it, else the plain view.
  makeView(container, changed) {
    if (typeof GeomendVtkView !== 'undefined' && location.hash !== '#plain') {
      try {
        return new GeomendVtkView.VtkView(container, changed);
      } catch (error) {
        container.replaceChildren();
        console.info(`the plain view is taken: ${error.message}`);
      }
    }
    return new PlainView(container, changed);
  }

  // The two views look from the same place.
  follow(leader, follower) {
    if (this.following || !leader || !follower || !leader.parts || !follower.parts) return;
    this.following = true;
    follower.take(leader.pose());
    this.following = false;
  }

  kind() { return this.view ? this.view.kind : 'none'; }

  resize() {
    const box = $('view').getBoundingClientRect();
    if (!(box.width > 0 && box.height > 0)) return;
    for (const view of this.views) view.resize(box.width, box.height, window.devicePixelRatio || 1);
    this.marks.resize(box.width, box.height, window.devicePixelRatio || 1);
    this.drawMarks();
  }

  showFile(index) {
    if (!this.view || index === this.file) return;
    this.file = index;
    const scene = this.report.files[index].scene;
    this.parts = this.decoded(scene);
    this.before = this.changes ? this.decoded(this.changes.before) : [];
    this.partBounds = this.parts.map((part) => grow(noBounds(), part.points));
    this.bounds = noBounds();
    for (const b of this.partBounds) if (b[3] >= b[0]) grow(this.bounds, b);
    for (const part of this.before) grow(this.bounds, part.points);
    if (!(this.bounds[3] >= this.bounds[0])) {
      for (const row of this.rows) if (row.fileIndex === index && this.markOf(row)) grow(this.bounds, row.bounds);
    }
    this.strong.clear();
    const coloured = (part) => ({...part, colour: changeColours[part.change] || roleColours[part.role] || roleColours.unknown,
                                 colours: part.triangles.length ? this.pointColours(part) : null});
    this.following = true;
    this.view.show(this.parts.map(coloured), this.bounds);
    if (this.other) this.other.show(this.before.map(coloured), this.bounds);
    this.following = false;
    this.stretchLimit();
    this.drawLegend();
    this.drawScale();
    this.drawNote(scene);
    this.look();
    this.view.reset();
  }

  decoded(scene) {
    if (!scene) return [];
    if (!scene.decoded) scene.decoded = scene.parts.map(decodedPart);
    for (const part of scene.decoded) part.group = part.change || (part.triangles.length ? part.role : 'lines');
    return scene.decoded;
  }

  // ---- what a repair did

  // The colours of the points of a part by how far they moved; null where there is nothing to tell by them.
  pointColours(part) {
    if (!this.changes || !(this.changes.largest > 0) || part.change || !this.parts.includes(part)) return null;
    const colours = new Uint8Array(part.points.length);
    for (let i = 0; 3 * i < colours.length; ++i) colours.set(movedColour(part.moved ? part.moved[i] / this.changes.largest : 0), 3 * i);
    return colours;
  }

  drawScale() {
    const c = this.changes, box = $('scale');
    box.hidden = !c;
    if (!c) return;
    const unit = c.unit ? ` ${c.unit}` : '', file = this.report.files[this.file];
    const found = (errors, warnings) => `${counted(errors, severityWords.error)}, ${counted(warnings, severityWords.warning)}`;
    $('before-caption').replaceChildren(make('b', {}, 'Before'), found(c.errors_before, c.warnings_before));
    $('after-caption').replaceChildren(make('b', {}, 'After'), found(file.counts.error, file.counts.warning));
    $('after-caption').hidden = false;
    if (!(c.largest > 0)) {
      box.replaceChildren(make('b', {}, 'No vertex that was read has moved'), make('p', {}, `${grouped(c.vertices)} of them are in the result.`));
      return;
    }
    const bar = make('div', {class: 'bar'}), mean = make('i', {title: 'mean'}), use = make('input', {type: 'checkbox', id: 'by-move'});
    const stops = Array.from({length: 11}, (_, i) => `rgb(${movedColour(i / 10).join(',')}) ${10 * i}%`);
    bar.style.background = `linear-gradient(to right, ${stops.join(', ')})`;
    mean.style.left = `calc(${100 * c.mean / c.largest}% - 1px)`;
    bar.append(mean);
    use.checked = true;
    use.addEventListener('change', () => this.look());
    box.replaceChildren(make('b', {}, 'How far vertices moved'), bar,
                        make('div', {class: 'ends'}, make('span', {}, `0${unit}`), make('span', {}, `${figure(c.largest)}${unit}`)),
                        make('p', {}, `Largest ${figure(c.largest)}${unit}, mean ${figure(c.mean)}${unit} (the mark), of ` +
                             `${grouped(c.moved)} that moved; ${grouped(c.vertices)} were read and are still there.` +
                             (c.unit ? '' : ' The file states no unit.')),
                        make('label', {}, use, 'Colour the result by it'));
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
      if (part.change && part.role !== 'boundary') return 1;
      if (this.strong.has(i)) return Math.max(opacity, 0.8);
      return (part.role === 'boundary' ? opacity * opacity : opacity) * (this.strong.size ? 0.4 : 1);
    };
    const pointColours = Boolean($('by-move') && $('by-move').checked), visible = (part) => !this.hidden.has(part.group);
    this.following = true;
    this.view.setLook({stretch, opacityOf, pointColours, visible});
    if (this.other) this.other.setLook({stretch, opacityOf: (part) => opacityOf(part, -1), pointColours: false, visible});
    this.following = false;
  }

  drawLegend() {
    const found = new Map();
    for (const part of this.before) if (part.change) found.set(part.group, (found.get(part.group) || 0) + 1);
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
      return make('label', {}, box, patch, groupWords[role] || role, make('small', {}, grouped(found.get(role))));
    }));
  }

  drawNote(scene) {
    const notes = [];
    if (!scene) notes.push('There is nothing to draw of this file.');
    else if (scene.simplified) notes.push(`Surfaces are drawn simplified: ${grouped(scene.drawn)} of ${grouped(scene.triangles)} triangles. Marks are exact.`);
    if (this.changes && this.changes.before.simplified)
      notes.push(`Before: ${grouped(this.changes.before.drawn)} of ${grouped(this.changes.before.triangles)} triangles.`);
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
