# SPDX-License-Identifier: Apache-2.0
"""`--on COMMAND`: asks launches through a connecting command. Stand-ins do to their words what ssh and docker do."""

import json
import os
import select
import shlex
import shutil
import signal
import socket
import subprocess
import unittest
from pathlib import Path

from own_launches import LAUNCH, PATIENCE, OwnLaunches

VERSION = subprocess.run([LAUNCH, '--version'], capture_output=True, text=True, check=True).stdout.split()[-1]


class OnOption(OwnLaunches):
    def setUp(self):
        super().setUp()
        # The other side: another environment, another directory, and a shell that reads the words once more.
        self.there = f'env -i HOME={self.folder} XDG_RUNTIME_DIR={self.folder}/run PATH={Path(LAUNCH).parent}:/usr/bin:/bin'
        self.ssh = self.script('ssh', f'shift\ncd /\nexec {self.there} sh -c "$*"')
        self.docker = self.script('docker', f'shift\nexec {self.there} "$@"')

    def script(self, name, text):
        path = self.folder / name
        path.write_text(f'#!/bin/sh\n{text}\n')
        path.chmod(0o700)
        return str(path)

    def on(self, connect, *words, **options):
        # What is here is not found: a command that does not go there finds nothing.
        return self.launch(*words, '--on', connect, **{'env': {**self.environment, 'XDG_RUNTIME_DIR': '/nowhere'}, **options})

    def test_every_command_works_as_it_does_there(self):
        launch = self.start_launch()
        chosen = ('--launch', launch.pid)
        for connect in (f'{self.ssh} robot', f'{self.docker} robot'):
            with self.subTest(connect):
                there = self.on(connect, 'ps', *chosen, '--json')
                self.assertEqual((there.returncode, there.stderr), (0, ''))
                self.assertEqual([process['name'] for process in json.loads(there.stdout)['launches'][0]['processes']], ['talker-1', 'sleeper-2'])
                self.assertTrue(self.on(connect, 'logs', 'talker', *chosen).stdout.startswith('[talker-1] ready\n'))
                before = self.pid_of(launch, 'sleeper-2')
                self.assertEqual(self.on(connect, 'restart', 'slee*', *chosen).returncode, 0)
                self.assertNotEqual(self.pid_of(launch, 'sleeper-2'), before)
                self.assertEqual(self.on(connect, 'stop', 'sleeper', *chosen).returncode, 0)
                self.assertIsNone(self.pid_of(launch, 'sleeper-2'))
                self.assertEqual(self.on(connect, 'start', 'sleeper', *chosen).returncode, 0)
                self.assertIsNotNone(self.pid_of(launch, 'sleeper-2'))
                self.assertEqual(self.on(connect, 'signal', 'talker', 'USR1', *chosen).stdout, 'talker-1 got SIGUSR1\n')
        self.assertEqual(self.on(f'{self.ssh} robot', 'shutdown', *chosen).stdout, f'launch {launch.pid} has ended\n')
        launch.wait(PATIENCE)

    def test_words_arrive_as_they_were_typed(self):
        launch = self.start_launch()
        for word in ("it's", 'a "b"  c', '$HOME', '*', '`id`', '; exit 7', '\\', 'ä'):
            with self.subTest(word):
                there = self.on(f'{self.ssh} robot', 'stop', word + '!', '--launch', launch.pid)
                here = self.launch('stop', word + '!', '--launch', launch.pid)
                self.assertEqual((there.returncode, there.stdout, there.stderr), (here.returncode, here.stdout, here.stderr))
                self.assertEqual(there.returncode, 1)

    def test_exit_codes_and_errors_are_those_of_the_other_side(self):
        connect = f'{self.ssh} robot'
        for words in (('stop',), ('loglevel',), ('loglevel', '/x', 'lowd'), ('ps', '--hepl'), ('stop', 'x', '--launch', 'nothing'), ('signal', 'x', 'NOSUCH')):
            with self.subTest(words):
                there, here = self.on(connect, *words), self.launch(*words)
                self.assertEqual((there.returncode, there.stdout, there.stderr), (here.returncode, here.stdout, here.stderr))
                self.assertNotEqual(there.returncode, 0)

    def test_a_variable_is_the_default(self):
        launch = self.start_launch()
        environment = {**self.environment, 'XDG_RUNTIME_DIR': '/nowhere', 'LAUNCH_ON': f'{self.ssh} robot'}
        words = ('logs', 'talker', '--launch', launch.pid)
        self.assertEqual(self.launch(*words, env=environment).stdout, '[talker-1] ready\n')
        self.assertEqual(self.launch(*words, '--on', '', env=environment).returncode, 1)
        # It is for commands that ask, and for this side alone.
        self.assertEqual(self.launch('schema', 'json', env={**environment, 'LAUNCH_ON': 'false'}).returncode, 0)
        self.assertIn('--on', self.launch('ps', '--help', env=environment).stdout)
        self.assertEqual(self.launch('complete', 'stop', '', env=environment).stdout, '')

    def test_what_a_login_prints_is_passed_over(self):
        launch = self.start_launch()
        noisy = self.script('noisy', f'echo Welcome; printf "no end of line"; echo; {self.ssh} "$@"')
        there = self.on(f'{noisy} robot', 'logs', 'talker', '--launch', launch.pid)
        self.assertEqual((there.stdout, there.stderr), ('[talker-1] ready\n', ''))

    def test_another_version_is_told(self):
        launch = self.start_launch()
        newer = self.script('newer', f'{self.docker} "$@" | sed -u "1s/ [0-9.]*$/ 99.1.0/"')
        there = self.on(f'{newer} robot', 'logs', 'talker', '--launch', launch.pid)
        self.assertEqual(there.stdout, '[talker-1] ready\n')
        self.assertEqual(there.stderr, f'launch logs: warning: launch has version 99.1.0 on the other side, and {VERSION} here\n')
        other = self.script('other', 'echo launch-remote 2 99.1.0; exec cat > /dev/null')
        self.assertEqual(self.on(other, 'ps').stderr,
                         f"launch ps: error: launch 99.1.0 on the other side of '{other}' and {VERSION} here can't talk with each other\n"
                         '      = help: install the same version on both sides\n')
        strange = self.script('strange', f'echo launch-remote 1 {VERSION}; echo nonsense; exec cat > /dev/null')
        self.assertEqual(self.on(strange, 'ps').stderr,
                         f"launch ps: error: launch on the other side of '{strange}' sends what is no message of launch\n"
                         f"      = help: see what '{strange} launch --version' prints; it must be {VERSION} or later\n")

    def test_what_does_not_connect_is_told(self):
        bare = self.script('bare', 'shift; exec env -i PATH=/usr/bin:/bin sh -c "$*"') + ' robot'
        old = self.script('old', 'echo I am old; exit 1')
        offline = self.script('offline', 'echo "no route to host" >&2; exit 255')
        killed = self.script('killed', 'kill -KILL $$')
        dies = self.script('dies', f'echo launch-remote 1 {VERSION}; head -c 1 > /dev/null; exit 255')
        for connect, before, what, help_ in (
                (bare, 'sh: 1: launch: not found\n', f"there is no program 'launch' in the PATH on the other side of '{bare}'",
                 f"install it there, or say where it is: --on '{bare} env PATH=/opt/launch/bin:/usr/bin:/bin'"),
                (old, 'I am old\n', f"'{old}' ended with exit code 1 before launch answered there",
                 f"see what '{old} launch --version' prints; it must be {VERSION} or later"),
                (offline, 'no route to host\n', f"no connection: '{offline}' ended with exit code 255", f"see whether '{offline} true' works"),
                (killed, '', f"'{killed}' was ended by SIGKILL before launch answered there",
                 f"see what '{killed} launch --version' prints; it must be {VERSION} or later"),
                (dies, '', f"the connection has ended: '{dies}' ended with exit code 255", 'what was asked for may have happened'),
                ('/no/such/program', '', "cannot start '/no/such/program': No such file or directory",
                 "--on needs a command, such as 'ssh robot'")):
            with self.subTest(connect):
                result = self.on(connect, 'ps')
                self.assertEqual(result.stderr, f'{before}launch ps: error: {what}\n      = help: {help_}\n')
                self.assertEqual((result.returncode, result.stdout), (255, ''))

    def test_the_remedy_for_a_program_outside_the_path_works(self):
        launch = self.start_launch()
        bare = self.script('bare', f'shift; exec env -i XDG_RUNTIME_DIR={self.folder}/run PATH=/usr/bin:/bin sh -c "$*"')
        there = self.on(f'{bare} robot env PATH={Path(LAUNCH).parent}:/usr/bin:/bin', 'logs', 'talker', '--launch', launch.pid)
        self.assertEqual((there.stdout, there.stderr), ('[talker-1] ready\n', ''))

    def test_a_wrong_option_is_told(self):
        see = "      = help: see 'launch ps --help'\n"
        for words, message in ((('--on',), '--on needs a value'), (('--on', ' '), "--on needs a command, such as 'ssh robot'"),
                               (('--on', "ssh 'robot"), '--on "ssh \'robot": no closing quotation in the command line')):
            with self.subTest(words):
                result = self.launch('ps', *words)
                self.assertEqual((result.returncode, result.stderr), (2, f'launch ps: error: {message}\n{see}'))

    def followed(self, connect):
        """`launch logs -f` through a connecting command, when its first line is there."""
        launch = self.start_launch()
        logs = self.start(LAUNCH, 'logs', '-f', '--launch', str(launch.pid), '--on', connect)
        logs.lines.wait_for('[talker-1] ready')
        return logs

    # The processes that have this number among their words.
    def commands_with(self, word):
        found = []
        for entry in Path('/proc').glob('[0-9]*/cmdline'):
            try:
                words = entry.read_bytes().split(b'\0')
            except OSError:
                continue
            if word.encode() in words and b'logs' in words:
                found.append(int(entry.parent.name))
        return found

    def test_a_signal_ends_both_sides(self):
        # The word is unique, and the command there has it as well.
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                logs = self.followed(f'{self.docker} robot')
                there = [pid for pid in self.commands_with(logs.args[4]) if pid != logs.pid]
                self.assertEqual(len(there), 1)
                gone = os.pidfd_open(there[0])
                logs.send_signal(number)
                self.assertEqual(logs.wait(PATIENCE), -number)
                self.wait_for_end(gone)

    def wait_for_end(self, pidfd):
        ready, _, _ = select.select([pidfd], [], [], PATIENCE)
        os.close(pidfd)
        self.assertTrue(ready, 'the command on the other side goes on')

    def test_when_this_side_is_killed_the_other_one_ends(self):
        logs = self.followed(f'{self.docker} robot')
        gone = os.pidfd_open([pid for pid in self.commands_with(logs.args[4]) if pid != logs.pid][0])
        logs.kill()
        logs.wait(PATIENCE)
        self.wait_for_end(gone)

    def test_a_reader_that_has_enough_ends_it_quietly(self):
        launch = self.start_launch()
        with subprocess.Popen([LAUNCH, 'events', '--launch', str(launch.pid), '--on', f'{self.docker} robot'],
                              env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as events:
            # It follows when it prints what happens.
            while not select.select([events.stdout], [], [], 0.1)[0]:
                self.launch('restart', 'sleeper', '--launch', launch.pid)
            events.stdout.close()
            while events.poll() is None:
                self.launch('restart', 'sleeper', '--launch', launch.pid)
            self.assertEqual(events.wait(PATIENCE), -signal.SIGPIPE)
            self.assertEqual(events.stderr.read(), b'')


class RealSsh(OwnLaunches):
    """The same through the ssh of the machine, and a server of this test's own."""

    def setUp(self):
        super().setUp()
        self.sshd = shutil.which('sshd', path=os.environ['PATH'] + ':/usr/sbin:/usr/local/sbin')
        if not self.sshd or not shutil.which('ssh') or not shutil.which('ssh-keygen'):
            self.skipTest('skipped, because there is no sshd or no ssh: the package openssh-server or openssh-client is not installed')

    def start_server(self):
        for name in ('host', 'user'):
            subprocess.run(['ssh-keygen', '-q', '-t', 'ed25519', '-N', '', '-f', self.folder / name], check=True, timeout=PATIENCE)
        shutil.copy(self.folder / 'user.pub', self.folder / 'authorized')
        with socket.create_server(('127.0.0.1', 0)) as free:
            port = free.getsockname()[1]
        # As inetd does: the server that a connection needs, and no other.
        options = {'HostKey': self.folder / 'host', 'AuthorizedKeysFile': self.folder / 'authorized', 'StrictModes': 'no', 'UsePAM': 'no',
                   'PidFile': 'none', 'PermitRootLogin': 'prohibit-password', 'PasswordAuthentication': 'no',
                   'SetEnv': f'XDG_RUNTIME_DIR={self.folder}/run'}
        config = self.folder / 'sshd_config'
        config.write_text(''.join(f'{name} {value}\n' for name, value in options.items()))
        proxy = f'{self.sshd} -i -f {config}'
        if os.geteuid() == 0:
            # A server of root needs this directory, which the start of the machine makes where the service is enabled.
            proxy = f'unshare --mount sh -c "mount -t tmpfs tmpfs /run && mkdir /run/sshd && exec {proxy}"'
        known = self.folder / 'known'
        known.write_text(f'[127.0.0.1]:{port} {(self.folder / "host.pub").read_text()}')
        client = self.folder / 'ssh_config'
        client.write_text(f'Host robot\n HostName 127.0.0.1\n Port {port}\n IdentityFile {self.folder}/user\n IdentitiesOnly yes\n'
                          f' UserKnownHostsFile {known}\n ProxyCommand {proxy}\n LogLevel ERROR\n BatchMode yes\n')
        return f'ssh -F {client} robot'

    def require_connection(self, connect):
        answer = subprocess.run([*shlex.split(connect), 'true'], capture_output=True, text=True, check=False, timeout=PATIENCE,
                                stdin=subprocess.DEVNULL)
        if answer.returncode != 0:
            self.skipTest(f'skipped, because sshd takes no connection here: {answer.stderr.strip()}')

    def test_a_launch_is_steered_through_it(self):
        connect = self.start_server()
        self.require_connection(connect)
        launch = self.start_launch()
        environment = {**self.environment, 'XDG_RUNTIME_DIR': '/nowhere'}
        missing = self.launch('ps', '--on', connect + ' env PATH=/usr/bin:/bin', env=environment)
        self.assertEqual(missing.returncode, 255)
        self.assertIn("error: there is no program 'launch' in the PATH on the other side of", missing.stderr)
        on = ('--launch', launch.pid, '--on', f'{connect} env PATH={Path(LAUNCH).parent}:/usr/bin:/bin')
        self.assertEqual(self.launch('logs', 'talker', *on, env=environment).stdout, '[talker-1] ready\n')
        before = self.pid_of(launch, 'sleeper-2')
        restarted = self.launch('restart', 'slee*', *on, env=environment)
        self.assertEqual((restarted.returncode, restarted.stderr), (0, ''))
        self.assertNotEqual(self.pid_of(launch, 'sleeper-2'), before)
        self.assertEqual(self.launch('stop', "it's", *on, env=environment).returncode, 1)
        self.assertEqual(self.launch('shutdown', *on, env=environment).stdout, f'launch {launch.pid} has ended\n')

    def test_a_server_that_knows_the_key_no_more_is_told(self):
        connect = self.start_server()
        self.require_connection(connect)
        (self.folder / 'authorized').write_text('')
        result = self.launch('ps', '--on', connect)
        self.assertEqual(result.returncode, 255)
        self.assertIn('Permission denied', result.stderr)
        self.assertIn(f"launch ps: error: no connection: '{connect}' ended with exit code 255\n", result.stderr)


if __name__ == '__main__':
    unittest.main()
