# SPDX-License-Identifier: Apache-2.0
"""The page of `launch serve` in a headless browser, with a real launch."""

import json
import unittest

from browser import Browser, chromium
from own_launches import PATIENCE, TALKER
from served import TOKEN, Served

# What a program prints is text, whatever it looks like.
HOSTILE = r'''
echo '<img src=x onerror="document.title = 1">'
printf '\033[31mred\033[0m\n'
sleep 1000
'''


class Page(Served):
    SIZE = (1280, 900)

    def setUp(self):
        super().setUp()
        if not chromium():
            self.skipTest('skipped, because there is no browser: the package chromium is not installed')
        self.browser = self.enterContext(Browser())
        self.browser.set_size(*self.SIZE)

    def tearDown(self):
        # The browser's own notes of answers that are errors are expected: the first page is asked for without a token.
        problems = [text for text in self.browser.problems if 'Failed to load resource' not in text]
        self.assertEqual(problems, [])
        self.assertEqual([url for url in self.browser.requests if not url.startswith((self.url, 'data:', 'blob:'))], [])

    def log_in(self):
        self.browser.open_address(self.url)
        self.browser.wait_for('document.activeElement.id === "token"')
        for letter in TOKEN:
            self.browser.key(letter)
        self.browser.key('Enter')
        self.browser.wait_for('document.getElementById("launch") && document.body.dataset.ready === "yes"')

    def show(self, launch):
        """Logs in and chooses the launch, beside which there may be those of other tests."""
        self.log_in()
        self.choose(launch)

    def choose(self, launch):
        self.browser.wait_for(f'page.launches.some(one => one.pid === {launch.pid})')
        self.browser.evaluate(f'''(() => {{
          const list = document.getElementById("launch");
          if (page.pid !== {launch.pid}) {{
            list.value = "{launch.pid}";
            list.dispatchEvent(new Event("change"));
          }}
        }})()''')
        self.browser.wait_for(f'page.pid === {launch.pid} && table.rows.size > 0')

    def text(self, selector):
        return self.browser.evaluate(f'document.querySelector({json.dumps(selector)}).textContent')

    def cell(self, process, kind):
        return f'tr[data-process={process}] .{kind}'

    def wait_for_text(self, selector, text):
        self.browser.wait_for(f'document.querySelector({json.dumps(selector)})?.textContent.includes({json.dumps(text)})')

    def press(self, process, verb, confirm=True):
        self.browser.wait_for(f'!document.querySelector("tr[data-process={process}] [data-verb={verb}]").disabled')
        self.browser.click(f'tr[data-process={process}] [data-verb={verb}]')
        if confirm:
            self.browser.wait_for('document.getElementById("question").open')
            self.browser.click('#question-yes')

    def test_buttons_steer_the_launch(self):
        launch = self.start_launch()
        self.serve('--allow-control')
        self.show(launch)
        sleeper = self.pid_of(launch, 'sleeper-2')
        self.assertEqual(self.text(self.cell('sleeper-2', 'pid')), str(sleeper))
        self.assertEqual(self.text(self.cell('sleeper-2', 'state')), 'running')

        self.press('sleeper-2', 'restart')
        self.browser.wait_for(f'!["{sleeper}", "-"].includes(document.querySelector("{self.cell("sleeper-2", "pid")}").textContent)')
        restarted = self.pid_of(launch, 'sleeper-2')
        self.assertNotEqual(restarted, sleeper)
        self.assertEqual(self.text(self.cell('sleeper-2', 'pid')), str(restarted))
        self.wait_for_text('#events', f'sleeper-2 has started, PID {restarted}')

        self.press('sleeper-2', 'stop')
        self.wait_for_text(self.cell('sleeper-2', 'state'), 'ended: SIGINT')
        self.assertIsNone(self.pid_of(launch, 'sleeper-2'))
        self.press('sleeper-2', 'start', confirm=False)
        self.wait_for_text(self.cell('sleeper-2', 'state'), 'running')
        self.assertEqual(self.text(self.cell('sleeper-2', 'pid')), str(self.pid_of(launch, 'sleeper-2')))

        self.browser.click('#shutdown')
        self.browser.wait_for('document.getElementById("question").open')
        self.browser.click('#question button[value=no]')
        self.browser.wait_for('!document.getElementById("question").open')
        self.assertIsNone(launch.poll())
        self.browser.click('#shutdown')
        self.browser.wait_for('document.getElementById("question").open')
        self.browser.click('#question-yes')
        launch.wait(PATIENCE)
        self.wait_for_text('#notice', 'The launch of system.launch.xml has ended.')

    def test_nodes_are_shown_on_demand(self):
        launch = self.start_launch()
        self.serve('--nodes')
        self.show(launch)
        self.browser.wait_for('!document.getElementById("nodes-panel").hidden')
        self.assertTrue(self.browser.evaluate('document.getElementById("nodes").hidden'))
        self.assertFalse(self.browser.evaluate('document.getElementById("nodes-shown").checked'))

    def test_nodes_are_not_shown_unless_that_is_allowed(self):
        launch = self.start_launch()
        self.serve()
        self.show(launch)
        self.assertTrue(self.browser.evaluate('document.getElementById("nodes-panel").hidden'))

    def test_the_page_goes_on_when_the_launch_is_started_again(self):
        launch = self.start_launch()
        self.serve('--allow-control')
        self.show(launch)
        self.browser.click('tr[data-process=talker-1] .name button')
        self.wait_for_text('#log', 'ready')
        self.end(launch)
        self.wait_for_text('#notice', 'The launch of system.launch.xml has ended. This page goes on when it is started again.')
        self.assertTrue(self.browser.evaluate('document.getElementById("shutdown").hidden'))
        again = self.start_launch()
        self.browser.wait_for(f'page.pid === {again.pid} && document.getElementById("notice").hidden')
        self.wait_for_text(self.cell('talker-1', 'pid'), str(self.pid_of(again, 'talker-1')))
        self.wait_for_text('#log', 'ready')
        self.launch('signal', 'talker', 'USR1', '--launch', again.pid)
        self.wait_for_text('#log', 'got USR1')

    def test_a_service_that_is_started_again_is_found(self):
        launch = self.start_launch()
        service = self.serve()
        self.show(launch)
        self.end(service)
        self.wait_for_text('#link', 'no connection')
        self.serve(listen=f'127.0.0.1:{self.port}')
        # Sessions end with the service.
        self.browser.wait_for('document.getElementById("token")')

    def test_output_is_text(self):
        (self.folder / 'hostile.sh').write_text(HOSTILE)
        launch = self.start_launch(TALKER + '<executable name="hostile" cmd="sh hostile.sh" output="both"/>')
        launch.lines.wait_for('red')
        self.serve()
        self.show(launch)
        self.browser.click('tr[data-process=hostile-2] .name button')
        self.wait_for_text('#log', 'red')
        self.assertEqual(self.browser.evaluate('[...document.querySelectorAll("#log div")].map(line => line.textContent)'),
                         ['<img src=x onerror="document.title = 1">', 'red'])
        self.assertEqual(self.browser.evaluate('document.querySelectorAll("#log img").length'), 0)
        self.browser.evaluate('''(() => {
          const search = document.getElementById("log-search");
          search.value = "RED";
          search.dispatchEvent(new Event("input"));
        })()''')
        self.assertEqual(self.browser.evaluate('[...document.querySelectorAll("#log div:not([hidden])")].map(line => line.textContent)'), ['red'])

    def test_who_may_only_look_has_no_buttons(self):
        launch = self.start_launch()
        self.serve()
        self.show(launch)
        self.browser.wait_for('!document.getElementById("rights").hidden')
        self.assertEqual(self.browser.evaluate('[...document.querySelectorAll("[data-verb], #shutdown")].filter(one => one.checkVisibility()).length'), 0)

    def test_a_keyboard_is_enough(self):
        launch = self.start_launch()
        self.serve('--allow-control')
        self.show(launch)
        before = self.pid_of(launch, 'talker-1')
        for wanted in ('.name button', '[data-verb=restart]'):
            # The start is disabled while it runs, so Tab passes it over.
            for _ in range(30):
                self.browser.key('Tab')
                if self.browser.evaluate(f'document.activeElement.matches("tr[data-process=talker-1] {wanted}")'):
                    break
            self.assertTrue(self.browser.evaluate(f'document.activeElement.matches("tr[data-process=talker-1] {wanted}")'), wanted)
            self.browser.key('Enter')
        self.wait_for_text('#log', 'ready')
        self.browser.wait_for('document.getElementById("question").open')
        self.assertEqual(self.browser.evaluate('document.activeElement.value'), 'no', 'what is dangerous is not the first choice')
        self.browser.key('Tab')
        self.browser.key('Enter')
        self.browser.wait_for(f'!["{before}", "-"].includes(document.querySelector("{self.cell("talker-1", "pid")}").textContent)')
        self.assertNotEqual(self.pid_of(launch, 'talker-1'), before)

    def test_a_wrong_token_is_told(self):
        self.serve()
        self.browser.open_address(self.url)
        self.browser.wait_for('document.activeElement.id === "token"')
        for letter in 'wrong':
            self.browser.key(letter)
        self.browser.key('Enter')
        self.wait_for_text('.wrong', 'This is not the token.')

    def test_one_of_several_launches_is_chosen(self):
        first = self.start_launch()
        second = self.start_launch(TALKER, name='other.launch.xml')
        self.serve()
        self.log_in()
        self.choose(first)
        self.assertEqual(self.text('#files'), 'system.launch.xml')
        self.choose(second)
        self.wait_for_text('#files', 'other.launch.xml')
        self.assertEqual(self.browser.evaluate('[...table.rows.keys()]'), ['talker-1'])

    def test_logging_out_ends_the_session(self):
        launch = self.start_launch()
        self.serve()
        self.show(launch)
        self.browser.click('header form button')
        self.browser.wait_for('document.getElementById("token")')
        self.browser.open_address(self.url)
        self.browser.wait_for('document.getElementById("token")')


class PageOnPhone(Page):
    SIZE = (400, 800)

    def tearDown(self):
        # Nothing is wider than the phone.
        self.assertLessEqual(self.browser.evaluate('document.documentElement.scrollWidth'), 400)
        super().tearDown()


if __name__ == '__main__':
    unittest.main()
