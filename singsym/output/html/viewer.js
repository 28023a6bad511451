// Draws the scenes of a page: shapes follow places, which turn with the view and move along tracks.
'use strict';
const WIDTH = 640, HEIGHT = 480, STEP = 60, ARC = 16;
const SVG = 'http://www.w3.org/2000/svg';

class Scene {
  constructor(box) {
    this.data = JSON.parse(box.querySelector('script').textContent);
    this.svg = box.querySelector('svg');
    this.track = box.querySelector('select');
    this.place = box.querySelector('input');
    this.button = box.querySelector('button');
    this.output = box.querySelector('output');
    this.layer = this.svg.appendChild(document.createElementNS(SVG, 'g'));
    this.shapes = this.data.shapes.map(shape => {
      const element = document.createElementNS(SVG, shape.kind);
      element.setAttribute('class', shape.style);
      if (shape.kind === 'circle') element.setAttribute('r', shape.radius);
      if (shape.kind === 'path') element.setAttribute('d', shape.text);
      if (shape.kind === 'text') element.textContent = shape.text;
      this.layer.append(element);
      return { ...shape, element };
    });
    this.home();
    this.playing = null;
    this.listen();
    this.draw();
  }

  home() { [this.azimuth, this.elevation] = this.data.view; }

  listen() {
    this.track?.addEventListener('change', () => this.draw());
    this.place?.addEventListener('input', () => this.draw());
    this.button?.addEventListener('click', () => this.toggle());
    if (this.data.flat) return;
    this.svg.addEventListener('keydown', event => {
      const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
      if (event.key in turns) this.turn(...turns[event.key].map(x => x * Math.PI / 30));
      else if (event.key === 'Home') this.home();
      else return;
      event.preventDefault();
      this.draw();
    });
    this.svg.addEventListener('pointerdown', event => {
      this.svg.setPointerCapture(event.pointerId);
      this.held = [event.clientX, event.clientY];
    });
    this.svg.addEventListener('pointermove', event => {
      if (!this.held) return;
      this.turn((event.clientX - this.held[0]) / 120, (event.clientY - this.held[1]) / 120);
      this.held = [event.clientX, event.clientY];
      this.draw();
    });
    for (const end of ['pointerup', 'pointercancel']) {
      this.svg.addEventListener(end, () => { this.held = null; });
    }
  }

  turn(across, up) {
    this.azimuth -= across;
    this.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.elevation + up));
  }

  // back and forth along the track, from where it is
  toggle() {
    if (this.playing) {
      clearInterval(this.playing);
      this.playing = null;
    } else {
      let ahead = 1;
      this.playing = setInterval(() => {
        const next = Number(this.place.value) + ahead;
        if (next < 0 || next > Number(this.place.max)) ahead = -ahead;
        this.place.value = Number(this.place.value) + ahead;
        this.draw();
      }, STEP);
    }
    this.button.textContent = this.playing ? 'Pause' : 'Play';
  }

  // to the right, up, towards the reader
  axes() {
    if (this.data.flat) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const [c, s] = [Math.cos(this.azimuth), Math.sin(this.azimuth)];
    const [flat, up] = [Math.cos(this.elevation), Math.sin(this.elevation)];
    return [[-s, c, 0], [-up * c, -up * s, flat], [flat * c, flat * s, up]];
  }

  // a place on the screen, with how near it is
  seen(place, axes) {
    const { middle, scale: whole } = this.along;
    const [x, y, near] = axes.map(u => u.reduce((sum, x, i) => sum + x * (place[i] - middle[i]), 0));
    const scale = whole / (this.data.flat ? 1 : 1 - near / 7000);
    return [WIDTH / 2 + scale * x, HEIGHT / 2 - scale * y, near];
  }

  draw() {
    const track = this.along = this.data.tracks[this.track ? this.track.value : 0];
    if (this.place) this.place.max = track.frames.length - 1;
    const at = this.place ? Number(this.place.value) : 0, frame = track.frames[at];
    const places = this.data.fixed.map(place => [...place]);
    this.data.moving.forEach((where, k) => { places[where] = frame.slice(3 * k, 3 * k + 3); });
    const axes = this.axes(), names = [];
    for (const shape of this.shapes) {
      const corners = shape.at.map(k => places[k]);
      const line = shape.round ? onSphere(corners, shape.round) : corners;
      const points = line.map(place => this.seen(place, axes));
      shape.near = points.reduce((sum, p) => sum + p[2], 0) / points.length + 12 * shape.rank;
      if (shape.front) shape.near = 1e6 + shape.rank;
      follow(shape, points, names);
    }
    if (!this.data.flat) {
      this.layer.append(...[...this.shapes].sort((a, b) => a.near - b.near).map(s => s.element));
      this.triad(axes);
    }
    if (this.output) this.output.textContent = track.notes[at] ?? '';
    for (const [plane, marks] of Object.entries(track.marks)) {
      for (const mark of document.querySelectorAll(`circle[data-plane="${plane}"]`)) {
        mark.setAttribute('visibility', 'visible');
        mark.setAttribute('cx', marks[at][0]);
        mark.setAttribute('cy', marks[at][1]);
      }
    }
  }

  triad(axes) {
    this.svg.querySelectorAll('.triad').forEach((element, k) => {
      const [x, y] = [46 + 30 * axes[0][k % 3], HEIGHT - 46 - 30 * axes[1][k % 3]];
      if (element.tagName === 'line') { element.setAttribute('x2', x); element.setAttribute('y2', y); }
      else { element.setAttribute('x', 46 + 1.35 * (x - 46)); element.setAttribute('y', HEIGHT - 41 + 1.35 * (y - HEIGHT + 46)); }
    });
  }
}

// an arc of a great circle between two places
function onSphere([a, b], radius) {
  return Array.from({ length: ARC + 1 }, (_, k) => {
    const chord = a.map((x, i) => x + (b[i] - x) * k / ARC), norm = Math.hypot(...chord) || 1;
    return chord.map(x => radius * x / norm);
  });
}

function follow(shape, points, names) {
  const set = (key, value) => shape.element.setAttribute(key, value), [x, y] = points[0];
  if (shape.kind === 'circle') { set('cx', x); set('cy', y); }
  else if (shape.kind === 'path') set('transform', `translate(${x} ${y})`);
  else if (shape.kind === 'text') {
    // names of one place stand side by side
    const before = names.filter(n => Math.hypot(n.x - x, n.y - y) < 14);
    names.push({ x, y, length: shape.text.length });
    set('x', x + before.reduce((all, n) => all + 12 * n.length + 8, 12));
    set('y', y - 10);
  } else set('points', points.map(p => `${p[0].toFixed(1)},${p[1].toFixed(1)}`).join(' '));
}

for (const box of document.querySelectorAll('.scene')) new Scene(box);
