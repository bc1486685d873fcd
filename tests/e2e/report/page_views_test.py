# SPDX-License-Identifier: Apache-2.0
"""
The page of `launch report --html` in a browser: every view draws something, clicks and keys do what they say.
"""

import unittest

import page_case


class Views(page_case.PageTest):

    def test_every_view_shows_something(self):
        for view in page_case.VIEWS:
            with self.subTest(view):
                self.show(view)
                self.assertGreater(len(self.text('#view')), 60)
                self.assertEqual(self.browser.evaluate('document.querySelector("[aria-selected=true]").dataset.view'), view)

    def test_overview_has_the_figures_and_what_is_worth_looking_at(self):
        tiles = self.texts('.tile')
        self.assertIn('298\ncallbacks run', tiles)
        self.assertIn('200\nmessages published', tiles)
        self.assertIn('3\nnodes', tiles)
        self.assertIn('none\nevents lost', tiles)
        found = [text.split('\n') for text in self.texts('.findings button')]
        findings = self.browser.evaluate('page.data.findings')
        self.assertEqual(found, [[finding[key] for key in ('title', 'subject', 'figures')] for finding in findings])
        self.assertEqual(self.texts('.findings .next'), [f'next: {finding["next"]}' for finding in findings if finding['next']])
        self.assertIn('Worst jitter', [title for title, _, _ in found])

    def test_a_view_with_the_focus_has_no_frame(self):
        self.show('graph')
        self.browser.key('Tab')
        self.browser.evaluate('document.getElementById("view").focus()')
        self.assertEqual(self.browser.evaluate('getComputedStyle(document.getElementById("view")).outlineStyle'), 'none')

    def test_a_finding_opens_its_view(self):
        at = [text.split('\n')[0] for text in self.texts('.findings button')].index('Worst jitter')
        self.browser.click(f'.findings li:nth-child({at + 1}) button')
        self.browser.wait_for('page.shown === "callbacks"')
        self.assertEqual(self.text('tr.active td:first-child'), '/sensor')

    def test_number_keys_open_views(self):
        for number, view in enumerate(page_case.VIEWS, 1):
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

    # Of the example: the filter's callback takes 400 us, 4 ms in every twentieth cycle.
    def test_chains_have_their_hops_at_any_percentile(self):
        self.show('chains')
        heads = self.texts('.chain .head')
        self.assertEqual(heads[0], '/sensor → /display\n3 callbacks, 98 runs\nresponse p50 850 µs, p90 850 µs, p99 4.45 ms, max 4.45 ms, mean 997 µs\n'
                         'longest run\nrun at p50\nrun at p90\nrun at p99')
        hops = ['100 µs', '(148|150) µs', '2.00 µs', '50.0 µs', '', '(148|150) µs', '2.00 µs', '50.0 µs', '50.0 µs']
        for statistic, filtered in (('p50', '300 µs'), ('p99', '3.90 ms'), ('max', '3.90 ms'), ('mean', '447 µs')):
            with self.subTest(statistic):
                self.choose('Bars show', statistic)
                label = self.browser.evaluate('document.querySelector(".hops").getAttribute("aria-label")')
                self.assertRegex(label, '^' + '; '.join(f'[^;]+ {hop or filtered}' for hop in hops) + '$')
        self.assertEqual(self.browser.evaluate('document.querySelector(".hops").children.length'), 9)
        self.assertTrue(self.browser.evaluate(
            '[...document.querySelectorAll(".hops")].every(bar => bar.clientWidth <= bar.parentElement.clientWidth)'))

    def test_each_part_of_a_chain_has_its_percentiles(self):
        self.show('chains')
        self.browser.click('.chain summary')
        self.browser.wait_for('document.querySelector(".chain details").open')
        rows = [row.split('\t') for row in self.texts('.chain:first-child .parts tbody tr')]
        self.assertEqual(len(rows), 10)
        self.assertEqual(rows[4], ['/filter · /scan', '300 µs', '300 µs', '3.90 ms', '3.90 ms', '447 µs'])
        self.assertEqual(rows[9], ['response', '850 µs', '850 µs', '4.45 ms', '4.45 ms', '997 µs'])

    def test_the_run_of_a_chain_at_a_percentile_is_shown_in_the_time_chart(self):
        self.show('chains')
        self.browser.click('.chain .head button:nth-of-type(2)')
        self.browser.wait_for('page.shown === "time" && selection.instance !== null')
        self.assertIn('850 µs from', self.text('.flow'))

    def test_the_longest_run_of_a_chain_is_shown_in_the_time_chart(self):
        self.show('chains')
        self.browser.click('.chain .head button')
        self.browser.wait_for('page.shown === "time" && selection.instance !== null')
        self.assertIn('/display · /points', self.text('.details'))
        shown = self.browser.evaluate('timeChartOptions.view.end - timeChartOptions.view.begin')
        self.assertTrue(4.45e6 < shown < 5e6, shown)  # the whole run of 4.45 ms


class Tables(page_case.PageTest):

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


class WithVerdict(page_case.PageTest):
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
class FurtherResults(page_case.PageTest):
    TIMES = '{count: 4, mean: 1e6, p50: 1e6, p99: 2e6, max: 3e6}'

    def draw(self, view, facts):
        self.browser.evaluate(f'Object.assign(page.data, {facts}); drawView("{view}")')

    def test_services_and_actions_have_their_times(self):
        self.draw('services', f"""{{
          calls: [{{service: "/add", client: "/sensor", server: "", requests: 5, responses: 3, in_flight: 1, round_trip: {self.TIMES}, request: null, in_service: {self.TIMES}, response: null}}],
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

    def test_processes_of_the_kernel_alone_are_told_by_name(self):
        facts = '{folded: [{name: "", host: "", count: 6911, events: 20000}, {name: "kworker/0:1", host: "", count: 1, events: 7}]}'
        self.draw('overview', facts)
        self.assertIn("3\nprocesses, 6,912 more of the kernel's events", self.texts('.tile'))
        self.draw('processes', facts)
        self.assertIn("6,912 processes more of the kernel's events", self.texts('h2'))
        self.assertEqual(self.texts('section:nth-of-type(2) tbody tr'), ['without a name\t6,911\t20,000', 'kworker/0:1\t1\t7'])

    def test_what_the_launcher_did_is_a_list_and_lines_in_the_time_chart(self):
        facts = """{launcher_events: [
          {time: 0.3e9, kind: "condition", subject: "on_rate of topic /scan", sentence: "/scan has 3 messages/s", file: "a.launch.xml", line: 4, ordinary: false},
          {time: 0.5e9, kind: "scheduling", subject: "planner-1", sentence: "its threads get processors by nice 5", file: "a.launch.xml", line: 5, ordinary: false},
          {time: 0.9e9, kind: "signal", subject: "planner-1", sentence: "was sent SIGINT", file: "", line: 0, ordinary: true}]}"""
        self.draw('overview', facts)
        self.assertEqual([row for row in self.texts('tbody tr') if 'a.launch.xml' in row],
                         ['0.300000 s\ton_rate of topic /scan\t/scan has 3 messages/s\ta.launch.xml:4',
                          '0.500000 s\tplanner-1\tits threads get processors by nice 5\ta.launch.xml:5'])
        self.draw('time', facts)
        self.wait_for_canvas('.time canvas')
        chart = 'document.querySelector("#view .panel").chart'
        self.assertEqual(self.browser.evaluate(f'launcherEventText(launcherEventAt({chart}, timeX({chart}, 0.3e9) + 2, 100))'), 'on_rate of topic /scan: /scan has 3 messages/s')
        self.assertTrue(self.browser.evaluate(f'launcherEventAt({chart}, timeX({chart}, 0.9e9), 100) === undefined'))
        red = f"""(() => {{
          const canvas = document.querySelector(".time canvas");
          const {{data}} = canvas.getContext("2d").getImageData(0, 100, canvas.width, 1);
          const at = x => [...data.slice(4 * Math.round(x), 4 * Math.round(x) + 3)].join();
          return at(timeX({chart}, 0.3e9) * devicePixelRatio) !== at(5);
        }})()"""
        self.assertTrue(self.browser.evaluate(red))

    def test_the_start_has_phases_and_a_critical_path(self):
        self.draw('processes', """{
          startup: {duration: 50e6, path: [{process: "", what: "load a.launch.xml", begin: 0, end: 10e6}, {process: "sensor-1", what: "until rcl_init", begin: 10e6, end: 50e6}]},
          starts: [{...page.data.starts[0], spawn: page.data.starts[0].exec - 1e6, init_after: 2e6, node_after: 3e6, ready_after: 8e6, callback_after: 5e6, publication_after: null}]}""")
        self.assertIn('Critical path of the start, 50.0 ms', self.texts('h2'))
        self.assertEqual(self.texts('.path > div'), ['launcher: load a.launch.xml 10.0 ms', '', 'sensor-1: until rcl_init 40.0 ms', ''])
        self.assertEqual(self.browser.evaluate('[...document.querySelectorAll(".bars:not(.path) .track div")].map(part => part.title)'),
                         ['until exec\n1.00 ms', 'until rcl_init\n2.00 ms', 'until its node\n1.00 ms', 'until its first callback\n2.00 ms', 'until ready\n3.00 ms'])


class DarkPage(page_case.PageTest):
    DARK = True

    def test_it_is_dark(self):
        self.assertEqual(self.browser.evaluate('getComputedStyle(document.body).backgroundColor'), 'rgb(18, 22, 29)')
        for view in page_case.VIEWS:
            self.show(view)
        self.show('time')
        self.wait_for_canvas('.time canvas')
        corner = 'document.querySelector(".time canvas").getContext("2d").getImageData(1, 60, 1, 1).data[0]'
        self.assertLess(self.browser.evaluate(corner), 80)


# 560,000 events; the time chart draws what falls into one pixel as one.
class LargePage(page_case.PageTest):
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
class PartOfAPage(page_case.PageTest):
    OPTIONS = ('--from', '+0.52', '--to', '+0.62')

    def test_it_says_which_part_it_holds(self):
        self.assertIn('This page holds 100 ms of 1.02 s, from 0.520000 s on.', self.text('#view .panel'))
        self.assertIn('30\ncallbacks run', self.texts('.tile'))
        self.show('time')
        self.wait_for_canvas('.time canvas')


# Recorded without timestamps of publications.
class OlderRecording(page_case.PageTest):
    EVENTS = ('older',)

    def test_it_marks_estimates(self):
        self.assertIn('The trace has no timestamps of publications', self.text('#view .facts'))
        self.show('topics')
        rows = {row.split('\t')[0]: row for row in self.texts('tbody tr')}
        self.assertEqual(rows['/points ~'].split('\t')[1:6], ['1', '1', '100', '98', '2'])
        self.assertEqual(rows['/scan ~'].split('\t')[7:], ['200 µs'] * 5)
        self.assertIn('~: an estimate.', self.text('#view .note'))
        self.show('chains')
        self.assertIn('(an estimate)', self.text('#view'))


# Nor with source timestamps of what was taken.
class UnknownMessages(page_case.PageTest):
    EVENTS = ('older', 'without_source_timestamps')

    def test_it_says_of_none_that_it_was_not_taken(self):
        self.show('topics')
        rows = {row.split('\t')[0]: row for row in self.texts('tbody tr')}
        self.assertEqual(rows['/scan ~'].split('\t')[1:6], ['1', '1', '100', '0', '0'])


if __name__ == '__main__':
    unittest.main()
