// SPDX-License-Identifier: MIT
// `minkray inspect --serve` as its page and as strangers meet it: node served_test.mjs MINKRAY. Exits
// with 77 where Chromium is missing.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { request } from 'node:http';
import { Browser, chromium } from './browser.mjs';

if (!chromium()) {
  console.log('Chromium is not installed');
  process.exit(77);
}
const minkray = process.argv[2];
const scene = 'shape-zoo', size = '320x250';
const server = spawn(minkray, ['inspect', scene, '-r', size, '-s', '1', '-q', '--serve'], { stdio: ['ignore', 'pipe', 'pipe'] });
// However this ends, no server is left that holds on to the pipes of whoever runs the tests.
server.stderr.pipe(process.stderr);
process.on('exit', () => server.kill('SIGKILL'));
const address = await new Promise((resolve, reject) => {
  server.stdout.setEncoding('utf8').once('data', text => resolve(text.trim()));
  server.once('exit', () => reject(new Error('the server ended')));
});
const { port, pathname } = new URL(address);

/** What is answered to a GET of a path, with headers of our own. */
function get(path, headers = {}, host = '127.0.0.1') {
  return new Promise((resolve, reject) => {
    const asked = request({ host, port, path, headers }, reply => {
      let body = '';
      reply.setEncoding('utf8').on('data', more => { body += more; });
      reply.on('end', () => resolve({ status: reply.statusCode, body, headers: reply.headers }));
    });
    asked.on('error', reject);
    asked.end();
  });
}

function trace(x, y, ...more) {
  return JSON.parse(execFileSync(minkray, ['trace', scene, '-r', size, '--pixel', x + ',' + y, '--json', ...more], { encoding: 'utf8' }));
}

const browser = new Browser();
const tests = [];
const test = (name, run) => tests.push({ name, run });
const open = async () => {
  const page = await browser.open(address);
  await page.until("document.documentElement?.dataset.ready === 'yes'");
  return page;
};
const asAsked = page => page.until("document.getElementById('served-state').textContent === 'As asked.'");
const place = (page, x, y) => page.value(`(() => {
  const canvas = document.getElementById('picture'), box = canvas.getBoundingClientRect();
  const side = canvas.clientWidth / 320;
  return [box.left + canvas.clientLeft + (${x} + 0.5) * side, box.top + canvas.clientTop + (${y} + 0.5) * side];
})()`);

test('strangers are told nothing', async () => {
  assert.match(pathname, /^\/[0-9a-f]{32}\/$/);
  for (const path of ['/', '/cast', '/' + '0'.repeat(32) + '/', '/..' + pathname, pathname + 'page.html', pathname + '../../etc/passwd',
    pathname + '%2e%2e/run', pathname.slice(0, -1) + '/' + scene + '.json'])
    assert.equal((await get(path)).status, 404, path);
  assert.equal((await get(pathname, { Host: 'example.com:' + port })).status, 421);
  assert.equal((await get(pathname)).status, 200);
  assert.equal((await get(pathname)).headers['cache-control'], 'no-store');
});

test('what makes no sense is refused, and the server goes on', async () => {
  for (const query of ['cast?x=nan&y=1', 'cast?x=', 'cast?eye=1,2', 'picture?samples=1e9', 'picture?zoom=0', 'picture?window=5,5,5,5',
    'picture?zoom=64&samples=1', 'pair?a=0&b=1', 'pair?a=1&b=1e9', 'view?solver=none', 'cast?tolerance=-1', 'cast?eye=0,0,0&at=0,0,0'])
    assert.equal((await get(pathname + query)).status, 400, query);
  assert.equal((await get(pathname)).status, 200);
});

test('any pixel is replayed as minkray trace has it', async () => {
  const page = await open();
  let hits = 0;
  for (const [x, y] of [[43, 91], [104, 91], [160, 91], [104, 150], [216, 148], [43, 203], [104, 203], [160, 203], [10, 10], [43, 147]]) {
    await page.click(...await place(page, x, y));
    await page.until(`document.getElementById('replay-summary').textContent.includes('pixel ${x}, ${y}:')`);
    const says = trace(x, y);
    const summary = await page.text('replay-summary');
    assert.ok(summary.includes(says.object + ' at pixel') && summary.includes(': ' + says.status), summary);
    assert.equal(await page.value("Number(document.getElementById('step').max)"), says.iterations);
    if (says.status === 'hit') ++hits;
    if (says.t !== undefined) assert.ok(summary.includes('t = ' + says.t + ','), summary + says.t);
  }
  assert.ok(hits >= 5, hits + ' hits');
  assert.deepEqual(page.complaints, []);
});

test('another solver and a coarser tolerance change what the pixels tell', async () => {
  const page = await open();
  const change = (id, value) => page.value(`(() => { const e = document.getElementById('${id}'); e.value = '${value}'; e.dispatchEvent(new Event('change')); })()`);
  const at = [104, 91];
  const hovered = async () => {
    await page.mouse('mouseMoved', ...await place(page, ...at));
    return Number(await page.text('hover-iterations'));
  };
  await page.click(...await place(page, ...at));
  const before = await hovered();
  assert.equal(before, trace(...at).iterations);
  await change('ask-solver', 'paper');
  await asAsked(page);
  const fine = await hovered();
  assert.equal(fine, trace(...at, '--solver', 'paper').iterations);
  await change('ask-tolerance', '1e-4');
  await asAsked(page);
  const coarse = await hovered();
  assert.ok(before < coarse && coarse < fine, [before, coarse, fine].join(' < '));
  assert.deepEqual(page.complaints, []);
});

test('the camera goes around, and the picture with it', async () => {
  const page = await open();
  const colours = () => page.value("document.getElementById('picture').toDataURL()");
  const before = await colours(), t = await page.text('hover-t');
  await page.value("document.getElementById('turn-left').click()");
  await asAsked(page);
  const after = await colours();
  assert.notEqual(after, before);
  await page.value("document.getElementById('camera-back').click()");
  await asAsked(page);
  assert.equal(await page.text('hover-t'), t);
  const asked = page.requests.filter(url => url.includes('picture?'));
  assert.ok(asked.some(url => url.includes('samples=1&')) && asked.some(url => url.includes('samples=16&')), 'pictures get better');
  assert.ok(page.requests.every(url => url.startsWith(address) || url.startsWith('data:')), page.requests.join('\n'));
  assert.deepEqual(page.complaints, []);
});

test('a point within a magnified pixel is replayed', async () => {
  const page = await open();
  for (let k = 0; k < 6; ++k) await page.value("document.getElementById('zoom-in').click()");
  const [x, y] = await page.value(`(() => {
    const canvas = document.getElementById('picture'), box = canvas.getBoundingClientRect();
    return [Math.round(box.left + 0.6 * box.width), Math.round(box.top + 0.45 * box.height)];
  })()`);
  const before = await page.text('replay-summary');
  await page.click(x, y);
  await page.until(`document.getElementById('replay-summary').textContent !== ${JSON.stringify(before)}`);
  const [px, py] = (await page.text('replay-summary')).match(/pixel ([\d.]+), ([\d.]+):/).slice(1).map(Number);
  assert.ok(px % 1 !== 0 && py % 1 !== 0, px + ', ' + py);
  await page.until(`location.hash.includes('pixel=${px},${py}&')`);
  await asAsked(page);
  assert.deepEqual(page.complaints, []);
});

test('dragging turns the camera', async () => {
  const page = await open();
  await page.value("document.getElementById('orbit').click()");
  const [x, y] = await place(page, 160, 120);
  await page.mouse('mousePressed', x, y, 'left');
  for (let k = 1; k <= 5; ++k) await page.mouse('mouseMoved', x + 12 * k, y + 3 * k, 'left');
  await page.mouse('mouseReleased', x + 60, y + 15, 'left');
  await asAsked(page);
  const views = page.requests.filter(url => url.includes('/view?'));
  assert.equal(views.length, 1, 'maps are asked for once, when it has come to rest');
  assert.match(views[0], /eye=/);
  assert.deepEqual(page.complaints.filter(text => !text.includes('ERR_ABORTED')), []);
});

test('what nobody waits for any more is left', async () => {
  // 327 million paths: many minutes.
  const asked = request({ host: '127.0.0.1', port, path: pathname + 'picture?samples=256&zoom=4' });
  asked.on('error', () => {});
  asked.end();
  await new Promise(resolve => setTimeout(resolve, 1500));
  asked.destroy();
  const begin = Date.now();
  assert.equal((await get(pathname + 'cast?x=104.5&y=91.5')).status, 200);
  assert.ok(Date.now() - begin < 20000, (Date.now() - begin) + ' ms');
});

let failed = 0;
for (const { name, run } of tests) {
  try {
    await run();
    console.log('ok    ' + name);
  } catch (error) {
    ++failed;
    console.log('FAILS ' + name + '\n' + error.stack);
  }
}
await browser.close();
// Ctrl-C ends it as that signal does by default.
const ended = new Promise(resolve => server.once('exit', (code, signal) => resolve(signal)));
server.kill('SIGINT');
const signal = await Promise.race([ended, new Promise(resolve => setTimeout(() => resolve('it goes on'), 10000))]);
console.log((signal === 'SIGINT' ? 'ok    ' : 'FAILS ') + 'Ctrl-C ends it: ' + signal);
if (signal !== 'SIGINT') {
  ++failed;
  server.kill('SIGKILL');
}
process.exit(failed > 0 ? 1 : 0);
