# SPDX-License-Identifier: Apache-2.0
"""
What makes a release: packages/prepare_release on a copy of the files that it writes, what the steps of `./dev release` are, and which
changes of the libraries for others packages/check_abi allows.
"""

import importlib.machinery
import importlib.util
import lzma
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])
PEOPLE = 'Some Robots <robots@robots.org>'


def program(name):
    """A program of packages/ as a module."""
    loader = importlib.machinery.SourceFileLoader(name, str(SOURCE / 'packages' / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


class Prepared(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        names = ['CMakeLists.txt', 'CHANGELOG.md', 'debian/control', 'debian/changelog', 'docs/install.md', 'docs/trace_reader.md', 'docs/stability.md',
                 'packages/prepare_release', 'launch_examples/package.xml',
                 *(str(path.relative_to(SOURCE)) for path in (SOURCE / 'instrumented_stack').glob('**/package.xml'))]
        for name in names:
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(SOURCE / name, self.folder / name)
        # Whatever this checkout is a commit of: there is something new, and nobody has set a maintainer.
        self.write('CHANGELOG.md', re.sub(r'^## \[', '## [Unreleased]\n\n### Fixed\n\n- Something.\n\n## [', self.read('CHANGELOG.md').replace('## [Unreleased]', '## [0.0.9]'),
                                          count=1, flags=re.M))
        self.version = re.search(r'^project\(launch VERSION (\S+)', self.read('CMakeLists.txt'), re.M)[1]
        self.next = f'{int(self.version.split(".")[0]) + 1}.0.0'
        self.write('debian/changelog', f'launch ({self.version}) unstable; urgency=medium\n\n  * New.\n\n'
                                       ' -- launch maintainers <maintainers@launch.example>  Thu, 26 Nov 2026 12:00:00 +0000\n')

    def read(self, name):
        return (self.folder / name).read_text()

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def contents(self):
        return {path: path.read_bytes() for path in self.folder.rglob('*') if path.is_file()}

    def prepare(self, *words):
        return subprocess.run([self.folder / 'packages/prepare_release', *words], capture_output=True, text=True)

    def test_the_version_and_the_maintainer_stand_everywhere(self):
        done = self.prepare(self.next, PEOPLE)
        self.assertEqual((done.stderr, done.returncode), ('', 0))
        self.assertIn(f'project(launch VERSION {self.next} ', self.read('CMakeLists.txt'))
        for path in self.folder.glob('**/package.xml'):
            text = path.read_text()
            self.assertNotIn(f'<version>{self.version}</version>', text)
            self.assertIn('<maintainer email="robots@robots.org">Some Robots</maintainer>', text)
        self.assertIn('<version>28.1.0</version>', self.read('instrumented_stack/rclcpp/package.xml'))
        self.assertIn(f'\nMaintainer: {PEOPLE}\n', self.read('debian/control'))
        self.assertRegex(self.read('debian/changelog'), rf'(?s)\Alaunch \({re.escape(self.next)}\) unstable.*\n -- {PEOPLE}  \w+, \d+ \w+ \d+ [\d:]+ [+-]\d+\n\Z')
        self.assertRegex(self.read('CHANGELOG.md'), rf'\n## \[{re.escape(self.next)}\] - \d+-\d\d-\d\d\n\n### Fixed\n')
        self.assertNotIn('[Unreleased]', self.read('CHANGELOG.md'))
        self.assertIn(f'tar -xf launch-{self.next}-debian-12-amd64.tar.xz', self.read('docs/install.md'))
        minor = self.next.rsplit('.', 1)[0]
        self.assertIn(f'find_package(launch_trace_reader {minor})', self.read('docs/trace_reader.md'))
        self.assertIn(f'`.so.{minor}`', self.read('docs/stability.md'))

    def test_who_hands_out_a_version_may_be_told_later(self):
        self.assertEqual(self.prepare(self.next).returncode, 0)
        self.assertIn('maintainers@launch.example', self.read('debian/changelog'))
        self.assertEqual(self.prepare(PEOPLE).returncode, 0)
        parts = [self.read(name) for name in ('debian/control', 'debian/changelog', 'launch_examples/package.xml')]
        self.assertEqual([text.count('maintainers@launch.example') for text in parts], [0, 0, 0])
        self.assertRegex(parts[1], rf'(?s)\Alaunch \({re.escape(self.next)}\) unstable.*\n -- {PEOPLE}  \w+, \d+ \w+ \d+ [\d:]+ [+-]\d+\n\Z')

    def test_a_release_before_stays_in_the_packages_changelog(self):
        self.write('debian/changelog', self.read('debian/changelog').replace('launch.example', 'robots.org'))
        self.assertEqual(self.prepare(self.next, PEOPLE).returncode, 0)
        self.assertEqual(re.findall(r'^launch \((.*)\)', self.read('debian/changelog'), re.M), [self.next, self.version])

    def test_a_mistake_changes_nothing(self):
        before = self.contents()
        for words, told in (((self.version, PEOPLE), 'does not come after'), (('1.0', PEOPLE), 'MAJOR.MINOR.PATCH'), ((self.next, 'Some Robots'), 'NAME <MAIL>'),
                            ((), 'wants a version, a maintainer, or both'), ((self.next, 'A <a@b.example>'), 'domain for examples'),
                            ((self.next, 'A <a@example.com>'), 'domain for examples'), ((self.next, 'A <root@localhost>'), 'domain for examples')):
            with self.subTest(words):
                done = self.prepare(*words)
                self.assertEqual(done.returncode, 2)
                self.assertRegex(done.stderr, r'\Aprepare_release: error: .*\n\Z')
                self.assertIn(told, done.stderr)
        self.assertEqual(self.contents(), before)

    def test_nothing_new_is_no_release(self):
        self.write('CHANGELOG.md', '## [Unreleased]\n\n## [0.1.0]\n\n- Something.\n')
        self.assertIn('nothing new', self.prepare(self.next, PEOPLE).stderr)

    @unittest.skipUnless(shutil.which('git'), 'git is not installed')
    def test_what_is_missing_is_told(self):
        environment = {**os.environ, 'GIT_CONFIG_GLOBAL': '/dev/null', 'GIT_CEILING_DIRECTORIES': str(self.folder.parent)}
        for name in ('AUTHOR', 'COMMITTER'):
            environment |= {f'GIT_{name}_NAME': 'A', f'GIT_{name}_EMAIL': 'a@b.example'}

        def git(*words):
            subprocess.run(['git', *words], cwd=self.folder, env=environment, check=True, capture_output=True)

        def check():
            done = subprocess.run([self.folder / 'packages/prepare_release', '--check'], env=environment, capture_output=True, text=True)
            return done.returncode, done.stdout

        git('init')
        git('add', '.')
        git('commit', '-m', 'before')
        code, told = check()
        self.assertEqual(code, 1)
        for line in (f'  the commit has no tag v{self.version}\n', '  the newest section of CHANGELOG.md is [Unreleased]',
                     '  the maintainer is not set (debian/changelog): no mail arrives at maintainers@launch.example'):
            self.assertIn(line, told)
        self.assertEqual(self.prepare(self.next, PEOPLE).returncode, 0)
        code, told = check()
        self.assertEqual((code, told), (1, f'  the commit has no tag v{self.next}\n  there are changes that are not committed\n'))
        git('commit', '-a', '-m', 'after')
        git('tag', f'v{self.next}')
        self.assertEqual(check(), (0, f'{self.next} can be handed out\n'))


class Steps(unittest.TestCase):

    ON = ('#!/bin/sh\n'
          'echo "$*"\n'
          'case "$*" in\n'
          '  "debian:13 build") exit 1 ;;\n'
          '  "debian:testing test"*) echo "97% tests passed, 3 tests failed out of 100"; exit 8 ;;\n'
          '  "debian:13/cross-arm64 test-guest") echo "test-guest: skipped, because there is no kernel" ;;\n'
          '  "debian:13/cross-arm64 "*) echo "dev on: error: there is no emulator" >&2; exit 2 ;;\n'
          '  "debian:12 package") mkdir -p build/systems/debian-12/build/packages && echo x >build/systems/debian-12/build/packages/launch-tools_1.deb ;;\n'
          '  *check_image) echo "check_image: error: no podman"; exit 1 ;;\n'
          'esac\n')

    PREPARE = ('#!/bin/sh\n'
               'echo "  no tag"\n'
               'echo "prepare_release: error: 1 thing is missing: $*" >&2\n'
               'exit 1\n')

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / 'packages').mkdir()
        for name in ('dev', 'packages/systems.sh', 'packages/table.txt', 'packages/release', 'CMakeLists.txt', 'CHANGELOG.md'):
            shutil.copy(SOURCE / name, self.folder / name)
        for name, text in (('on', self.ON), ('prepare_release', self.PREPARE)):
            (self.folder / 'packages' / name).write_text(text)
            (self.folder / 'packages' / name).chmod(0o755)

    def release(self, *words):
        return subprocess.run([self.folder / 'dev', 'release', *words], capture_output=True, text=True)

    def test_goes_on_after_a_failure_and_says_what_has_failed_and_what_was_skipped(self):
        result = self.release('--skip', 'sources=no git here', '--skip', 'docs=no time')
        self.assertEqual(result.returncode, 1)
        rows = [re.split('  +', line, maxsplit=2) for line in result.stdout.splitlines()]
        self.assertEqual([(name, outcome) for name, minutes, outcome in rows],
                         [('ready', 'failed: prepare_release: error: 1 thing is missing: --check'), ('sources', 'skipped: no git here'), ('debian-12', 'passed'), ('debian-13', 'failed, see build/release-logs/debian-13.log'),
                          ('debian-testing', 'failed: 97% tests passed, 3 tests failed out of 100'), ('arm64', 'skipped: there is no emulator'),
                          ('arm64-guest', 'skipped: there is no kernel'), ('packages', 'passed'), ('abi', 'passed'), ('install', 'passed'), ('image', 'failed: check_image: error: no podman'),
                          ('docs', 'skipped: no time'), ('notes', 'passed'), ('checksums', 'passed')])
        self.assertEqual((self.folder / 'build/release-logs/debian-testing.log').read_text(), 'debian:testing build\ndebian:testing test -L unit\n'
                         '97% tests passed, 3 tests failed out of 100\n')

    def test_makes_files_with_their_checksums(self):
        result = self.release('packages', 'notes', 'checksums')
        self.assertEqual(result.returncode, 0, result.stdout)
        files = self.folder / 'build/release-files'
        self.assertEqual(sorted(path.name for path in files.iterdir()), ['NOTES.md', 'SHA256SUMS', 'launch-tools_1.deb'])
        checked = subprocess.run(['sha256sum', '--check', '--quiet', 'SHA256SUMS'], cwd=files)
        self.assertEqual(checked.returncode, 0)
        self.assertIn('### Added', (files / 'NOTES.md').read_text())

    def test_prepare_is_a_program_of_its_own(self):
        result = self.release('prepare', '1.0.0', PEOPLE)
        self.assertEqual((result.returncode, result.stderr), (1, f'prepare_release: error: 1 thing is missing: 1.0.0 {PEOPLE}\n'))

    def test_a_step_that_does_not_exist(self):
        for words in (['pancakes'], ['--skip', 'pancakes=no eggs']):
            with self.subTest(words):
                result = self.release(*words)
                self.assertEqual(result.returncode, 2)
                self.assertRegex(result.stderr, r"^dev release: error: there is no step 'pancakes'; there are: ready sources debian-12 ")


class Interfaces(unittest.TestCase):

    SUMMARY = 'Functions changes summary: {} Removed, 1 Changed, 2 Added functions\nVariables changes summary: {} Removed, 0 Changed, 0 Added variable\n'

    @classmethod
    def setUpClass(cls):
        cls.check = program('check_abi')

    def allowed(self, kept, built, removed=0, different=True):
        return not self.check.forbidden(kept, built, different, self.SUMMARY.format(removed, 0))

    def test_a_patch_changes_nothing(self):
        self.assertTrue(self.allowed((1, 0), (1, 0), different=False))
        self.assertFalse(self.allowed((1, 0), (1, 0)))

    def test_a_minor_version_takes_nothing_away(self):
        self.assertTrue(self.allowed((1, 0), (1, 1)))
        self.assertFalse(self.allowed((1, 0), (1, 1), removed=1))

    def test_a_major_version_may_and_so_may_a_minor_one_before_the_first(self):
        self.assertTrue(self.allowed((1, 4), (2, 0), removed=3))
        self.assertTrue(self.allowed((0, 1), (0, 2), removed=3))

    def test_what_is_kept_is_of_this_version_or_an_earlier_one(self):
        version = tuple(map(int, re.search(r'^project\(launch VERSION (\d+)\.(\d+)', (SOURCE / 'CMakeLists.txt').read_text(), re.M).groups()))
        for name, headers in self.check.HEADERS.items():
            text = lzma.decompress((SOURCE / f'packages/abi/{name}.abi.xz').read_bytes()).decode()
            self.assertLessEqual(self.check.origin(text)[0], version)
            for folder in headers:
                self.assertTrue((SOURCE / folder).is_dir(), folder)


if __name__ == '__main__':
    unittest.main()
