// SPDX-License-Identifier: MIT
// The page: what is shown, and how it hangs together.

/** @param {number | undefined} triangle of a mesh */
function triangleText(triangle) {
  return triangle === undefined ? '' : ', triangle ' + triangle;
}

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
    this.progressive = this.served && new Progressive(this.served, this.picture);
    this.mode = 'ray';
    this.pair = 0;
    /** @type {{a: number, b: number}[]} */
    this.pairs = [];
    /** The rays that are replayed, by solver. @type {RayReplay[]} */
    this.rays = [];
    /** Whether the address may be written: not while it is read. */
    this.isReady = false;
    /** The timer of the address's next writing; 0: none waits. */
    this.addressTimer = 0;
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
    listenToPicture(this.picture, {
      point: (x, y) => this.point(x, y),
      choose: (x, y) => { this.choose(x, y); },
      moved: () => { if (this.progressive) this.progressive.show(false); },
      turns: () => this.served !== null && element('orbit').checked,
      turn: (yaw, pitch) => {
        if (!this.served || !this.progressive) return;
        this.served.turn(yaw, pitch);
        this.progressive.show(true);
      },
    });
    this.listenToRest();
    const progressive = this.progressive;
    if (this.served && progressive) {
      progressive.changed = () => this.viewChanged();
      listenToServed(this.served, this.about, this.view.solvers[0].name, () => progressive.show(true));
    }
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

  /** Replays the cast at a point of the picture: its pixel's, or, where the program can be asked and pixels are magnified,
   *  its own; of a page alone, the nearest that is here. @param {number} x @param {number} y @param {number} step */
  async choose(x, y, step = Infinity) {
    this.mode = element('mode').value = 'ray';
    const centre = (/** @type {number} */ at) => Math.floor(at) + 0.5;
    if (this.served) {
      const finest = Math.max(1, Math.round(this.picture.scale()));
      const place = (/** @type {number} */ at) => finest > 2 ? (Math.floor(at * finest) + 0.5) / finest : centre(at);
      [x, y] = [place(x), place(y)];
      try {
        this.rays = this.replays.add(await (await this.served.ask('cast', { x, y })).text());
      } catch (error) {
        element('served-state').textContent = String(error);
        return;
      }
    } else {
      const nearest = this.replays.nearest(Math.floor(x), Math.floor(y));
      this.rays = nearest ? this.replays.rays.get(nearest.join(',')) || [] : [];
      [x, y] = (nearest || [x, y]).map(centre);
    }
    this.picture.chosen = [x, y];
    this.point(Math.floor(x), Math.floor(y));
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
      // The planes tell of the view as it is; a point within a pixel may have been answered otherwise.
      const i = this.picture.index(Math.floor(ray.at[0]), Math.floor(ray.at[1]));
      const path = this.about.paths[this.picture.plane('ray_path')[i]];
      const what = name + triangleText(ray.triangle) + ' at pixel ' + placeText(ray.at, ', ');
      this.replay.open(rayPlay(ray.cast, ray.mesh, this.view.solvers[ray.solver].name, others, what, path), step, keepsLook);
    } else {
      const pair = await this.pairReplay();
      if (!pair) return this.replay.open(null, 0, false);
      element('pair').value = this.pair;
      const a = this.about.objects[pair.a] + triangleText(pair.triangle_a), b = this.about.objects[pair.b] + triangleText(pair.triangle_b);
      if (this.mode === 'impact') {
        const cast = pair.impact;
        this.replay.open(rayPlay(cast, pair.mesh, 'auto', [{ name: 'auto', cast }], b + ' goes at ' + a + ', in the set A - B', ''), step, keepsLook);
      } else {
        const flat = this.mode === 'plane';
        this.replay.open(distancePlay(flat ? pair.plane : pair.distance, pair.mesh, a + ' and ' + b, flat), step, keepsLook);
      }
    }
    this.keepAddress();
  }

  /** Maps of another camera, solver or tolerance have come. */
  viewChanged() {
    const { picture } = this;
    this.listSolvers();
    this.showMap(picture.map.name);
    this.point(picture.pixel[0], picture.pixel[1]);
    if (picture.chosen && this.mode === 'ray') this.choose(picture.chosen[0], picture.chosen[1]);
  }

  /** Writes the address soon: browsers refuse more than some 20 writings a second. */
  keepAddress() {
    if (this.isReady && !this.addressTimer) this.addressTimer = window.setTimeout(() => this.writeAddress(), 100);
  }

  /** The state as the address has it. */
  writeAddress() {
    this.addressTimer = 0;
    const parts = [];
    if (this.picture.chosen) parts.push('pixel=' + placeText(this.picture.chosen, ','));
    parts.push('step=' + this.replay.step);
    if (this.picture.solver > 0) parts.push('solver=' + this.view.solvers[this.picture.solver].name);
    if (this.picture.map !== maps[0]) parts.push('show=' + this.picture.map.name);
    if (this.mode !== 'ray') parts.push('what=' + this.mode + '&pair=' + this.pair);
    history.replaceState(null, '', '#' + parts.join('&'));
  }

  async readAddress() {
    this.isReady = false;
    window.clearTimeout(this.addressTimer);
    this.addressTimer = 0;
    const values = new URLSearchParams(location.hash.slice(1));
    const solver = this.view.solvers.findIndex(s => s.name === values.get('solver'));
    this.picture.solver = Math.max(solver, 0);
    this.listSolvers();
    this.showMap(values.get('show') || 'picture');
    const numbers = (values.get('pixel') || '').split(',').map(Number);
    const isPlace = numbers.length === 2 && numbers.every(Number.isFinite);
    const isPixel = numbers.every(Number.isInteger);
    const step = values.has('step') ? Number(values.get('step')) : Infinity;
    const first = isPlace ? numbers.map(at => isPixel ? at + 0.5 : at)
      : (this.replays.hardest() || [this.view.width >> 1, this.view.height >> 1]).map(at => at + 0.5);
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
    listenToKeys({
      ',': () => this.replay.go(this.replay.step - 1),
      '.': () => this.replay.go(this.replay.step + 1),
      Home: () => this.replay.go(1),
      End: () => this.replay.go(Infinity),
      p: () => this.replay.run(),
      s: () => this.setSolver((this.picture.solver + 1) % this.view.solvers.length),
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
