# SPDX-License-Identifier: Apache-2.0
"""
The way of a message through a chosen callback, in the page of `launch report --html` in a browser: as a list of steps, and
drawn on the time chart.
"""

import unittest

import page_case


class Flow(page_case.PageTest):
    EVENTS = ('writes',)
    CHART = 'document.querySelector("#view .panel").chart'

    def setUp(self):
        super().setUp()
        self.browser.evaluate('showInTime(page.data, 1)')  # the first callback of /filter
        self.wait_for_canvas('.time canvas')

    def steps(self):
        return self.cells('.flow tbody tr')

    # Times of the first cycle: tests/support/trace_writer/example_system.hpp.
    def test_each_step_has_its_time(self):
        self.assertEqual([row[:3] for row in self.steps()], [
            ['+0 ns', '/sensor · timer 10.0 ms begins', ''],
            ['+95.0 µs', 'publish() of /scan is called', '95.0 µs'],
            ['+100 µs', '/scan is given to the middleware (rmw_publish)', '5.00 µs'],
            ['+103 µs', '/scan is written (dds:write)', '3.00 µs'],
            ['+250 µs', '/filter takes /scan (rmw_take)', '150 µs'],
            ['+300 µs', '/filter · /scan begins', '50.0 µs'],
            ['+595 µs', 'publish() of /points is called', '295 µs'],
            ['+600 µs', '/points is given to the middleware (rmw_publish)', '5.00 µs'],
            ['+603 µs', '/points is written (dds:write)', '3.00 µs'],
            ['+750 µs', '/display takes /points (rmw_take)', '150 µs'],
            ['+800 µs', '/display · /points begins', '50.0 µs'],
            ['+850 µs', '/display · /points ends', '50.0 µs'],
            ['+700 µs', '/filter · /scan ends', '400 µs'],
        ])
        self.assertIn('850 µs from 0.020000 s, 3 callbacks, 2 messages', self.text('.flow'))
        self.assertEqual(self.texts('.flow tr.active td:nth-child(2)'), ['/filter · /scan begins', '/filter · /scan ends'])

    def test_a_step_leads_to_its_callback(self):
        self.browser.click('.flow tbody tr:nth-child(11) button')
        self.browser.wait_for('selection.instance === 2')
        self.assertEqual(self.steps()[0][1], '/sensor · timer 10.0 ms begins', 'the way back goes to its begin')
        self.assertEqual(self.steps()[-1][:2], ['+850 µs', '/display · /points ends'])
        self.assertEqual(self.texts('.flow tr.active td:nth-child(2)'), ['/display · /points begins', '/display · /points ends'])

    def test_a_message_that_nobody_took_is_told(self):
        lost = self.browser.evaluate('page.data.messages.from[page.data.messages.taken.findIndex(Number.isNaN)]')
        self.browser.evaluate(f'showInTime(page.data, {lost})')
        self.assertIn('nobody took this message of /points', [row[1] for row in self.steps()])

    # As if the publisher of /scan used the last /points that had come.
    def test_kept_messages_belong_to_it(self):
        self.browser.evaluate('page.data.kept = [[0, 1]]; page.data.computed = undefined; select({instance: 4})')
        steps = [row[1] for row in self.steps()]
        self.assertEqual(steps[0], '/sensor · timer 10.0 ms begins')
        kept = steps.index('/display · /points begins, its message is kept')
        self.assertEqual(steps[kept + 1], '/sensor · timer 10.0 ms begins', 'the callback that published comes last')

    def test_what_a_publisher_has_kept_goes_on_with_it(self):
        self.browser.evaluate('page.data.kept = [[0, 1]]; page.data.computed = undefined')
        self.assertEqual(self.browser.evaluate('sentLater(page.data, 2).map(message => [page.data.messages.from[message], page.data.topics[topicOf(page.data, message)]])'), [[3, '/scan']])
        self.assertEqual(self.browser.evaluate('causesOf(page.data, page.data.instances.message[4])'), [3, 2])
        self.assertEqual(self.browser.evaluate('causesOf(page.data, page.data.instances.message[1])'), [0])
        self.browser.evaluate('select({instance: 5}); select({instance: 2})')
        self.assertIn('298 callbacks, 200 messages', self.text('.flow p'), 'all that follows, each once')

    def test_it_says_what_the_thread_did_in_the_meantime(self):
        # As if /filter had been busy with something else while the message was on its way.
        self.browser.evaluate('''(() => {
          const {instances, messages} = page.data;
          const message = instances.message[4];
          messages.published[message] = messages.called[message] = instances.end[1] - 150000;
          select({instance: 4});
        })()''')
        self.assertIn('on the way, or in the queue; its thread ran /filter · /scan for 150 µs', [row[3] for row in self.steps()])

    def test_the_key_shows_all_of_it(self):
        self.browser.key('f')
        begin = self.browser.evaluate('page.data.instances.start[0]')
        view = self.browser.evaluate(f'({{...{self.CHART}.view}})')
        self.assertAlmostEqual(view['begin'], begin - 42_500, delta=2)
        self.assertAlmostEqual(view['end'], begin + 892_500, delta=2)

    # How many pixels of the row of a thread have the colour of a stage.
    def stage(self, row, kind):
        return self.browser.evaluate(f'''(() => {{
          const canvas = document.querySelector(".time canvas");
          const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", {{willReadFrequently: true}});
          copy.fillStyle = `hsl(${{kFlowColors.{kind}}} 75% ${{color("bar-lightness")}})`;
          copy.fillRect(0, 0, 1, 1);
          const wanted = copy.getImageData(0, 0, 1, 1).data;
          copy.drawImage(canvas, 0, 0);
          const {{data}} = copy.getImageData(kLabelWidth, Math.round(rowTop({self.CHART}, {row}) + kRowHeight - 3), canvas.width - kLabelWidth, 1);
          let count = 0;
          for (let i = 0; i < data.length; i += 4) count += [0, 1, 2].every(k => Math.abs(data[i + k] - wanted[k]) < 4);
          return count;
        }})()''')

    def test_the_chart_has_its_stages(self):
        self.browser.key('f')
        self.browser.evaluate('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))')
        pixel = self.browser.evaluate(f'({self.CHART}.width - labelWidth({self.CHART})) / {self.CHART}.span()')
        for row in (1, 2):  # /filter, /display: 150 us on the way, 50 us until the callback
            self.assertAlmostEqual(self.stage(row, 'way'), 150_000 * pixel, delta=6)
            self.assertAlmostEqual(self.stage(row, 'taken'), 50_000 * pixel, delta=6)
        self.browser.key('Escape')
        self.browser.wait_for('selection.instance === null')
        self.browser.evaluate('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))')
        self.assertEqual(self.stage(1, 'way'), 0)
        self.assertTrue(self.browser.evaluate('document.querySelector(".flow").parentElement.hidden'))


class WithScheduler(page_case.PageTest):
    EVENTS = ('scheduler',)

    def test_without_writes_there_is_no_step_for_them(self):
        self.browser.evaluate('showInTime(page.data, 1)')
        self.assertEqual(len(self.texts('.flow tbody tr')), 11)
        self.assertNotIn('dds:write', self.text('.flow'))

    # Of the second cycle: before its first callback nothing is known of a thread.
    def test_it_says_how_long_the_thread_waited_for_a_processor(self):
        self.browser.evaluate('showInTime(page.data, 4)')
        self.assertIn('on the way, or in the queue; its thread waited for a processor for 10.0 µs', self.texts('.flow td:nth-child(4)'))


if __name__ == '__main__':
    unittest.main()
