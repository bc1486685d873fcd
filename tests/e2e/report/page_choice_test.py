# SPDX-License-Identifier: Apache-2.0
"""
What the reader has chosen, in the page of `launch report --html` in a browser: every view shows it and takes it back, the
address keeps it.
"""

import unittest

import page_case


class Choice(page_case.PageTest):

    def test_every_view_shows_what_a_click_has_chosen_and_takes_it_back(self):
        for view in page_case.VIEWS:
            with self.subTest(view):
                self.show('graph')
                self.browser.click('[data-box="node /filter"]')
                self.show('callbacks')
                self.browser.click('tbody tr')
                self.show(view)
                self.assertEqual(self.chips(), ['node /filter ✕', 'callback /filter · /scan ✕', 'all ✕'])
                self.assertTrue(self.browser.evaluate('''[...document.querySelectorAll(".chip")].every(chip => {
                  const box = chip.getBoundingClientRect();
                  return document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2) === chip;
                })'''), 'they are in sight')
                self.browser.click('[data-chip=callback]')
                self.assertEqual(self.chips(), ['node /filter ✕'])
                self.browser.click('[data-chip=node]')
                self.assertEqual(self.chips(), [])

    def test_escape_takes_back_everything_in_every_view(self):
        for view in page_case.VIEWS:
            with self.subTest(view):
                self.browser.evaluate('select({node: 1, topic: 0, callback: 1, instance: null})')
                self.show(view)
                self.browser.key('Escape')
                self.browser.wait_for('document.querySelector("#selection").textContent === ""')

    def test_in_the_time_chart_escape_takes_back_the_callback_first(self):
        self.browser.evaluate('select({node: 1})')
        self.browser.evaluate('showInTime(page.data, 1)')
        self.assertEqual(self.chips()[:2], ['node /filter ✕', f'run at {self.browser.evaluate("formatTime(page.data.instances.start[1])")} ✕'])
        self.browser.key('Escape')
        self.assertEqual(self.chips(), ['node /filter ✕'])
        self.browser.key('Escape')
        self.assertEqual(self.chips(), [])

    def test_a_view_says_when_it_does_not_depend_on_it(self):
        self.browser.evaluate('select({topic: 0})')
        for view, idle in (('overview', 1), ('time', 0), ('topics', 0), ('lifecycle', 1)):
            self.show(view)
            self.assertEqual(self.browser.evaluate('document.querySelectorAll(".chip.idle").length'), idle, view)

    def test_chains_show_only_those_of_the_chosen_callback(self):
        self.browser.evaluate('select({callback: 2})')
        self.show('chains')
        self.assertEqual(len(self.texts('.chain')), 1)
        self.browser.evaluate('page.data.chains = page.data.chains.map(chain => ({...chain, steps: chain.steps.slice(0, 2)})); drawView("chains")')
        self.assertEqual(self.texts('.chain'), [])
        self.assertIn('No chain goes through what is chosen.', self.text('#view'))


class Address(page_case.PageTest):

    def test_it_keeps_the_view_the_choice_and_the_time(self):
        self.show('graph')
        self.browser.click('[data-box="topic /scan"]')
        self.assertEqual(self.hash(), '#graph&topic=/scan')
        self.browser.evaluate('showInTime(page.data, 1)')
        self.browser.wait_for('location.hash.includes("from=")')
        address = self.hash()
        self.assertRegex(address, r'^#time&topic=/scan&at=1&from=0\.0\d+&to=0\.0\d+$')
        view = self.browser.evaluate('({...timeChartOptions.view})')
        self.browser.call('Page.navigate', url='about:blank')
        self.browser.open(f'{self.page}{address}')
        self.assertEqual(self.chips(), ['topic /scan ✕', f'run at {self.browser.evaluate("formatTime(page.data.instances.start[1])")} ✕', 'all ✕'])
        self.assertEqual(self.browser.evaluate('page.shown'), 'time')
        self.wait_for_canvas('.time canvas')
        again = self.browser.evaluate('({...timeChartOptions.view})')
        self.assertAlmostEqual(again['begin'], view['begin'], delta=1)
        self.assertAlmostEqual(again['end'], view['end'], delta=1)

    def test_back_goes_back(self):
        self.show('graph')
        self.browser.click('[data-box="node /filter"]')
        self.show('callbacks')
        self.browser.evaluate('history.back()')
        self.browser.wait_for('page.shown === "graph"')
        self.assertEqual(self.chips(), ['node /filter ✕'])
        self.browser.evaluate('history.back()')
        self.browser.wait_for('selection.node === null')
        self.assertEqual(self.chips(), [])
        self.assertEqual(self.browser.evaluate('page.shown'), 'graph')

    def test_what_the_page_does_not_have_is_left_out(self):
        self.browser.evaluate('location.hash = "#callbacks&node=/nobody&topic=%E0%A4%A&at=-1&from=x&callback=/filter · /scan"')
        self.browser.wait_for('page.shown === "callbacks"')
        self.assertEqual(self.chips(), ['callback /filter · /scan ✕'])


class NarrowPage(page_case.PageTest):
    SIZE = (390, 800)

    def test_no_view_is_wider_than_the_page(self):
        self.browser.evaluate('select({node: 1, topic: 0, callback: 1, instance: 1})')
        for view in page_case.VIEWS:
            with self.subTest(view):
                self.show(view)
                self.assert_fits()


if __name__ == '__main__':
    unittest.main()
