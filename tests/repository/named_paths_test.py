# SPDX-License-Identifier: Apache-2.0
"""
What documents and comments name is there: paths of the repository, sources by their name, other documents, and places in them.

A path counts if it begins with a folder of the repository. `{a,b}` and `*` stand for several, a word in capitals stands for a
name of the reader's own.
"""

import os
import re
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])
FOLDERS = ('.ci', '.github', 'actions', 'base', 'cmake', 'docs', 'instrumented_stack', 'launch_examples', 'launcher', 'programs', 'tests',
           'third_party', 'tracing')
# Documents that describe the sources. The others name files of users and of ROS 2 as well.
ABOUT_SOURCES = ('CONTRIBUTING.md', 'docs/architecture.md', 'docs/life_of_a_launch.md')
FENCE = re.compile(r'^\s*```')
QUOTED = re.compile(r'`([^`\n]+)`')
LINK = re.compile(r'(?<!`)\[[^\]\n]*\]\(([^)\s]+)\)')
COMMAND_WORD = re.compile(r'(?:^|(?<=[\s"\'=:]))[\w.]+/[\w./{},*-]*')
COMMENT = re.compile(r'(?:^|\s)(?://|#(?!\w|\[)) .*')
COMMENT_WORD = re.compile(r'(?<![\w/.<>{}$*"\'-])[\w.]+/[\w./{},*]*[\w}]')
SOURCE_NAME = re.compile(r'[\w/*{},]+\.(?:cpp|hpp|py)')


def documents(top):
    return [path for path in [*sorted(top.glob('*.md')), *sorted((top / 'docs').glob('*.md'))] if path.name != 'CHANGELOG.md']


def lines(path):
    """Yields number, line, and whether the line stands in a block of code."""
    in_block = False
    for number, line in enumerate(path.read_text(encoding='utf-8').splitlines(), 1):
        if FENCE.match(line):
            in_block = not in_block
        else:
            yield number, line, in_block


def alternatives(name):
    """Expands the braces, as a shell does: `a/{b,c}` is `a/b` and `a/c`."""
    match = re.search(r'\{([^{}]*)\}', name)
    if not match:
        return [name]
    return [whole for part in match.group(1).split(',') for whole in alternatives(name[:match.start()] + part + name[match.end():])]


def pattern(name):
    """What to look for: a word in capitals, which the reader replaces, is any name."""
    return '/'.join(re.sub(r'^[A-Z]+(?=\.|$)', '*', part) if part.split('.')[0] not in ('README', 'LICENSE') else part for part in name.split('/'))


def is_there(top, name):
    name = pattern(name.rstrip('/.'))
    return any(top.glob(name)) if '*' in name else (top / name).exists()


def missing_paths(top):
    """The paths in backquotes and in blocks of code that do not exist."""
    result = []
    for document in documents(top):
        for number, line, in_block in lines(document):
            for name in (COMMAND_WORD if in_block else QUOTED).findall(line):
                if name.partition('/')[0] in FOLDERS and '/' in name and ' ' not in name:
                    result += [f'{document.relative_to(top)}:{number}: {path}' for path in alternatives(name) if not is_there(top, path)]
    return result


def missing_in_comments(top):
    """The paths in comments of sources that do not exist. A source in a folder below may also mean its own folder."""
    result = []
    for folder in FOLDERS:
        for file in sorted(path for path in (top / folder).rglob('*') if path.is_file()):
            if file.suffix not in ('.cpp', '.hpp', '.h', '.c', '.cmake', '.py') and file.name != 'CMakeLists.txt':
                continue
            for number, line in enumerate(file.read_text(encoding='utf-8').splitlines(), 1):
                words = (word for comment in COMMENT.findall(line) for word in COMMENT_WORD.findall(comment))
                for name in (name for word in words for name in alternatives(word)):
                    if name.partition('/')[0] in FOLDERS and not is_there(top, name) and not (file.parent / name).exists():
                        result.append(f'{file.relative_to(top)}:{number}: {name}')
    return result


def missing_sources(top):
    """The sources that a document about them names by the end of their path, and that do not exist."""
    files = [f'/{path.relative_to(top)}' for folder in FOLDERS for path in (top / folder).rglob('*') if path.is_file()]
    result = []
    for document in (top / name for name in ABOUT_SOURCES if (top / name).exists()):
        for number, line, in_block in lines(document):
            for name in [] if in_block else QUOTED.findall(line):
                for path in alternatives(name) if SOURCE_NAME.fullmatch(name) else []:
                    ending = re.compile('/' + re.escape(pattern(path)).replace(r'\*', '[^/]*') + '$')
                    if not any(map(ending.search, files)):
                        result.append(f'{document.relative_to(top)}:{number}: {path}')
    return result


def anchors(document):
    """The places in a document that a link can name, as GitHub makes them of the headings."""
    result = set()
    for _, line, in_block in lines(document):
        heading = None if in_block else re.match(r'#+ +(.*?) *#*$', line)
        if heading:
            anchor = re.sub(r'[^\w\- ]', '', heading.group(1).lower()).replace(' ', '-')
            names = [anchor, *(f'{anchor}-{i}' for i in range(1, len(result) + 1))]
            result.add(next(name for name in names if name not in result))
    return result


def broken_links(top):
    result = []
    for document in documents(top):
        for number, line, in_block in lines(document):
            for link in [] if in_block else LINK.findall(line):
                if re.match(r'\w+:', link):
                    continue
                name, _, anchor = link.partition('#')
                target = document.parent / name if name else document
                if not target.exists() or (anchor and (target.suffix != '.md' or anchor not in anchors(target))):
                    result.append(f'{document.relative_to(top)}:{number}: {link}')
    return result


class NamedPaths(unittest.TestCase):
    maxDiff = None

    def test_the_folders_are_those_of_the_repository(self):
        self.assertEqual([folder for folder in FOLDERS if not (SOURCE / folder).is_dir()], [])

    def test_each_path_exists(self):
        self.assertEqual(missing_paths(SOURCE), [])

    def test_each_path_in_a_comment_exists(self):
        self.assertEqual(missing_in_comments(SOURCE), [])

    def test_each_source_exists(self):
        self.assertEqual(missing_sources(SOURCE), [])

    def test_each_link_leads_somewhere(self):
        self.assertEqual(broken_links(SOURCE), [])


class PlantedFaults(unittest.TestCase):
    """Each kind of fault, planted in a small tree, is found at its place; what stands beside it is right."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = Path(folder.name)
        self.write('base/text/ascii.hpp', '')
        self.write('base/files/pipe.hpp', '')
        self.write('docs/page.md', '# A `page`\n\n## Twice\n\n## Twice\n')

    def write(self, name, text):
        (self.top / name).parent.mkdir(parents=True, exist_ok=True)
        (self.top / name).write_text(text)

    def test_a_path(self):
        self.write('README.md', '`base/text/` `base/{text,files}` `base/*/pipe.hpp` `base/FOLDER/pipe.hpp`, `and/or`\n\n`base/text/utf8.hpp`\n')
        self.assertEqual(missing_paths(self.top), ['README.md:3: base/text/utf8.hpp'])

    def test_one_of_several_in_braces(self):
        self.write('README.md', '`base/{text,words,files}/`\n')
        self.assertEqual(missing_paths(self.top), ['README.md:1: base/words/'])

    def test_a_path_in_a_command(self):
        self.write('README.md', '```\ncat base/text/ascii.hpp\ncat base/text/utf8.hpp\ncat build/base/no\n```\n')
        self.assertEqual(missing_paths(self.top), ['README.md:3: base/text/utf8.hpp'])

    def test_a_path_in_a_comment(self):
        self.write('base/text/ascii.cpp', '#include "base/no.hpp"\n// As in base/files/pipe.hpp.\nint a;  // not as in ' 'base/no.hpp\n')
        self.write('base/CMakeLists.txt', '# base/files/nothing.cmake has it.\n')
        self.assertEqual(missing_in_comments(self.top), ['base/CMakeLists.txt:1: base/files/nothing.cmake', 'base/text/ascii.cpp:3: base/no.hpp'])

    def test_a_source(self):
        self.write('CONTRIBUTING.md', '`pipe.hpp` `files/pipe.hpp` `p*.hpp`\n`ipe.hpp`\n`text/pipe.hpp`\n')
        self.assertEqual(missing_sources(self.top), ['CONTRIBUTING.md:2: ipe.hpp', 'CONTRIBUTING.md:3: text/pipe.hpp'])

    def test_a_link(self):
        self.write('README.md', '[a](docs/page.md#a-page) [b](docs/page.md#twice-1) [c](https://example.com/#no)\n[d](docs/pages.md)\n'
                                '[e](docs/page.md#twice-2)\n[f](#nowhere)\n')
        self.assertEqual(broken_links(self.top),
                         ['README.md:2: docs/pages.md', 'README.md:3: docs/page.md#twice-2', 'README.md:4: #nowhere'])


if __name__ == '__main__':
    unittest.main()
