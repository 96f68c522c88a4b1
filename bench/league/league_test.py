#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The league judges solvers that are made to be right, wrong, silent or gone, each for what it is."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import judge  # noqa: E402
import league  # noqa: E402
from solver_process import Solver  # noqa: E402

BALL = {'name': 'ball', 'query': 'ray', 'shape': {'type': 'sphere', 'radius': 2}, 'ray': {'origin': [-5, 0, 0], 'direction': [1, 0, 0]},
        'expect': {'hit': True, 't': 3, 't_abs_tol': 1e-12}, 'certificate': {'t_lo': '3', 't_hi': '3', 'normal': ['-1', '0', '0'], 'within': 0}}
BESIDE = {'name': 'beside', 'query': 'ray', 'shape': {'type': 'sphere', 'radius': 2}, 'ray': {'origin': [-5, 3, 0], 'direction': [1, 0, 0]},
          'expect': {'hit': False}, 'certificate': {'normal': ['0', '1', '0']}}
INSIDE = {'name': 'inside', 'query': 'ray', 'shape': {'type': 'sphere', 'radius': 2}, 'ray': {'origin': [1, 0, 0], 'direction': [1, 0, 0]},
          'expect': {'hit': True, 't': 0, 't_abs_tol': 0}, 'certificate': {'t_lo': '0', 't_hi': '0', 'within': 0}}
BALLS = {'name': 'balls', 'query': 'signed_distance', 'a': {'type': 'sphere', 'radius': 1}, 'b': {'type': 'sphere', 'radius': 2},
         'expect': {'distance': -3, 'abs_tol': 1e-12}, 'certificate': {}}


def command(code):
    """A solver that runs `code` for each query q."""
    program = 'import sys, json, os, time\nfor line in sys.stdin:\n  q = json.loads(line)\n  ' + code
    return [sys.executable, '-u', '-c', program]


class Processes(unittest.TestCase):
    def ask(self, code, limit=20):
        solver = Solver('s', command(code), limit)
        answer = solver.ask(judge.question(BALL))
        again = solver.ask(judge.question(BALL))
        solver.stop()
        return answer, again

    def test_answers_are_passed_on(self):
        self.assertEqual(self.ask('print(json.dumps({"status": "hit", "t": 3}))')[1], {'status': 'hit', 't': 3})

    def test_a_solver_never_sees_what_is_expected(self):
        self.assertEqual(self.ask('print(json.dumps({"keys": sorted(q)}))')[0]['keys'], ['query', 'ray', 'shape'])

    def test_one_that_dies_crashed_and_is_started_again(self):
        for answer in self.ask('q["query"] == "about" and print("{}") or os.kill(os.getpid(), 11)'):
            self.assertEqual((answer['status'], answer['why']), ('crashed', 'SIGSEGV'))

    def test_one_that_does_not_return_hung_and_is_ended(self):
        for answer in self.ask('q["query"] == "about" and print("{}") or time.sleep(60)', limit=0.5):
            self.assertEqual(answer, {'status': 'hung'})

    def test_what_is_no_answer_is_a_failure(self):
        self.assertEqual(self.ask('print("[1]")')[0]['status'], 'failed')
        self.assertEqual(self.ask('print("hello")')[0]['status'], 'failed')


class Verdicts(unittest.TestCase):
    def verdict(self, case, **answer):
        return judge.judge(case, answer)[0]

    def test_hits_by_how_far_they_are_off(self):
        # The ball's box has a half diagonal of 2 sqrt 3.
        unit = 2 * 3 ** 0.5
        for off, verdict in ((0, 'right'), (0.9e-6, 'right'), (1.1e-6, 'close'), (0.9e-3, 'close'), (1.1e-3, 'wrong')):
            self.assertEqual(self.verdict(BALL, status='hit', t=3 + off * unit), verdict)
        self.assertEqual(self.verdict(BALL, status='hit', t=float('nan')), 'wrong')
        self.assertEqual(self.verdict(BALL, status='hit'), 'wrong')
        self.assertEqual(self.verdict(BALL, status='miss'), 'wrong')

    def test_misses(self):
        self.assertEqual(self.verdict(BESIDE, status='miss'), 'right')
        self.assertEqual(self.verdict(BESIDE, status='hit', t=5), 'wrong')
        near = json.loads(json.dumps(BESIDE))
        near['ray']['origin'][1] = 2 + 1e-7
        self.assertEqual(self.verdict(near, status='hit', t=5), 'close')

    def test_casts_from_inside_are_a_convention(self):
        self.assertEqual(self.verdict(INSIDE, status='inside', t=0), 'right')
        self.assertEqual(self.verdict(INSIDE, status='hit', t=1), 'convention')
        self.assertEqual(self.verdict(INSIDE, status='miss'), 'convention')

    def test_distances_and_depths(self):
        self.assertEqual(self.verdict(BALLS, status='overlapping', value=-3), 'right')
        self.assertEqual(self.verdict(BALLS, status='overlapping', distance=-3.1), 'wrong')
        self.assertEqual(self.verdict(BALLS, status='overlapping'), 'yes or no')
        self.assertEqual(self.verdict(BALLS, status='separated'), 'wrong')

    def test_who_gives_up_and_says_so_is_not_wrong(self):
        for status in ('failed', 'exhausted', 'undecided'):
            self.assertEqual(self.verdict(BALL, status=status), 'said so')
        self.assertEqual(self.verdict(BALL, status='unsupported'), 'not asked')


class Program(unittest.TestCase):
    def test_a_machine_without_git_is_no_error(self):
        with mock.patch.dict(os.environ, PATH='/nowhere'):
            self.assertEqual(league.machine()[1], 'unknown')

    def test_a_stranger_s_solver_is_in_the_table_and_the_report(self):
        with tempfile.TemporaryDirectory() as folder:
            cases, page = os.path.join(folder, 'c.jsonl'), os.path.join(folder, 'r.html')
            solver = os.path.join(folder, 'solver.py')
            with open(solver, 'w') as file:
                file.write(command('print(json.dumps({"status": "hit", "t": 3, "name": "mine", "settings": "<none>"}))')[-1])
            with open(cases, 'w') as file:
                file.write(json.dumps(BALL) + '\n' + json.dumps(BESIDE) + '\n')
            out = subprocess.run([sys.executable, os.path.join(HERE, 'league.py'), '--programs', folder, '--cases', cases, '-o', page,
                                  '--exec', f'{sys.executable} -u {solver}', '-q'], capture_output=True, text=True, check=True)
            self.assertIn('not installed: minkray', out.stderr)
            row = [line for line in out.stdout.splitlines() if ' | ' in line][1]
            self.assertEqual([cell.strip() for cell in row.split(' | ')][1:5], ['2', '1', '0', '0'])
            with open(page) as file:
                text = file.read()
            self.assertIn('&lt;none&gt;', text)
            self.assertNotIn('src=', text)


if __name__ == '__main__':
    unittest.main()
