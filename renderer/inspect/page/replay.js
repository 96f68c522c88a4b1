// SPDX-License-Identifier: MIT
// The panel that replays: a slider with a stop for each step, the view, the numbers.

class Replay {
  constructor() {
    this.scene = new Scene3D(element('view'));
    /** @type {Play | null} */
    this.play = null;
    this.step = 1;
    /** @type {number | undefined} */
    this.timer = undefined;
    /** It is told when the step changes. @type {() => void} */
    this.changed = () => {};
    const slider = element('step');
    slider.addEventListener('input', () => this.go(Number(slider.value)));
    element('first').addEventListener('click', () => this.go(1));
    element('previous').addEventListener('click', () => this.go(this.step - 1));
    element('next').addEventListener('click', () => this.go(this.step + 1));
    element('last').addEventListener('click', () => this.go(Infinity));
    element('play').addEventListener('click', () => this.run());
    for (const id of ['show-inner', 'show-outer', 'show-around', 'show-planes', 'follow'])
      element(id).addEventListener('change', () => this.draw());
    element('view-all').addEventListener('click', () => {
      element('follow').checked = false;
      this.scene.whole();
      this.draw();
    });
  }

  /** @param {Play | null} play @param {number} step @param {boolean} keepsLook whether the same shape is looked at */
  open(play, step, keepsLook) {
    this.stop();
    this.play = play;
    element('replay-summary').textContent = play ? play.summary : 'Nothing to replay near here: the rays pass by all objects without a step.';
    const slider = element('step');
    const count = play ? play.count : 0;
    slider.min = Math.min(1, count);
    slider.max = count;
    slider.disabled = count < 2;
    if (play && !keepsLook) this.scene.look(play);
    if (play) this.scene.mesh = play.mesh;
    element('around').hidden = !play || !play.mesh || !play.mesh.around;
    element('closing-text').textContent = play ? closingText(play) : '';
    element('table').innerHTML = play ? this.table(play) : '';
    this.go(step);
  }

  /** @param {Play} play */
  table(play) {
    const row = (/** @type {string[]} */ cells, /** @type {string} */ tag) =>
      '<tr>' + cells.map(cell => '<' + tag + '>' + escaped(cell) + '</' + tag + '>').join('') + '</tr>';
    return '<table>' + row(play.columns, 'th') + play.rows.map(cells => row(cells, 'td')).join('') + '</table>';
  }

  /** @param {number} step */
  go(step) {
    const count = this.play ? this.play.count : 0;
    this.step = Math.min(Math.max(step, Math.min(1, count)), count);
    this.draw();
    this.changed();
  }

  run() {
    if (this.timer !== undefined) return this.stop();
    const count = this.play ? this.play.count : 0;
    if (this.step >= count) this.go(1);
    element('play').textContent = 'Pause';
    this.timer = window.setInterval(() => {
      if (this.step >= count) this.stop();
      else this.go(this.step + 1);
    }, 900);
  }

  stop() {
    window.clearInterval(this.timer);
    this.timer = undefined;
    element('play').textContent = 'Play';
  }

  draw() {
    const { play, scene, step } = this;
    const slider = element('step');
    slider.value = step;
    if (!play) {
      scene.mesh = null;
      scene.items = [];
      scene.draw();
      for (const id of ['line', 'closing', 'formulas']) element(id).innerHTML = '';
      element('step-text').textContent = element('step-sentence').textContent = '';
      return;
    }
    const shown = play.show(step, element('show-planes').checked);
    scene.items = shown.items;
    scene.inner = element('show-inner').checked;
    scene.outer = element('show-outer').checked;
    scene.around = element('show-around').checked;
    if (element('follow').checked && step > 0) {
      scene.centre = shown.focus;
      scene.zoom = play.radius / shown.focus_size;
    }
    scene.draw();
    slider.setAttribute('aria-valuetext', shown.sentence);
    element('step-text').textContent = step + ' of ' + play.count;
    element('step-sentence').textContent = shown.sentence;
    element('formulas').innerHTML = '<table>' + shown.formulas.map(([name, text]) =>
      '<tr><th scope="row">' + escaped(name) + '</th><td>' + escaped(text) + '</td></tr>').join('') + '</table>';
    element('line').innerHTML = numberLine(play, step);
    element('line').setAttribute('aria-label', play.quantity + ' lies in ' + between(...play.bounds(step)));
    element('closing').innerHTML = closingChart(play, step);
    element('closing').setAttribute('aria-label', closingText(play));
    element('table').querySelectorAll('tr').forEach((/** @type {Element} */ row, /** @type {number} */ i) =>
      row.classList.toggle('now', i === step));
  }
}
