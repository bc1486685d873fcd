# SPDX-License-Identifier: Apache-2.0
"""Cases about what launch files and parameter files say: `launch check`, `--dry-run` and launches of nothing that stays."""

import re

from place import expect, expect_in

CASES = {}


def case(number):
    """What a case wants, in the words of the function's text."""

    def add(function):
        CASES[number] = function
        return function

    return add


def expect_findings(place, expected, *words):
    """`launch check` finds these in these lines, and nothing else: {(file, line): id}."""
    found = {key: ids[0] if len(ids) == 1 else ids for key, ids in place.findings(*words).items()}
    expect(found == expected, f'findings {found}, not {expected}')


@case('01')
def scoped_include(place):
    """an include with scoped="true" keeps its variables to itself"""
    expect_in('mode=unset', place.launch('top.launch.xml'))


@case('02')
def two_defaults(place):
    """of two defaults of one argument the first counts, and check warns"""
    expect_in('b rate=1', place.launch('top.launch.xml'))
    expect_findings(place, {('b.launch.xml', 1): 'LF0504'}, 'top.launch.xml')


@case('04')
def list_of_set_parameter(place):
    """set_parameter takes a list, in YAML too"""
    for file in ('a.launch.yaml', 'b.launch.yaml', 'c.launch.xml'):
        expect_in("-p 'datum:=[48.5, 9.25, 0.0]'", place.launch('--dry-run', file))


@case('05')
def variable_of_several_words(place):
    """a variable with blanks is one word, and check warns"""
    expect_in("--name r '-x 0.0 -y 0.5'", place.launch('--dry-run', 'a.launch.xml'))
    expect_findings(place, {('a.launch.xml', 3): 'LF0208'}, 'a.launch.xml')


@case('13')
def key_for_children(place):
    """an action's list under a wrong key is explained"""
    expect_in("did you mean 'children'?", place.launch('a.launch.yaml', code=1))


@case('17')
def path_of_package(place):
    """the share directory of a package is extended with a slash in Python"""
    expect_in('/share/fake/launch/x.launch.py', place.launch('a.launch.py'))
    text = place.launch('c.launch.py')
    expect_in('/share/fake/launch/a1', text)
    expect_in(f'{place.folder}/x', text)


@case('18')
def service_of_a_script(place):
    """a script of one's own runs a launch with LaunchService"""
    packages = place.prefix / 'lib/launch/python'  # setup.bash puts it there
    expect_in('hello', place.run('/usr/bin/python3', 'script.py', PYTHONPATH=str(packages)))


@case('21')
def output_of_a_short_process(place):
    """a post-shutdown test of a process that ends at once passes, each time"""
    for _ in range(10):
        text = place.run(place.prefix / 'bin/launch_test', 'test_echo.py')
        expect(re.search(r'^OK$', text, re.MULTILINE), text[-1500:])


@case('24')
def values_of_the_command_line(place):
    """any text is a value on the command line, an empty one too; what is none is explained"""
    for words, part in {('t:=', 'u-v:=a:=b', 'a.b:=ünï "q" $HOME $(x) \\n'): '[] [a:=b] [ünï "q" $HOME $(x) \\n]',
                        ('t:=-x',): '[-x] [y] [z]', ('t:=[1, 2, {a: b}]',): '[[1, 2, {a: b}]] [y] [z]',
                        ('t:=two\nlines',): '[two\nlines] [y] [z]', ('t:=1', 't:=2'): '[2] [y] [z]',
                        ('T:=1',): "did you mean 't'?"}.items():
        expect_in(part, place.launch('a.launch.xml', *words))
    expect_in("expected format '<name>:=<value>'", place.launch('a.launch.xml', 't=1', code=None))
    expect_in('unknown option', place.launch('a.launch.xml', '--t:=1', code=None))


@case('28')
def section_for_the_node(place):
    """check warns of a parameter file without a section for the node's full name"""
    expect_findings(place, {('a.launch.xml', 3): 'LF0309'}, '--disable', 'LF0306', 'a.launch.xml')


@case('29a')
def list_of_two_types(place):
    """a list of integers and doubles is an error of check"""
    expect_findings(place, {('mixed.yaml', 3): 'LF0305'}, 'mixed.launch.xml')


@case('29c')
def list_of_lists(place):
    """a list of lists is an error of check, and so is all else that no node reads"""
    expect_findings(place, {('nested.yaml', 3): 'LF0305'}, 'nested.launch.xml')
    for file, line in {'bare': 1, 'misspelt': 2, 'no_key': 2, 'tab': 3}.items():
        expect_findings(place, {(f'{file}.yaml', line): 'LF0305'}, f'{file}.launch.xml')
    for file in ('binary', 'empty', 'numbers', 'tags', 'wild_order', 'wild_parts'):
        expect_findings(place, {}, f'{file}.launch.xml')


@case('29e')
def parameter_twice(place):
    """check warns of a parameter that is given twice"""
    expect_findings(place, {('twice.yaml', 4): 'LF0310'}, 'twice.launch.xml')


@case('36')
def what_an_include_leaves(place):
    """check says, if it is asked to, what an included file leaves behind"""
    expect_findings(place, {}, 'top.launch.xml')
    expect_findings(place, {('top.launch.xml', 2): 'LF0209'}, '--enable', 'LF0209', 'top.launch.xml')
    text = place.launch('check', '--enable', 'LF0209', 'top.launch.xml')
    for part in ('configurations mode', 'environment SPEED', 'namespace /left'):
        expect_in(part, text)


@case('38')
def backslashes(place):
    """check warns of each parameter whose backslashes go with the substitutions"""
    expect_in("regex: '^d+$'", place.launch('--dry-run', 'a.launch.xml'))
    found = place.findings('a.launch.xml')
    lines = {line for (file, line), ids in found.items() if file == 'p.yaml' and ids == ['LF0210']}
    expect(lines and len(found) == len(lines), f'findings {found}')


@case('68')
def every_way_of_a_parameter_file(place):
    """a parameter file is checked whichever way it is given: to a component, to all nodes, in args"""
    for mistake, line in {'anchor': 4, 'mixed': 3, 'nested': 3, 'null': 3}.items():
        for way in ('', 'set_', 'args_'):
            if way or mistake != 'anchor':  # a component gets the values from the launcher, which reads aliases
                expect_findings(place, {(f'{mistake}.yaml', line): 'LF0305'}, '--disable', 'LF0306',
                                f'{way}{mistake}.launch.xml')
    expect_findings(place, {}, '--disable', 'LF0306', 'anchor.launch.xml')


@case('98')
def argument_of_a_parameter_file(place):
    """an argument that only a parameter file or an included file reads is no finding"""
    expect_findings(place, {}, '--disable', 'LF0306',
                    *(f'{name}.launch.{kind}' for name, kind in (('a', 'xml'), ('c', 'py'), ('d', 'xml'), ('e', 'py'))))
