// SPDX-License-Identifier: MIT
// What the page may ask of `minkray inspect --serve`: rays anywhere, other solvers and tolerances,
// other places of the camera. It asks where it came from and nowhere else.

class Served {
  /** @param {About} about */
  constructor(about) {
    this.eye = about.camera.position;
    this.at = about.camera.look_at;
    this.up = about.camera.up;
    this.home = { eye: this.eye, at: this.at };
    this.solver = '';
    this.tolerance = '';
  }

  /** @param {string} path @param {Record<string, string | number>} values @param {AbortSignal} [until] */
  async ask(path, values, until) {
    const all = new URLSearchParams();
    if (this.eye !== this.home.eye) all.set('eye', this.eye.join(','));
    if (this.at !== this.home.at) all.set('at', this.at.join(','));
    if (this.solver) all.set('solver', this.solver);
    if (this.tolerance) all.set('tolerance', this.tolerance);
    for (const key of Object.keys(values)) all.set(key, String(values[key]));
    const reply = await fetch(path + '?' + all, until ? { signal: until } : {});
    if (!reply.ok) throw new Error(await reply.text());
    return reply;
  }

  /** Turns the camera about what it looks at. @param {number} yaw @param {number} pitch in radians */
  turn(yaw, pitch) {
    const up = unit(this.up);
    const from = minus(this.eye, this.at);
    const height = dot(from, up);
    const flat = minus(from, times(height, up));
    const distance = size(from);
    const turned = unit(plus(times(Math.cos(yaw), flat), times(Math.sin(yaw), cross(up, flat))));
    const angle = Math.min(Math.max(Math.atan2(height, size(flat)) + pitch, -1.5), 1.5);
    this.eye = plus(this.at, plus(times(distance * Math.cos(angle), turned), times(distance * Math.sin(angle), up)));
  }

  /** @param {number} factor */
  approach(factor) {
    this.eye = plus(this.at, times(factor, minus(this.eye, this.at)));
  }

  back() {
    this.eye = this.home.eye;
    this.at = this.home.at;
  }
}

/** The picture's part that is seen, in pixels of the view. @param {Picture} picture */
function windowOf(picture) {
  const { canvas, centre, view } = picture;
  const half = [canvas.clientWidth / 2 / picture.scale(), canvas.clientHeight / 2 / picture.scale()];
  return [
    Math.max(0, centre[0] - half[0]), Math.max(0, centre[1] - half[1]),
    Math.min(view.width, centre[0] + half[0]), Math.min(view.height, centre[1] + half[1]),
  ];
}

/** Asks for what is to be seen, coarse first and better and better; whatever is under way when
 *  something else is to be seen is broken off. */
class Progressive {
  /** @param {Served} served @param {Picture} picture */
  constructor(served, picture) {
    this.served = served;
    this.picture = picture;
    this.under_way = new AbortController();
    /** Whether the maps are no longer those of the picture. */
    this.needs_view = false;
    /** It is told when maps have come. @type {() => void} */
    this.changed = () => {};
  }

  /** @param {boolean} isOtherView whether camera, solver or tolerance is another; else just the window is */
  async show(isOtherView) {
    this.under_way.abort();
    this.under_way = new AbortController();
    const until = this.under_way.signal;
    this.needs_view ||= isOtherView;
    const say = (/** @type {string} */ text) => { element('served-state').textContent = text; };
    say('Asking ...');
    try {
      const { picture, served } = this;
      const window = windowOf(picture);
      const finest = picture.zoom * Math.min(1, picture.canvas.clientWidth / picture.view.width);
      for (const [part, samples] of [[0.25, 1], [1, 1], [1, 16]]) {
        const zoom = part * finest;
        const reply = await served.ask('picture', { samples, zoom, window: window.map(at => Math.round(at * zoom)).join(',') }, until);
        const photo = await createImageBitmap(await reply.blob());
        if (until.aborted) return;
        picture.photo = photo;
        picture.photo_window = window.map(at => Math.round(at * zoom) / zoom);
        picture.draw();
      }
      if (this.needs_view) {
        const view = await viewOf(await (await served.ask('view', {}, until)).json());
        if (until.aborted) return;
        this.needs_view = false;
        picture.view = view;
        picture.findPlaces();
        this.changed();
      }
      say('As asked.');
    } catch (error) {
      if (!until.aborted) say(String(error));
    }
  }
}

/** The form below the picture. @param {Served} served @param {About} about @param {string} first the solver at first
 *  @param {() => void} changed */
function listenToServed(served, about, first, changed) {
  element('served').hidden = false;
  element('served').addEventListener('submit', (/** @type {Event} */ event) => event.preventDefault());
  element('ask-solver').innerHTML = '<option value="">' + escaped(first) + ' (as begun)</option>' +
    about.all_solvers.map(s => '<option value="' + s.name + '">' + s.name + ': ' + escaped(s.doc) + '</option>').join('');
  element('ask-tolerance').innerHTML = '<option value="">as fine as rounding</option>' +
    ['1e-24', '1e-16', '1e-12', '1e-8', '1e-6', '1e-4', '1e-2'].map(t => '<option>' + t + '</option>').join('');
  for (const id of ['ask-solver', 'ask-tolerance'])
    element(id).addEventListener('change', () => {
      served.solver = element('ask-solver').value;
      served.tolerance = element('ask-tolerance').value;
      changed();
    });
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
      changed();
    });
}
