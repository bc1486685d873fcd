# SPDX-License-Identifier: Apache-2.0
"""
The time chart of the page of `launch report --html` in a browser, and the scripts that it is drawn with.
"""

import unittest
from pathlib import Path

import page_case


class TimeChart(page_case.PageTest):
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

    # Nothing was clicked in the chart, and nothing in it has been given the focus.
    def press(self, *keys):
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

    def test_two_fingers_zoom(self):
        x, y = self.place_of(150)
        before = self.view()
        for kind, apart in (('touchStart', 40), ('touchMove', 80), ('touchMove', 160), ('touchEnd', None)):
            points = [] if apart is None else [{'x': x - apart, 'y': y, 'id': 0}, {'x': x + apart, 'y': y, 'id': 1}]
            self.browser.call('Input.dispatchTouchEvent', type=kind, touchPoints=points)
        self.browser.wait_for(f'{self.CHART}.view.end - {self.CHART}.view.begin < {0.4 * (before["end"] - before["begin"])}')
        self.assertEqual(self.browser.evaluate('selection.instance'), None, 'nothing is chosen by it')

    def test_arrows_appear_when_there_is_room(self):
        self.press(*'++++++++')
        self.browser.wait_for(f'{self.CHART}.arrowsHidden === 0')
        self.browser.evaluate('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))')
        with_arrows = self.drawn('.time canvas')
        self.press('m')
        self.browser.wait_for(f'{page_case.DRAWN}(".time canvas") < {with_arrows}')
        self.press('m')
        self.browser.wait_for(f'{page_case.DRAWN}(".time canvas") === {with_arrows}')

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

    def test_keys_work_right_after_the_tab_was_clicked_and_wherever_the_focus_is(self):
        whole = self.view()
        self.press('w')
        self.assertLess(self.view()['end'], whole['end'])
        for focus in ('document.activeElement.blur()', 'document.querySelector("[aria-label=\'Zoom in\']").focus()', 'document.querySelector("input[type=checkbox]").focus()'):
            with self.subTest(focus):
                self.browser.evaluate(focus)
                before = self.view()
                self.press('ArrowRight')
                self.assertGreater(self.view()['begin'], before['begin'])
                self.press('ArrowLeft')

    def test_a_field_that_takes_text_keeps_its_keys(self):
        self.show('callbacks')
        self.browser.click('input[type=search]')
        for key in 'c?2':
            self.browser.key(key)
        self.assertEqual(self.browser.evaluate('[page.shown, document.activeElement.value, document.querySelector("dialog") === null]'), ['callbacks', 'c?2', True])

    def test_the_help_lists_the_keys_those_of_the_view_first(self):
        self.press('?')
        self.browser.wait_for('document.querySelector("dialog[open]")')
        self.assertEqual(self.texts('dialog h3')[:2], ['Everywhere', 'Time chart'])
        self.assertIn('the whole trace', self.texts('dialog dd'))
        whole = self.view()
        self.press('w')
        self.assertEqual(self.view(), whole, 'keys act on the help, not on what is behind it')
        self.press('Escape')
        self.browser.wait_for('!document.querySelector("dialog")')
        self.press('?', '?')
        self.browser.wait_for('!document.querySelector("dialog")')
        self.browser.click('#others button')
        self.browser.wait_for('document.querySelector("dialog[open]")')

    def test_every_key_of_the_help_does_something(self):
        self.browser.evaluate('timeChartOptions.view = null; select({node: null, instance: null}); drawView("time")')
        self.assertEqual(self.browser.evaluate(f'''(async () => {{
          const frame = () => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
          const state = () => JSON.stringify([{self.CHART}.view, {self.CHART}.row, {self.CHART}.arrows, selection.instance]);
          const idle = [];
          await frame();
          for (const {{keys}} of [...keysOf.time, ...keysOf.time]) for (const key of keys) {{
            {self.CHART}.setView(2e8, 6e8);
            if (key === 'p') {self.CHART}.show(30);
            else if (key === 'f') select({{instance: 1}});
            else if (key === 'ArrowUp') {self.CHART}.row = 2;
            const before = state();
            document.body.dispatchEvent(new KeyboardEvent('keydown', {{key, bubbles: true}}));
            if (state() === before) idle.push(key);
          }}
          return idle;
        }})()'''), [])

    def test_a_chosen_callback_makes_the_others_faint(self):
        def strong():
            self.browser.evaluate('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))')
            return self.browser.evaluate('''(() => {
              const canvas = document.querySelector(".time canvas");
              const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", {willReadFrequently: true});
              copy.drawImage(canvas, 0, 0);
              const {data} = copy.getImageData(kLabelWidth, kMapHeight + kScaleHeight, canvas.width - kLabelWidth, canvas.height - kMapHeight - kScaleHeight);
              let count = 0;
              for (let i = 0; i < data.length; i += 4) count += Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 90;
              return count;
            })()''')
        self.press('m')
        self.browser.evaluate(f'{self.CHART}.setView(20e6, 60e6)')
        before = strong()
        self.browser.evaluate('select({callback: 0})')
        self.assertLess(strong(), 0.5 * before)
        self.browser.click('[data-chip=callback]')
        self.assertEqual(strong(), before)
        self.press('m')

    def test_rows_are_threads_or_callbacks(self):
        self.choose('Rows', 'callback')
        self.assertEqual(self.browser.evaluate(f'{self.CHART}.rows.map(row => row.text)'),
                         ['/sensor', 'timer 10.0 ms', '/filter', '/scan', '/display', '/points'])


class StatesOfThreads(page_case.PageTest):
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


# No two boxes cover one another, all are in the picture, and each edge has a way.
LAYS_OUT = '''((boxes, edges, room) => {
  const {width, height} = layOut(boxes, edges, room);
  const [w, h] = [boxes[0].width, boxes[0].height];
  const apart = boxes.every((a, i) => boxes.every((b, k) => i === k || Math.abs(a.x - b.x) >= w || Math.abs(a.y - b.y) >= h));
  const inside = boxes.every(box => box.x >= w / 2 && box.x <= width - w / 2 && box.y >= h / 2 && box.y <= height - h / 2);
  return apart && inside && edges.every(edge => edge.points.length > 0);
})'''


class Scripts(page_case.PageTest):

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
        self.assertEqual(self.browser.evaluate('''[{width: 1000, height: 1000}, {width: 100, height: 1000}, {width: 1000, height: 100}].map(room => {
          const boxes = Array.from({length: 6}, () => ({width: 80, height: 20}));
          const edges = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 3], [0, 4], [4, 2]].map(([from, to]) => ({from, to}));
          return laysOut(boxes, edges, room);
        })'''.replace('laysOut', LAYS_OUT)), [True] * 3)

    def test_a_long_graph_and_a_wide_one_are_folded(self):
        self.assertEqual(self.browser.evaluate('''[[...Array(150).keys()].map(i => [i, i + 1]), [...Array(150).keys()].map(i => [0, i + 1])].map(pairs => {
          const boxes = Array.from({length: 151}, () => ({width: 180, height: 40}));
          const fits = laysOut(boxes, pairs.map(([from, to]) => ({from, to})), {width: 1200, height: 700});
          const {width, height} = layOut(boxes, pairs.map(([from, to]) => ({from, to})), {width: 1200, height: 700});
          return [fits, Math.min(1200 / width, 700 / height) > 0.25];
        })'''.replace('laysOut', LAYS_OUT)), [[True, True]] * 2)

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


if __name__ == '__main__':
    unittest.main()
