# SPDX-License-Identifier: Apache-2.0
"""
Runs files of launch tests: `launch_test FILE.py… [NAME:=VALUE…]`.

Each launch is a run of the launcher, which has the tests run inside; this program gathers the results. It needs nothing
of the packages beside it.
"""

import argparse
import json
import os
import signal
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

_OWN_DIRECTORY = os.path.dirname(os.path.abspath(__file__))
_OUTCOMES = {'failure': 'failures', 'error': 'errors', 'skipped': 'skipped'}


def _launcher():
    beside = os.path.normpath(os.path.join(_OWN_DIRECTORY, '..', '..', '..', '..', 'bin', 'launch'))
    return os.environ.get('LAUNCH_PROGRAM') or (beside if os.path.exists(beside) else 'launch')


def _parser():
    parser = argparse.ArgumentParser(
        prog='launch_test', description='Launches systems and tests them, as ROS 2\'s launch_test does.')
    parser.add_argument('words', nargs='+', metavar='FILE', help='files of tests, and arguments as NAME:=VALUE')
    parser.add_argument('--package-name', help='the package, in the names of the results')
    parser.add_argument('-v', '--verbose', action='store_true', help='the launcher tells more, with --debug')
    parser.add_argument('-s', '--show-args', '--show-arguments', action='store_true',
                        help='show the arguments of the launch, and test nothing')
    parser.add_argument('--junit-xml', metavar='PATH', help='write the results to this file')
    return parser


class _Suite:
    """The results of one launch."""

    def __init__(self, name, cases):
        self.name = name
        self.cases = cases

    def count(self, outcome):
        return sum(case['outcome'] == outcome for case in self.cases)

    @property
    def has_passed(self):
        return all(case['outcome'] in ('passed', 'skipped') for case in self.cases)


def _launch(order, arguments, options):
    """The exit code of the launcher, and what the tests told: None when they could not begin."""
    with tempfile.TemporaryDirectory(prefix='launch_test-') as directory:
        results = os.path.join(directory, 'results.json')
        environment = {**os.environ, 'LAUNCH_TESTING_RUN': json.dumps({**order, 'results': results})}
        # The tests judge how processes have ended.
        command = [_launcher(), '--ignore-failures', *(['--debug'] if options.verbose else []),
                   *(['--show-args'] if options.show_args else []), os.path.join(_OWN_DIRECTORY, 'run.launch.py'),
                   *arguments]
        process = subprocess.Popen(command, env=environment)
        try:
            code = process.wait()
        except KeyboardInterrupt:
            # The launcher has got Ctrl-C as well, and ends the system.
            signal.signal(signal.SIGINT, signal.SIG_IGN)
            process.wait()
            raise
        try:
            with open(results, encoding='utf-8') as file:
                return code, json.load(file)
        except FileNotFoundError:
            return code, None


def _suites_of_file(path, arguments, options):
    if not os.path.isfile(path):
        print(f"launch_test: error: the file '{path}' does not exist", file=sys.stderr)
        return [_Suite(path, [_case('launch', 'error', f"the file '{path}' does not exist")])]
    base = os.path.splitext(os.path.basename(path))[0]
    package = options.package_name or base
    order = {'file': os.path.abspath(path), 'name': package.replace('.', '_') + '_launch_test',
             'arguments': dict(argument.split(':=', 1) for argument in arguments)}
    suites = []
    count = 1
    while len(suites) < count:
        code, told = _launch({**order, 'run': len(suites)}, arguments, options)
        if options.show_args:
            return [_Suite(base, [_case('launch', 'passed' if code == 0 else 'error')])]
        told = told or {'runs': count, 'suffix': '', 'cases': [], 'completed': False, 'skipped': None}
        cases = told['cases']
        if told['skipped'] is not None:
            cases = [_case('launch', 'skipped', told['skipped'])]
        elif not told['completed']:
            cases.append(_case('launch', 'failure', 'the launch ended before the tests were completed'))
        elif code != 0:
            cases.append(_case('launch', 'failure', f'the launcher ended with the exit code {code}'))
        elif not cases:
            cases.append(_case('launch', 'failure', 'the file has no tests'))
        suites.append(_Suite(f"{package}.{base}.launch_tests{told['suffix']}", cases))
        count = told['runs']
    return suites


def _case(name, outcome, message=''):
    return {'name': name, 'class': 'launch', 'seconds': 0, 'outcome': outcome, 'message': message}


def _write_junit(path, name, suites):
    root = ElementTree.Element('testsuites', name=name)
    for outcome, attribute in _OUTCOMES.items():
        if outcome != 'skipped':
            root.set(attribute, str(sum(suite.count(outcome) for suite in suites)))
    root.set('tests', str(sum(len(suite.cases) for suite in suites)))
    for suite in suites:
        element = ElementTree.SubElement(root, 'testsuite', name=suite.name, tests=str(len(suite.cases)))
        for outcome, attribute in _OUTCOMES.items():
            element.set(attribute, str(suite.count(outcome)))
        element.set('time', str(round(sum(case['seconds'] for case in suite.cases), 3)))
        for case in suite.cases:
            of_case = ElementTree.SubElement(element, 'testcase', classname=f"{suite.name}.{case['class']}",
                                             name=case['name'], time=str(case['seconds']))
            if case['outcome'] != 'passed':
                # XML has no way to write control characters.
                message = ''.join(c for c in case['message'] if c >= ' ' or c in '\n\t')
                ElementTree.SubElement(of_case, case['outcome'], message=message.splitlines()[-1] if message else
                                       '').text = message
    ElementTree.indent(root)
    ElementTree.ElementTree(root).write(path, encoding='utf-8', xml_declaration=True)


def main():
    parser = _parser()
    options = parser.parse_args()
    arguments = [word for word in options.words if ':=' in word]
    files = [word for word in options.words if ':=' not in word]
    if not files:
        parser.error('no file of tests is given')
    suites = []
    try:
        for path in files:
            suites += _suites_of_file(path, arguments, options)
    except KeyboardInterrupt:
        return 130
    if options.junit_xml:
        name = options.package_name or os.path.splitext(os.path.basename(files[0]))[0]
        try:
            os.makedirs(os.path.dirname(options.junit_xml) or '.', exist_ok=True)
            _write_junit(options.junit_xml, name, suites)
        except OSError as error:
            print(f"launch_test: error: can't write '{options.junit_xml}': {error.strerror}", file=sys.stderr)
            return 1
    for suite in suites:
        for case in suite.cases:
            if case['class'] == 'launch' and case['outcome'] not in ('passed', 'skipped'):
                print(f"launch_test: {suite.name}: {case['message']}", file=sys.stderr)
    return 0 if all(suite.has_passed for suite in suites) else 1


if __name__ == '__main__':
    sys.exit(main())
