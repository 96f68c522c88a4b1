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
    /** The number of the latest picture that was asked for: what comes of earlier ones is left. */
    this.latest = 0;
  }

  /** @param {string} path @param {Record<string, string | number>} values */
  async ask(path, values) {
    const all = new URLSearchParams();
    if (this.eye !== this.home.eye) all.set('eye', this.eye.join(','));
    if (this.at !== this.home.at) all.set('at', this.at.join(','));
    if (this.solver) all.set('solver', this.solver);
    if (this.tolerance) all.set('tolerance', this.tolerance);
    for (const key of Object.keys(values)) all.set(key, String(values[key]));
    const reply = await fetch(path + '?' + all);
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

  isAtHome() {
    return this.eye === this.home.eye && this.solver === '' && this.tolerance === '';
  }

  /** Pictures of a window, each better than the one before, until others are wanted.
   *  @param {number[]} window in pixels of the view @param {number} zoom @param {number} finest pixels of the page a pixel
   *  @param {(picture: ImageBitmap) => void} got @returns {Promise<boolean>} whether the last one came */
  async pictures(window, zoom, finest, got) {
    const mine = ++this.latest;
    for (const [part, samples] of [[0.25, 1], [1, 1], [1, 16]]) {
      const z = zoom * part * finest;
      const reply = await this.ask('picture', { samples, zoom: z, window: window.map(at => Math.round(at * z)).join(',') });
      const picture = await createImageBitmap(await reply.blob());
      if (mine !== this.latest) return false;
      got(picture);
    }
    return true;
  }
}
