# SPDX-License-Identifier: Apache-2.0
"""
The table of packages that `./dev` installs, the functions that read it, and what `./dev on` says to wrong words.
"""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])
TABLE = SOURCE / 'packages/table.txt'
FUNCTIONS = SOURCE / 'packages/systems.sh'

GROUPS = {'build', 'test', 'bench', 'format', 'lint', 'fuzz', 'docs', 'editor', 'guest', 'guest-arm64', 'package', 'abi', 'root', 'emulator'}
ABOUT_THE_SYSTEM = {'suite', 'also', 'verified'}


def rows():
    """The rows of the table below its head, and the names of the systems in the head."""
    lines = [line.split() for line in TABLE.read_text().splitlines() if line and not line.startswith('#')]
    return lines[1:], lines[0][2:]


def bash(script, *arguments, environment=None):
    """What a script prints that has the functions of systems.sh."""
    return subprocess.run(['bash', '-euo', 'pipefail', '-c', f'say() {{ echo "$*" >&2; }}; . {FUNCTIONS}; {script}', 'bash', *arguments],
                          capture_output=True, text=True, env={**os.environ, **(environment or {})})


class Table(unittest.TestCase):

    def test_every_row_has_a_word_for_every_system(self):
        lines, systems = rows()
        self.assertEqual(len(systems), len(set(systems)))
        for line in lines:
            with self.subTest(' '.join(line[:2])):
                self.assertEqual(len(line), 2 + len(systems))
                self.assertIn(line[0], GROUPS | ABOUT_THE_SYSTEM)
                self.assertRegex(line[1], r'^(-|(program|found|module|header|python):\S+)$')
                self.assertNotEqual(line[2], '=', 'nothing stands before the first system')
                for word in line[2:]:
                    self.assertRegex(word, r'^(=|-|[a-z0-9][a-z0-9+.-]+)$')

    def test_every_group_has_rows_and_no_need_stands_there_twice(self):
        lines, _ = rows()
        self.assertEqual({line[0] for line in lines}, GROUPS | ABOUT_THE_SYSTEM)
        needs = [(line[0], line[1], line[2]) for line in lines]
        self.assertEqual(len(needs), len(set(needs)))

    def test_every_system_says_what_is_verified(self):
        lines, systems = rows()
        verified = next(line for line in lines if line[0] == 'verified')
        for system, word in zip(systems, verified[2:]):
            with self.subTest(system):
                self.assertIn(word, ('names', 'builds', 'tests'))

    def test_the_packages_of_debian_ask_for_what_the_build_needs(self):
        # `./dev package` installs the group `build`, but a build service reads debian/control.
        control = (SOURCE / 'debian/control').read_text()
        asked = set(re.findall(r'[a-z0-9+.-]+', re.search(r'^Build-Depends:((?:\n .*)+)', control, re.M)[1]))
        only_here = {'build-essential', 'make', 'ccache', 'babeltrace2', 'libgtest-dev', 'libgmock-dev', 'libbenchmark-dev', 'python3-yaml', 'libxml2-utils',
                     'python3-jsonschema', 'btrfs-progs'}
        needed = set(bash('packages_of build debian:12').stdout.split())
        self.assertEqual(needed - only_here - asked, set())

    def test_dev_asks_for_groups_that_exist(self):
        asked = set()
        for words in re.findall(r'^ *\(?need ([a-z ]+?)\)?(?: \|\|.*)?$', (SOURCE / 'dev').read_text(), re.M):
            asked.update(words.split())
        self.assertLess({'build', 'lint', 'test'}, asked)
        self.assertEqual(asked - GROUPS, set())


class OwnSystem(unittest.TestCase):

    def system_of(self, text):
        with tempfile.NamedTemporaryFile('w') as file:
            file.write(text)
            file.flush()
            result = bash('own_system "$1"', file.name)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout.strip()

    def test_by_its_number(self):
        self.assertEqual(self.system_of('ID=debian\nVERSION_ID="13"\nVERSION_CODENAME=trixie\n'), 'debian:13')
        self.assertEqual(self.system_of('ID=ubuntu\nVERSION_ID="24.04"\nVERSION_CODENAME=noble\n'), 'ubuntu:24.04')

    def test_testing_has_no_number(self):
        self.assertEqual(self.system_of('ID=debian\nVERSION_CODENAME=forky\n'), 'debian:testing')

    def test_systems_made_of_another_one(self):
        self.assertEqual(self.system_of('ID=raspbian\nVERSION_ID="12"\nVERSION_CODENAME=bookworm\n'), 'debian:12')
        self.assertEqual(self.system_of('ID=linuxmint\nVERSION_ID="22"\nVERSION_CODENAME=wilma\nUBUNTU_CODENAME=noble\n'), 'ubuntu:24.04')

    def test_others_are_not_known(self):
        self.assertEqual(self.system_of('ID=fedora\nVERSION_ID=43\n'), '')
        self.assertEqual(self.system_of('ID=debian\nVERSION_ID="11"\nVERSION_CODENAME=bullseye\n'), '')
        self.assertEqual(bash('own_system /nowhere').stdout, '')


class Need(unittest.TestCase):

    def test_a_name_is_that_of_the_column_before(self):
        self.assertEqual(bash('packages_of emulator debian:12').stdout, bash('packages_of emulator debian:13').stdout)
        self.assertEqual(bash('packages_of emulator debian:testing').stdout, 'qemu-user\n')
        self.assertEqual(bash('packages_of format debian:13').stdout, '')

    def test_a_program_that_came_from_elsewhere_needs_no_package(self):
        script = 'is_there() { [ "$1" = found:node ]; }; wanted_packages_of editor debian:12'
        self.assertEqual(bash(script).stdout, 'npm\n')

    def test_on_a_system_that_is_not_known_it_says_what_is_missing(self):
        # As Fedora would be: nothing is installed, apt is not called.
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, 'apt-get').write_text('#!/bin/sh\necho apt was called\n')
            Path(folder, 'apt-get').chmod(0o755)
            result = bash('own_system() { :; }; system_words() { echo Plan 9; }; is_there() { [ "$1" != program:xz ]; }; need package',
                          environment={'PATH': f'{folder}:{os.environ["PATH"]}'})
        self.assertEqual(result.returncode, 1)
        self.assertIn('the packages of Plan 9 are not known here, so nothing is installed. This is missing:\n  program:xz\n', result.stderr)
        self.assertIn('Debian 12 has it in: xz-utils\n', result.stderr)
        self.assertNotIn('apt was called', result.stdout + result.stderr)

    def test_on_a_system_that_is_not_known_it_goes_on_when_all_is_there(self):
        result = bash('own_system() { :; }; is_there() { true; }; need package build; echo went on')
        self.assertEqual((result.returncode, result.stdout), (0, 'went on\n'))

    def test_it_names_what_a_known_system_does_not_have(self):
        result = bash('own_system() { echo debian:13; }; is_there() { false; }; install_packages() { echo "installs: $*"; }; need format')
        self.assertEqual(result.stderr, 'debian:13 has no package for program:clang-format-16\n')
        self.assertEqual(result.returncode, 0)


    def test_for_another_processor_it_installs_the_compiler_and_the_libraries_of_that_processor(self):
        result = bash('own_system() { echo debian:13; }; is_there() { true; }; install_packages() { printf "%s\\n" "$@"; };'
                      'apt-cache() { case $3 in libcli11-dev) echo "Architecture: all" ;; *) echo "Architecture: amd64" ;; esac; };'
                      'need build', environment={'LAUNCH_CROSS': 'arm64'})
        self.assertEqual(result.returncode, 0, result.stderr)
        packages = set(result.stdout.split())
        self.assertLessEqual({'ninja-build', 'libfmt-dev', 'crossbuild-essential-arm64', 'libfmt-dev:arm64', 'libpython3-dev:arm64'}, packages)
        self.assertEqual(packages & {'libcli11-dev:arm64', 'python3-dev:arm64', 'ninja-build:arm64'}, set())


class On(unittest.TestCase):

    def on(self, *words):
        return subprocess.run([SOURCE / 'dev', 'on', *words], capture_output=True, text=True)

    def test_a_system_that_is_not_in_the_table(self):
        result = self.on('debian:6', 'build')
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"^dev on: error: unknown system 'debian:6'; there are: debian:12 .*ubuntu:24.04")

    def test_a_processor_that_is_not_known(self):
        result = self.on('debian:12/vax', 'build')
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr, "dev on: error: unknown processor 'vax'; there are amd64 and arm64\n")

    def test_a_processor_without_a_cross_compiler(self):
        result = self.on('debian:13/cross-vax', 'build')
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr, "dev on: error: there is no cross compiler for 'vax' here; there is one for arm64\n")

    def test_without_a_command_it_prints_its_usage(self):
        result = self.on('debian:12')
        self.assertEqual(result.returncode, 2)
        self.assertTrue(result.stderr.startswith('Usage: ./dev on SYSTEM COMMAND'), result.stderr)


if __name__ == '__main__':
    unittest.main()
