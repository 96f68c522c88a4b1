# SPDX-License-Identifier: MIT
"""The league's table as text, and case by solver as one HTML file."""
import html as escape

import judge

COLUMNS = ('asked', 'right', 'yes or no', 'close', 'wrong', 'said so', 'crashed', 'hung', 'convention', 'not asked')
LEGEND = (f'right: within {judge.RIGHT:g} of the radius of the smaller shape; close: within {judge.CLOSE:g}; wrong: further off, or a '
          'hit for a miss; yes or no: right that they overlap or do not, without a number; said so: gave up and told; convention: the '
          'cast begins in the shape, and is a miss or told where it leaves; not asked: has no such query or shape')


def number(x):
    return '' if x is None else f'{x:.0f}' if isinstance(x, float) and x >= 10 else f'{x:.1e}' if isinstance(x, float) else str(x)


def error(x):
    return '' if x is None else f'{x:.0e}'


def lines_of(table, summary):
    head = ['solver'] + list(COLUMNS) + ['worst error', 'ns, median']
    rows = [head]
    for solver, records in table:
        line = summary(records)
        rows.append([solver.name] + [str(line[c]) for c in COLUMNS] + [error(line['worst']), number(line['ns'])])
    return rows


def aligned(rows):
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return '\n'.join(' | '.join(cell.ljust(w) if i == 0 else cell.rjust(w) for i, (cell, w) in enumerate(zip(row, widths)))
                     for row in rows)


def by_family(rays, random_table, summary):
    out = []
    for family in dict.fromkeys(ray['family'] for ray in rays):
        chosen = [(s, [r for ray, r in zip(rays, records) if ray['family'] == family]) for s, records in random_table]
        chosen = [(s, records) for s, records in chosen if any(r['verdict'] != 'not asked' for r in records)]
        out.append((family, lines_of(chosen, summary)))
    return out


def text(facts, cases, table, rays, random_table, summary):
    parts = [f"{facts['cases']} hard cases, {facts['machine']}, commit {facts['commit']}", aligned(lines_of(table, summary)), LEGEND, 'Settings:']
    parts += [f"  {s.name} {s.about['version']}: {s.about['settings']}" for s, _ in table]
    first = [(s, case, r) for s, records in table if s.name.startswith('minkray') for case, r in zip(cases, records)
             if r['verdict'] not in ('right', 'not asked')]
    parts.append("Minkray's own failures:" + ('' if first else ' none'))
    parts += [f"  {s.name}: {case['name']}: {r['verdict']} {error(r['error'])}" for s, case, r in first]
    for family, rows in by_family(rays, random_table, summary):
        parts.append(f'\nRandom rays, {family}:\n' + aligned(rows))
    return '\n'.join(parts)


STYLE = """
:root { color-scheme: light dark; --right: #cfe8d5; --close: #f3ecc4; --wrong: #f6c4b8; --said: #cddcf2; --broken: #d8b4e2; --none: transparent }
@media (prefers-color-scheme: dark) { :root { --right: #1f4a2c; --close: #574f16; --wrong: #6e2a1b; --said: #21395e; --broken: #502a5e } }
body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 100rem; padding: 0 1rem }
table { border-collapse: collapse; margin: 1rem 0; font-variant-numeric: tabular-nums }
th, td { border: 1px solid #8886; padding: .15rem .5rem; text-align: right; font-size: .85rem }
th:first-child, td:first-child { text-align: left }
td:not(:first-child) { white-space: nowrap }
thead th { position: sticky; top: 0; background: Canvas }
.right { background: var(--right) } .close { background: var(--close) } .wrong { background: var(--wrong) }
.said { background: var(--said) } .crashed, .hung { background: var(--broken) } .not { color: #888 }
"""


def table_html(rows):
    head, *body = rows
    cells = lambda row, tag: ''.join(f'<{tag}>{escape.escape(c)}</{tag}>' for c in row)
    return f'<table><thead><tr>{cells(head, "th")}</tr></thead><tbody>' + ''.join(f'<tr>{cells(r, "td")}</tr>' for r in body) + '</tbody></table>'


def cell(record):
    verdict = record['verdict']
    shown = {'right': '✓', 'not asked': '–'}.get(verdict, verdict)
    if verdict in ('close', 'wrong') and record['error'] is not None:
        shown = f'{verdict} {error(record["error"])}'
    told = escape.escape(str({k: v for k, v in record['answer'].items()}), quote=True)
    return f'<td class="{verdict.split()[0]}" title="{told}">{shown}</td>'


def html(facts, cases, table, rays, random_table, summary):
    """One page without anything from elsewhere; an answer is shown where the pointer rests on its cell."""
    rows = []
    for i, case in enumerate(cases):
        name, source = escape.escape(case['name']), escape.escape(case.get('source', ''), quote=True)
        link = f'<a href="{source}">{name}</a>' if source.startswith('http') else name
        expect = case['expect']
        truth = f"t = {expect['t']:.9g}" if expect.get('hit') else 'miss' if 'hit' in expect else f"{expect['distance']:.9g}"
        rows.append(f'<tr><td>{link}</td><td>{case["query"].replace("_", " ")}</td><td>{truth}</td>' +
                    ''.join(cell(records[i]) for _, records in table) + '</tr>')
    settings = ''.join(f'<li><b>{escape.escape(s.name)}</b> {escape.escape(s.about["version"])}: {escape.escape(s.about["settings"])}</li>'
                       for s, _ in table)
    heads = ''.join(f'<th>{escape.escape(s.name)}</th>' for s, _ in table)
    families = ''.join(f'<h3>{family}</h3>' + table_html(lines) for family, lines in by_family(rays, random_table, summary))
    return f"""<!doctype html><html lang="en"><meta charset="utf-8"><title>League of solvers</title><style>{STYLE}</style>
<h1>League of solvers</h1><p>{facts['cases']} hard cases, whose answers are proven. {escape.escape(facts['machine'])}, commit
{facts['commit']}. <code>{escape.escape(facts['command'])}</code>; {facts['limit']:g} seconds for an answer, each solver in a process of its own.</p>
{table_html(lines_of(table, summary))}<p>{LEGEND}.</p><h2>Settings</h2><ul>{settings}</ul>
{'<h2>Random rays</h2>' + families if families else ''}
<h2>Case by solver</h2><table><thead><tr><th>case</th><th>query</th><th>exact</th>{heads}</tr></thead><tbody>{''.join(rows)}</tbody></table>"""
