# SPDX-License-Identifier: Apache-2.0
"""
The page of two runs, `launch report --diff A B --html FILE`, in a browser. In the run after, /filter takes 1 ms longer.
"""

import json
import os
import re
import subprocess
import unittest
from pathlib import Path

import page_case


class TwoRuns(page_case.PageTest):
    PAIR = 'document.querySelector("#view").firstElementChild.pair'
    TABLE = '#view section:nth-of-type(2)'

    @classmethod
    def make_page(cls):
        before = page_case.write_trace(Path(cls.folder) / 'monday', 300)
        after = page_case.write_trace(Path(cls.folder) / 'tuesday', 260, ['slow'])
        chains = [{'name': 'reaction', 'nodes': ['/sensor', '/display']}, {'name': 'end', 'nodes': ['/filter', '/display']}]
        for trace in (before, after):
            (trace / 'chains.json').write_text(json.dumps({'chains': chains}))
        page = Path(cls.folder) / 'both.html'
        done = subprocess.run([os.environ['LAUNCH_REPORT'], '--diff', before, after, '--html', page, '--fail-on', 'slower'],
                              stdout=subprocess.PIPE, text=True)
        assert done.returncode == 3, done
        cls.told = done.stdout
        return page

    def setUp(self):
        super().setUp()
        self.browser.evaluate('Object.assign(compareOptions, {kind: "callback", subject: null, view: null, lag: 0, chosen: [null, null]}); showView("compare")')
        self.wait_for_canvas('.side:last-of-type .time canvas')

    def rows(self):
        return self.cells(f'{self.TABLE} tbody tr')

    def views(self):
        return self.browser.evaluate(f'{self.PAIR}.charts.map(chart => ({{...chart.view}}))')


class Comparison(TwoRuns):

    def test_the_terminal_has_the_comparison_and_the_size_of_the_page(self):
        self.assertIn('/filter, subscription /scan\n    duration, p10                    400 us -> 1.40 ms   +1.00 ms', self.told)
        self.assertRegex(self.told, '\n' + re.escape(str(self.page)) + r': [\d.]+ kB\n$')

    def test_the_comparison_comes_first(self):
        self.browser.call('Page.navigate', url='about:blank')
        self.browser.open(self.page)
        self.assertEqual(self.browser.evaluate('page.shown'), 'compare')
        self.assertEqual(self.text('#title'), 'monday and tuesday')
        self.assertIn('have changed; with a confidence of 99 % none of them by chance', self.text('#view section'))
        self.assertIn('monday: 8,', self.text('#view section'))

    def test_the_table_has_both_runs_and_the_verdict(self):
        rows = self.rows()
        self.assertEqual([[row[0].split('\n')[0], row[1]] for row in rows], [['/filter, subscription /scan', 'slower'], ['/sensor, timer 10 ms', 'no change holds'], ['/display, subscription /points', 'no change holds']])
        self.assertEqual(rows[0][2:7], ['400 µs → 1.40 ms', '+1.00 ms (+250 %)', '4.00 ms → 4.00 ms', '±0 ns (±0.00 %)', '300 → 260'])
        self.assertIn('duration, median 400 µs → 1.40 ms (+1.00 ms)', rows[0][0])
        self.choose('Percentile', 'p90')
        self.assertEqual(self.rows()[0][4:6], ['400 µs → 1.40 ms', '+1.00 ms (+250 %)'])

    def test_hops_and_chains_are_compared_too(self):
        self.choose('What', 'hop')
        self.assertEqual([row[:3] for row in self.rows()], [['/scan to /filter', 'no change holds', '205 µs → 205 µs'], ['/points to /display', 'no change holds', '205 µs → 205 µs']])
        self.choose('What', 'chain')
        chain, part = self.rows()
        self.assertEqual([part[0], *part[1:4]], ['end: /filter (/scan) -> /display (/points)', 'not compared', '550 µs → 1.55 ms', '+1.00 ms (+182 %)'],
                         'the comparison knows whole chains only')
        self.assertEqual([chain[0].split('\n')[0], *chain[1:4]], ['reaction: /sensor (timer 10 ms) -> /filter (/scan) -> /display (/points)', 'slower', '850 µs → 1.85 ms', '+1.00 ms (+118 %)'])
        self.assertIn('through /filter, subscription /scan', chain[0])
        self.choose('What', 'call')
        self.assertIn('Neither run has any.', self.text(self.TABLE))

    def test_the_verdicts_are_those_of_the_comparison(self):
        self.assertEqual(self.browser.evaluate('''(() => {
          const change = {kind: "callback", subject: "/a", quantity: "duration", statistic: "median", before_ns: 1, after_ns: 2, shift_ns: -1, changed_steps: [], cause: ""};
          const comparison = {changes: [], likely: [], gone: [], new: [], ...{likely: [change]}};
          const many = {times: {count: 100}};
          comparison.names = [{chains: ["/c -> /d"]}, {chains: ["/c -> /d", "/e -> /f"]}];
          const of = (subject, sides, kind = "callback") => verdictOf(comparison, {kind, subject, sides}).word;
          return [of("/c -> /d", [many, many], "chain"), of("/e -> /f", [many, many], "chain"), of("/a", [many, many]), of("/b", [many, many]), of("/b", [null, many]), of("/b", [many, null]), of("/b", [many, {times: {count: 15}}])];
        })()'''), ['no change holds', 'not compared', 'likely faster', 'no change holds', 'only after', 'only before', 'too few to tell'])

    def test_both_charts_move_together(self):
        for key, moved in (('+', 'end'), ('d', 'begin')):
            before = self.views()
            self.browser.key(key)
            self.browser.wait_for(f'{self.PAIR}.charts[0].view.{moved} !== {before[0][moved]}')
            views = self.views()
            self.assertEqual(views[0]['begin'], views[1]['begin'])
            self.assertEqual(views[0]['end'], views[1]['end'])
        x, y = self.browser.evaluate('(() => { const canvas = document.querySelectorAll(".time canvas")[1]; canvas.scrollIntoView(); const box = canvas.getBoundingClientRect(); return [box.x + 700, box.y + 80]; })()')
        before = self.views()
        self.browser.call('Input.dispatchMouseEvent', type='mouseWheel', x=x, y=y, deltaX=0, deltaY=-400, modifiers=2)
        self.browser.wait_for(f'{self.PAIR}.charts[0].view.begin > {before[0]["begin"]}')
        views = self.views()
        self.assertAlmostEqual(views[0]['begin'], views[1]['begin'], delta=1)

    def test_a_row_shows_its_runs_below_one_another(self):
        self.browser.click(f'{self.TABLE} tbody td')
        chosen = self.browser.evaluate('compareOptions.chosen')
        starts = [self.browser.evaluate(f'page.runs[{side}].instances.start[{chosen[side]}]') for side in (0, 1)]
        xs = self.browser.evaluate(f'{self.PAIR}.charts.map((chart, side) => timeX(chart, [{starts[0]}, {starts[1]}][side]))')
        self.assertAlmostEqual(xs[0], xs[1], delta=0.5)
        self.assertEqual(self.browser.evaluate(f'page.runs.map((data, side) => data.instances.end[{chosen}[side]] - data.instances.start[{chosen}[side]])'), [4e6, 4e6], 'p99')
        self.assertEqual(self.texts('.two h2'), ['before: way of the message', 'after: way of the message'])
        self.browser.wait_for('document.querySelector(".u-wrap canvas")')
        self.browser.click(f'{self.TABLE} tbody td')
        self.assertEqual(self.browser.evaluate('document.querySelectorAll(".u-wrap").length'), 0)

    def test_a_callback_has_the_same_colour_in_both(self):
        self.assertEqual(self.browser.evaluate('''page.runs[0].callbacks.every((callback, id) =>
          callback.color === page.runs[1].callbacks[page.runs[1].names.callbacks.indexOf(page.runs[0].names.callbacks[id])].color)'''), True)

    def test_the_other_views_show_either_run(self):
        self.show('callbacks')
        self.assertIn('260', self.texts('tbody td:nth-child(3)'))
        self.browser.evaluate('select({node: page.data.nodes.findIndex(({name}) => name === "/filter")})')
        self.choose('Run', 'before')
        self.assertEqual(self.texts('tbody td:nth-child(3)'), ['300'])
        self.assertEqual(self.chips(), ['node /filter ✕'])
        self.assertEqual(self.hash(), '#callbacks&run=before&node=/filter')
        self.browser.evaluate('history.back()')
        self.browser.wait_for('document.querySelector("tbody td:nth-child(3)").innerText === "260"')
        self.assertEqual(self.browser.evaluate('document.querySelector("[aria-label=Run]").value'), 'after')
        self.browser.key('c')
        self.browser.wait_for('page.shown === "compare"')

    def test_every_view_shows_something(self):
        for view in page_case.VIEWS:
            with self.subTest(view):
                self.show(view)
                self.assertGreater(len(self.text('#view')), 60)


class DarkNarrowComparison(TwoRuns):
    DARK = True
    SIZE = (390, 800)

    def test_nothing_is_wider_than_the_page(self):
        self.browser.click(f'{self.TABLE} tbody td')
        self.assert_fits()
        self.assertEqual(self.browser.evaluate('getComputedStyle(document.querySelector(".side .swatch")).backgroundColor'), 'rgb(110, 168, 254)')


if __name__ == '__main__':
    unittest.main()
