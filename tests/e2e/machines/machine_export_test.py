# SPDX-License-Identifier: Apache-2.0
"""`launch export` of a launch over several machines: what runs on a machine is in a folder of its name, and was looked up there."""

import shutil
import subprocess
import unittest

from machine_hosts import MachinesTest


class MachineExport(MachinesTest):
    maxDiff = None

    def setUp(self):
        super().setUp()
        prefix = self.folder / 'ws'
        (prefix / 'share/ament_index/resource_index/packages').mkdir(parents=True)
        (prefix / 'share/ament_index/resource_index/packages/demo').touch()
        (prefix / 'lib/demo').mkdir(parents=True)
        program = prefix / 'lib/demo/talker'
        program.write_text('#!/bin/sh\n')
        program.chmod(0o755)
        self.prefix = prefix
        arm = self.plain(f'AMENT_PREFIX_PATH={prefix}', 'ROS_DOMAIN_ID=7', 'HIDDEN=1')
        self.file(f'''<machine name="arm" connect="{arm}"/>
<executable name="here" cmd="true" required="true"/>
<node pkg="demo" exec="talker" machine="arm"><param name="rate" value="5"/><env name="MODE" value="fast"/></node>
<executable name="after" cmd="sleep 1" machine="arm"><depends_on process="talker"/><depends_on process="here"/></executable>''')

    def export(self, *words):
        done = self.launch('export', *words, 'system.launch.xml')
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def text(self, path):
        return (self.folder / path).read_text()

    def test_units_of_each_machine(self):
        said = self.export('--systemd', 'units', '--install-dir', '/etc/robot', '--as', 'root')
        units = self.folder / 'units'
        self.assertEqual(said.splitlines(), [
            *[f'{units}/{name}' for name in (
                'system.target', 'system-here.service', 'arm/system.target', 'arm/parameters/system/talker.yaml',
                'arm/system-talker.service', 'arm/system-after.service')],
            "not exported: 'after' waits until 'here' has started, on another machine (system.launch.xml:5:85)",
            "not exported: the end of all on other machines with the end of 'here' (system.launch.xml:3:2)",
            f'next: copy {units}/ to /etc/robot/, then systemctl link /etc/robot/*.service /etc/robot/*.target, then systemctl enable --now '
            'system.target',
            f"next on machine 'arm': copy {units}/arm/ to /etc/robot/, then systemctl link /etc/robot/*.service /etc/robot/*.target, then "
            'systemctl enable --now system.target',
        ])
        talker = self.text('units/arm/system-talker.service')
        self.assertIn(f'\nExecStart="{self.prefix}/lib/demo/talker" "--ros-args" "--params-file" "/etc/robot/parameters/system/talker.yaml"\n', talker)
        self.assertIn('\nWorkingDirectory=~\n', talker)
        self.assertIn('\nEnvironment="MODE=fast"\n', talker)
        self.assertIn('\nEnvironment="ROS_DOMAIN_ID=7"\n', talker)
        self.assertNotIn('HIDDEN', talker)
        self.assertNotIn('UnsetEnvironment', talker)
        after = self.text('units/arm/system-after.service')
        self.assertIn('\nAfter=system-talker.service\n', after)
        self.assertNotIn('system-here', after)
        # sleep is searched where it runs.
        self.assertIn('\nExecStart="/bin/sh" "-c" "exec \\"$$0\\" \\"$$@\\"" "sleep" "1"\n', after)
        head = [line for line in self.text('units/arm/system.target').splitlines() if line.startswith('# not exported')]
        self.assertEqual(head, ['# ' + line for line in said.splitlines() if line.startswith('not exported')])
        if shutil.which('systemd-analyze'):
            for folder in (units, units / 'arm'):
                done = subprocess.run(['systemd-analyze', 'verify', '--man=no', *map(str, folder.glob('*.*'))], capture_output=True, text=True,
                                      env={**self.environment, 'SYSTEMD_UNIT_PATH': f'{folder}:/lib/systemd/system'})
                self.assertEqual((done.returncode, done.stderr), (0, ''))

    def test_a_machine_that_is_no_longer_used_leaves_no_files(self):
        self.export('--systemd', 'units')
        self.text('units/arm/system.target')
        (self.folder / 'units/arm/mine').touch()
        self.environment['AMENT_PREFIX_PATH'] = str(self.prefix)
        said = self.export('--systemd', 'units', '--machine', 'arm=local')
        self.assertNotIn('units/arm', said)
        self.assertEqual([path.name for path in (self.folder / 'units/arm').rglob('*') if path.is_file()], ['mine'])

    def test_nobody_is_asked_offline(self):
        said = self.export('--systemd', 'units', '--offline')
        self.assertIn("not exported: the program of 'talker', for nobody has asked the machine: <prefix of demo on arm> (system.launch.xml:4:2)\n", said)

    def test_a_machine_that_can_not_be_reached_is_an_error_and_nothing_is_written(self):
        done = self.launch('export', '--systemd', 'units', '--machine', 'arm=false', 'system.launch.xml')
        self.assertEqual(done.returncode, 1)
        self.assertIn("no connection to machine 'arm'", done.stdout)
        self.assertFalse((self.folder / 'units').exists())

    def test_containers(self):
        said = self.export('--compose', 'deploy/robot.yaml', '--image', 'robot:1')
        self.assertIn('\n  here:\n', self.text('deploy/robot.yaml'))
        self.assertIn('\n  talker:\n', self.text('deploy/arm/robot.yaml'))
        self.assertIn('rate: 5', self.text('deploy/arm/parameters/talker.yaml'))
        self.assertIn(f"next on machine 'arm', with the files of {self.folder}/deploy/arm: docker compose -f robot.yaml up\n", said)
        said = self.export('--kubernetes', 'objects', '--image', 'robot:1')
        self.assertIn('\n  nodeSelector:\n    launch.machine: "arm"\n', self.text('objects/system-talker.yaml'))
        self.assertNotIn('nodeSelector', self.text('objects/system-here.yaml'))
        self.assertIn(f"next: kubectl label node NODE launch.machine=arm, with the node that is 'arm', then kubectl apply -f {self.folder}/objects\n", said)


if __name__ == '__main__':
    unittest.main()
