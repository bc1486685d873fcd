#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""
Edits launch files at random in the language server, as somebody would who types, and holds the diagnostics after each edit against those of
`launch check` for the same text. Python files are not run while somebody types: their diagnostics are held against those of a server that gets the
text as a whole, and errors of syntax against Python's compiler.

    random_edits.py LAUNCH CORPUS PREFIX [--files N] [--edits N] [--seed N] [--python]

CORPUS is a folder with launch files, such as corpus/launch_files of the build; it is copied. PREFIX is on AMENT_PREFIX_PATH (make_prefix). Run it by
the Python that the launcher was built with.
"""

import argparse
import collections
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import warnings

ENDINGS = ('.launch.xml', '.launch.yaml', '.launch.yml', '.launch')
PIECES = ('<', '>', '"', "'", '/>', '$(', '$(var x)', '$(eval 1)', ')', '\n', '\n  ', '<node pkg="', '<arg name="a"/>', 'é', '😀', '- ', ':', ': ', '</group>',
          '<!--', '-->', '&', '&lt;', ' ', 'true', '1', '{', '}', '[', ']', '#', '\t', '', '', '')

PYTHON_ENDINGS = ('.launch.py',)
PYTHON_PIECES = ('(', ')', '[', ']', '{', '}', "'", '"', '"""', '\\', '\n', '\n    ', ',', ':', '=', 'Node(', "LaunchConfiguration('x')", 'def ', 'return ', 'import ',
                 'from launch.actions import ', 'é', '😀', '#', ' ', '\t', '\f', '\0', '\ufeff', '\r', 'lambda ', "f'{", '1', 'is ', '', '', '')


class Server:
    def __init__(self, launch, environment):
        self.process = subprocess.Popen([launch, 'lsp'], stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment)
        self.version = 0
        self.send({'id': 1, 'method': 'initialize', 'params': {'processId': None, 'rootUri': None, 'capabilities': {}}})
        self.read()
        self.tell('initialized', {})

    def send(self, message):
        text = json.dumps({'jsonrpc': '2.0', **message}).encode()
        self.process.stdin.write(b'Content-Length: %d\r\n\r\n' % len(text) + text)
        self.process.stdin.flush()

    def read(self):
        length = 0
        while (line := self.process.stdout.readline()) != b'\r\n':
            if not line:
                raise EOFError
            length = int(line.partition(b':')[2])
        return json.loads(self.process.stdout.read(length))

    def tell(self, method, params):
        self.send({'method': method, 'params': params})

    def document(self, uri):
        self.version += 1
        return {'uri': uri, 'version': self.version}

    def opened(self, uri, language, text):
        """The diagnostics of a file that is opened with this text."""
        self.tell('textDocument/didOpen', {'textDocument': {**self.document(uri), 'languageId': language, 'text': text}})
        return self.diagnostics(uri)

    def changed(self, uri, text, begin, end, piece):
        """The diagnostics after a change of this text."""
        self.tell('textDocument/didChange', {'textDocument': self.document(uri), 'contentChanges': [
            {'range': {'start': position(text, begin), 'end': position(text, end)}, 'text': piece}]})
        return self.diagnostics(uri)

    def end(self):
        """Returns its exit code."""
        self.process.stdin.close()
        self.process.kill()
        self.process.stdout.close()
        return self.process.wait()

    def diagnostics(self, uri):
        """Those of the latest version."""
        while True:
            message = self.read()
            found = message.get('params', {})
            if message.get('method') == 'textDocument/publishDiagnostics' and found['uri'] == uri and found.get('version') == self.version:
                return found['diagnostics']


def position(text, offset):
    """A line ends with LF, CR LF or CR."""
    before = text[:offset]
    begin = max(before.rfind('\n'), before.rfind('\r')) + 1
    lines = before.replace('\r\n', '\n').replace('\r', '\n').count('\n')
    return {'line': lines, 'character': len(before[begin:].encode('utf-16-le')) // 2}


def edit(draw, text, pieces):
    """Begin, end and replacement of a change."""
    begin = draw.randrange(len(text) + 1)
    kind = draw.randrange(6)
    if kind < 3:
        return begin, min(len(text), begin + draw.randrange(4)), draw.choice(pieces)
    line_begin = text.rfind('\n', 0, begin) + 1
    line_end = text.find('\n', begin) + 1 or len(text)
    line = text[line_begin:line_end]
    if kind == 3:
        return line_begin, line_end, ''
    if kind == 4:
        return line_end, line_end, line
    return line_begin, line_begin, line.replace(' name=', ' nmae=').replace('node', 'nodes').replace('Node', 'Nodee')


def edits_of(draw, text, count, pieces):
    """Yields (begin, end, replacement, text before)."""
    original = text
    for number in range(count):
        if number % 50 == 49:  # from the beginning again: a text that is nothing but broken tells little
            begin, end, piece = 0, len(text), original
        else:
            begin, end, piece = edit(draw, text, pieces)
        # Nothing stands between CR and LF.
        begin -= text[begin - 1:begin + 1] == '\r\n' if begin else 0
        end += text[end - 1:end + 1] == '\r\n' if end else 0
        yield begin, end, piece, text
        text = text[:begin] + piece + text[end:]


def first_line(message):
    """Without what each process makes anew: the names of $(anon …)."""
    return re.sub(r'_\w+_\d+_\d+', '_ANONYMOUS', message.split('\n')[0])


def own_findings(found, server):
    """(id, line, severity, first line of the message) of each finding that stands in the file itself."""
    if server:
        return sorted((one['code'], one['range']['start']['line'] + 1, {1: 'error', 2: 'warning'}[one['severity']],
                       first_line(one['message'])) for one in found if not one.get('relatedInformation'))
    return sorted((one['id'], one['line'] or 1, one['severity'], first_line(one['message'])) for one in found)


def check(launch, environment, paths):
    result = subprocess.run([launch, 'check', '--format', 'json', *map(str, paths)], capture_output=True, env=environment, check=False)
    found = collections.defaultdict(list)
    for one in json.loads(result.stdout):
        found[one['file']].append(one)
    return found


def try_file(launch, environment, path, edits, draw):
    """Returns the number of edits that were compared, and what differs."""
    text = path.read_text(encoding='utf-8', errors='strict')
    server = Server(launch, environment)
    uri = path.as_uri()
    ending = next(ending for ending in ENDINGS if path.name.endswith(ending))
    variants, answers, wrong = [], [], []
    server.opened(uri, 'xml', text)
    try:
        for number, (begin, end, piece, before) in enumerate(edits_of(draw, text, edits, PIECES)):
            variant = path.parent / f'{path.name[:-len(ending)]}_edit{number:04}{ending}'
            variant.write_text(before[:begin] + piece + before[end:], encoding='utf-8', newline='')
            variants.append(variant)
            answers.append(own_findings(server.changed(uri, before, begin, end, piece), True))
    except EOFError:
        return len(answers), [f'{path}: the server has ended with {server.process.wait()} at edit {len(answers)}']
    finally:
        server.end()
    found = check(launch, environment, variants)
    for number, (variant, answer) in enumerate(zip(variants, answers)):
        expected = [(*row[:3], row[3].replace(variant.name, path.name)) for row in own_findings(found[str(variant)], False)]
        if sorted(expected) != answer:
            # One that is told for another file first is not told again by a check of many files.
            expected = own_findings(check(launch, environment, [variant])[str(variant)], False)
            expected = sorted((*row[:3], row[3].replace(variant.name, path.name)) for row in expected)
        if expected != answer:
            wrong.append(f'{path}, edit {number}: check {[row for row in expected if row not in answer]}, '
                         f'server {[row for row in answer if row not in expected]}')
            shutil.copy(variant, f'{tempfile.gettempdir()}/wrong_{len(wrong)}_{variant.name}')
        variant.unlink()
    return len(answers), wrong


def syntax_errors(text):
    """What Python's compiler says."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter('ignore')
            compile(text.removeprefix('\ufeff'), 'text', 'exec', 0, True)
    except SyntaxError as error:
        return [f'{type(error).__name__}: {error.msg}']
    except (ValueError, RecursionError, MemoryError, OverflowError) as error:
        return [f'{type(error).__name__}: {error}']
    return []


def try_python_file(launch, environment, path, edits, draw):
    """As try_file()."""
    text = path.read_text(encoding='utf-8', errors='strict')
    server, whole = Server(launch, environment), Server(launch, environment)
    uri = path.as_uri()
    server.opened(uri, 'python', text)
    compared, wrong = 0, []
    try:
        for begin, end, piece, before in edits_of(draw, text, edits, PYTHON_PIECES):
            text = before[:begin] + piece + before[end:]
            answer = server.changed(uri, before, begin, end, piece)
            expected = whole.opened(uri, 'python', text)
            errors = [one['message'] for one in answer if 'Error: ' in one['message']]
            if answer != expected or errors != syntax_errors(text):
                wrong.append(f'{path}, edit {compared}: whole {expected}, Python {syntax_errors(text)}, server {answer}')
                pathlib.Path(f'{tempfile.gettempdir()}/wrong_{len(wrong)}_{path.name}').write_text(text, encoding='utf-8', newline='')
            compared += 1
            whole.tell('textDocument/didClose', {'textDocument': {'uri': uri}})
            whole.read()
    except EOFError:
        wrong.append(f'{path}: a server has ended at edit {compared}')
    finally:
        server.end()
        whole.end()
    return compared, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('launch')
    parser.add_argument('corpus')
    parser.add_argument('prefix')
    parser.add_argument('--files', type=int, default=200)
    parser.add_argument('--edits', type=int, default=500)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--python', action='store_true', help='Python files, instead of XML and YAML')
    arguments = parser.parse_args()
    endings, try_one = (PYTHON_ENDINGS, try_python_file) if arguments.python else (ENDINGS, try_file)
    draw = random.Random(arguments.seed)
    with tempfile.TemporaryDirectory() as directory:
        copy = pathlib.Path(directory).resolve() / 'files'
        shutil.copytree(arguments.corpus, copy)
        environment = {**os.environ, 'AMENT_PREFIX_PATH': os.path.abspath(arguments.prefix), 'ROS_LOG_DIR': f'{directory}/log'}
        files = sorted(path for path in copy.rglob('*') if path.name.endswith(endings) and path.is_file())
        draw.shuffle(files)
        compared, wrong = 0, []
        for count, path in enumerate(files[:arguments.files], 1):
            try:
                edits, differences = try_one(os.path.abspath(arguments.launch), environment, path, arguments.edits, random.Random(f'{arguments.seed} {path.name}'))
            except UnicodeDecodeError:
                continue
            compared += edits
            wrong += differences
            print(*differences, sep='\n', end='\n' if differences else '', flush=True)
            if count % 10 == 0:
                print(f'{count} files, {compared} edits, {len(wrong)} differ', flush=True)
    print(f'{compared} edits of {min(len(files), arguments.files)} files, {len(wrong)} differ')
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
