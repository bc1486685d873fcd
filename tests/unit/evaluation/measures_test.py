# SPDX-License-Identifier: Apache-2.0
"""What is measured beside the experiment: what benchmarks report, other installations of ROS 2, the list of steps."""

import os
import re
import sys
import tempfile
import types
import unittest
from pathlib import Path

from evaluation import ros2, steps
from evaluation.measures import benchmark, tracepoints

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])


class Benchmark(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.bench = types.SimpleNamespace(place=types.SimpleNamespace(directory=self.folder))

    def script(self, text):
        file = self.folder / 'bench.py'
        file.write_text(text)
        return [sys.executable, file]

    def test_reports_lines_of_samples(self):
        command = self.script(
            "import os; open(os.environ['BENCHMARK_SAMPLES'], 'a').write('{\"name\": \"a\", \"unit\": \"ms\", "
            "\"values\": [1, 3, 2], \"floor_name\": \"bare\", \"floor\": [1, 1, 4], \"better\": \"lower\"}\\n')")
        for _ in range(2):  # what an earlier run has reported does not count again
            line, = benchmark.samples_of(self.bench, command)
        figure = benchmark.figure('start', line)
        self.assertEqual((figure.name, figure.value, figure.floor, figure.floor_name, figure.samples), ('a', 2, 1, 'bare', 3))

    def message_of(self, call):
        with self.assertRaises(benchmark.BenchmarkError) as caught:
            call()
        return str(caught.exception).replace(os.path.basename(sys.executable), 'PROGRAM')

    def test_that_reports_nothing_is_an_error(self):
        self.assertEqual(self.message_of(lambda: benchmark.samples_of(self.bench, self.script(''))),
                         'PROGRAM has reported nothing')

    def test_that_fails_is_an_error_with_its_last_line(self):
        command = self.script("import sys; sys.exit('one\\nno daemon')")
        self.assertEqual(self.message_of(lambda: benchmark.run(command)), 'PROGRAM failed: no daemon')


class Backends(unittest.TestCase):

    def test_are_those_that_are_built_and_are_preloaded(self):
        with tempfile.TemporaryDirectory() as folder:
            library = Path(folder) / 'prefix/lib/tracetools/backends/none/libtracetools.so'
            library.parent.mkdir(parents=True)
            library.touch()
            bench = types.SimpleNamespace(programs=Path(folder))
            self.assertEqual(list(tracepoints.backends(bench, 'none', 'usdt')), [('none', {'LD_PRELOAD': str(library)})])


class OtherRos2(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.prefix = Path(folder.name)

    def test_needs_rclcpp(self):
        with self.assertRaises(ros2.Ros2Error) as caught:
            ros2.environment_of(self.prefix)
        self.assertEqual(str(caught.exception), f"{self.prefix}: no ROS 2 there: 'share/rclcpp' is missing")

    def test_is_set_up_by_its_script(self):
        (self.prefix / 'share/rclcpp').mkdir(parents=True)
        (self.prefix / 'setup.bash').write_text('export ROS_DISTRO=some\necho noise\n')
        environment = ros2.environment_of(self.prefix)
        self.assertEqual((environment['ROS_DISTRO'], environment['RMW_IMPLEMENTATION']), ('some', 'rmw_fastrtps_cpp'))
        self.assertNotIn('PWD', environment)

    def test_without_a_script_is_found_by_its_paths(self):
        (self.prefix / 'share/rclcpp').mkdir(parents=True)
        environment = ros2.environment_of(self.prefix)
        self.assertEqual(environment['AMENT_PREFIX_PATH'], str(self.prefix))
        self.assertEqual(environment['LD_LIBRARY_PATH'], str(self.prefix / 'lib'))

    def test_gets_the_source_that_this_stack_gets(self):
        for name in ros2.SOURCES + ros2.HEADERS:
            self.assertTrue((ros2.BENCHMARKS / name).exists(), name)


class Steps(unittest.TestCase):

    def test_are_in_the_documentation(self):
        rows = re.findall(r'^\| `(\w+)` \|', (SOURCE / 'docs/evaluation.md').read_text(), re.M)
        for name in steps.NAMES:
            self.assertIn(name, rows)

    def test_need_the_programs_that_they_run(self):
        self.assertEqual(steps.targets_of(['experiment']), ['latency_stack', 'tracetools_provider'])
        self.assertIn('bench_reader', steps.targets_of(None))


if __name__ == '__main__':
    unittest.main()
