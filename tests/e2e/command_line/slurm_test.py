# SPDX-License-Identifier: Apache-2.0
"""`launch test --engine 'srun …'` with a Slurm of its own: munged, slurmctld and slurmd on this machine."""

import getpass
import os
import re
import shutil
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

PROGRAMS = ('munged', 'slurmctld', 'slurmd', 'sinfo', 'srun', 'salloc')
PATIENCE = 60  # seconds
TESTS = 20
PATH = os.environ.get('PATH', '') + ':/usr/sbin:/sbin'

CONFIGURATION = '''
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={directory}/munge.socket
CredType=cred/munge
SlurmctldPort={controller}
SlurmdPort={daemon}
SlurmctldPidFile={directory}/slurmctld.pid
SlurmdPidFile={directory}/slurmd.pid
StateSaveLocation={directory}/state
SlurmdSpoolDir={directory}/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
PropagateResourceLimits=NONE
SlurmdParameters=config_overrides
NodeName={host} NodeAddr=127.0.0.1 CPUs=8 State=UNKNOWN
PartitionName=test Nodes={host} Default=YES MaxTime=INFINITE State=UP
'''


def free_port():
    with socket.socket() as port:
        port.bind(('127.0.0.1', 0))
        return port.getsockname()[1]


@unittest.skipUnless(all(shutil.which(name, path=PATH) for name in PROGRAMS), 'Slurm and munge are not installed')
class Slurm(unittest.TestCase):

    def setUp(self):
        self.directory = Path(tempfile.mkdtemp(prefix='slurm-'))
        self.addCleanup(shutil.rmtree, self.directory, ignore_errors=True)
        self.directory.chmod(0o755)
        host = socket.gethostname().split('.')[0]
        file = self.directory / 'slurm.conf'
        file.write_text(CONFIGURATION.format(host=host, user=getpass.getuser(), directory=self.directory,
                                             controller=free_port(), daemon=free_port()))
        self.environment = {**os.environ, 'PATH': PATH, 'SLURM_CONF': str(file), 'ROS_HOME': str(self.directory / 'ros')}
        for name in ('state', 'spool'):
            (self.directory / name).mkdir()
        key = self.directory / 'munge.key'
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        self.start('munged', '--foreground', '--force', f'--socket={self.directory}/munge.socket', f'--key-file={key}',
                   f'--pid-file={self.directory}/munged.pid', f'--seed-file={self.directory}/munge.seed')
        self.wait_until((self.directory / 'munge.socket').exists, 'munged does not start')
        self.start('slurmctld', '-D', '-f', str(file))
        self.start('slurmd', '-D', '-f', str(file), '-N', host)
        self.wait_until(self.is_idle, 'the node does not come up')

    def start(self, *command):
        with open(self.directory / f'{command[0]}.txt', 'wb') as output:
            daemon = subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=output,
                                      stderr=subprocess.STDOUT)
        self.addCleanup(daemon.wait)
        self.addCleanup(daemon.terminate)

    def wait_until(self, holds, otherwise):
        """Skips the test where Slurm does not run at all, as in a container without the rights that it needs."""
        end = time.monotonic() + PATIENCE
        while not holds():
            if time.monotonic() > end:
                self.skipTest(f'{otherwise}: ' + ''.join(file.read_text(errors='replace')[-500:]
                                                         for file in self.directory.glob('*.txt')))
            time.sleep(0.05)

    def is_idle(self):
        state = subprocess.run(['sinfo', '-h', '-o', '%t'], env=self.environment, stdout=subprocess.PIPE,
                               stderr=subprocess.DEVNULL, text=True, check=False)
        return state.stdout.strip() == 'idle'

    def test_each_test_is_a_job_step(self):
        file = self.directory / 'a.launch.xml'
        file.write_text(f'''<launch>
  <for len="{TESTS}" name="i">
    <test name="step $(index i)">
      <executable name="step" shell="true" cmd="echo step $SLURM_STEP_ID; exit $(index i)"/>
      <output process="step" pattern="^step [0-9]+$"/>
      <exit process="step" code="$(eval '0 if $(index i) == 7 else $(index i)')"/>
    </test>
  </for>
</launch>
''')
        result = subprocess.run(
            ['salloc', '-Q', '-n', '8', os.environ['LAUNCH_PROGRAM'], 'test', str(file), '-j', '8',
             '--engine', 'srun -n1 --overlap -Q'], env=self.environment, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True, timeout=5 * PATIENCE, check=False)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn(f'\n{TESTS} tests: {TESTS - 1} passed, 1 failed, in ', result.stdout)
        self.assertRegex(result.stdout, re.compile("^FAIL  .*: step 7  .*\n.*error: 'step' has exited with code 7$",
                                                   re.MULTILINE))


if __name__ == '__main__':
    unittest.main()
