# SPDX-License-Identifier: Apache-2.0
"""The same through the ssh of the machine, and servers of this test's own."""

import os
import shlex
import shutil
import signal
import subprocess
import unittest
from pathlib import Path

from machine_hosts import LAUNCH, MARK, PATIENCE, MachinesTest


class MachinesBySsh(MachinesTest):
    def setUp(self):
        super().setUp()
        self.sshd = shutil.which('sshd', path=os.environ['PATH'] + ':/usr/sbin:/usr/local/sbin')
        if not self.sshd or not shutil.which('ssh') or not shutil.which('ssh-keygen'):
            self.skipTest('skipped, because there is no sshd or no ssh: the package openssh-server or openssh-client is not installed')
        for name in ('host', 'user'):
            subprocess.run(['ssh-keygen', '-q', '-t', 'ed25519', '-N', '', '-f', self.folder / name], check=True, timeout=PATIENCE)
        self.arm = self.ssh_host('arm')

    def ssh_host(self, name):
        """A host whose sshd serves each connection as inetd would let it."""
        host = self.host(name)
        there = host.folder / 'tmp'  # /tmp of the host
        shutil.copy(self.folder / 'host', there / 'host')
        shutil.copy(self.folder / 'user.pub', there / 'authorized')
        config = there / 'sshd'
        options = {'HostKey': '/tmp/host', 'AuthorizedKeysFile': '/tmp/authorized', 'StrictModes': 'no', 'UsePAM': 'no',
                   'PidFile': 'none', 'PermitRootLogin': 'prohibit-password', 'PasswordAuthentication': 'no'}
        config.write_text(''.join(f'{key} {value}\n' for key, value in options.items()))
        known = self.folder / f'{name}_known'
        known.write_text(f'{name} {(self.folder / "host.pub").read_text()}')
        server = f'{self.sshd} -i -f /tmp/sshd'
        if os.geteuid() == 0:
            server = f'sh -c "mount -t tmpfs tmpfs /run && mkdir /run/sshd && exec {server}"'
        enter = host.connect()
        proxy = enter.replace(' -- ', ' -- unshare --mount ', 1) + ' ' + server if os.geteuid() == 0 else enter + ' ' + server
        client = self.folder / f'{name}_ssh'
        client.write_text(f'Host {name}\n HostName {name}\n IdentityFile {self.folder}/user\n IdentitiesOnly yes\n'
                          f' UserKnownHostsFile {known}\n ProxyCommand {proxy}\n LogLevel ERROR\n BatchMode yes\n')
        host.ssh = f'ssh -F {client} {name}'
        answer = subprocess.run([*shlex.split(host.ssh), 'true'], capture_output=True, text=True, check=False, timeout=PATIENCE,
                                stdin=subprocess.DEVNULL)
        if answer.returncode != 0:
            self.skipTest(f'skipped, because sshd takes no connection here: {answer.stderr.strip()}')
        return host

    def machine(self, more=''):
        return f'<machine name="arm" connect="{self.arm.ssh}" launch="{LAUNCH}" keepalive="2"{more}/>\n'

    def test_words_and_variables_arrive_as_they_are(self):
        done = self.launch(self.file(self.machine() + '''
            <executable name="words" machine="arm" output="screen" cmd="printf '%s|' 'it''s' 'a  b' '$HOME' '*' '; exit 7' ''">
              <env name="ODD" value="two  words; $(var none '*')"/>
            </executable>
            <executable name="host" machine="arm" output="screen" cmd="sh -c 'hostname; echo &quot;$ODD&quot;'">
              <env name="ODD" value="two  words; *"/>
            </executable>'''))
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('[arm:words-1] its|a  b|$HOME|*|; exit 7||', done.stdout)
        self.assertIn('[arm:host-2] arm\n', done.stdout)
        self.assertIn('[arm:host-2] two  words; *\n', done.stdout)

    def test_a_key_that_is_not_known_is_told(self):
        (self.arm.folder / 'tmp/authorized').write_text('')
        done = self.launch(self.file(self.machine() + '<executable cmd="true" machine="arm"/>'))
        self.assertEqual(done.returncode, 1)
        self.assertIn("error: no connection to machine 'arm': ", done.stdout)
        self.assertIn('Permission denied', done.stdout)

    def test_no_launch_there_is_told(self):
        done = self.launch(self.file(f'<machine name="arm" connect="{self.arm.ssh}" launch="/opt/none/launch"/>'
                                     '<executable cmd="true" machine="arm"/>'))
        self.assertEqual(done.returncode, 1)
        self.assertIn("is '/opt/none/launch' there? launch=\"PATH\" says where launch is on the machine", done.stdout)

    def test_nothing_survives(self):
        for victim in ('launcher', 'ssh', 'all'):
            with self.subTest(victim):
                launch = self.start(self.file(self.machine() + f'''
                    <executable name="tree" machine="arm" output="screen" sigterm_timeout="0.5" sigkill_timeout="0.5"
                        cmd="sh -c 'trap : INT; setsid sleep 1000 &amp; sleep 1000 &amp; echo ready; while :; do sleep 0.1; done'">
                      <env name="{MARK}" value="{self.mark}"/>
                    </executable>'''))
                launch.lines.wait_for('[arm:tree-1] ready')
                self.assertGreater(len(self.marked()), 2)
                killed = []
                wanted = {'launcher': ('launch', 'launch-guardian'), 'ssh': ('ssh',), 'all': ('launch', 'launch-guardian', 'ssh')}[victim]
                for entry in Path('/proc').iterdir():
                    if not entry.name.isdigit():
                        continue
                    try:
                        program = os.readlink(entry / 'exe').rpartition('/')[2]
                        words = (entry / 'cmdline').read_bytes()
                    except OSError:
                        continue
                    ours = str(self.folder).encode() in words or b'system.launch.xml' in words and program.startswith('launch')
                    if ours and program in wanted and (entry / 'cwd').exists() and os.readlink(entry / 'cwd') == str(self.folder):
                        os.kill(int(entry.name), signal.SIGKILL)
                        killed.append(program)
                self.assertEqual(sorted(set(killed)), sorted(wanted), killed)
                launch.wait(PATIENCE)
                self.assert_nothing_left(victim)


if __name__ == '__main__':
    unittest.main()
