# SPDX-License-Identifier: Apache-2.0
"""
Files of ROS 2's launch_testing under pytest.

A file whose generate_test_description() is marked with pytest.mark.launch_test is one test of pytest. `launch_test` runs
it, in a process of its own: the packages of launch files live in the launcher.
"""

import ast
import os
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

_ROS_2_PLUGIN = 'launch'  # as launch_testing of ROS 2 names its own
_OPTION = '--launch-args'


def _launch_test():
    launcher = os.environ.get('LAUNCH_PROGRAM')
    beside = [Path(launcher).parent] if launcher else []
    for folder in [*beside, *(parent / 'bin' for parent in Path(__file__).resolve().parents)]:
        if (folder / 'launch_test').exists():
            return str(folder / 'launch_test')
    return shutil.which('launch_test') or 'launch_test'


def _is_marked(function):
    return any(isinstance(node, ast.Attribute) and node.attr == 'launch_test'
               for decorator in function.decorator_list for node in ast.walk(decorator))


def _is_launch_test(path):
    try:
        source = path.read_text(encoding='utf-8')
        if 'generate_test_description' not in source:
            return False
        tree = ast.parse(source)
    except (OSError, SyntaxError, UnicodeDecodeError, ValueError):
        return False
    return any(isinstance(node, ast.FunctionDef) and node.name == 'generate_test_description' and _is_marked(node)
               for node in tree.body)


class LaunchTestFailure(Exception):
    """Tests of a launch have failed."""


class LaunchTestItem(pytest.Item):

    def runtest(self):
        with tempfile.TemporaryDirectory(prefix='launch_test-') as directory:
            results = Path(directory, 'results.xml')
            arguments = [word for words in self.config.getoption(_OPTION) for word in words]
            run = subprocess.run([_launch_test(), str(self.path), *arguments, '--junit-xml', str(results)],
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors='replace',
                                 check=False)
            sys.stdout.write(run.stdout)
            cases = list(ElementTree.parse(results).getroot().iter('testcase')) if results.exists() else []
        bad = [(case, part) for case in cases for part in case if part.tag in ('failure', 'error')]
        if run.returncode != 0 or bad:
            texts = [f"FAIL: {case.get('classname').rpartition('.')[2]}.{case.get('name')}\n{part.text}"
                     for case, part in bad]
            raise LaunchTestFailure('\n'.join(texts) or f'launch_test ended with {run.returncode}\n{run.stdout}')
        if cases and all(len(case) and case[0].tag == 'skipped' for case in cases):
            pytest.skip(cases[0][0].get('message'))

    def repr_failure(self, excinfo):
        return str(excinfo.value) if isinstance(excinfo.value, LaunchTestFailure) else super().repr_failure(excinfo)

    def reportinfo(self):
        return self.path, 0, f'launch tests: {self.name}'


class LaunchTestFile(pytest.File):

    def collect(self):
        yield LaunchTestItem.from_parent(self, name=self.path.stem)


def pytest_addoption(parser, pluginmanager):
    if not pluginmanager.hasplugin(_ROS_2_PLUGIN):
        parser.addoption(_OPTION, action='append', nargs='*', default=[], help='arguments of launches, NAME:=VALUE')


def pytest_configure(config):
    config.addinivalue_line('markers', 'launch_test: marks a generate_test_description function of launch_testing')


def pytest_pycollect_makemodule(module_path, parent):
    if parent.config.pluginmanager.hasplugin(_ROS_2_PLUGIN) or not _is_launch_test(module_path):
        return None
    return LaunchTestFile.from_parent(parent, path=module_path)
