# SPDX-License-Identifier: MIT
"""A solver in a process of its own: a query a line on its stdin, an answer a line from its stdout."""
import json
import os
import select
import shlex
import signal
import subprocess
import time


class Solver:
    """A solver's process, started at the first query and again after a crash or at the time limit."""

    def __init__(self, name, command, limit):
        self.name, self.command, self.limit = name, command, limit
        self.process, self.rest = None, b''
        self.about = {'name': name, 'version': '', 'settings': ''}
        if command is not None:
            about = self.ask({'query': 'about'})
            if 'name' in about or 'version' in about:
                self.about.update({k: str(v) for k, v in about.items()})

    def start(self):
        words = shlex.split(self.command) if isinstance(self.command, str) else self.command
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                        start_new_session=True)
        self.rest = b''

    def stop(self):
        """Ends the process, and those that it started."""
        if self.process is None:
            return
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout):
            try:
                pipe.close()
            except OSError:
                pass
        self.process = None

    def ask(self, query):
        """The answer, or {'status': 'crashed'}, or {'status': 'hung'}."""
        if self.process is None:
            self.start()
        try:
            self.process.stdin.write(json.dumps(query).encode() + b'\n')
            self.process.stdin.flush()
            line = self.line(time.monotonic() + self.limit)
        except (BrokenPipeError, OSError):
            line = b''
        if line is None:
            self.stop()
            return {'status': 'hung'}
        if not line:
            code = self.process.wait()
            self.stop()
            return {'status': 'crashed', 'why': signal.Signals(-code).name if code < 0 else f'exit code {code}'}
        try:
            answer = json.loads(line)
            return answer if isinstance(answer, dict) else {'status': 'failed', 'why': 'no object'}
        except ValueError:
            return {'status': 'failed', 'why': 'no JSON: ' + line[:60].decode(errors='replace')}

    def line(self, until):
        """The next line; nothing after the last one; None if it is too late."""
        out = self.process.stdout.fileno()
        while b'\n' not in self.rest:
            left = until - time.monotonic()
            if left <= 0 or not select.select([out], [], [], left)[0]:
                return None
            some = os.read(out, 65536)
            if not some:
                return b''
            self.rest += some
        line, self.rest = self.rest.split(b'\n', 1)
        return line
