// SPDX-License-Identifier: MIT
// The inspector's page as a reader meets it: node page_test.mjs MINKRAY makes a page, opens it in
// Chromium without a network and points, clicks and types. What it shows must be what the program
// says. Exits with 77 where Chromium is missing.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { Browser, chromium } from './browser.mjs';

if (!chromium()) {
  console.log('Chromium is not installed');
  process.exit(77);
}
const minkray = process.argv[2];
const scene = 'shape-zoo', size = '640x360';
const folder = mkdtempSync(join(tmpdir(), 'minkray-inspect-'));
const file = join(folder, 'page.html');
execFileSync(minkray, ['inspect', scene, '-r', size, '-s', '1', '-q', '-o', file]);

function trace(x, y, solver = 'auto', object = '') {
  const words = ['trace', scene, '-r', size, '--pixel', x + ',' + y, '--solver', solver, '--json'];
  return JSON.parse(execFileSync(minkray, object ? [...words, '--object', object] : words, { encoding: 'utf8' }));
}

const browser = new Browser();
const tests = [];
const test = (name, run) => tests.push({ name, run });
const pages = [];
const open = async (state = '', width = 1000, height = 1000, ...more) => {
  const page = await browser.open('file://' + file + (state ? '#' + state : ''), width, height, ...more);
  pages.push(page);
  await page.until("document.documentElement?.dataset.ready === 'yes'");
  return page;
};
/** Where on the screen a pixel's centre is. */
const place = (page, x, y) => page.value(`(() => {
  const canvas = document.getElementById('picture'), box = canvas.getBoundingClientRect();
  const side = canvas.clientWidth / 640;
  return [box.left + canvas.clientLeft + (${x} + 0.5) * side, box.top + canvas.clientTop + (${y} + 0.5) * side];
})()`);

test('the page is one file of at most 6 MB', () => {
  const bytes = readFileSync(file);
  assert.ok(bytes.length <= 6e6, bytes.length + ' bytes');
  assert.ok(bytes.length > 2e6, 'and it has its data in it');
});

test('100 hovered pixels show what minkray trace prints', async () => {
  const page = await open('', 2800, 1600);  // a pixel is larger than what the mouse is rounded to
  // A linear congruential generator (Knuth), so that the pixels are the same each time.
  let random = 2024;
  const below = most => {
    random = (random * 1664525 + 1013904223) % 4294967296;
    return Math.floor(random / 4294967296 * most);
  };
  let hits = 0;
  const objects = new Set();
  for (let k = 0; k < 100; ++k) {
    // Most of the picture is background: they lie about the objects' middles.
    const x = [152, 240, 320, 400, 490][below(5)] - 25 + below(50), y = [48, 131, 212, 293][below(4)] - 25 + below(50);
    await page.mouse('mouseMoved', ...await place(page, x, y));
    assert.equal(await page.text('hover-pixel'), x + ', ' + y);
    const says = trace(x, y);
    const where = 'pixel ' + x + ',' + y + ' ';
    assert.equal(await page.text('hover-status'), says.status, where);
    assert.equal(await page.text('hover-object'), says.object, where);
    assert.equal(await page.text('hover-t'), says.t === undefined ? '-' : String(says.t), where);
    assert.equal(await page.text('hover-iterations'), String(says.iterations), where);
    assert.equal(await page.text('hover-supports'), String(says.supports), where);
    const normal = (await page.text('hover-normal')).slice(1, -1).split(',').map(Number);
    for (let i = 0; i < 3; ++i) assert.ok(Math.abs(normal[i] - says.normal[i]) < 2e-4, where + normal);
    if (says.status === 'hit') {
      ++hits;
      objects.add(says.object);
      // "t - A ... t + B"
      const [below, above] = (await page.text('hover-bounds')).match(/[\d.]+(e-?\d+)?/g).map(Number);
      assert.ok(below >= 0 && below < 1e-6 && above >= 0 && above < 1e-6, where + below + ' ' + above);
    }
  }
  assert.ok(hits >= 30 && hits <= 70, hits + ' of 100 hit');
  assert.ok(objects.size >= 12, objects.size + ' objects were hit');
  assert.deepEqual(page.complaints, []);
});

test('the slider has a stop for each iteration, and its bounds are those of the trace', async () => {
  const page = await open();
  const shapes = ['hull', 'rounded', 'ellipsoid', 'minkowski_sum', 'minkowski_difference'];
  const places = await page.value(`(async () => {
    const all = new Replays();
    all.add(new TextDecoder().decode(await unpacked(bytesOf(document.getElementById('replays').textContent))));
    const objects = JSON.parse(document.getElementById('about').textContent).objects;
    return ${JSON.stringify(shapes)}.map(shape => {
      for (const [key, rays] of all.rays)
        if (objects[rays[0].object - 1] === shape && rays[0].cast.status === 'hit') return key.split(',').map(Number);
    });
  })()`);
  for (const [k, shape] of shapes.entries()) {
    const at = places[k];
    assert.ok(at, 'a hit of ' + shape + ' can be replayed');
    await page.click(...await place(page, ...at));
    for (const solver of ['auto', 'paper']) {
      await page.value(`document.querySelectorAll('#solvers input')[${solver === 'auto' ? 0 : 1}].click()`);
      const says = trace(...at, solver, shape);
      const stops = await page.value(`(() => { const s = document.getElementById('step'); return s.max - s.min + 1; })()`);
      assert.equal(stops, says.iterations, shape + ' by ' + solver);
      assert.equal(says.trace.length, says.iterations, shape + ' by ' + solver);
      // All stops at once: a page that is asked again and again is slow on a busy machine.
      const formulas = await page.value(`(() => {
        const s = document.getElementById('step'), texts = [];
        for (let k = 1; k <= ${stops}; ++k) {
          s.value = k;
          s.dispatchEvent(new Event('input'));
          texts.push(document.getElementById('formulas').textContent);
        }
        return texts;
      })()`);
      says.trace.forEach((step, k) => {
        const lower = step.t_lo === null ? '-\u221e' : String(step.t_lo);
        assert.ok(formulas[k].includes('[t_lo, t_hi][' + lower + ','), shape + ' by ' + solver + ' step ' + k + ': ' + lower + ' in ' + formulas[k]);
      });
      assert.ok((await page.text('formulas')).includes('answerhit, t = ' + says.t + ' in ['), shape + ' by ' + solver);
      const painted = await page.value(`(() => {
        const c = document.createElement('canvas'), view = document.getElementById('view');
        [c.width, c.height] = [view.width, view.height];
        const pen = c.getContext('2d', { willReadFrequently: true });
        pen.drawImage(view, 0, 0);
        const d = pen.getImageData(0, 0, c.width, c.height).data;
        const colours = new Set();
        for (let i = 0; i < d.length; i += 4) colours.add((d[i] << 16) + (d[i + 1] << 8) + d[i + 2]);
        return colours.size;
      })()`);
      assert.ok(painted > 30, shape + ': the view shows ' + painted + ' colours');
    }
  }
  assert.deepEqual(page.complaints, []);
});

test('distances, times of impact and the sequence in the plane are replayed', async () => {
  const page = await open();
  const pairs = await page.value("document.querySelectorAll('#pair option').length");
  assert.ok(pairs >= 4);
  for (const what of ['distance', 'impact', 'plane']) {
    await page.value(`(() => { const m = document.getElementById('mode'); m.value = '${what}'; m.dispatchEvent(new Event('change')); })()`);
    let steps = 0;
    for (let i = 0; i < pairs; ++i) {
      await page.value(`(() => { const m = document.getElementById('pair'); m.value = '${i}'; m.dispatchEvent(new Event('change')); })()`);
      steps += Number(await page.value("document.getElementById('step').max"));
      assert.match(await page.text('replay-summary'), what === 'impact' ? /goes at/ : /distance [\d.e-]+/);
      assert.ok((await page.text('formulas')).includes('answer'));
    }
    assert.ok(steps >= pairs, what);
  }
  assert.deepEqual(page.complaints, []);
});

test('a link leads to its pixel and step, and the address says where one is', async () => {
  const first = await open('pixel=233,196&step=3&solver=paper&show=iterations');
  const chosen = (await first.text('replay-summary')).match(/pixel (\d+), (\d+)/).slice(1).join(',');
  assert.equal(await first.value("document.getElementById('step').value"), '3');
  assert.match(await first.text('replay-summary'), /by paper$/);
  await first.value("document.getElementById('next').click()");
  const address = '#pixel=' + chosen + '&step=4&solver=paper&show=iterations';
  await first.until(`location.hash === '${address}'`);
  const second = await open(address.slice(1));
  assert.equal(await second.text('replay-summary'), await first.text('replay-summary'));
  assert.equal(await second.text('step-sentence'), await first.text('step-sentence'));
});

test('the table tells of the solver that is chosen', async () => {
  const page = await open('', 2800, 1600);
  await page.mouse('mouseMoved', ...await place(page, 240, 131));
  const by = async solver => {
    const says = trace(240, 131, solver);
    assert.equal(await page.text('hover-iterations'), String(says.iterations), solver);
    assert.equal(await page.text('hover-supports'), String(says.supports), solver);
    return says.iterations;
  };
  const first = await by('auto');
  await page.value("document.querySelectorAll('#solvers input')[1].click()");
  assert.notEqual(await by('paper'), first);
});

test('everything can be reached by the keyboard', async () => {
  const page = await open('pixel=233,196&step=1&solver=paper');
  await page.value("document.getElementById('picture').focus()");
  const before = await page.text('hover-pixel');
  await page.key('ArrowRight');
  await page.key('ArrowDown');
  const [x, y] = before.split(', ').map(Number);
  assert.equal(await page.text('hover-pixel'), (x + 1) + ', ' + (y + 1));
  assert.match(await page.text('hover-sentence'), /^Pixel \d+, \d+: /);
  await page.key('.');
  assert.equal(await page.value("document.getElementById('step').value"), '2');
  await page.key('End');
  assert.equal(await page.value("document.getElementById('step').value"), await page.value("document.getElementById('step').max"));
  // Whatever can be operated can be tabbed to, and has a name for those who do not see it.
  const nameless = await page.value(`[...document.querySelectorAll('button, select, input, canvas[tabindex], summary')].filter(e =>
    e.tabIndex < 0 || !(e.getAttribute('aria-label') || e.textContent.trim() || e.closest('label')?.textContent.trim())).map(e => e.outerHTML)`);
  assert.deepEqual(nameless, []);
});

test('every map is drawn, magnified and in the dark, and on a small screen nothing is wider than it', async () => {
  const page = await open('', 390, 844, true);
  for (const map of await page.value("[...document.querySelectorAll('#show option')].map(o => o.value)")) {
    await page.value(`(() => { const m = document.getElementById('show'); m.value = '${map}'; m.dispatchEvent(new Event('change')); })()`);
    await page.value("document.getElementById('zoom-in').click(); document.getElementById('theme').click()");
  }
  assert.equal(await page.value('document.documentElement.scrollWidth'), 390);
  assert.deepEqual(page.complaints, []);
});

test('no page asked for anything but its file', async () => {
  assert.ok(pages.length > 5, pages.length + ' pages');
  for (const page of pages) assert.deepEqual(page.requests.map(request => request.split('#')[0]), ['file://' + file]);
});

let failed = 0;
for (const { name, run } of tests) {
  try {
    const begin = Date.now();
    await run();
    console.log('ok    ' + name + ' (' + Math.round((Date.now() - begin) / 100) / 10 + ' s)');
  } catch (error) {
    ++failed;
    console.log('FAILS ' + name + '\n' + error.stack);
  }
}
await browser.close();
rmSync(folder, { recursive: true });
process.exit(failed > 0 ? 1 : 0);
