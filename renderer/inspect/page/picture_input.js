// SPDX-License-Identifier: MIT
// Mouse, fingers and keys: pointing at the picture, choosing, moving and magnifying, turning the
// camera; and the keys of the whole page.

/** What happens at the picture. @typedef {object} PictureHandlers
 *  @property {(x: number, y: number) => void} point a pixel is pointed at
 *  @property {(x: number, y: number) => void} choose a point of the picture is chosen: pixel centres lie at halves
 *  @property {() => void} moved another part of the picture is seen
 *  @property {() => boolean} turns whether dragging turns the camera
 *  @property {(yaw: number, pitch: number) => void} turn in radians */

/** @param {Picture} picture @param {PictureHandlers} on */
function listenToPicture(picture, on) {
  const canvas = picture.canvas;
  /** @type {{x: number, y: number, centre: number[], moved: boolean} | null} */
  let drag = null;
  const at = (/** @type {MouseEvent} */ event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left - canvas.clientLeft, event.clientY - box.top - canvas.clientTop];
  };
  const pointAt = (/** @type {MouseEvent} */ event) => {
    const [px, py] = at(event);
    return picture.toPicture(px, py);
  };
  const pointTo = (/** @type {MouseEvent} */ event) => {
    const [x, y] = pointAt(event);
    on.point(Math.floor(x), Math.floor(y));
  };
  const magnify = (/** @type {number} */ factor, /** @type {number[]} */ place = []) => {
    picture.magnify(factor, place[0], place[1]);
    // Where all is seen, a finger may scroll the page.
    canvas.style.touchAction = picture.zoom > 1 ? 'none' : 'pan-y';
    on.moved();
  };
  canvas.style.touchAction = 'pan-y';

  canvas.addEventListener('pointerdown', event => {
    const [x, y] = at(event);
    drag = { x, y, centre: picture.centre, moved: false };
    canvas.setPointerCapture(event.pointerId);
    if (event.pointerType === 'touch') pointTo(event);
  });
  canvas.addEventListener('pointermove', event => {
    const [x, y] = at(event);
    if (drag && Math.hypot(x - drag.x, y - drag.y) > 4) drag.moved = true;
    if (!drag || !drag.moved) return pointTo(event);
    if (on.turns()) {
      on.turn(-(x - drag.x) * 0.008, (y - drag.y) * 0.008);
      drag = { x, y, centre: picture.centre, moved: true };
    } else {
      const s = picture.scale();
      picture.moveTo(drag.centre[0] - (x - drag.x) / s, drag.centre[1] - (y - drag.y) / s);
    }
  });
  canvas.addEventListener('pointerup', event => {
    const ended = drag;
    drag = null;
    if (!ended) return;
    if (ended.moved) {
      if (!on.turns()) on.moved();
      return;
    }
    const [x, y] = pointAt(event);
    if (x >= 0 && y >= 0 && x < picture.view.width && y < picture.view.height) on.choose(x, y);
  });
  canvas.addEventListener('pointercancel', () => { drag = null; });
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    magnify(Math.exp(-event.deltaY * 0.002), at(event));
  }, { passive: false });
  element('zoom-in').addEventListener('click', () => magnify(1.6));
  element('zoom-out').addEventListener('click', () => magnify(1 / 1.6));
  element('zoom-all').addEventListener('click', () => magnify(1e-9));
  canvas.addEventListener('keydown', event => {
    const far = event.shiftKey ? 10 : 1;
    const [x, y] = picture.pixel;
    /** @type {Record<string, () => void>} */
    const actions = {
      ArrowLeft: () => on.point(x - far, y),
      ArrowRight: () => on.point(x + far, y),
      ArrowUp: () => on.point(x, y - far),
      ArrowDown: () => on.point(x, y + far),
      Enter: () => on.choose(x + 0.5, y + 0.5),
      '+': () => magnify(1.6),
      '-': () => magnify(1 / 1.6),
    };
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

/** Keys that are nobody else's. @param {Record<string, () => void>} actions by key */
function listenToKeys(actions) {
  document.addEventListener('keydown', event => {
    const target = /** @type {HTMLElement} */ (event.target);
    if (event.ctrlKey || event.altKey || event.metaKey || ['SELECT', 'INPUT', 'TEXTAREA'].includes(target.tagName)) return;
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
