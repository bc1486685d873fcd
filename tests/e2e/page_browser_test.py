# SPDX-License-Identifier: Apache-2.0
"""
The page of `launch report --html` in a browser: every view draws something, clicks and keys do what they say, and the
console has no error. The trace is the example system of tests/support/trace_writer/example_system.hpp.
"""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from browser import Browser, chromium

VIEWS = ('overview', 'graph', 'time', 'callbacks', 'topics', 'services', 'chains', 'lifecycle', 'processes')

# The number of pixels of a canvas that differ from its upper left one.
DRAWN = '''(selector => {
  const canvas = document.querySelector(selector);
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', {willReadFrequently: true});
  copy.drawImage(canvas, 0, 0);
  const {data} = copy.getImageData(0, 0, canvas.width, canvas.height);
  const pixels = new Uint32Array(data.buffer);
  return pixels.reduce((count, pixel) => count + (pixel !== pixels[0]), 0);
})'''


def write_page(folder, cycles, options, events, verdict):
    trace = Path(folder) / 'example'
    subprocess.run([os.environ['WRITE_EXAMPLE_TRACE'], trace / 'ust', str(cycles), *events], check=True)
    if verdict:
        (trace / 'verdict.json').write_text(json.dumps(verdict))
    page = Path(folder) / f'page-{cycles}.html'
    subprocess.run([os.environ['LAUNCH_REPORT'], trace, '--html', page, *options], check=True, stdout=subprocess.DEVNULL)
    return page


class PageTest(unittest.TestCase):
    CYCLES = 100
    DARK = False
    OPTIONS = ()
    EVENTS = ()
    VERDICT = None

    @classmethod
    def setUpClass(cls):
        if not chromium():
            raise unittest.SkipTest('there is no browser: the package chromium is not installed')
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        page = write_page(cls.folder, cls.CYCLES, cls.OPTIONS, cls.EVENTS, cls.VERDICT)
        cls.browser = cls.enterClassContext(Browser(dark=cls.DARK))
        cls.page = page

    def setUp(self):
        self.browser.problems.clear()
        self.browser.open(self.page)

    def tearDown(self):
        self.assertEqual(self.browser.problems, [])
        self.assertEqual([url for url in self.browser.requests if not url.startswith(('file:', 'data:', 'blob:'))], [])

    def show(self, view):
        self.browser.click(f'[data-view={view}]')
        self.browser.wait_for(f'page.shown === "{view}"')

    def text(self, selector):
        return self.browser.evaluate(f'document.querySelector({selector!r}).innerText')

    def texts(self, selector):
        return self.browser.evaluate(f'[...document.querySelectorAll({selector!r})].map(found => found.innerText.trim())')

    def drawn(self, selector):
        return self.browser.evaluate(f'{DRAWN}({selector!r})')

    def wait_for_canvas(self, selector):
        self.browser.wait_for(f'document.querySelector({selector!r}) && {DRAWN}({selector!r}) > 0')


class Views(PageTest):

    def test_every_view_shows_something(self):
        for view in VIEWS:
            with self.subTest(view):
                self.show(view)
                self.assertGreater(len(self.text('#view')), 60)
                self.assertEqual(self.browser.evaluate('document.querySelector("[aria-selected=true]").dataset.view'), view)

    def test_overview_has_the_figures_and_what_is_worth_looking_at(self):
        tiles = self.texts('.tile')
        self.assertIn('298\ncallbacks run', tiles)
        self.assertIn('200\nmessages', tiles)
        self.assertIn('3\nnodes', tiles)
        self.assertIn('none\nevents lost', tiles)
        found = [text.split('\n') for text in self.texts('.findings button')]
        self.assertEqual(found, [[finding[key] for key in ('title', 'subject', 'figures')] for finding in self.browser.evaluate('page.data.findings')])
        self.assertIn('Worst jitter', [title for title, _, _ in found])

    def test_a_finding_opens_its_view(self):
        at = [text.split('\n')[0] for text in self.texts('.findings button')].index('Worst jitter')
        self.browser.click(f'.findings li:nth-child({at + 1}) button')
        self.browser.wait_for('page.shown === "callbacks"')
        self.assertEqual(self.text('tr.active td:first-child'), '/sensor')

    def test_number_keys_open_views(self):
        for number, view in enumerate(VIEWS, 1):
            self.browser.key(str(number))
            self.browser.wait_for(f'page.shown === "{view}"')

    def test_lifecycle_has_a_bar_for_each_state(self):
        self.show('lifecycle')
        self.assertEqual(self.browser.evaluate('[...document.querySelectorAll(".track div")].map(bar => bar.title.split("\\n")[0])'),
                         ['unconfigured', 'configuring', 'inactive', 'activating', 'active'])
        self.assertGreater(self.browser.evaluate('document.querySelector(".track div:last-child").offsetWidth'), 500)

    def test_processes_have_their_places_in_the_launch_file(self):
        self.show('processes')
        self.assertEqual(self.texts('tbody td:last-child'), [f'/examples/system.launch.xml:{line}' for line in (5, 4, 3)])
        self.assertEqual(self.texts('tbody td:first-child'), ['display-3', 'filter-2', 'sensor-1'])

    def test_chains_have_their_hops(self):
        self.show('chains')
        heads = self.texts('.chain .head')
        self.assertEqual(heads[0], '/sensor → /display\n3 callbacks, 98 runs\nresponse mean 997 µs, p99 4.45 ms, max 4.45 ms\nlongest run')
        label = self.browser.evaluate('document.querySelector(".hops").getAttribute("aria-label")')
        self.assertEqual([part.rsplit(' ', 2)[1:] for part in label.split('; ')],
                         [['100', 'µs'], ['148', 'µs'], ['2.00', 'µs'], ['50.0', 'µs'],
                          ['447', 'µs'], ['148', 'µs'], ['2.00', 'µs'], ['50.0', 'µs'], ['50.0', 'µs']])
        self.assertEqual(self.browser.evaluate('document.querySelector(".hops").children.length'), 9)

    def test_the_longest_run_of_a_chain_is_shown_in_the_time_chart(self):
        self.show('chains')
        self.browser.click('.chain .head button')
        self.browser.wait_for('page.shown === "time" && selection.instance !== null')
        self.assertIn('/display · /points', self.text('.details'))


class Tables(PageTest):

    def rows(self, column):
        return self.texts(f'tbody td:nth-child({column})')

    def test_callbacks_have_their_statistics(self):
        self.show('callbacks')
        rows = dict(zip(self.rows(1), self.texts('tbody tr')))
        self.assertEqual(rows['/filter'].split('\t'), ['/filter', '/scan', '100', '99.9 Hz', '580 µs', '400 µs', '4.00 ms', '4.00 ms',
                                                       '58.0 ms', '10.0 ms', '11.0 ms', rows['/filter'].split('\t')[-1]])
        self.assertEqual(rows['/sensor'].split('\t')[:6], ['/sensor', 'timer 10.0 ms', '100', '99.9 Hz', '200 µs', '200 µs'])

    def test_a_header_sorts(self):
        self.show('callbacks')
        self.browser.click('thead th:nth-child(1) button')
        self.assertEqual(self.rows(1), ['/display', '/filter', '/sensor'])
        self.browser.click('thead th:nth-child(1) button')
        self.assertEqual(self.rows(1), ['/sensor', '/filter', '/display'])
        self.assertEqual(self.browser.evaluate('document.querySelector("[aria-sort]").getAttribute("aria-sort")'), 'descending')

    def test_a_filter_leaves_rows_out(self):
        self.show('callbacks')
        self.browser.click('input[type=search]')
        for character in 'scan':
            self.browser.key(character)
        self.assertEqual(self.rows(1), ['/filter'])
        self.assertIn('1 of 3 callbacks', self.texts('.tools span'))

    def test_a_row_shows_plots(self):
        self.show('callbacks')
        self.browser.click('tbody tr:nth-child(1)')
        self.browser.wait_for('document.querySelectorAll(".u-wrap canvas").length === 6')
        for plot in range(1, 7):
            with self.subTest(plot):
                self.wait_for_canvas(f'.plot:nth-child({plot}) canvas')
        self.assertIn('/filter · /scan', self.texts('h2'))

    def test_a_row_is_chosen_by_keys(self):
        self.show('topics')
        self.browser.evaluate('document.querySelector("tbody tr").focus()')
        self.browser.key('ArrowDown')
        self.browser.key('Enter')
        self.browser.wait_for('document.querySelectorAll(".u-wrap canvas").length === 4')
        self.assertEqual(self.text('[data-chip=topic]'), 'topic ' + self.rows(1)[1] + ' ✕')

    def test_topics_have_their_latencies(self):
        self.show('topics')
        rows = dict(zip(self.rows(1), self.texts('tbody tr')))
        self.assertEqual(rows['/points'].split('\t')[1:6], ['1', '1', '100', '98', '2'])
        self.assertEqual(rows['/scan'].split('\t')[7:], ['200 µs'] * 5)

    def test_the_longest_callback_is_shown_in_the_time_chart(self):
        self.show('callbacks')
        self.browser.click('tbody tr:nth-child(1)')
        self.browser.wait_for('document.querySelectorAll(".u-wrap canvas").length === 6')
        self.browser.click('#view p.tools button')
        self.browser.wait_for('page.shown === "time"')
        self.assertIn('4.00 ms', self.text('.details'))


class Graph(PageTest):

    def test_it_has_a_box_for_each_node_and_topic_with_rate_and_latency(self):
        self.show('graph')
        labels = self.browser.evaluate('[...document.querySelectorAll(".box")].map(box => box.getAttribute("aria-label")).sort()')
        self.assertEqual([label.split(' ')[:2] for label in labels],
                         [['node', '/display'], ['node', '/filter'], ['node', '/sensor'], ['topic', '/points'], ['topic', '/scan']])
        self.assertRegex(labels[4], r'topic /scan \d+\.\d Hz · p99 200 µs')
        self.assertEqual(self.browser.evaluate('document.querySelectorAll(".graph svg > path").length'), 4)
        xs = self.browser.evaluate('Object.fromEntries([...document.querySelectorAll(".box")].map(box => [box.dataset.box, box.getBoundingClientRect().x]))')
        order = ['node /sensor', 'topic /scan', 'node /filter', 'topic /points', 'node /display']
        self.assertEqual(sorted(xs, key=xs.get), order)

    def test_a_click_filters_all_views_and_the_chip_takes_it_back(self):
        self.show('graph')
        self.browser.click('[data-box="node /filter"]')
        self.assertEqual(self.text('[data-chip=node]'), 'node /filter ✕')
        self.assertEqual(self.browser.evaluate('document.querySelector(".box.active").dataset.box'), 'node /filter')
        self.assertEqual(self.browser.evaluate('[...document.querySelectorAll(".box.dim")].map(box => box.dataset.box).sort()'),
                         ['node /display', 'node /sensor'])
        self.show('callbacks')
        self.assertEqual(self.texts('tbody td:nth-child(1)'), ['/filter'])
        self.show('time')
        self.assertEqual(self.browser.evaluate('document.querySelector("#view .panel").chart.rows.map(row => row.text)'), ['/filter'])
        self.browser.click('[data-chip=node]')
        self.browser.wait_for('document.querySelector("#view .panel").chart.rows.length === 3')
        self.assertEqual(self.text('#selection'), '')

    def test_a_box_is_chosen_by_keys(self):
        self.show('graph')
        self.browser.evaluate('document.querySelector(\'[data-box="topic /scan"]\').focus()')
        self.browser.key('Enter')
        self.assertEqual(self.text('[data-chip=topic]'), 'topic /scan ✕')
        self.assertEqual(self.browser.evaluate('document.activeElement.dataset.box'), 'topic /scan', 'it keeps the focus')


class TimeChart(PageTest):
    CHART = 'document.querySelector("#view .panel").chart'

    def setUp(self):
        super().setUp()
        self.show('time')
        self.wait_for_canvas('.time canvas')

    def view(self):
        return self.browser.evaluate(f'({{...{self.CHART}.view}})')

    # The place on the screen of an instance, which must be in sight.
    def place_of(self, instance):
        return self.browser.evaluate(f'''(() => {{
          const chart = {self.CHART};
          const box = document.querySelector(".time canvas").getBoundingClientRect();
          const {{start, end}} = page.data.instances;
          return [box.x + timeX(chart, (start[{instance}] + end[{instance}]) / 2),
                  box.y + rowTop(chart, chart.index.rowOf({instance})) + kRowHeight / 2];
        }})()''')

    def press(self, *keys):
        self.browser.evaluate('document.querySelector(".time canvas").focus()')
        for key in keys:
            self.browser.key(key)

    def test_it_draws_each_row(self):
        self.assertEqual(self.browser.evaluate(f'{self.CHART}.rows.map(row => row.text)'), ['/sensor', '/filter', '/display'])
        self.assertGreater(self.drawn('.time canvas'), 2000)

    def test_keys_zoom_move_and_go_back(self):
        whole = self.view()
        self.press('+', '+')
        zoomed = self.view()
        self.assertAlmostEqual(zoomed['end'] - zoomed['begin'], 0.36 * (whole['end'] - whole['begin']), delta=2)
        self.press('ArrowRight')
        self.assertGreater(self.view()['begin'], zoomed['begin'])
        self.press('0')
        self.assertEqual(self.view(), whole)

    def test_the_wheel_zooms_at_the_pointer(self):
        x, y = self.place_of(150)
        time = self.browser.evaluate('page.data.instances.start[150]')
        for _ in range(5):
            self.browser.call('Input.dispatchMouseEvent', type='mouseWheel', x=x, y=y, deltaX=0, deltaY=-400, modifiers=2)
        self.browser.wait_for(f'{self.CHART}.view.end - {self.CHART}.view.begin < 0.1 * page.data.duration')
        view = self.view()
        self.assertTrue(view['begin'] < time < view['end'], (view, time))

    def test_dragging_moves(self):
        self.press('+', '+', '+')
        before = self.view()
        x, y = self.place_of(150)
        for kind, at in (('mousePressed', x), ('mouseMoved', x - 100), ('mouseReleased', x - 100)):
            self.browser.call('Input.dispatchMouseEvent', type=kind, x=at, y=y, button='left', clickCount=1)
        self.browser.wait_for(f'{self.CHART}.view.begin > {before["begin"]}')

    def test_arrows_appear_when_there_is_room(self):
        self.press(*'++++++++')
        self.browser.wait_for(f'{self.CHART}.arrowsHidden === 0')
        self.browser.evaluate('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))')
        with_arrows = self.drawn('.time canvas')
        self.press('m')
        self.browser.wait_for(f'{DRAWN}(".time canvas") < {with_arrows}')
        self.press('m')
        self.browser.wait_for(f'{DRAWN}(".time canvas") === {with_arrows}')

    def test_a_click_tells_of_a_callback_and_what_came_of_it(self):
        self.browser.evaluate('showInTime(page.data, 1)')  # the first callback of /filter
        self.browser.evaluate('select({instance: null})')
        self.browser.evaluate('drawView("time")')
        self.wait_for_canvas('.time canvas')
        self.browser.click_at(*self.place_of(1))
        self.browser.wait_for('selection.instance === 1')
        told = self.text('.details')
        self.assertIn('/filter · /scan', told)
        self.assertIn('Filter::on_scan(sensor_msgs::msg::LaserScan const&)', told)
        self.assertIn('400 µs', told)
        self.assertIn('/scan: 200 µs after its publication; 150 µs until it was taken, 50.0 µs until the callback', told)
        self.assertEqual(self.texts('.details button'), ['/sensor · timer 10.0 ms', '/display · /points', 'next', 'statistics'])
        self.browser.click('.details button:nth-of-type(1)')
        self.browser.wait_for('selection.instance === 0')

    def test_keys_go_from_callback_to_callback(self):
        self.press('ArrowDown', 'n')
        self.browser.wait_for('selection.instance === 0')
        self.press('n')
        self.browser.wait_for('selection.instance === 3')
        self.press('p')
        self.browser.wait_for('selection.instance === 0')
        self.press('Escape')
        self.browser.wait_for('selection.instance === null')

    def test_rows_are_threads_or_callbacks(self):
        self.browser.evaluate('''(() => {
          const choice = document.querySelector("[aria-label=Rows]");
          choice.value = "callback";
          choice.dispatchEvent(new Event("change"));
        })()''')
        self.assertEqual(self.browser.evaluate(f'{self.CHART}.rows.map(row => row.text)'),
                         ['/sensor', 'timer 10.0 ms', '/filter', '/scan', '/display', '/points'])


class WithVerdict(PageTest):
    VERDICT = {
        'absent': ['camera [12] was never registered with the session daemon: 4 events that it fired are missing'],
        'discarded_events': 3,
        'channels': [{'before_first_packet': {'why': 'overwritten, as asked', 'packets': 2, 'events': 900}}],
        'event_cost': {'ns': 500},
        'processes': [{'name': 'sensor', 'pid': 101, 'events': 1500,
                       'tracing': {'seconds': 0.00075, 'processor_share': 0.00073, 'ns_per_callback': 7500}}]}

    def test_the_overview_says_what_is_missing(self):
        self.assertIn('3\nlost', self.texts('.tile'))
        self.assertEqual(self.texts('.absences li'), [*self.VERDICT['absent'], '900 events overwritten, as asked'])

    def test_the_overview_has_the_cost_of_tracing(self):
        self.assertEqual(self.texts('h2')[-1], 'Cost of tracing')
        self.assertRegex(self.texts('section p')[-2], r'^1\.\d\d ms, 0\.\d\d % of a processor: 500 ns for each event\.$')
        self.assertEqual(self.texts('tbody tr')[-1].split('\t'), ['sensor', '101', '1,500', '750 µs', '0.07 %', '7.50 µs'])


# Functions of the page's scripts, with data that the example does not have.
class FurtherResults(PageTest):
    TIMES = '{count: 4, mean: 1e6, p50: 1e6, p99: 2e6, max: 3e6}'

    def draw(self, view, facts):
        self.browser.evaluate(f'Object.assign(page.data, {facts}); drawView("{view}")')

    def test_services_and_actions_have_their_times(self):
        self.draw('services', f"""{{
          calls: [{{service: "/add", client: "/sensor", server: "", requests: 5, responses: 4, round_trip: {self.TIMES}, request: null, in_service: {self.TIMES}, response: null}}],
          actions: [{{name: "/fibonacci", client: "/filter", server: "/display", goals: 2, answers: 2, results: 1, cancels: 1, feedback: 9, acceptance: {self.TIMES}, execution: {self.TIMES}}}]}}""")
        self.assertEqual([row.split('\t') for row in self.texts('tbody tr')], [
            ['/add', '/sensor', '?', '5', '1', '1.00 ms', '2.00 ms', '3.00 ms', '–', '1.00 ms', '–'],
            ['/fibonacci', '/filter', '/display', '2', '1', '1', '9', '1.00 ms', '1.00 ms', '2.00 ms', '3.00 ms']])
        self.browser.evaluate('select({node: page.data.nodes.findIndex(node => node.name === "/display")})')
        self.assertEqual(self.texts('tbody td:first-child'), ['/fibonacci'])

    def test_memory_is_told_of_callbacks_and_states(self):
        self.draw('callbacks', '{callback_memory: [[0, 100, 250, 4000]]}')
        self.assertIn('250\t2.50\t4.0 kB', '\n'.join(self.texts('tbody tr')))
        self.draw('lifecycle', '{state_memory: [{node: "/display", state: "active", begin: 0, duration: 1e9, allocations: 7, bytes: 999, process_allocations: 8, process_bytes: 2e6}]}')
        self.assertEqual(self.texts('section:last-child tbody tr'), ['/display\tactive\t0.000000 s\t1.00 s\t7\t999 bytes\t8\t2.0 MB'])

    def test_the_start_has_phases_and_a_critical_path(self):
        self.draw('processes', """{
          startup: {duration: 50e6, path: [{process: "", what: "load a.launch.xml", begin: 0, end: 10e6}, {process: "sensor-1", what: "until rcl_init", begin: 10e6, end: 50e6}]},
          starts: [{...page.data.starts[0], spawn: page.data.starts[0].exec - 1e6, init_after: 2e6, node_after: 3e6, ready_after: 8e6, callback_after: 5e6, publication_after: null}]}""")
        self.assertIn('Critical path of the start, 50.0 ms', self.texts('h2'))
        self.assertEqual(self.texts('.path > div'), ['launcher: load a.launch.xml 10.0 ms', '', 'sensor-1: until rcl_init 40.0 ms', ''])
        self.assertEqual(self.browser.evaluate('[...document.querySelectorAll(".bars:not(.path) .track div")].map(part => part.title)'),
                         ['until exec\n1.00 ms', 'until rcl_init\n2.00 ms', 'until its node\n1.00 ms', 'until its first callback\n2.00 ms', 'until ready\n3.00 ms'])


class StatesOfThreads(PageTest):
    EVENTS = ('scheduler',)
    CHART = 'document.querySelector("#view .panel").chart'
    # The first callback of 4 ms, which waits for a processor.
    LONG = 'page.data.instances.callback.findIndex((_, i) => page.data.instances.end[i] - page.data.instances.start[i] > 3e6)'

    def setUp(self):
        super().setUp()
        self.browser.evaluate(f'showInTime(page.data, {self.LONG})')
        self.browser.wait_for('page.shown === "time"')
        self.wait_for_canvas('.time canvas')

    # How many pixels of the strip below a row have a colour of page.css.
    def strip(self, row, name):
        return self.browser.evaluate(f'''(() => {{
          const canvas = document.querySelector(".time canvas");
          const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", {{willReadFrequently: true}});
          const top = Math.round(rowTop({self.CHART}, {row}) + kRowHeight - 2 - kStateHeight / 2);
          copy.drawImage(canvas, 0, 0);
          const colors = [color("{name}")].map(hex => [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16)));
          const {{data}} = copy.getImageData(kLabelWidth, top, canvas.width - kLabelWidth, 1);
          let count = 0;
          for (let i = 0; i < data.length; i += 4) count += colors[0].every((part, k) => Math.abs(part - data[i + k]) < 3);
          return count;
        }})()''')

    def test_the_chosen_callback_says_what_its_thread_did_and_what_ran_instead(self):
        self.assertIn('on a processor 500 µs, waited for a processor 3.50 ms (stress [90] ran instead)', self.text('.details'))

    def test_a_strip_shows_them_below_threads_and_callbacks(self):
        self.assertEqual(self.texts('.key span'), ['on a processor', 'waited for a processor', 'blocked'])
        self.browser.evaluate('select({instance: null})')
        self.browser.evaluate(f'{self.CHART}.view.begin = page.data.instances.start[{self.LONG}]; '
                              f'{self.CHART}.view.end = page.data.instances.end[{self.LONG}] + 1e6; drawView("time")')
        for rows, row in (('thread', 1), ('callback', 3)):
            with self.subTest(rows):
                self.browser.evaluate(f'timeChartOptions.by = "{rows}"; drawView("time")')
                self.browser.wait_for(f'{self.CHART}.rows.length === {3 if rows == "thread" else 6}')
                self.browser.evaluate('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))')
                self.assertGreater(self.strip(row, 'runnable'), 500)
                self.assertGreater(self.strip(row, 'running'), 80)
                self.assertEqual(self.strip(row, 'blocked') > 80, rows == 'thread', 'it sleeps after the callback')
        self.browser.evaluate('timeChartOptions.by = "thread"')

    def test_the_pointer_tells_of_the_state_below_it(self):
        x, y = self.browser.evaluate(f'''(() => {{
          const box = document.querySelector(".time canvas").getBoundingClientRect();
          return [box.x + timeX({self.CHART}, page.data.instances.start[{self.LONG}] + 2e6), box.y + rowTop({self.CHART}, 1) + kRowHeight / 2];
        }})()''')
        self.browser.call('Input.dispatchMouseEvent', type='mouseMoved', x=x, y=y, button='none')
        self.browser.wait_for('!document.querySelector(".tip").hidden')
        self.assertIn('here: waited for a processor for 3.50 ms; stress [90] ran instead', self.text('.tip'))


class Scripts(PageTest):

    def test_intervals_know_how_busy_any_time_is(self):
        self.assertEqual(self.browser.evaluate('''(() => {
          let seed = 1;
          const random = () => (seed = seed * 16807 % 2147483647) / 2147483647;
          const instances = {start: [], end: []};
          for (let time = 0; instances.start.length < 500;) {
            instances.start.push(time += Math.floor(random() * 100));
            instances.end.push(time += Math.floor(random() * 100));
          }
          const intervals = new Intervals(instances, instances.start.keys());
          for (let i = 0; i < 500; ++i) {
            const begin = Math.floor(random() * 50000) - 100;
            const end = begin + Math.floor(random() * 5000);
            let sum = 0;
            for (let k = 0; k < 500; ++k) sum += Math.max(0, Math.min(end, instances.end[k]) - Math.max(begin, instances.start[k]));
            if (intervals.busyTime(begin, end) !== sum) return [begin, end, sum, intervals.busyTime(begin, end)];
          }
          return "equal";
        })()'''), 'equal')

    def test_intervals_within_others_are_drawn_in_them(self):
        self.assertEqual(self.browser.evaluate('''(() => {
          const intervals = new Intervals({start: [0, 10, 15, 40, 60], end: [50, 30, 20, 45, 70]}, [0, 1, 2, 3, 4]);
          const levels = [];
          for (let level = intervals; level; level = level.nested) levels.push([...level.ids]);
          return [levels, [5, 16, 35, 42, 55, 58].map(time => intervals.at(time, 3))];
        })()'''), [[[0, 4], [1, 3], [2]], [0, 2, 0, 3, -1, 4]])

    def test_a_graph_with_circles_gets_a_place_for_each_box(self):
        self.assertEqual(self.browser.evaluate('''[Infinity, 100].map(room => {
          const boxes = Array.from({length: 6}, () => ({width: 80, height: 20}));
          const edges = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 3], [0, 4], [4, 2]].map(([from, to]) => ({from, to}));
          const {width, height} = layOut(boxes, edges, room);
          const apart = boxes.every((a, i) => boxes.every((b, k) => i === k || Math.abs(a.x - b.x) >= 80 || Math.abs(a.y - b.y) >= 20));
          const inside = boxes.every(box => box.x >= 40 && box.x <= width - 40 && box.y >= 10 && box.y <= height - 10);
          return [apart, inside, edges.every(edge => edge.points.length > 0)];
        })'''), [[True, True, True]] * 2)

    def test_durations_have_three_digits_and_a_unit(self):
        self.assertEqual(self.browser.evaluate('[0, 999, 1000, 999499, 999500, 1e6, 45.6e6, 999.6e6, 107e9, NaN, -1500].map(formatDuration)'),
                         ['0 ns', '999 ns', '1.00 µs', '999 µs', '1.00 ms', '1.00 ms', '45.6 ms', '1.00 s', '107 s', '–', '-1.50 µs'])

    def test_a_page_that_cannot_be_read_says_so(self):
        text = Path(self.page).read_text()
        broken = Path(self.folder) / 'broken.html'
        broken.write_text(text.replace('id="columns">', 'id="columns">AAAA'))
        self.browser.call('Page.navigate', url=f'file://{broken}')
        self.browser.wait_for('document.querySelector("[role=alert]")')
        self.assertRegex(self.text('[role=alert]'), '^The page could not read its data: ')
        self.browser.problems.clear()


class DarkPage(PageTest):
    DARK = True

    def test_it_is_dark(self):
        self.assertEqual(self.browser.evaluate('getComputedStyle(document.body).backgroundColor'), 'rgb(18, 22, 29)')
        for view in VIEWS:
            self.show(view)
        self.show('time')
        self.wait_for_canvas('.time canvas')
        corner = 'document.querySelector(".time canvas").getContext("2d").getImageData(1, 60, 1, 1).data[0]'
        self.assertLess(self.browser.evaluate(corner), 80)


# 560,000 events; the time chart draws what falls into one pixel as one.
class LargePage(PageTest):
    CYCLES = 20_000

    def test_it_draws_all_and_a_part(self):
        self.show('time')
        self.wait_for_canvas('.time canvas')
        self.assertGreater(self.drawn('.time canvas'), 20_000)
        self.browser.evaluate('document.querySelector(".time canvas").focus()')
        for _ in range(20):
            self.browser.key('+')
        self.browser.wait_for('document.querySelector("#view .panel").chart.arrowsHidden === 0')
        self.assertIn('59,600\ncallbacks run', (self.show('overview'), self.texts('.tile'))[1])
        self.show('callbacks')
        self.browser.click('tbody tr:nth-child(1)')
        self.browser.wait_for('document.querySelectorAll(".u-wrap canvas").length === 6')


# Another part of the trace than all of it.
class PartOfAPage(PageTest):
    OPTIONS = ('--from', '+0.52', '--to', '+0.62')

    def test_it_says_which_part_it_holds(self):
        self.assertIn('This page holds 100 ms of 1.02 s, from 0.520000 s on.', self.text('#view .panel'))
        self.assertIn('30\ncallbacks run', self.texts('.tile'))
        self.show('time')
        self.wait_for_canvas('.time canvas')


del PageTest  # unittest would run it, too

if __name__ == '__main__':
    unittest.main()
