# SPDX-License-Identifier: Apache-2.0
"""What `launch export` writes, read back as systemd, Compose and Kubernetes read it, is what the plan has."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import yaml

LAUNCH = os.environ['LAUNCH_PROGRAM']
PATIENCE = 120  # seconds
ODD = ['plain', 'two words', '', '"double"', "'single'", 'back\\slash', 'trailing\\', '100% %n %%', '$HOME ${HOME} $$ $(HOME) $$(X) $',
       'line\nend\n', '\n', ' first\nsecond', 'tab\tcr\r\x0b\x1b\x7f', 'ünï→😀\u2028\u2029\u0085\ufeff', 'no', '1.10', '0x1f', '~', '#x', ';',
       '- a', ': b', '{a: b}', '\\n', '\\x41', '%%$$\\"', ' lead', 'trail ', '*', '&a', '!b', '|', '>', '@x', '`', '-', '+', '=']
ESCAPES = {'a': '\a', 'b': '\b', 'f': '\f', 'n': '\n', 'r': '\r', 't': '\t', 'v': '\v', 's': ' ', '\\': '\\', '"': '"', "'": "'"}
# Prints what it has got.
SAYS = 'import json, os, sys; print(json.dumps([sys.argv[1:], os.getcwd()]))'


def systemd_words(text):
    """Splits and unquotes as systemd.syntax(7) says; each specifier must be a doubled "%"."""
    words, word, quote = [], None, ''
    rest = iter(text)
    for c in rest:
        if c == '\\':
            c = next(rest)
            word = (word or '') + (chr(int(next(rest) + next(rest), 16)) if c == 'x' else ESCAPES[c])
        elif quote:
            quote = '' if c == quote else quote
            word = word if quote == '' else word + c
        elif c in '"\'':
            quote, word = c, word or ''
        elif c in ' \t':
            words += [] if word is None else [word]
            word = None
        else:
            word = (word or '') + c
    assert not quote, text
    words += [] if word is None else [word]
    return [undoubled(word, '%') for word in words]


def undoubled(text, sign):
    rest = text.replace(sign * 2, '')
    assert sign not in rest, f'a single {sign} in {text!r}'
    return text.replace(sign * 2, sign)


def compose_value(text):
    return undoubled(text, '$')


def kubernetes_value(text):
    """As expansion.Expand() of Kubernetes, for a container without variables."""
    result, i = '', 0
    while i < len(text):
        if text[i] == '$' and i + 1 < len(text):
            assert not re.match(r'\$\([^)]*\)', text[i:]), f'a variable in {text!r}'
            result += '$' if text[i + 1] == '$' else text[i:i + 2]
            i += 2
        else:
            result += text[i]
            i += 1
    return result


def unit_of(path):
    """Keys with lists of their values."""
    text = path.read_bytes().decode()  # systemd passes over lines that are no UTF-8
    assert '\r' not in text and '\0' not in text, 'systemd ends a line there'
    settings = {}
    for line in text.split('\n'):
        if line and line[0] not in '#[':
            key, value = line.split('=', 1)
            assert not value.endswith('\\'), 'the next line would belong to it'
            settings.setdefault(key, []).append(value)
    return settings


class ExportReadBack(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix='export-')
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()
        self.place = self.folder / 'a "b"\nc$ %n'
        self.place.mkdir()
        program = self.folder / 'it$\'s "a" %program'
        program.write_text(f'#!{sys.executable}\n{SAYS}\n')
        program.chmod(0o755)
        (self.folder / 'odd.launch.py').write_text(f'''
from launch import LaunchDescription
from launch.actions import ExecuteProcess, SetEnvironmentVariable
def generate_launch_description():
    return LaunchDescription([
        SetEnvironmentVariable('NO', 'yes'),
        *[SetEnvironmentVariable(f'ODD_{{i}}', text) for i, text in enumerate({ODD!r})],
        ExecuteProcess(cmd=[{sys.executable!r}, '-c', {SAYS!r}, *{ODD!r}], name='says'),
        ExecuteProcess(cmd=[{sys.executable!r}, '-c', {SAYS!r}, *{ODD!r}], name='no', cwd={str(self.place)!r}),
        ExecuteProcess(cmd=[{str(program)!r}, *{ODD!r}], name='../../1.10\\n"x"'),
    ])
''')
        plan = self.launch('--dry-run=json', 'odd.launch.py')
        self.assertEqual(plan.returncode, 0, plan.stderr)
        self.processes = json.loads(plan.stdout)['processes']
        self.assertEqual(self.processes[0]['argv'][3:], ODD)
        self.assertEqual([self.processes[0]['env'][f'ODD_{i}'] for i in range(len(ODD))], ODD)

    def launch(self, *words):
        return subprocess.run([LAUNCH, *words], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE)

    def export(self, *words):
        done = self.launch('export', *words, 'odd.launch.py')
        self.assertEqual((done.returncode, done.stderr), (0, ''), done.stdout)
        self.assertNotIn('not exported', done.stdout)
        outside = {path for path in self.folder.parent.glob('*1.10*')}
        self.assertEqual(outside, set(), 'a name leads out of the folder')
        return done.stdout

    def assert_set(self, process, variables):
        for name, value in process['env'].items():
            self.assertEqual(variables.get(name), value, name)

    def test_systemd(self):
        self.export('--systemd', 'units')
        units = sorted((self.folder / 'units').glob('*.service'), key=lambda path: ['says', 'no', 'x'].index(path.stem.strip('-').split('-')[-1]))
        self.assertEqual(len(units), 3)
        for process, path in zip(self.processes, units):
            unit = unit_of(path)
            [command] = unit['ExecStart']
            argv = [undoubled(word, '$') for word in systemd_words(command)]
            with self.subTest(process['name']):
                self.assertRegex(argv[0], r'^/[^"\'\\$]+$', 'a path that systemd takes')
                self.assert_set(process, dict(systemd_words(value)[0].split('=', 1) for value in unit['Environment']))
                if process['name'] == 'says':
                    self.assertEqual(argv, process['argv'])
                # A shell stands before what systemd does not take as a program or a directory. It runs the same.
                directory = [undoubled(value, '%') for value in unit.get('WorkingDirectory', ['/'])][0]
                said = subprocess.run(argv, cwd=directory, capture_output=True, text=True, timeout=PATIENCE)
                self.assertEqual(said.returncode, 0, said.stderr)
                self.assertEqual(json.loads(said.stdout), [ODD, process['cwd'] or str(self.folder)])

    def test_systemd_finds_nothing_wrong(self):
        if not shutil.which('systemd-analyze'):
            self.skipTest('skipped, because systemd-analyze is not installed')
        self.export('--systemd', 'units', '--name', 'robot 50% "x"')
        units = self.folder / 'units'
        done = subprocess.run(['systemd-analyze', 'verify', '--man=no', *map(str, units.glob('*.*'))], capture_output=True, text=True,
                              timeout=PATIENCE, env={**os.environ, 'SYSTEMD_UNIT_PATH': f'{units}:/lib/systemd/system'})
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, ''))

    def test_compose(self):
        self.export('--compose', 'compose.yaml', '--image', 'robot:1')
        services = yaml.safe_load((self.folder / 'compose.yaml').read_bytes())['services']
        self.assertEqual([type(name) for name in services], [str] * 3)
        for process, service in zip(self.processes, services.values()):
            with self.subTest(process['name']):
                self.assertEqual([compose_value(word) for word in service['command']], process['argv'])
                self.assert_set(process, {name: compose_value(value) for name, value in service['environment'].items()})
                self.assertEqual(compose_value(service.get('working_dir', '')) or None, process['cwd'] or None)

    def test_compose_is_what_compose_reads(self):
        for tool in (['docker', 'compose'], ['docker-compose']):
            if shutil.which(tool[0]) and subprocess.run([*tool, 'version'], capture_output=True).returncode == 0:
                break
        else:
            self.skipTest('skipped, because neither docker compose nor docker-compose is installed')
        self.export('--compose', 'compose.yaml', '--image', 'robot:1')
        done = subprocess.run([*tool, '-f', 'compose.yaml', 'config'], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual(done.returncode, 0, done.stderr)
        services = yaml.safe_load(done.stdout)['services']
        for process in self.processes[:2]:
            service = services[process['name']]
            self.assertEqual([compose_value(word) for word in service['command']], process['argv'])
            self.assert_set(process, {name: compose_value(value) for name, value in service['environment'].items()})

    def test_kubernetes(self):
        self.export('--kubernetes', 'objects', '--image', 'robot:1')
        self.compare_pods([yaml.safe_load(path.read_bytes()) for path in (self.folder / 'objects').glob('*.yaml')])

    def test_kubernetes_is_what_kubectl_reads(self):
        if not shutil.which('kubectl'):
            self.skipTest('skipped, because kubectl is not installed')
        self.export('--kubernetes', 'objects', '--image', 'robot:1')
        # With --local, it asks no cluster: it reads the objects as what they are, and writes them again.
        done = subprocess.run(['kubectl', 'label', '--local', '-f', 'objects', 'read=back', '-o', 'json'], cwd=self.folder, capture_output=True,
                              timeout=PATIENCE, env={**os.environ, 'HOME': str(self.folder), 'KUBECONFIG': '/dev/null'})
        self.assertEqual(done.returncode, 0, done.stderr)
        decoder, text, pods = json.JSONDecoder(strict=False), done.stdout.decode().strip(), []
        while text:
            pod, end = decoder.raw_decode(text)
            pods.append(pod)
            text = text[end:].strip()
        self.compare_pods(pods)

    def compare_pods(self, pods):
        containers = {pod['spec']['containers'][0]['name']: pod['spec']['containers'][0] for pod in pods}
        self.assertEqual(set(containers), {'says', 'no', '1-10-x'})
        for process, name in zip(self.processes, ('says', 'no', '1-10-x')):
            with self.subTest(process['name']):
                self.assertEqual([kubernetes_value(word) for word in containers[name]['args']], process['argv'])
                self.assert_set(process, {item['name']: kubernetes_value(item['value']) for item in containers[name]['env']})
                self.assertEqual(containers[name].get('workingDir') or None, process['cwd'] or None)

    def test_what_is_left_out_stands_in_the_head_of_the_first_file(self):
        (self.folder / 'odd.launch.xml').write_text('''<launch>
  <executable cmd="true" name="a" tty="true"/>
  <on_process_exit process="a"><log message="gone"/></on_process_exit>
  <timer period="2"><shutdown reason="done"/></timer>
</launch>
''')
        expected = ['not exported: the terminal of \'a\' (odd.launch.xml:2:4)',
                    'not exported: on_process_exit of \'a\' with exit code any (odd.launch.xml:3:4)',
                    'not exported: the end of all that the file asks for: done (odd.launch.xml:4:22)']
        for words, first in ((('--systemd', 'head'), 'head/odd.target'), (('--compose', 'head/compose.yaml', '--image', 'x'), 'head/compose.yaml'),
                             (('--kubernetes', 'head', '--image', 'x'), 'head/odd-a.yaml')):
            with self.subTest(words):
                done = self.launch('export', *words, 'odd.launch.xml')
                self.assertEqual((done.returncode, done.stderr), (0, ''))
                told = [line for line in done.stdout.splitlines() if line.startswith('not exported')]
                self.assertEqual(sorted(told), sorted(expected))
                head = (self.folder / first).read_text().splitlines()[1:4]
                self.assertEqual(sorted(head), sorted('# ' + line for line in expected))
        self.assertTrue((self.folder / 'head/odd.target').exists(), 'an export of another kind has left it')

    def test_parameter_files_are_where_they_will_be(self):
        # Two names of one word, and a name that is like a second file.
        (self.folder / 'odd.launch.xml').write_text(f'''<launch>
  <node exec="{shutil.which('true')}" exec_name="x y"><param name="a" value="ü %"/><param from="more.yaml" allow_substs="true"/></node>
  <node exec="{shutil.which('true')}" exec_name="x/y"><param name="b" value="2"/></node>
  <node exec="{shutil.which('true')}" exec_name="x-y.2"><param name="c" value="3"/></node>
</launch>
''')
        (self.folder / 'more.yaml').write_text('/**:\n  ros__parameters:\n    d: $(env HOME)\n')
        done = self.launch('export', '--systemd', 'units', '--install-dir', '/etc/odd/', 'odd.launch.xml')
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertIn(f'next: copy {self.folder}/units/ to /etc/odd/, then systemctl link /etc/odd/*.service /etc/odd/*.target', done.stdout)
        seen = set()
        for path in (self.folder / 'units').glob('*.service'):
            words = systemd_words(unit_of(path)['ExecStart'][0])
            for flag, word in zip(words, words[1:]):
                if flag == '--params-file':
                    self.assertTrue(word.startswith('/etc/odd/parameters/odd/'), word)
                    self.assertTrue((self.folder / 'units' / Path(word).relative_to('/etc/odd')).exists(), word)
                    self.assertNotIn(word, seen)
                    seen.add(word)
        self.assertEqual(len(seen), 4)


if __name__ == '__main__':
    unittest.main()
