// SPDX-License-Identifier: AGPL-3.0-or-later
// The view by vtk.js, with the same functions as PlainView. Bundled by bundle.mjs into one script.

import '@kitware/vtk.js/Rendering/Profiles/Geometry';
import vtkActor from '@kitware/vtk.js/Rendering/Core/Actor';
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray';
import vtkInteractorStyleTrackballCamera from '@kitware/vtk.js/Interaction/Style/InteractorStyleTrackballCamera';
import vtkMapper from '@kitware/vtk.js/Rendering/Core/Mapper';
import vtkOpenGLRenderWindow from '@kitware/vtk.js/Rendering/OpenGL/RenderWindow';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData';
import vtkRenderer from '@kitware/vtk.js/Rendering/Core/Renderer';
import vtkRenderWindow from '@kitware/vtk.js/Rendering/Core/RenderWindow';
import vtkRenderWindowInteractor from '@kitware/vtk.js/Rendering/Core/RenderWindowInteractor';

const flightMilliseconds = 450;

function polyDataOf(part) {
  const data = vtkPolyData.newInstance();
  data.getPoints().setData(part.points, 3);
  if (part.triangles.length) {
    const cells = new Uint32Array(part.triangles.length / 3 * 4);
    for (let t = 0, at = 0; t < part.triangles.length; t += 3) {
      cells[at++] = 3;
      cells[at++] = part.triangles[t];
      cells[at++] = part.triangles[t + 1];
      cells[at++] = part.triangles[t + 2];
    }
    data.getPolys().setData(cells);
  }
  if (part.lines.length) {
    const cells = [];
    for (const line of part.lines) cells.push(line.length, ...line);
    data.getLines().setData(Uint32Array.from(cells));
  }
  if (!part.triangles.length && !part.lines.length) {
    const count = part.points.length / 3, cells = new Uint32Array(2 * count);
    for (let i = 0; i < count; ++i) cells.set([1, i], 2 * i);
    data.getVerts().setData(cells);
  }
  if (part.colours) data.getPointData().setScalars(vtkDataArray.newInstance({name: 'colours', numberOfComponents: 3, values: part.colours}));
  return data;
}

export class VtkView {
  constructor(container, changed) {
    const probe = document.createElement('canvas').getContext('webgl2');
    if (!probe) throw new Error('the browser has no WebGL 2');
    this.kind = 'vtk';
    this.container = container;
    this.changed = changed;
    this.stretch = 1;
    this.window = vtkRenderWindow.newInstance();
    this.renderer = vtkRenderer.newInstance();
    this.renderer.setBackground(0, 0, 0, 0);  // the page's own shows through
    this.window.addRenderer(this.renderer);
    this.glass = vtkOpenGLRenderWindow.newInstance();
    this.window.addView(this.glass);
    this.glass.setContainer(container);
    this.interactor = vtkRenderWindowInteractor.newInstance();
    this.interactor.setView(this.glass);
    this.interactor.initialize();
    this.interactor.bindEvents(container);
    this.interactor.setInteractorStyle(vtkInteractorStyleTrackballCamera.newInstance());
    this.camera = this.renderer.getActiveCamera();
    this.camera.onModified(() => this.changed());
    this.actors = [];
  }

  show(parts, bounds) {
    for (const actor of this.actors) {
      this.renderer.removeActor(actor);
      actor.getMapper().delete();
      actor.delete();
    }
    this.parts = parts;
    this.bounds = bounds;
    this.actors = parts.map((part) => {
      const mapper = vtkMapper.newInstance({scalarVisibility: false});
      mapper.setInputData(polyDataOf(part));
      const actor = vtkActor.newInstance();
      actor.setMapper(mapper);
      const look = actor.getProperty(), solid = part.triangles.length > 0;
      look.setColor(...(solid || part.change ? part.colour : [0.15, 0.19, 0.23]));
      if (part.change) {  // lies on what is drawn, too
        mapper.setResolveCoincidentTopologyToPolygonOffset();
        mapper.setRelativeCoincidentTopologyPolygonOffsetParameters(-2, -2);
        mapper.setRelativeCoincidentTopologyLineOffsetParameters(-4, -4);
        if (!solid) look.setLineWidth(2);
      }
      look.setAmbient(solid ? 0.45 : 1);
      look.setDiffuse(solid ? 0.65 : 0);
      look.setPointSize(5);
      this.renderer.addActor(actor);
      return actor;
    });
  }

  setLook(look) {
    const camera = this.camera, factor = look.stretch / this.stretch;
    if (factor !== 1) {
      const stretched = (p) => [p[0], p[1], p[2] * factor], focus = camera.getFocalPoint(), eye = camera.getPosition();
      const to = stretched(focus);
      camera.setFocalPoint(...to);
      camera.setPosition(...eye.map((v, a) => v - focus[a] + to[a]));
    }
    this.stretch = look.stretch;
    this.actors.forEach((actor, i) => {
      const part = this.parts[i], solid = part.triangles.length > 0;
      actor.setScale(1, 1, look.stretch);
      actor.setVisibility(look.visible(part) && (look.opacityOf(part, i) > 0 || !solid));
      actor.getMapper().setScalarVisibility(Boolean(part.colours && look.pointColours));
      actor.getProperty().setOpacity(solid ? look.opacityOf(part, i) : 1);
    });
    this.renderer.resetCameraClippingRange();
    this.render();
  }

  resize(width, height, ratio) {
    [this.width, this.height] = [width, height];
    this.glass.setSize(Math.round(width * ratio), Math.round(height * ratio));
    this.render();
  }

  reset() {
    const b = this.bounds, f = this.stretch;
    if (!(b[3] >= b[0])) return this.render();
    this.stop();
    this.camera.setViewUp(0, 0, 1);
    const centre = [(b[0] + b[3]) / 2, (b[1] + b[4]) / 2, f * (b[2] + b[5]) / 2];
    const from = [-0.5, -0.75, 0.45].map((v) => v / Math.hypot(0.5, 0.75, 0.45)), way = this.distanceOfBox(centre, from);
    this.place(centre, centre.map((v, a) => v + way * from[a]));
  }

  // What another view needs to look at the same from the same place.
  pose() { return [...this.camera.getFocalPoint(), ...this.camera.getPosition(), ...this.camera.getViewUp()]; }
  take(pose) {
    if (pose.every((v, i) => v === this.pose()[i])) return;
    this.stop();
    this.camera.setFocalPoint(...pose.slice(0, 3));
    this.camera.setPosition(...pose.slice(3, 6));
    this.camera.setViewUp(...pose.slice(6, 9));
    this.renderer.resetCameraClippingRange();
    this.render();
  }

  // How far away, in a direction, all corners of the bounds are in the picture.
  distanceOfBox(centre, from) {
    const b = this.bounds, slope = Math.tan(0.5 * this.camera.getViewAngle() * Math.PI / 180), wide = slope * (this.width / this.height || 1);
    const length = Math.hypot(from[0], from[1]), right = [-from[1] / length, from[0] / length, 0];
    const up = [-right[1] * from[2], right[0] * from[2], length].map((v, a) => a < 2 ? -v : v);
    const dot = (v, p) => v[0] * p[0] + v[1] * p[1] + v[2] * p[2];
    let way = 1e-9;
    for (let corner = 0; corner < 8; ++corner) {
      const p = [0, 1, 2].map((a) => b[corner >> a & 1 ? 3 + a : a] * (a === 2 ? this.stretch : 1) - centre[a]);
      way = Math.max(way, dot(from, p) + 1.08 * Math.max(Math.abs(dot(right, p)) / wide, Math.abs(dot(up, p)) / slope));
    }
    return way;
  }

  // How far away a sphere fills the picture.
  distance(radius) {
    const half = 0.5 * this.camera.getViewAngle() * Math.PI / 180, narrow = Math.min(1, this.width / this.height || 1);
    return radius / Math.sin(Math.atan(narrow * Math.tan(half)));
  }

  place(focus, eye) {
    this.camera.setFocalPoint(...focus);
    this.camera.setPosition(...eye);
    this.renderer.resetCameraClippingRange();
    this.render();
  }

  flyTo(centre, radius) {
    this.stop();
    const focus = this.camera.getFocalPoint(), eye = this.camera.getPosition(), back = eye.map((v, a) => v - focus[a]);
    const length = Math.hypot(...back) || 1, way = this.distance(radius);
    const to = [centre[0], centre[1], centre[2] * this.stretch], there = to.map((v, a) => v + way * back[a] / length);
    const still = window.matchMedia('(prefers-reduced-motion: reduce)').matches, start = performance.now();
    if (still) return this.place(to, there);
    const between = (a, b, t) => a.map((v, i) => v + t * (b[i] - v));
    const go = (now) => {
      const t = Math.min(1, Math.max(0, (now - start) / flightMilliseconds)), soft = t * t * (3 - 2 * t);
      this.flying = t < 1 ? requestAnimationFrame(go) : 0;
      this.place(between(focus, to, soft), between(eye, there, soft));
    };
    this.flying = requestAnimationFrame(go);
  }

  stop() {
    if (this.flying) cancelAnimationFrame(this.flying);
    this.flying = 0;
  }

  // vtk.js gives its matrices row by row.
  matrix() {
    const m = this.camera.getCompositeProjectionMatrix(this.width / this.height || 1, -1, 1), turned = new Array(16);
    for (let r = 0; r < 4; ++r) for (let c = 0; c < 4; ++c) turned[4 * c + r] = m[4 * r + c];
    return turned;
  }

  render() {
    if (this.waiting || !(this.width > 0)) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.window.render();
      this.changed();
    });
  }
}
