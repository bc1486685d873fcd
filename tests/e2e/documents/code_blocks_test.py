# SPDX-License-Identifier: Apache-2.0
"""The code blocks of the documentation: launch files have no mistake, Python compiles, commands have the options that stand
there. `<!-- not run: REASON -->` in the line before a block takes it out."""
import functools
import json
import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ['SOURCE_DIRECTORY'])
LAUNCH = os.environ['LAUNCH_PROGRAM']

# Their blocks hold the mistakes that they describe; golden_errors_test and the tests of findings run them.
PAGES_OF_MISTAKES = {'docs/errors.md', 'docs/findings.md'}
# What a part of a file can't bring along: files, packages and programs, and the expectations of a test.
MAY_BE_MISSING = {'LF0001', 'LF0301', 'LF0302', 'LF0304'}


def documents():
    try:
        names = subprocess.run(['git', '-C', SOURCE, 'ls-files', '*.md'], capture_output=True, text=True).stdout.split()
    except FileNotFoundError:  # a machine without git
        names = []
    names = names or [str(path.relative_to(SOURCE)) for path in [*SOURCE.glob('docs/*.md'), SOURCE / 'README.md']]
    return [name for name in names if name not in PAGES_OF_MISTAKES and name != 'CHANGELOG.md']


def blocks(text):
    """(line, language, text, reason why it is not run or None) of each block."""
    lines, before, at = text.splitlines(), '', 0
    while at < len(lines):
        start = re.match(r'( *)```(\S*)$', lines[at])
        if start:
            end = next(index for index in range(at + 1, len(lines)) if lines[index].strip() == '```')
            marked = re.match(r'<!-- not run: (.+) -->$', before)
            indent = len(start.group(1))
            yield at + 1, start.group(2), '\n'.join(line[indent:] for line in lines[at + 1:end]) + '\n', marked and marked.group(1)
            at = end
        before = lines[at].strip() or before
        at += 1


@functools.lru_cache(maxsize=None)
def help_of(words):
    """The help of `launch WORDS --help`, or None if there is no such command."""
    shown = subprocess.run([LAUNCH, *words, '--help'], capture_output=True, text=True)
    return shown.stdout if shown.returncode == 0 else None


def commands(text):
    """The words of each call of launch in a block: after a prompt, ./dev or PREFIX/bin."""
    for line in text.splitlines():
        called = re.match(r'(?:\$ |sudo )?(?:\./dev |PREFIX/bin/)?launch (?!\()(.+)$', line)
        if not called:
            continue
        words = re.sub(r'\s#.*$', '', called.group(1)).replace('[', ' ').replace(']', ' ').replace('\\', ' ')
        try:
            yield line, re.split(r'\s[|&;>]', ' '.join(shlex.split(words)))[0].split()
        except ValueError:  # a quote that goes on in the next line
            yield line, words.split()


def unknown_options(words):
    """The options that the help of the command does not name. What follows -- or a program's name of `run` is not ours."""
    command = []
    for word in words:
        if word.startswith('-') or len(command) == 2 or help_of(tuple(command + [word])) is None:
            break
        if command and help_of(tuple(command + [word])) == help_of(tuple(command)):
            break
        command.append(word)
    known = help_of(tuple(command)) or ''
    own = words[:words.index('--')] if '--' in words else words
    if command == ['run']:
        own = []
    return [word for word in own if re.match(r'--[a-z]', word) and
            not re.search(re.escape(word.split('=')[0]) + r'(?![a-z-])', known)]


class CodeBlocksTest(unittest.TestCase):
    def each_block(self, *languages):
        for name in documents():
            for line, language, text, reason in blocks((SOURCE / name).read_text()):
                if language in languages and not reason:
                    yield f'{name}:{line}', language, text

    def test_launch_files_have_no_mistake(self):
        checked = 0
        with tempfile.TemporaryDirectory() as directory:
            files = {}
            for place, language, text in self.each_block('xml', 'yaml'):
                if language == 'xml' and '<launch' not in text:
                    text = f'<launch>\n{text}</launch>\n'
                if (language == 'xml' and '<package' in text) or (language == 'yaml' and not re.match(r'launch:', text)):
                    continue
                file = pathlib.Path(directory, f'{len(files)}.launch.{language}')
                file.write_text(text)
                files[str(file)] = place
            shown = subprocess.run([LAUNCH, 'check', '--format', 'json', *files], capture_output=True, text=True)
            self.assertIn(shown.returncode, (0, 1), shown.stderr)
            wrong = []
            for finding in json.loads(shown.stdout):
                if finding['severity'] == 'error' and finding['id'] not in MAY_BE_MISSING:
                    wrong.append(f"{files[finding['file']]}, line {finding['line']} of the file: {finding['message']}")
            checked = len(files)
        self.assertEqual(wrong, [])
        self.assertGreater(checked, 15)

    def test_python_compiles(self):
        places = 0
        for place, _, text in self.each_block('python'):
            with self.subTest(place):
                compile(text, place, 'exec')
            places += 1
        self.assertGreater(places, 8)

    def test_commands_have_their_options(self):
        wrong, seen = [], 0
        for place, _, text in self.each_block('', 'sh', 'text'):
            for line, words in commands(text):
                seen += 1
                wrong += [f'{place}: {line.strip()}: no option {option}' for option in unknown_options(words)]
        for name in documents():
            for call in re.findall(r'`((?:\./dev )?launch [^`]*)`', (SOURCE / name).read_text()):
                for line, words in commands(' '.join(call.split())):
                    seen += 1
                    wrong += [f'{name}: {line}: no option {option}' for option in unknown_options(words)]
        self.assertEqual(wrong, [])
        self.assertGreater(seen, 300)

    def test_planted_mistakes_are_found(self):
        self.assertEqual(unknown_options(['report', 'DIR', '--jsom']), ['--jsom'])
        self.assertEqual(unknown_options(['topic', 'hz', '/chatter', '--windows', '3']), ['--windows'])
        self.assertEqual(unknown_options(['--dry-run=json', 'FILE']), [])
        page = 'text\n\n<!-- not run: a reason -->\n```xml\n<a/>\n```\n\n```sh\nlaunch x\n```\n'
        self.assertEqual(list(blocks(page)), [(4, 'xml', '<a/>\n', 'a reason'), (8, 'sh', 'launch x\n', None)])


if __name__ == '__main__':
    unittest.main()
