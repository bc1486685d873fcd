# SPDX-License-Identifier: Apache-2.0
"""
The graph of the page of `launch report --html` in a browser: boxes and edges, zoom, choice.
"""

import unittest

import page_case

# How far the box or text that sticks out most is out of the picture.
OUT_OF_SIGHT = '''(() => {
  const outer = document.querySelector(".graph svg").getBoundingClientRect();
  return Math.max(...[...document.querySelectorAll(".graph .box, .graph .box text, .graph .line")].map(found => found.getBoundingClientRect()).map(
    box => Math.max(outer.left - box.left, box.right - outer.right, outer.top - box.top, box.bottom - outer.bottom)));
})()'''

# A system of many nodes with long names; each publishes a topic that the next two take.
MANY_NODES = '''(() => {
  const {data} = page;
  const long = "/a_robot_with_a_name/of_its_own/and_components/camera_front_left_rectified_";
  const count = 100;
  data.nodes = Array.from({length: count}, (_, i) => ({process: 1, name: long + i}));
  data.topics = Array.from({length: count}, (_, i) => `${long}image_${i}/with_compression`);
  data.publishers = data.topics.map((_, i) => ({node: i, topic: i}));
  data.subscriptions = data.topics.flatMap((_, i) => [{node: (i + 1) % count, topic: i}, {node: (i * 7 + 3) % count, topic: i}]);
  data.computed = undefined;
  drawView("graph");
})()'''


class GraphTest(page_case.PageTest):

    def show_graph(self):
        """A new picture is fitted before it is painted."""
        self.show('graph')
        self.browser.wait_for('document.querySelector(".graph svg > g").hasAttribute("transform")')


class Graph(GraphTest):

    def scale(self):
        return self.browser.evaluate('document.querySelector(".graph svg > g").getCTM().a')

    def test_it_has_a_box_for_each_node_and_topic_with_rate_and_latency(self):
        self.show_graph()
        labels = self.browser.evaluate('[...document.querySelectorAll(".box")].map(box => box.getAttribute("aria-label")).sort()')
        self.assertEqual([label.split(' ')[:2] for label in labels],
                         [['node', '/display'], ['node', '/filter'], ['node', '/sensor'], ['topic', '/points'], ['topic', '/scan']])
        self.assertRegex(labels[4], r'topic /scan \d+\.\d Hz · p99 200 µs')
        self.assertEqual(self.browser.evaluate('document.querySelectorAll(".graph .edge").length'), 4)
        xs = self.browser.evaluate('Object.fromEntries([...document.querySelectorAll(".box")].map(box => [box.dataset.box, box.getBoundingClientRect().x]))')
        order = ['node /sensor', 'topic /scan', 'node /filter', 'topic /points', 'node /display']
        self.assertEqual(sorted(xs, key=xs.get), order)

    def test_a_click_filters_all_views_and_the_chip_takes_it_back(self):
        self.show_graph()
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
        self.show_graph()
        self.browser.evaluate('document.querySelector(\'[data-box="topic /scan"]\').focus()')
        self.browser.key('Enter')
        self.assertEqual(self.text('[data-chip=topic]'), 'topic /scan ✕')
        self.assertEqual(self.browser.evaluate('document.activeElement.dataset.box'), 'topic /scan', 'it keeps the focus')

    def test_all_of_it_is_in_sight(self):
        self.show_graph()
        self.browser.wait_for(f'{OUT_OF_SIGHT} <= 0')

    def test_a_hundred_nodes_with_long_names_are_in_sight_and_none_is_cut(self):
        self.browser.evaluate(MANY_NODES)
        self.assertEqual(self.browser.evaluate('document.querySelectorAll(".box").length'), 200)
        self.browser.wait_for(f'{OUT_OF_SIGHT} <= 0')
        self.assertTrue(self.browser.evaluate('''[...document.querySelectorAll(".box")].every(box => {
          const name = [...box.querySelectorAll("text:not(.rate)")].map(line => line.textContent).join("");
          const outer = box.querySelector("rect").getBoundingClientRect();
          const inside = [...box.querySelectorAll("text")].map(text => text.getBoundingClientRect()).every(
            text => text.left >= outer.left && text.right <= outer.right && text.top >= outer.top - 1 && text.bottom <= outer.bottom + 1);
          return inside && box.dataset.box.endsWith(" " + name);
        })'''), 'the whole name stands in the box')
        self.assert_fits()

    def test_the_wheel_zooms_at_the_pointer(self):
        self.show_graph()
        box = '[data-box="node /filter"]'
        place = f'(() => {{ const box = document.querySelector(\'{box}\').getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; }})()'
        x, y = self.browser.evaluate(place)
        before = self.scale()
        self.browser.call('Input.dispatchMouseEvent', type='mouseWheel', x=x, y=y, deltaX=0, deltaY=-400)
        self.browser.wait_for(f'document.querySelector(".graph svg > g").getCTM().a > {1.5 * before}')
        after = self.browser.evaluate(place)
        self.assertLess(abs(after[0] - x) + abs(after[1] - y), 2, 'what is below the pointer stays there')
        self.browser.click('[aria-label="Show all of it"]')
        self.browser.wait_for(f'Math.abs(document.querySelector(".graph svg > g").getCTM().a - {before}) < 0.01')

    def test_dragging_moves_and_chooses_nothing(self):
        self.show_graph()
        place = '(() => { const box = document.querySelector(\'[data-box="node /filter"]\').getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; })()'
        x, y = self.browser.evaluate(place)
        for kind, at in (('mousePressed', x), ('mouseMoved', x + 30), ('mouseMoved', x + 80), ('mouseReleased', x + 80)):
            self.browser.call('Input.dispatchMouseEvent', type=kind, x=at, y=y, button='left', clickCount=1, buttons=0 if kind == 'mouseReleased' else 1)
        moved = self.browser.evaluate(place)
        self.assertAlmostEqual(moved[0], x + 80, delta=5)
        self.assertEqual(self.chips(), [])
        self.browser.click_at(*moved)
        self.assertEqual(self.chips(), ['node /filter ✕'], 'a click after it chooses')
        self.assertAlmostEqual(self.browser.evaluate(place)[0], moved[0], delta=1, msg='it stays where it is')

    def test_keys_zoom_move_and_fit_at_once(self):
        self.show_graph()
        whole = self.scale()
        self.browser.key('+')
        self.browser.wait_for(f'document.querySelector(".graph svg > g").getCTM().a > {1.3 * whole}')
        x = self.browser.evaluate('document.querySelector(".graph svg > g").getCTM().e')
        self.browser.key('ArrowRight')
        self.browser.wait_for(f'document.querySelector(".graph svg > g").getCTM().e < {x} - 50')
        self.browser.key('0')
        self.browser.wait_for(f'document.querySelector(".graph svg > g").getCTM().a === {whole}')

    def test_the_zoom_stays_when_the_view_changes(self):
        self.show_graph()
        self.browser.key('+')
        scale = self.scale()
        self.show('topics')
        self.show_graph()
        self.assertEqual(self.scale(), scale)


class NarrowGraph(GraphTest):
    SIZE = (390, 800)

    def test_all_of_it_is_in_sight(self):
        self.show_graph()
        self.browser.wait_for(f'{OUT_OF_SIGHT} <= 0')
        self.assert_fits()
        self.browser.evaluate(MANY_NODES)
        self.browser.wait_for(f'{OUT_OF_SIGHT} <= 0')


if __name__ == '__main__':
    unittest.main()
