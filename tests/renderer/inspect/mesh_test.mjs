// SPDX-License-Identifier: MIT
// The inspector's page of a mesh, a terrain and a ball as a reader meets it: node mesh_test.mjs MINKRAY.
// What it shows must be what the program says. Exits with 77 where Chromium is missing.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { Browser, chromium } from './browser.mjs';

if (!chromium()) {
  console.log('Chromium is not installed');
  process.exit(77);
}
const minkray = process.argv[2];
const folder = mkdtempSync(join(tmpdir(), 'minkray-inspect-'));
const scene = join(folder, 'meshes.json'), page_file = join(folder, 'page.html'), size = '320x200';

/** A ring of 24 x 12 squares, each of two triangles. */
function ring() {
  const vertices = [], triangles = [];
  for (let i = 0; i < 24; ++i)
    for (let j = 0; j < 12; ++j) {
      const u = 2 * Math.PI * i / 24, v = 2 * Math.PI * j / 12, r = 1 + 0.4 * Math.cos(v);
      vertices.push([r * Math.cos(u), r * Math.sin(u), 0.4 * Math.sin(v)]);
      const at = (a, b) => (a % 24) * 12 + b % 12;
      triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
  return { vertices, triangles };
}
const heights = [...Array(9).keys()].map(i => [...Array(9).keys()].map(j => 0.3 * Math.sin(i) * Math.cos(j)));
const content = {
  version: 2,
  camera: { position: [0, -6, 4], look_at: [0, 0, 0] },
  objects: [
    { name: 'ring', mesh: ring(), transform: { translate: [-1.2, 0, 0.5], rotate: { axis: [1, 0, 0], degrees: 30 } } },
    { name: 'ball', shape: { type: 'ellipsoid', radii: [0.5, 0.4, 0.3] }, transform: { translate: [1.2, 0, 0.3] } },
    { name: 'hills', height_field: { heights, size: [6, 4] }, transform: { translate: [0, 0, -0.8] } },
  ],
};
writeFileSync(scene, JSON.stringify(content));
execFileSync(minkray, ['inspect', scene, '-r', size, '-s', '1', '-q', '-o', page_file]);
const trace = (x, y, solver) => JSON.parse(execFileSync(minkray,
  ['trace', scene, '-r', size, '--pixel', x + ',' + y, '--solver', solver, '--json'], { encoding: 'utf8' }));

const browser = new Browser();
let failed = false;
try {
  const page = await browser.open('file://' + page_file, 1300, 1100);
  await page.until("document.documentElement?.dataset.ready === 'yes'");
  const place = (x, y) => page.value(`(() => {
    const canvas = document.getElementById('picture'), box = canvas.getBoundingClientRect();
    const side = canvas.clientWidth / 320;
    return [box.left + canvas.clientLeft + (${x} + 0.5) * side, box.top + canvas.clientTop + (${y} + 0.5) * side];
  })()`);
  const counts = {};
  for (const [x, y] of [[60, 100], [100, 60], [110, 110], [90, 128], [225, 95], [160, 150], [250, 140], [100, 170]]) {
    const where = 'pixel ' + x + ',' + y + ': ';
    await page.click(...await place(x, y));  // goes to the nearest pixel that can be replayed
    const [px, py] = (await page.text('hover-pixel')).split(', ').map(Number);
    const own = trace(px, py, 'auto');
    const name = own.object + (own.triangle === undefined ? '' : ', triangle ' + own.triangle);
    assert.equal(await page.text('hover-object'), name, where);
    assert.equal(await page.text('hover-t'), String(own.t), where);
    assert.equal(await page.text('hover-iterations'), String(own.iterations), where);
    const [below, above] = (await page.text('hover-bounds')).match(/[\d.]+(e-?\d+)?/g).map(Number);
    assert.ok(below >= 0 && below < 1e-10 && above >= 0 && above < 1e-10, where + below + ' ' + above);
    assert.match(await page.text('hover-cost'), /nodes, [1-9]\d* casts/, where);
    counts[own.object] = (counts[own.object] || 0) + 1;
    for (const solver of ['auto', 'paper']) {
      await page.value(`document.querySelectorAll('#solvers input')[${solver === 'auto' ? 0 : 1}].click()`);
      const steps = trace(px, py, solver);
      assert.ok((await page.text('replay-summary')).startsWith(name + ' at pixel ' + px + ', ' + py), await page.text('replay-summary'));
      assert.equal(await page.value("Number(document.getElementById('step').max)"), steps.iterations, where + solver);
      assert.ok((await page.text('formulas')).includes('answerhit, t = ' + steps.t + ' in ['), where + solver);
      assert.equal(await page.value("document.getElementById('around').hidden"), own.triangle === undefined, where);
    }
    await page.value("document.querySelectorAll('#solvers input')[0].click()");
  }
  assert.ok(counts.ring >= 2 && counts.hills >= 2 && counts.ball >= 1, JSON.stringify(counts));
  // With the mesh around the triangle more is drawn.
  const ink = () => page.value(`(() => {
    const c = document.createElement('canvas'), view = document.getElementById('view');
    [c.width, c.height] = [view.width, view.height];
    const pen = c.getContext('2d', { willReadFrequently: true });
    pen.drawImage(view, 0, 0);
    const d = pen.getImageData(0, 0, c.width, c.height).data;
    let drawn = 0;
    for (let i = 3; i < d.length; i += 4) drawn += d[i] > 0 ? 1 : 0;
    return drawn;
  })()`);
  await page.click(...await place(100, 60));
  const all = await ink();
  await page.value("document.getElementById('show-around').click()");
  assert.ok(await ink() < all / 2, all + ' and ' + await ink());
  await page.value("document.getElementById('show-around').click()");
  // The pair of ring and hills is that of their nearest triangles: no distance is less.
  await page.value("(() => { const m = document.getElementById('mode'); m.value = 'distance'; m.dispatchEvent(new Event('change')); })()");
  const pair = await page.value("[...document.querySelectorAll('#pair option')].findIndex(o => o.textContent === 'ring - hills')");
  await page.value(`(() => { const m = document.getElementById('pair'); m.value = '${pair}'; m.dispatchEvent(new Event('change')); })()`);
  await page.until("document.getElementById('replay-summary').textContent.startsWith('ring, triangle')");
  const { objects: [of_ring, , of_hills] } = content;
  const query = { query: 'distance', a: { mesh: of_ring.mesh, transform: of_ring.transform },
    b: { height_field: of_hills.height_field, transform: of_hills.transform } };
  const nearest = JSON.parse(execFileSync(minkray, ['cast', '-'], { input: JSON.stringify(query) + '\n', encoding: 'utf8' }));
  const summary = await page.text('replay-summary');
  assert.ok(summary.startsWith('ring, triangle ' + nearest.triangle_a + ' and hills, triangle ' + nearest.triangle_b), summary);
  assert.ok(Math.abs(Number(summary.match(/distance ([\d.e-]+)/)[1]) - nearest.distance) < 1e-9, summary + ' ' + nearest.distance);
  for (const map of ['casts', 'nodes']) {
    await page.value(`(() => { const s = document.getElementById('show'); s.value = '${map}'; s.dispatchEvent(new Event('change')); })()`);
    assert.ok((await page.text('legend')).includes(map === 'casts' ? 'shapes and triangles cast at per ray' : 'nodes visited per ray'));
  }
  assert.deepEqual(page.complaints, []);
} catch (error) {
  failed = true;
  console.error(error);
}
await browser.close();
rmSync(folder, { recursive: true, force: true });
process.exit(failed ? 1 : 0);
