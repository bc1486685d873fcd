# SPDX-License-Identifier: Apache-2.0
"""
A test case for the page of `launch report --html` in a browser. After each test the console has no error, and nothing
but files was asked for. The trace is the example system of tests/support/trace_writer/example_system.hpp.
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


def write_trace(trace, cycles, events=()):
    subprocess.run([os.environ['WRITE_EXAMPLE_TRACE'], trace / 'ust', str(cycles), *events], check=True)
    return trace


def write_page(folder, cycles, options, events, verdict):
    trace = write_trace(Path(folder) / 'example', cycles, events)
    if verdict:
        (trace / 'verdict.json').write_text(json.dumps(verdict))
    page = Path(folder) / f'page-{cycles}.html'
    subprocess.run([os.environ['LAUNCH_REPORT'], trace, '--html', page, *options], check=True, stdout=subprocess.DEVNULL)
    return page


class PageTest(unittest.TestCase):
    CYCLES = 100
    DARK = False
    SIZE = (1280, 900)
    OPTIONS = ()
    EVENTS = ()
    VERDICT = None

    @classmethod
    def setUpClass(cls):
        if not chromium():
            raise unittest.SkipTest('there is no browser: the package chromium is not installed')
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.page = cls.make_page()
        cls.browser = cls.enterClassContext(Browser(dark=cls.DARK))
        cls.browser.set_size(*cls.SIZE)

    @classmethod
    def make_page(cls):
        return write_page(cls.folder, cls.CYCLES, cls.OPTIONS, cls.EVENTS, cls.VERDICT)

    def setUp(self):
        self.browser.problems.clear()
        self.browser.open(self.page)

    def tearDown(self):
        self.assertEqual(self.browser.problems, [])
        self.assertEqual([url for url in self.browser.requests if not url.startswith(('file:', 'data:', 'blob:'))], [])

    def show(self, view):
        self.browser.click(f'[data-view={view}]')
        self.browser.wait_for(f'page.shown === "{view}"')

    # Chooses in the list with this label.
    def choose(self, label, value):
        self.browser.evaluate(f'''(() => {{
          const list = document.querySelector('[aria-label="{label}"]');
          list.value = {value!r};
          list.dispatchEvent(new Event("change"));
        }})()''')

    def hash(self):
        return self.browser.evaluate('decodeURIComponent(location.hash)')

    def chips(self):
        return self.texts('#selection .chip')

    # What sticks out of the page to the right makes it scroll sideways.
    def assert_fits(self):
        self.assertLessEqual(self.browser.evaluate('document.documentElement.scrollWidth - document.documentElement.clientWidth'), 0)

    def text(self, selector):
        return self.browser.evaluate(f'document.querySelector({selector!r}).innerText')

    def texts(self, selector):
        return self.browser.evaluate(f'[...document.querySelectorAll({selector!r})].map(found => found.innerText.trim())')

    def cells(self, rows):
        return self.browser.evaluate(f'[...document.querySelectorAll({rows!r})].map(row => [...row.cells].map(cell => cell.innerText.trim()))')

    def drawn(self, selector):
        return self.browser.evaluate(f'{DRAWN}({selector!r})')

    def wait_for_canvas(self, selector):
        self.browser.wait_for(f'document.querySelector({selector!r}) && {DRAWN}({selector!r}) > 0')
