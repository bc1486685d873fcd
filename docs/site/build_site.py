#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the documentation a site with navigation and search: build_site.py OUTPUT

OUTPUT/pages gets the pages as MkDocs reads them, OUTPUT/site gets the site, with the C++ reference in site/cpp. What the
site cannot hold together is an error: a page that the navigation lacks, a link or an anchor that leads nowhere.

The pages of the repository name one another in backquotes (`docs/report.md`), which reads well in an editor. Here such a
name becomes a link with the title of the page.
"""
import ast
import html.parser
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]

# Pages that are not in docs/, by their name in the site.
OTHER_PAGES = {
    'README.md': 'index.md',
    'CONTRIBUTING.md': 'contributing.md',
    'RELEASING.md': 'releasing.md',
    'SECURITY.md': 'security.md',
    'CHANGELOG.md': 'changelog.md',
    'launch_examples/README.md': 'examples.md',
    'instrumented_stack/tracetools/README.md': 'tracetools_package.md',
    'instrumented_stack/rosidl/README.md': 'rosidl.md',
}
STUBS = REPOSITORY / 'tracing/decode/python_api/launch_trace/_events.pyi'
CPP_HEADERS = ['tracing/decode/cpp_api/include', 'tracing/expect/include']


class SiteError(Exception):
    """What a reader of the site would stumble over."""


def pages():
    """The pages of the repository: path in it -> name in the site."""
    found = {f'docs/{path.name}': path.name for path in sorted((REPOSITORY / 'docs').glob('*.md'))}
    found.update(OTHER_PAGES)
    return found


def title_of(text):
    """The first heading, without its backquotes."""
    return next(line[2:].replace('`', '').strip() for line in text.splitlines() if line.startswith('# '))


def with_links(text, page, names, titles):
    """Names of pages in backquotes become links, links of the repository become links of the site."""

    def named(match):
        target = match.group(1)
        if target not in names or names[target] == names[page]:
            return match.group(0)
        return f'[{titles[target]}]({names[target]})'

    def linked(match):
        label, target = match.groups()
        path, _, anchor = target.partition('#')
        if '://' in target or not path:
            return match.group(0)
        there = os.path.normpath(os.path.join(os.path.dirname(page), path))
        if there not in names:
            return match.group(0)
        return f'[{label}]({names[there]}{"#" + anchor if anchor else ""})'

    lines, in_block = [], False
    for line in text.splitlines():
        if line.lstrip().startswith('```'):
            in_block = not in_block
        elif not in_block and not line.startswith('#'):
            line = re.sub(r'\[([^\]]*)\]\(([^)\s]+)\)', linked, line)
            line = re.sub(r'(?<!\[)`([A-Za-z0-9_./-]+\.md)`', named, line)
        lines.append(line)
    return '\n'.join(lines) + '\n'


def python_reference():
    """The page of the Python module, from the signatures and docstrings of its stubs."""
    module = ast.parse(STUBS.read_text())
    lines = ['# The Python module launch_trace', '', ast.get_docstring(module) or '', '']
    lines += ['The guide with examples is `docs/trace_reader.md`.', '']

    def signature(function):
        text = re.sub(r'\s+', ' ', ast.unparse(ast.FunctionDef(**{**vars(function), 'body': [], 'decorator_list': []}))).strip(': ')
        text = text.replace('self, /, ', '').replace('self, /', '').replace('self, ', '').replace('(self)', '()')
        if any(ast.unparse(decorator) == 'property' for decorator in function.decorator_list):
            return text.removeprefix('def ').replace('() ->', ':', 1)
        return text

    def document(node, level):
        """A class is a section; members without a text of their own share a block."""
        if isinstance(node, ast.ClassDef):
            lines.extend([f'{"#" * level} class {node.name}', '', ast.get_docstring(node) or '', ''])
            for member in node.body:
                document(member, level + 1)
        elif isinstance(node, (ast.FunctionDef, ast.AnnAssign)):
            is_function = isinstance(node, ast.FunctionDef)
            text = signature(node) if is_function else ast.unparse(node)
            if lines[-2:] == ['```', '']:
                lines[-2:] = [text, '```', '']
            else:
                lines.extend(['```python', text, '```', ''])
            if is_function and ast.get_docstring(node):
                lines.extend([ast.get_docstring(node), ''])

    for node in module.body:
        document(node, 2)
    return '\n'.join(lines)


def write_pages(folder):
    """Writes the pages, and returns their names in the site."""
    names = pages()
    texts = {page: (REPOSITORY / page).read_text() for page in names}
    titles = {page: title_of(text) for page, text in texts.items()}
    for page, text in texts.items():
        (folder / names[page]).write_text(with_links(text, page, names, titles))
    (folder / 'launch_trace_python.md').write_text(
        with_links(python_reference(), 'docs/launch_trace_python.md', {**names, 'docs/launch_trace_python.md': ''}, titles))
    for kept in ['pictures', 'schema']:
        shutil.copytree(REPOSITORY / 'docs' / kept, folder / kept)
    return {*names.values(), 'launch_trace_python.md'}


def check_navigation(configuration, names):
    """Each page stands in the navigation once."""
    listed = re.findall(r'^\s+- (\S+\.md)$', configuration, re.M)
    for name in sorted(names - set(listed)):
        raise SiteError(f'docs/site/mkdocs.yml: the navigation lacks the page {name}')
    for name in sorted(set(listed) - names):
        raise SiteError(f'docs/site/mkdocs.yml: there is no page {name}')


class Anchors(html.parser.HTMLParser):
    """The links of a page, and the places within it that a link may name."""

    def __init__(self, text):
        super().__init__()
        self.links, self.places = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.places.update(value for name, value in attributes if name == 'id' or (tag == 'a' and name == 'name'))
        for name in ('href', 'src'):
            if values.get(name):
                self.links.append(values[name])


def check_links(site):
    """Each local link of the site leads to a file, and each anchor to a place in it."""
    read = {path: Anchors(path.read_text(errors='replace')) for path in site.rglob('*.html') if 'cpp' not in path.parts}
    broken = []
    for path, page in read.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc or path.name == '404.html':
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            target = target / 'index.html' if target.is_dir() else target
            if not target.exists():
                broken.append(f'{path.relative_to(site)}: {link} leads to no file')
            elif parts.fragment and target in read and urllib.parse.unquote(parts.fragment) not in read[target].places:
                broken.append(f'{path.relative_to(site)}: {link} names no place in that page')
    if broken:
        raise SiteError('\n'.join(sorted(set(broken))))


def cpp_reference(folder):
    """The classes of the installed C++ headers, by Doxygen."""
    settings = {
        'PROJECT_NAME': 'launch, C++ reference',
        'INPUT': ' '.join(str(REPOSITORY / headers) for headers in CPP_HEADERS),
        'OUTPUT_DIRECTORY': folder.parent, 'HTML_OUTPUT': folder.name,
        'RECURSIVE': 'YES', 'EXTRACT_ALL': 'YES', 'JAVADOC_AUTOBRIEF': 'YES', 'GENERATE_LATEX': 'NO', 'QUIET': 'YES',
        # The sources' comments are plain ones.
        'INPUT_FILTER': r'''"sed -E 's,^( *)//( |$),\1///\2,; s,; +// ,; ///< ,; /^ *\/\/\//s,<,\\<,g'"''',
        'WARN_IF_UNDOCUMENTED': 'NO', 'STRIP_FROM_PATH': REPOSITORY, 'FILE_PATTERNS': '*.hpp', 'HAVE_DOT': 'NO',
    }
    text = ''.join(f'{name} = {value}\n' for name, value in settings.items())
    subprocess.run(['doxygen', '-'], input=text, text=True, check=True)


def build(output):
    """Builds the whole site anew."""
    shutil.rmtree(output, ignore_errors=True)
    (output / 'pages').mkdir(parents=True)
    configuration = (REPOSITORY / 'docs/site/mkdocs.yml').read_text()
    check_navigation(configuration, write_pages(output / 'pages'))
    cpp_reference(output / 'pages/cpp')
    (output / 'mkdocs.yml').write_text(f'{configuration}docs_dir: pages\nsite_dir: site\nuse_directory_urls: false\n')
    subprocess.run(['mkdocs', '--quiet', 'build', '--strict', '--config-file', output / 'mkdocs.yml'], check=True)
    check_links(output / 'site')


def main():
    output = pathlib.Path(sys.argv[1]).resolve()
    try:
        build(output)
    except SiteError as error:
        print(f'build_site: error: {error}', file=sys.stderr)
        return 1
    except subprocess.CalledProcessError as error:
        print(f'build_site: error: {error.cmd[0]} failed', file=sys.stderr)
        return 1
    print(output / 'site/index.html')
    return 0


if __name__ == '__main__':
    sys.exit(main())
