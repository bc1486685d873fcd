# SPDX-License-Identifier: Apache-2.0
"""Errors before anything has started anywhere, at their places, with what the connecting command has said."""

import os
import subprocess
import unittest

from machine_hosts import LAUNCH, MachinesTest

VERSION = subprocess.run([LAUNCH, '--version'], capture_output=True, text=True, check=True).stdout.split()[-1]


class MachineErrors(MachinesTest):
    def script(self, name, text):
        path = self.folder / name
        path.write_text(f'#!/bin/sh\n{text}\n')
        path.chmod(0o700)
        return str(path)

    def fails(self, connect, what, help_, more='', file=None):
        """The whole error. Nothing of the launch file has started, here neither."""
        self.file(file or f'<machine name="arm" connect="{connect}"{more}/>\n'
                  '<executable cmd="touch started"/>\n<executable cmd="true" machine="arm"/>')
        done = self.launch('system.launch.xml')
        error = [line for line in done.stdout.splitlines() if line.startswith('system.launch.xml:') and ' error: ' in line]
        self.assertEqual((done.returncode, error), (1, [what]), done.stdout)
        self.assertIn(help_, done.stdout)
        self.assertNotIn('process started', done.stdout)
        self.assertFalse((self.folder / 'started').exists())

    def test_no_connection(self):
        place = 'system.launch.xml:2:30: error: '
        offline = self.script('offline', 'echo "ssh: connect to host arm port 22: No route to host" >&2; exit 255')
        self.fails(offline, f"{place}no connection to machine 'arm': '{offline}' ended with exit code 255",
                   'it wrote: ssh: connect to host arm port 22: No route to host; see whether')
        missing = self.script('missing', 'echo "bash: launch: command not found" >&2; exit 127')
        self.fails(missing, f"{place}no connection to machine 'arm': '{missing}' ended with exit code 127",
                   'it wrote: bash: launch: command not found; is')
        old = self.script('old', 'echo "launch: error: no such file: agent" >&2; exit 2')
        self.fails(old, f"{place}no connection to machine 'arm': '{old}' ended with exit code 2 before launch answered there",
                   f"see what '{old} launch --version' prints")
        killed = self.script('killed', 'kill -KILL $$')
        self.fails(killed, f"{place}no connection to machine 'arm': '{killed}' was ended by SIGKILL before launch answered there", '')
        self.fails('no-such-program arm', f"{place}no connection to machine 'arm': cannot start 'no-such-program': No such file or directory",
                   "connect needs a command, such as 'ssh robot'")

    def test_silence(self):
        silent = self.script('silent', 'exec sleep 1000')
        self.fails(silent, "system.launch.xml:2:30: error: no connection to machine 'arm': launch has not answered there for 1 s",
                   f"see whether '{silent} true' works; connect_timeout allows more time", ' connect_timeout="1"')

    def test_other_versions(self):
        newer = self.script('newer', 'echo launch-agent 3 99.0.0; exec cat > /dev/null')
        self.fails(newer, f"system.launch.xml:2:30: error: no connection to machine 'arm': launch 99.0.0 there and {VERSION} here can't talk "
                   'with each other', 'install the same version on both machines')
        patched = self.script('patched', f'{self.plain()} "$@" | {{ read -r line; echo launch-agent 2 99.1.0; exec cat; }}')
        self.file(f'<machine name="arm" connect="{patched}"/>\n<executable cmd="true" machine="arm"/>')
        done = self.launch('system.launch.xml')
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn(f"launch has version 99.1.0 on machine 'arm', and {VERSION} here", done.stdout)

    def test_what_a_login_prints_is_passed_over(self):
        noisy = self.script('noisy', f'echo Welcome; printf "no end of line"; echo; exec {self.plain()} "$@"')
        self.file(f'<machine name="arm" connect="{noisy}"/>\n<executable cmd="echo there" output="screen" machine="arm"/>')
        done = self.launch('system.launch.xml')
        self.assertIn('[arm:echo-1] there', done.stdout)
        self.assertNotIn('Welcome', done.stdout)

    def test_a_hostile_agent_ends_its_connection_alone(self):
        for name, bytes_, what in (
                ('garbage', r'\1\377\377\377\377', 'what comes is no message of launch'),
                ('kind', r'\143\0\0\0\0', 'it sends a message of an unknown kind'),
                ('early', r'\4\0\0\0\5\0\0\0\1\0', 'a message is about a process that was never asked for'),
                ('short', r'\1\0\0\0\4\0\0\0\11', 'a message ends too early')):
            with self.subTest(name):
                hostile = self.script(name, f"echo launch-agent 2 {VERSION}; printf '{bytes_}'; exec sleep 1000")
                self.fails(hostile, f"system.launch.xml:2:30: error: no connection to machine 'arm': the agent there sends what it must not: "
                           f'{what}', '')

    def test_setup_that_fails(self):
        setup = self.folder / 'setup.bash'
        setup.write_text('echo "no workspace here" >&2\nreturn 3\n')
        self.fails(self.plain(), f"system.launch.xml:2:30: error: no connection to machine 'arm': the setup file '{setup}' has failed there: "
                   'exit code 3', 'it wrote: no workspace here', f' setup="{setup}"')
        self.fails(self.plain(), "system.launch.xml:2:30: error: no connection to machine 'arm': the setup file '/none.bash' does not exist "
                   'there', '', ' setup="/none.bash"')

    def test_wrong_declarations(self):
        for text, error in (
                ('<machine name="local" connect="ssh x"/>', "error: 'local' is the name of this machine, and needs no declaration"),
                ('<machine name="a b" connect="ssh x"/>', "error: 'a b' is no name for a machine"),
                ('<machine name="a" connect=" "/>', 'error: connect is empty'),
                ('<machine name="a" connect="ssh x" launch="launch; rm -rf ."/>', "error: 'launch; rm -rf .' is no plain path of a program"),
                ('<machine name="a" connect="ssh x" grace="-1"/>', 'error: grace must be from 0 to 86400 seconds, got -1'),
                ('<machine name="a" connect="ssh x" on_disconnect="wait"/>', "error: on_disconnect is expected to be stop or keep, got 'wait'"),
                ('<machine name="a" connect="ssh x" on_disconnect="keep" grace="1"/>',
                 'error: grace has no effect with on_disconnect="keep"'),
                ('<machine name="a" connect="ssh x" keep_for="1"/>', 'error: keep_for has no effect with on_disconnect="stop"'),
                ('<machine name="a" connect="ssh x" keepalive="0"/>', 'error: keepalive must be from 0.5 to 86400 seconds, got 0'),
                ('<machine name="a" connect="ssh x"/><machine name="a" connect="ssh y"/>',
                 "error: machine 'a' is declared differently in system.launch.xml:2:")):
            with self.subTest(text):
                done = self.launch('--dry-run', self.file(text))
                self.assertEqual(done.returncode, 1)
                self.assertIn(error, done.stdout)

    def test_what_does_not_go_together(self):
        process = '<executable cmd="true" machine="arm"/>'
        machine = f'<machine name="arm" connect="{self.plain()}"/>'
        for text, words, error in (
                (f'{machine}<trace session-name="t" dual-session="true"/>{process}', (),
                 'works on this machine only'),
                (f'{machine}{process}<trace session-name="t" syscalls="openat"/>', (),
                 "error: this setting of <trace> works on this machine only, and processes run on machine 'arm'"),
                (f'{machine}{process}<trace session-name="t"><channel name="k" events-kernel="sched_switch"/></trace>', (),
                 "error: this setting of <trace> works on this machine only, and processes run on machine 'arm'"),
                (f'{machine}<trace session-name="t" machine="arm" append-trace="true"/>', (),
                 "error: this setting of <trace> works on this machine only, and the trace is one of machine 'arm'"),
                (f'{machine}<trace session-name="t" machine="leg"/>', (), "error: there is no machine 'leg'"),
                (f'{machine}{process}<trace session-name="t" collect="stream"/>', (),
                 "error: collect is expected to be end or none, got 'stream'"),
                ('<trace session-name="t" machine="local" collect="end"/>', (),
                 'error: collect is for recordings of other machines, and this trace has none'),
                (f'{machine}<group machine="arm" scoped="false">{process}</group>', (), 'error: machine needs a scoped group'),
                (f'{machine}{process}', ('--contain',), "error: a launch with --contain can't reach other machines"),
                (f'{machine}{process}', ('--isolate',), "error: a launch with --isolate can't reach other machines")):
            with self.subTest(text=text, words=words):
                done = self.launch(*words, self.file(text))
                if words and "namespace" in done.stdout and error not in done.stdout:
                    self.skipTest(f'skipped, because {words} does not work here: {done.stdout.splitlines()[-1]}')
                self.assertEqual(done.returncode, 1)
                self.assertIn(error, done.stdout)
                self.assertNotIn('process started', done.stdout)

    def test_agent_is_not_started_by_hand(self):
        done = subprocess.run([LAUNCH, 'agent', 'now'], capture_output=True, text=True, check=False, env=os.environ, timeout=60,
                              stdin=subprocess.DEVNULL)
        self.assertEqual((done.returncode, done.stderr),
                         (2, 'launch agent: error: it is started by a launch, through the connect of a <machine>, not by hand\n'))


if __name__ == '__main__':
    unittest.main()
