// SPDX-License-Identifier: MIT
// The page: what is shown, and how it hangs together.

class Inspector {
  /** @param {About} about @param {View} view @param {Replays} replays */
  constructor(about, view, replays) {
    this.about = about;
    this.replays = replays;
    this.picture = new Picture(element('picture'), view, about);
    this.picture.replayable = new Set(replays.rays.keys());
    this.replay = new Replay();
    this.replay.changed = () => this.keepAddress();
    this.served = about.served ? new Served(about) : null;
    this.mode = 'ray';
    this.pair = 0;
    /** @type {{a: number, b: number}[]} */
    this.pairs = [];
    /** The rays that are replayed, by solver. @type {RayReplay[]} */
    this.rays = [];
    /** Whether the address may be written: not while it is read. */
    this.isReady = false;
  }

  get view() {
    return this.picture.view;
  }

  start() {
    element('scene-name').textContent = this.about.name;
    document.title = this.about.name + ' - Minkray inspector';
    element('scene-description').textContent = this.about.description;
    element('replayable').textContent = this.served ? 'The program is asked for every ray: all can be replayed.' :
      'The casts of ' + this.replays.rays.size + ' of the ' + this.view.width * this.view.height +
      ' pixels can be replayed here (see "what can be replayed here"); a click elsewhere goes to the nearest of them. ' +
      'minkray inspect --serve replays any.';
    element('show').innerHTML = maps.map(map => '<option value="' + map.name + '">' + map.text + '</option>').join('');
    this.listSolvers();
    this.listPairs();
    this.listenToPicture();
    this.listenToRest();
    if (this.served) this.listenToServed(this.served);
    window.addEventListener('hashchange', () => this.readAddress());
    new ResizeObserver(() => {
      this.picture.draw();
      this.replay.draw();
    }).observe(element('look'));
    this.readAddress();
  }

  listSolvers() {
    const box = element('solvers');
    box.querySelectorAll('label').forEach((/** @type {Element} */ label) => label.remove());
    this.view.solvers.forEach((solver, i) => {
      const label = document.createElement('label');
      label.title = solver.doc;
      label.innerHTML = '<input type="radio" name="solver" value="' + i + '"' + (i === this.picture.solver ? ' checked' : '') + '> ' + escaped(solver.name);
      label.addEventListener('change', () => this.setSolver(i));
      box.append(label);
    });
  }

  listPairs() {
    this.pairs = this.replays.pairs.map(({ a, b }) => ({ a, b }));
    // The program can be asked for all others, too, of scenes that are not too large for a list.
    const count = this.served && this.about.objects.length <= 40 ? this.about.objects.length : 0;
    for (let a = 0; a < count; ++a)
      for (let b = a + 1; b < count; ++b)
        if (!this.pairs.some(pair => pair.a === a && pair.b === b)) this.pairs.push({ a, b });
    element('pair').innerHTML = this.pairs.map((pair, i) =>
      '<option value="' + i + '">' + escaped(this.about.objects[pair.a] + ' - ' + this.about.objects[pair.b]) + '</option>').join('');
    if (this.pairs.length === 0)
      for (const value of ['distance', 'impact', 'plane'])
        element('mode').querySelector('option[value=' + value + ']').disabled = true;
  }

  /** @param {number} solver */
  setSolver(solver) {
    this.picture.solver = solver;
    element('solvers').querySelectorAll('input').forEach((/** @type {HTMLInputElement} */ input, /** @type {number} */ i) => {
      input.checked = i === solver;
    });
    this.showMap(this.picture.map.name);
    this.point(this.picture.pixel[0], this.picture.pixel[1]);
    if (this.mode === 'ray') this.openReplay(Infinity, true);
  }

  /** @param {string} name */
  showMap(name) {
    this.picture.map = maps.find(map => map.name === name) || maps[0];
    element('show').value = this.picture.map.name;
    this.picture.makeHeat();
    this.picture.draw();
    element('legend').innerHTML = this.picture.legend();
    const bar = element('legend').querySelector('canvas');
    if (bar) {
      const pen = bar.getContext('2d');
      for (let i = 0; i < bar.width; ++i) {
        pen.fillStyle = 'rgb(' + amountColour(i / (bar.width - 1)).join(',') + ')';
        pen.fillRect(i, 0, 1, 1);
      }
    }
    this.keepAddress();
  }

  /** Tells of a pixel. @param {number} x @param {number} y */
  point(x, y) {
    x = Math.min(Math.max(x, 0), this.view.width - 1);
    y = Math.min(Math.max(y, 0), this.view.height - 1);
    this.picture.pixel = [x, y];
    const answer = this.picture.answer(x, y);
    const put = (/** @type {string} */ id, /** @type {string | number} */ text) => { element('hover-' + id).textContent = String(text); };
    put('pixel', x + ', ' + y);
    put('object', answer.object || 'none');
    put('status', answer.status);
    put('t', whole(answer.t));
    put('bounds', answer.bounds);
    put('normal', vectorText(answer.normal));
    put('iterations', answer.iterations);
    put('supports', answer.supports);
    put('cost', answer.cost);
    put('sentence', 'Pixel ' + x + ', ' + y + ': ' + answer.status + (answer.object ? ', ' + answer.object : '') +
      (answer.t === null ? '' : ', t = ' + short(answer.t)) + '.');
    this.picture.draw();
  }

  /** Replays the cast of a pixel, or of the nearest that is here. @param {number} x @param {number} y @param {number} step */
  async choose(x, y, step = Infinity) {
    this.mode = element('mode').value = 'ray';
    element('pair-label').hidden = true;
    if (this.served) {
      const served = this.served;
      try {
        const reply = await served.ask('cast', { x: x + 0.5, y: y + 0.5 });
        this.rays = this.replays.add(await reply.text());
      } catch (error) {
        element('served-state').textContent = String(error);
        return;
      }
    } else {
      const nearest = this.replays.nearest(x, y);
      if (!nearest) {
        this.rays = [];
      } else {
        [x, y] = nearest;
        this.rays = this.replays.rays.get(x + ',' + y) || [];
      }
    }
    this.picture.chosen = [x, y];
    this.point(x, y);
    await this.openReplay(step, false);
  }

  /** The pair that is meant, asked for if it is not here. @returns {Promise<PairReplay | undefined>} */
  async pairReplay() {
    const wanted = this.pairs[this.pair];
    const find = () => this.replays.pairs.find(pair => wanted && pair.a === wanted.a && pair.b === wanted.b);
    if (find() || !wanted || !this.served) return find();
    try {
      this.replays.add(await (await this.served.ask('pair', { a: wanted.a + 1, b: wanted.b + 1 })).text());
    } catch (error) {
      element('served-state').textContent = String(error);
    }
    return find();
  }

  /** @param {number} step @param {boolean} keepsLook */
  async openReplay(step, keepsLook) {
    element('pair-label').hidden = this.mode === 'ray';
    if (this.mode === 'ray') {
      const ray = this.rays[this.picture.solver] || this.rays[0];
      if (!ray) return this.replay.open(null, 0, false);
      const name = this.view.names[ray.object] || this.about.objects[ray.object - 1] || 'object ' + ray.object;
      const others = this.rays.map((other, i) => ({ name: this.view.solvers[i].name, cast: other.cast }));
      const what = name + ' at pixel ' + Math.floor(ray.at[0]) + ', ' + Math.floor(ray.at[1]);
      this.replay.open(rayPlay(ray.cast, ray.mesh, this.view.solvers[ray.solver].name, others, what), step, keepsLook);
    } else {
      const pair = await this.pairReplay();
      if (!pair) return this.replay.open(null, 0, false);
      element('pair').value = this.pair;
      const a = this.about.objects[pair.a], b = this.about.objects[pair.b];
      if (this.mode === 'impact') {
        const cast = pair.impact;
        this.replay.open(rayPlay(cast, cast.mesh || { rank: -1 }, 'auto', [{ name: 'auto', cast }], b + ' goes at ' + a + ', in the set A - B'), step, keepsLook);
      } else {
        const flat = this.mode === 'plane';
        this.replay.open(distancePlay(flat ? pair.plane : pair.distance, a + ' and ' + b, flat), step, keepsLook);
      }
    }
    this.keepAddress();
  }

  /** The state as the address has it. */
  keepAddress() {
    if (!this.isReady) return;
    const parts = [];
    if (this.picture.chosen) parts.push('pixel=' + this.picture.chosen.join(','));
    parts.push('step=' + this.replay.step);
    if (this.picture.solver > 0) parts.push('solver=' + this.view.solvers[this.picture.solver].name);
    if (this.picture.map !== maps[0]) parts.push('show=' + this.picture.map.name);
    if (this.mode !== 'ray') parts.push('what=' + this.mode + '&pair=' + this.pair);
    history.replaceState(null, '', '#' + parts.join('&'));
  }

  async readAddress() {
    this.isReady = false;
    const values = new URLSearchParams(location.hash.slice(1));
    const solver = this.view.solvers.findIndex(s => s.name === values.get('solver'));
    this.picture.solver = Math.max(solver, 0);
    this.listSolvers();
    this.showMap(values.get('show') || 'picture');
    const numbers = (values.get('pixel') || '').split(',').map(Number);
    const isPixel = numbers.length === 2 && numbers.every(Number.isInteger);
    const step = values.has('step') ? Number(values.get('step')) : Infinity;
    const first = isPixel ? numbers : this.firstPixel();
    await this.choose(first[0], first[1], Number.isFinite(step) ? step : Infinity);
    const what = values.get('what');
    if (what && ['distance', 'impact', 'plane'].includes(what)) {
      this.mode = element('mode').value = what;
      this.pair = Math.min(Math.max(Number(values.get('pair')) || 0, 0), Math.max(this.pairs.length - 1, 0));
      await this.openReplay(step, false);
    }
    this.isReady = true;
    document.documentElement.dataset.ready = 'yes';
  }

  /** Where to begin: at the hardest cast that hits and can be replayed. */
  firstPixel() {
    let best = [this.view.width >> 1, this.view.height >> 1], most = -1;
    for (const [key, rays] of this.replays.rays) {
      const last = rays[rays.length - 1];
      if (!last || last.cast.status !== 'hit' || last.cast.iterations <= most) continue;
      most = last.cast.iterations;
      best = key.split(',').map(Number);
    }
    return best;
  }

  listenToPicture() {
    const canvas = element('picture');
    const picture = this.picture;
    /** @type {{x: number, y: number, centre: number[], moved: boolean} | null} */
    let drag = null;
    const at = (/** @type {PointerEvent | WheelEvent} */ event) => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left - canvas.clientLeft, event.clientY - box.top - canvas.clientTop];
    };
    const pixelAt = (/** @type {PointerEvent} */ event) => {
      const [px, py] = at(event);
      return picture.toPicture(px, py).map(Math.floor);
    };
    canvas.addEventListener('pointerdown', (/** @type {PointerEvent} */ event) => {
      const [x, y] = at(event);
      drag = { x, y, centre: picture.centre, moved: false };
      canvas.setPointerCapture(event.pointerId);
      if (event.pointerType === 'touch') this.point(...(/** @type {[number, number]} */ (pixelAt(event))));
    });
    canvas.addEventListener('pointermove', (/** @type {PointerEvent} */ event) => {
      const [x, y] = at(event);
      if (drag && Math.hypot(x - drag.x, y - drag.y) > 4) drag.moved = true;
      if (drag && drag.moved) {
        if (this.isOrbiting()) {
          this.orbit((x - drag.x) * 0.008, (y - drag.y) * 0.008);
          drag = { x, y, centre: picture.centre, moved: true };
        } else {
          const s = picture.scale();
          picture.moveTo(drag.centre[0] - (x - drag.x) / s, drag.centre[1] - (y - drag.y) / s);
        }
        return;
      }
      const [px, py] = pixelAt(event);
      this.point(px, py);
    });
    canvas.addEventListener('pointerup', (/** @type {PointerEvent} */ event) => {
      const wasClick = drag && !drag.moved;
      const wasPan = drag && drag.moved && !this.isOrbiting();
      drag = null;
      if (wasClick) {
        const [px, py] = pixelAt(event);
        if (px >= 0 && py >= 0 && px < this.view.width && py < this.view.height) this.choose(px, py);
      }
      if (wasPan) this.window_changed();
    });
    canvas.addEventListener('pointercancel', () => { drag = null; });
    canvas.addEventListener('wheel', (/** @type {WheelEvent} */ event) => {
      event.preventDefault();
      const [px, py] = at(event);
      picture.magnify(Math.exp(-event.deltaY * 0.002), px, py);
      this.window_changed();
    }, { passive: false });
    const zoom = (/** @type {number} */ factor) => {
      picture.magnify(factor);
      this.window_changed();
    };
    element('zoom-in').addEventListener('click', () => zoom(1.6));
    element('zoom-out').addEventListener('click', () => zoom(1 / 1.6));
    element('zoom-all').addEventListener('click', () => zoom(1e-9));
    canvas.addEventListener('keydown', (/** @type {KeyboardEvent} */ event) => {
      const far = event.shiftKey ? 10 : 1;
      const [x, y] = picture.pixel;
      /** @type {Record<string, () => void>} */
      const actions = {
        ArrowLeft: () => this.point(x - far, y),
        ArrowRight: () => this.point(x + far, y),
        ArrowUp: () => this.point(x, y - far),
        ArrowDown: () => this.point(x, y + far),
        Enter: () => { this.choose(x, y); },
        '+': () => zoom(1.6),
        '-': () => zoom(1 / 1.6),
      };
      const action = actions[event.key];
      if (!action) return;
      event.preventDefault();
      action();
    });
  }

  listenToRest() {
    element('show').addEventListener('change', () => this.showMap(element('show').value));
    element('names').addEventListener('change', () => {
      this.picture.names = element('names').checked;
      this.picture.draw();
    });
    element('mode').addEventListener('change', () => {
      this.mode = element('mode').value;
      this.openReplay(Infinity, false);
    });
    element('pair').addEventListener('change', () => {
      this.pair = Number(element('pair').value);
      this.openReplay(Infinity, false);
    });
    const root = document.documentElement;
    root.dataset.theme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
    element('theme').addEventListener('click', () => {
      root.dataset.theme = root.dataset.theme === 'dark' ? 'light' : 'dark';
      this.replay.draw();
      this.picture.draw();
    });
    document.addEventListener('keydown', event => {
      const target = /** @type {HTMLElement} */ (event.target);
      if (event.ctrlKey || event.altKey || event.metaKey || ['SELECT', 'INPUT', 'TEXTAREA'].includes(target.tagName)) return;
      /** @type {Record<string, () => void>} */
      const actions = {
        ',': () => this.replay.go(this.replay.step - 1),
        '.': () => this.replay.go(this.replay.step + 1),
        Home: () => this.replay.go(1),
        End: () => this.replay.go(Infinity),
        p: () => this.replay.run(),
        s: () => this.setSolver((this.picture.solver + 1) % this.view.solvers.length),
      };
      const action = actions[event.key];
      if (!action) return;
      event.preventDefault();
      action();
    });
  }

  isOrbiting() {
    return this.served !== null && element('orbit').checked;
  }

  /** @param {number} yaw @param {number} pitch */
  orbit(yaw, pitch) {
    if (!this.served) return;
    this.served.turn(-yaw, pitch);
    this.view_changed();
  }

  /** Asks for pictures of what is seen of the view, which is magnified. */
  async window_changed() {
    const { served, picture } = this;
    if (!served) return;
    const half = [picture.canvas.clientWidth / 2 / picture.scale(), picture.canvas.clientHeight / 2 / picture.scale()];
    const window = [
      Math.max(0, picture.centre[0] - half[0]), Math.max(0, picture.centre[1] - half[1]),
      Math.min(this.view.width, picture.centre[0] + half[0]), Math.min(this.view.height, picture.centre[1] + half[1]),
    ];
    const finest = Math.min(1, picture.canvas.clientWidth / this.view.width);
    try {
      return await served.pictures(window, picture.zoom, finest, photo => {
        picture.photo = photo;
        picture.photo_window = window;
        picture.draw();
      });
    } catch (error) {
      element('served-state').textContent = String(error);
      return false;
    }
  }

  /** Another camera, solver or tolerance: pictures, then what each pixel tells. */
  async view_changed() {
    const { served, picture } = this;
    if (!served) return;
    element('served-state').textContent = 'Asking ...';
    if (!await this.window_changed()) return;
    const latest = served.latest;
    try {
      const view = await viewOf(await (await served.ask('view', {})).json());
      if (latest !== served.latest) return;
      picture.view = view;
      picture.findPlaces();
    } catch (error) {
      element('served-state').textContent = String(error);
      return;
    }
    element('served-state').textContent = 'As asked.';
    this.listSolvers();
    this.showMap(picture.map.name);
    this.point(picture.pixel[0], picture.pixel[1]);
    if (picture.chosen && this.mode === 'ray') this.choose(picture.chosen[0], picture.chosen[1]);
  }

  /** @param {Served} served */
  listenToServed(served) {
    element('served').hidden = false;
    element('served').addEventListener('submit', (/** @type {Event} */ event) => event.preventDefault());
    element('ask-solver').innerHTML = '<option value="">' + escaped(this.view.solvers[0].name) + ' (as begun)</option>' +
      this.about.all_solvers.map(s => '<option value="' + s.name + '">' + s.name + ': ' + escaped(s.doc) + '</option>').join('');
    element('ask-tolerance').innerHTML = '<option value="">as fine as rounding</option>' +
      ['1e-24', '1e-16', '1e-12', '1e-8', '1e-6', '1e-4', '1e-2'].map(t => '<option>' + t + '</option>').join('');
    const changed = () => {
      served.solver = element('ask-solver').value;
      served.tolerance = element('ask-tolerance').value;
      this.view_changed();
    };
    element('ask-solver').addEventListener('change', changed);
    element('ask-tolerance').addEventListener('change', changed);
    /** @type {Record<string, () => void>} */
    const buttons = {
      'turn-left': () => served.turn(-0.2, 0),
      'turn-right': () => served.turn(0.2, 0),
      'turn-up': () => served.turn(0, 0.15),
      'turn-down': () => served.turn(0, -0.15),
      nearer: () => served.approach(0.8),
      further: () => served.approach(1.25),
      'camera-back': () => served.back(),
    };
    for (const id of Object.keys(buttons))
      element(id).addEventListener('click', () => {
        buttons[id]();
        this.view_changed();
      });
  }
}

async function main() {
  /** @type {About} */
  const about = JSON.parse(element('about').textContent);
  const view = await viewOf(about.view);
  const replays = new Replays();
  replays.add(new TextDecoder().decode(await unpacked(bytesOf(element('replays').textContent))));
  const inspector = new Inspector(about, view, replays);
  inspector.picture.photo = await createImageBitmap(new Blob([bytesOf(element('png').textContent)], { type: 'image/png' }));
  inspector.start();
}

main().catch(error => {
  document.body.prepend('This page needs a browser of 2023 or later. ' + error);
  console.error(error);
});
