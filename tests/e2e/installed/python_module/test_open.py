# SPDX-License-Identifier: Apache-2.0
"""Tests of launch_trace.open(), with the trace of the example system (tests/support/trace_writer/example_system.hpp)."""

import ctypes
import importlib.util
import json
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

for _module in filter(None, os.environ['WITHOUT_MODULE'].split(',')):
    sys.modules[_module] = None

import launch_trace
from launch_trace import _tables
from launch_trace._chain import nearest_rank
from launch_trace._run import Run, _TableOf

SYSTEM = Path(os.environ['SYSTEM'])
REPORT = os.environ['REPORT']
NOTEBOOK = os.environ['NOTEBOOK']


def has(module):
    return sys.modules.get(module, module) is not None and importlib.util.find_spec(module) is not None


def needs(module):
    return unittest.skipUnless(has(module), f'{module} is not installed')


class OpenedRun(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.run_ = launch_trace.open(SYSTEM)


class ProcessesOfOthers(unittest.TestCase):

    def test_are_left_out_unless_all_is_asked_for(self):
        whole = launch_trace.open(SYSTEM)
        ids = sorted(whole.processes.to_list('vpid'))
        self.assertEqual(whole.trace.to_list('others'), [0])
        with tempfile.TemporaryDirectory() as directory:
            shutil.copytree(SYSTEM, directory, dirs_exist_ok=True)
            Path(directory, 'verdict.json').write_text(json.dumps({'launch_processes': ids[:1]}))
            own = launch_trace.open(directory)
            self.assertEqual(own.processes.to_list('vpid'), ids[:1])
            self.assertEqual(own.trace.to_list('others'), [len(ids) - 1])
            self.assertEqual(sorted(launch_trace.open(directory, all=True).processes.to_list('vpid')), ids)


class Tables(OpenedRun):

    def test_every_table_is_an_attribute(self):
        attributes = [name for name, value in vars(Run).items() if isinstance(value, _TableOf)]
        self.assertEqual(sorted(attributes), sorted(_tables.NAMES))
        for name in self.run_.tables:
            self.assertEqual(getattr(self.run_, name).name, name)
        self.assertEqual(self.run_.schema_version.rows(), [(_tables.VERSION,)])

    def test_a_table_has_rows_and_columns(self):
        nodes = self.run_.nodes
        self.assertEqual(len(nodes), 3)
        self.assertEqual(nodes.columns, ['id', 'process', 'name'])
        self.assertEqual(list(nodes)[0], {'id': 0, 'process': 1, 'name': '/sensor'})
        self.assertEqual(nodes.rows('name', 'id'), [('/sensor', 0), ('/filter', 1), ('/display', 2)])
        self.assertEqual(list(nodes['name']), ['/sensor', '/filter', '/display'])
        self.assertIn('name', nodes)
        self.assertIn('/sensor', nodes._repr_html_())
        self.assertIn('<Run', repr(self.run_))
        self.assertIn('<ul>', self.run_._repr_html_())

    def test_what_the_trace_does_not_tell_is_none(self):
        receiving = self.run_.messages.to_list('receiving_instance')
        self.assertEqual(receiving.count(None), 2)
        self.assertEqual(self.run_.callbacks.to_list('period_ns'), [10_000_000, None, None])

    def test_an_unknown_name_is_an_error_that_says_what_there_is(self):
        with self.assertRaisesRegex(KeyError, "nodes has no column 'nme'; it has id, process, name"):
            self.run_.nodes['nme']
        with self.assertRaisesRegex(KeyError, "there is no table 'nothing'; the tables are schema_version, trace"):
            self.run_.table('nothing')

    def test_what_is_no_trace_is_an_error(self):
        with self.assertRaisesRegex(launch_trace.TraceError, "cannot read the trace '/nonexistent/trace'"):
            launch_trace.open('/nonexistent/trace')

    def test_several_directories_are_read_as_one(self):
        self.assertEqual(len(launch_trace.open([SYSTEM]).messages), 200)
        with self.assertRaises(ValueError):
            launch_trace.open([])

    def test_tables_stay_when_everything_else_has_gone(self):
        messages = launch_trace.open(SYSTEM).messages
        self.assertEqual(len(messages.to_list('published_ns')), 200)

    @needs('numpy')
    def test_numbers_are_arrays_without_a_copy(self):
        import numpy
        starts = self.run_.callback_instances['start_ns']
        self.assertEqual(starts.dtype, numpy.int64)
        self.assertIs(starts.flags.owndata, False)
        receiving = self.run_.messages['receiving_instance']
        self.assertIsInstance(receiving, numpy.ma.MaskedArray)
        self.assertEqual(receiving.count(), 198)


class Frames(OpenedRun):

    @needs('pandas')
    def test_pandas_gets_the_types_of_the_columns(self):
        import numpy
        frame = self.run_.messages.to_pandas()
        self.assertEqual(len(frame), 200)
        self.assertEqual(str(frame.dtypes['published_ns']), 'int64')
        self.assertEqual(str(frame.dtypes['receiving_instance']), 'Int64')
        self.assertEqual(frame.receiving_instance.isna().sum(), 2)
        self.assertTrue(numpy.shares_memory(frame.published_ns.to_numpy(), self.run_.messages['published_ns']))
        self.assertEqual(str(self.run_.callbacks.to_pandas().dtypes['kind']), 'category')
        self.assertEqual(len(self.run_.chain('/sensor', '/display').hops.to_pandas()), 294)

    def test_what_is_missing_is_named(self):
        for module, function in (('pandas', 'to_pandas'), ('polars', 'to_polars'), ('pyarrow', 'to_arrow')):
            if has(module):
                continue
            with self.subTest(module), self.assertRaisesRegex(ImportError, rf'{function}\(\) needs {module}, .* python3-{module}'):
                getattr(self.run_.nodes, function)()

    @needs('pyarrow')
    def test_pyarrow_gets_the_same_rows(self):
        table = self.run_.messages
        self.assertEqual([tuple(row.values()) for row in table.to_arrow().to_pylist()], table.rows())

    @needs('polars')
    def test_polars_gets_the_same_rows(self):
        self.assertEqual(self.run_.messages.to_polars().rows(), self.run_.messages.rows())

    def test_arrow_gets_the_same_rows(self):
        for name in self.run_.tables:
            table = self.run_.table(name)
            with self.subTest(name):
                columns = read_arrow(table.__arrow_c_stream__())
                self.assertEqual(list(columns), table.columns)
                for column, values in columns.items():
                    self.assertEqual(values, [None if value != value else value for value in table.to_list(column)])

    def test_an_arrow_stream_that_nobody_reads_is_released(self):
        self.run_.nodes.__arrow_c_stream__()


class Chains(OpenedRun):

    def test_a_chain_has_its_instances_and_hops(self):
        chain = self.run_.chain('/sensor', '/display')
        self.assertEqual([step.node for step in chain.steps], ['/sensor', '/filter', '/display'])
        self.assertEqual(len(chain), 98)
        self.assertEqual(chain.instances.rows('response_ns', 'first')[0], (850_000, 1))
        self.assertEqual(chain.hops.rows('instance', 'step', 'until_publish_ns', 'transfer_ns')[:3],
                         [(0, 0, None, None), (0, 1, 100_000, 200_000), (0, 2, 300_000, 200_000)])
        self.assertIn('/filter', chain._repr_html_())

    def test_a_chain_may_be_named_by_topics(self):
        whole = self.run_.chain('/sensor', '/display').summary()
        self.assertEqual(self.run_.chain('/scan', '/points').summary(), whole)
        self.assertEqual(self.run_.chain('/sensor', '/filter', '/points').summary(), whole)

    def test_a_part_of_a_chain_is_a_chain(self):
        chain = self.run_.chain('/filter', '/display')
        self.assertEqual(len(chain.steps), 2)
        self.assertEqual(chain.summary()['max_ns'], 4_000_000 - 100_000 + 250_000)
        self.assertEqual(len(self.run_.chain('/scan', '/scan').steps), 2)

    def test_its_parts_add_up_to_the_response(self):
        chain = self.run_.chain('/sensor', '/display')
        for begin, end, _, hops in chain.first_ways():
            self.assertEqual(sum(nanoseconds for _, nanoseconds in chain.parts(hops)), end - begin)

    def test_no_chain_is_an_error_that_names_those_that_are_there(self):
        with self.assertRaisesRegex(KeyError, 'no chain leads from /display to /sensor; the chains of the trace: /sensor → '):
            self.run_.chain('/display', '/sensor')
        with self.assertRaisesRegex(KeyError, "no chain is named 'name'; named chains: none"):
            self.run_.chain('name')


class Plots(OpenedRun):

    @needs('matplotlib')
    def test_every_plot_is_drawn(self):
        import matplotlib
        matplotlib.use('agg')
        chain = self.run_.chain('/sensor', '/display')
        for axes in (self.run_.plot.over_time('/scan'), self.run_.plot.over_time('/filter'),
                     self.run_.plot.histogram('/scan'), chain.plot(), chain.plot_flow(),
                     self.run_.plot.scheduling(seconds=0.1), self.run_.plot.outliers(chain)):
            axes.figure.canvas.draw()
            self.assertTrue(axes.has_data())
        heights = {}
        for bar in chain.plot().patches:
            heights[round(bar.get_x(), 1)] = heights.get(round(bar.get_x(), 1), 0) + bar.get_height()
        self.assertAlmostEqual(max(heights.values()), chain.summary()['max_ns'] / 1e6)

    @needs('matplotlib')
    def test_scheduling_begins_with_the_first_callback(self):
        import matplotlib
        matplotlib.use('agg')
        first = min(self.run_.callback_instances.to_list('start_ns')) - self.run_.trace.to_list('begin_ns')[0]
        axes = self.run_.plot.scheduling(seconds=1e-6)
        self.assertEqual(len(axes.collections), 1)
        self.assertAlmostEqual(axes.collections[0].get_paths()[0].get_extents().x0, first / 1e9)

    def test_a_legend_has_the_largest_parts_and_one_line_for_the_rest(self):
        styles = launch_trace._plot._colours({f'part {number}': float(number) for number in range(20)})
        self.assertEqual([style['label'] for style in styles.values() if 'label' in style],
                         ['11 shorter parts', *(f'part {number}' for number in range(11, 20))])
        colours = [style['color'] for label, style in styles.items() if int(label.split()[1]) > 10]
        self.assertEqual(len(set(colours)), len(colours))
        self.assertEqual({style['color'] for label, style in styles.items() if int(label.split()[1]) <= 10}, {'lightgrey'})

    def test_without_matplotlib_the_error_says_what_to_install(self):
        if has('matplotlib'):
            self.skipTest('matplotlib is installed')
        with self.assertRaisesRegex(ImportError, 'a plot needs matplotlib, .* python3-matplotlib'):
            self.run_.plot.over_time('/scan')

    def test_the_values_of_plots_are_there_without_it(self):
        self.assertEqual(len(self.run_.plot.latencies_ns('/scan')['/filter']), 100)
        durations = self.run_.plot.durations_ns('/filter')['/filter, subscription /scan']
        self.assertEqual(max(value for _, value in durations), 4_000_000)


class Doors(OpenedRun):
    """The same question in SQL, CSV, Python and the JSON of the report."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([REPORT, SYSTEM, '--sql', f'{folder}/trace.db', '--csv', f'{folder}/csv'], check=True,
                           stdout=subprocess.DEVNULL)
            file = sqlite3.connect(f'{folder}/trace.db')
            cls.database = sqlite3.connect(':memory:')
            file.backup(cls.database)
            file.close()
            cls.csv = {path.stem: path.read_text().splitlines() for path in Path(folder, 'csv').glob('*.csv')}
        cls.json = json.loads(subprocess.run([REPORT, SYSTEM, '--json'], check=True, capture_output=True).stdout)

    @classmethod
    def tearDownClass(cls):
        cls.database.close()

    def ask(self, question):
        return self.database.execute(question).fetchall()

    def test_every_table_has_the_same_rows(self):
        names = {name for name, in self.ask("SELECT name FROM sqlite_master WHERE type = 'table'")}
        self.assertEqual(names, set(self.run_.tables))
        self.assertEqual(set(self.csv), names)
        for name in names:
            with self.subTest(name):
                table = self.run_.table(name)
                rows = [tuple(None if value != value else value for value in row) for row in table.rows()]
                self.assertEqual(self.ask(f'SELECT * FROM {name}'), rows)
                self.assertEqual(self.csv[name][0].split(','), table.columns)
                self.assertEqual(len(self.csv[name]) - 1, len(rows))

    def test_the_latency_of_a_topic(self):
        told, = [topic['latency'] for topic in self.json['topics'] if topic['name'] == '/scan']
        asked, = self.ask("SELECT count(*), max(latency_ns), avg(latency_ns) FROM message_latencies WHERE topic = '/scan'")
        values = [value for _, value in self.run_.plot.latencies_ns('/scan')['/filter']]
        self.assertEqual((told['count'], told['max_ns'], told['mean_ns']), asked)
        self.assertEqual((len(values), max(values), sum(values) / len(values)), asked)

    def test_the_percentiles_of_a_chain(self):
        told = self.json['chains'][0]['response']
        asked = [value for value, in self.ask(
            'SELECT end_ns - begin_ns AS ns FROM chain_instances WHERE first = 1 AND chain = 0 ORDER BY ns')]
        summary = self.run_.chain('/sensor', '/display').summary()
        for name, percent in (('p50_ns', 50), ('p90_ns', 90), ('p99_ns', 99), ('max_ns', 100)):
            self.assertEqual(nearest_rank(asked, percent), told[name])
            self.assertEqual(summary[name], told[name])

    def test_the_parts_of_the_way_to_each_callback_of_a_chain(self):
        for place, step in enumerate(self.json['chains'][0]['steps'][1:], 1):
            for name in ('until_publish', 'transfer', 'executor', 'take'):
                asked = [value for value, in self.ask(
                    f'SELECT {name}_ns FROM chain_hops h JOIN chain_instances i ON i.id = h.chain_instance '
                    f'WHERE step = {place} AND chain = 0 AND {name}_ns IS NOT NULL')]
                hops = self.run_.chain('/sensor', '/display').hops.rows('step', f'{name}_ns')
                self.assertEqual(sorted(value for at, value in hops if at == place and value is not None), sorted(asked))
                self.assertLessEqual(len(asked), step[name]['count'])  # all that reached this callback
                if len(asked) == step[name]['count']:
                    self.assertEqual(nearest_rank(asked, 99), step[name]['p99_ns'])

    def test_the_durations_of_a_callback(self):
        for told in self.json['callbacks']:
            asked, = self.ask(f"SELECT count(*), max(duration_ns) FROM callback_durations WHERE node = '{told['node']}'")
            self.assertEqual((told['duration']['count'], told['duration']['max_ns']), asked)

    def test_what_is_worth_a_look(self):
        self.assertEqual([(row['kind'], row['subject'], row['figures']) for row in self.run_.findings],
                         [(one['kind'], one['subject'], one['figures']) for one in self.json['findings']])
        self.assertEqual(self.ask('SELECT kind, weight FROM findings'),
                         [(one['kind'], one['weight']) for one in self.json['findings']])

    def test_what_became_of_the_messages(self):
        asked = self.ask('SELECT topic, node, received, delivered, lost FROM subscription_statistics')
        self.assertEqual(asked, [(one['topic'], one['node'], one['received'], one['delivered'], one['lost'])
                                 for one in self.json['subscriptions']])


class Notebook(unittest.TestCase):

    def test_its_cells_run(self):
        result = subprocess.run([sys.executable, '-B', NOTEBOOK, SYSTEM], capture_output=True, text=True,
                                env={**os.environ, 'MPLBACKEND': 'agg', 'PYTHONIOENCODING': 'utf-8'})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn('/scan → /filter', result.stdout)
        self.assertIn('p99 4.450 ms: /sensor → /filter → /display', result.stdout)


class ArrowSchema(ctypes.Structure):
    pass


class ArrowArray(ctypes.Structure):
    pass


class ArrowArrayStream(ctypes.Structure):
    pass


ArrowSchema._fields_ = [
    ('format', ctypes.c_char_p), ('name', ctypes.c_char_p), ('metadata', ctypes.c_char_p), ('flags', ctypes.c_int64),
    ('n_children', ctypes.c_int64), ('children', ctypes.POINTER(ctypes.POINTER(ArrowSchema))),
    ('dictionary', ctypes.POINTER(ArrowSchema)), ('release', ctypes.CFUNCTYPE(None, ctypes.POINTER(ArrowSchema))),
    ('private_data', ctypes.c_void_p)]
ArrowArray._fields_ = [
    ('length', ctypes.c_int64), ('null_count', ctypes.c_int64), ('offset', ctypes.c_int64), ('n_buffers', ctypes.c_int64),
    ('n_children', ctypes.c_int64), ('buffers', ctypes.POINTER(ctypes.c_void_p)),
    ('children', ctypes.POINTER(ctypes.POINTER(ArrowArray))), ('dictionary', ctypes.POINTER(ArrowArray)),
    ('release', ctypes.CFUNCTYPE(None, ctypes.POINTER(ArrowArray))), ('private_data', ctypes.c_void_p)]
ArrowArrayStream._fields_ = [
    ('get_schema', ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ArrowArrayStream), ctypes.POINTER(ArrowSchema))),
    ('get_next', ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ArrowArrayStream), ctypes.POINTER(ArrowArray))),
    ('get_last_error', ctypes.CFUNCTYPE(ctypes.c_char_p, ctypes.POINTER(ArrowArrayStream))),
    ('release', ctypes.CFUNCTYPE(None, ctypes.POINTER(ArrowArrayStream))), ('private_data', ctypes.c_void_p)]


def values_of_arrow(schema, array):
    kind = {b'l': ctypes.c_int64, b'g': ctypes.c_double, b'i': ctypes.c_int32}[schema.format]
    values = list((kind * array.length).from_address(array.buffers[1])) if array.length else []
    if array.dictionary:
        words = array.dictionary.contents
        offsets = list((ctypes.c_int32 * (words.length + 1)).from_address(words.buffers[1]))
        text = ctypes.string_at(words.buffers[2], offsets[-1])
        texts = [text[begin:end].decode() for begin, end in zip(offsets, offsets[1:])]
        values = [texts[value] if value >= 0 else None for value in values]
    if array.buffers[0]:
        bits = ctypes.string_at(array.buffers[0], (array.length + 7) // 8)
        valid = [bits[row // 8] >> row % 8 & 1 for row in range(array.length)]
        assert valid.count(0) == array.null_count
        values = [value if there else None for value, there in zip(values, valid)]
    return values


def read_arrow(capsule):
    """The columns of a stream, read as a consumer of Arrow's C interface does."""
    get_pointer = ctypes.pythonapi.PyCapsule_GetPointer
    get_pointer.restype = ctypes.c_void_p
    get_pointer.argtypes = [ctypes.py_object, ctypes.c_char_p]
    stream = ctypes.cast(get_pointer(capsule, b'arrow_array_stream'), ctypes.POINTER(ArrowArrayStream))
    schema, array, end = ArrowSchema(), ArrowArray(), ArrowArray()
    assert stream.contents.get_schema(stream, ctypes.byref(schema)) == 0
    assert stream.contents.get_next(stream, ctypes.byref(array)) == 0
    assert stream.contents.get_next(stream, ctypes.byref(end)) == 0
    assert not end.release and schema.format == b'+s' and array.n_children == schema.n_children
    stream.contents.release(stream)  # the parts outlive it
    columns = {}
    for place in range(schema.n_children):
        child = schema.children[place].contents
        columns[child.name.decode()] = values_of_arrow(child, array.children[place].contents)
    schema.release(ctypes.byref(schema))
    array.release(ctypes.byref(array))
    return columns


if __name__ == '__main__':
    unittest.main()
