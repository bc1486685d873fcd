# SPDX-License-Identifier: Apache-2.0
"""Results of tests as the XML that JUnit and many tools know."""

import xml.etree.ElementTree as ElementTree

_KINDS = (('failures', 'failure'), ('errors', 'error'), ('skipped', 'skipped'))


def unittestResultsToXml(*, name='launch_test', test_results={}):  # noqa: N802  ROS 2's name
    """A document with a suite for each result, by its name."""
    root = ElementTree.Element('testsuites', name=name)
    results = test_results.values()
    root.set('tests', str(sum(result.testsRun for result in results)))
    root.set('failures', str(sum(len(result.failures) for result in results)))
    root.set('errors', str(sum(len(result.errors) for result in results)))
    root.set('time', str(round(sum(sum(result.testTimes.values()) for result in results), 3)))
    for suite, result in test_results.items():
        root.append(unittestResultToXml(str(suite), result))
    return ElementTree.ElementTree(root)


def unittestResultToXml(name, test_result):  # noqa: N802  ROS 2's name
    """A suite with a case for each test."""
    suite = ElementTree.Element('testsuite', name=name, tests=str(test_result.testsRun))
    for kind, _tag in _KINDS:
        suite.set(kind, str(len(getattr(test_result, kind))))
    suite.set('time', str(round(sum(test_result.testTimes.values()), 3)))
    for case in test_result.testCases:
        suite.append(unittestCaseToXml(test_result, case))
    return suite


def unittestCaseToXml(test_result, test_case):  # noqa: N802  ROS 2's name
    """A test with its failures, errors and reasons to be skipped."""
    # An id may have what parametrizes the launch at its end: module.Class.test_a[1, 2].
    place, bracket, parameters = test_case.id().partition('[')
    class_name, _, name = place.rpartition('.')
    element = ElementTree.Element('testcase', classname=class_name, name=name + bracket + parameters,
                                  time=str(round(test_result.testTimes[test_case], 3)))
    for kind, tag in _KINDS:
        for case, message in getattr(test_result, kind):
            if case == test_case or getattr(case, 'test_case', None) == test_case:
                # XML has no way to write control characters.
                text = ''.join(c for c in str(message) if c >= ' ' or c in '\n\t')
                ElementTree.SubElement(element, tag, message=text.strip().split('\n')[-1]).text = text
    return element
