# SPDX-License-Identifier: Apache-2.0
"""
Drives a headless Chromium by the DevTools protocol, over two pipes: each message is JSON with a zero byte at its end.
"""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

PATIENCE = 120  # seconds; a busy machine needs them


def chromium():
    """The path of the browser, or None."""
    return shutil.which('chromium') or shutil.which('chromium-browser')


class Browser:
    """
    One page at a time. Use it as a context manager.

        with Browser() as browser:
            browser.open(path)
            browser.evaluate('document.title')

    `problems` holds the texts of errors and warnings of the page's console, and of exceptions; `requests` the addresses
    that it has asked for.
    """

    def __init__(self, dark=False):
        self._profile = tempfile.TemporaryDirectory(prefix='browser-', ignore_cleanup_errors=True)
        to_browser, self._out = os.pipe()
        self._in, from_browser = os.pipe()
        # Root may not use Chromium's sandbox; the page is our own. A container's /dev/shm may be too small for it.
        # The name of this process is chromium's, because the shell becomes it.
        self._process = subprocess.Popen(
            ['sh', '-c', f'exec "$0" "$@" 3<&{to_browser} 4>&{from_browser}', chromium(), '--headless=new', '--no-sandbox',
             '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run', '--hide-scrollbars', '--remote-debugging-pipe',
             '--disable-background-networking', '--disable-component-update', '--disable-sync', f'--user-data-dir={self._profile.name}', 'about:blank'],
            pass_fds=(to_browser, from_browser), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            env={**os.environ, 'HOME': self._profile.name}, start_new_session=True)
        os.close(to_browser)
        os.close(from_browser)
        self._buffer = b''
        self._last_id = 0
        self._session = None
        self.problems = []
        self.requests = []
        self._attach(dark)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._send('Browser.close', {}, None)
            self._process.wait(PATIENCE)
        except (OSError, subprocess.TimeoutExpired):
            self._process.kill()
            self._process.wait()
        os.close(self._out)
        os.close(self._in)
        self._profile.cleanup()

    def _attach(self, dark):
        pages = self.call('Target.getTargets', at_browser=True)['targetInfos']
        page = next(target for target in pages if target['type'] == 'page')
        attached = self.call('Target.attachToTarget', at_browser=True, targetId=page['targetId'], flatten=True)
        self._session = attached['sessionId']
        for domain in ('Page', 'Runtime', 'Log', 'Network'):
            self.call(domain + '.enable')
        self.call('Emulation.setEmulatedMedia',
                  features=[{'name': 'prefers-color-scheme', 'value': 'dark' if dark else 'light'}])
        self.set_size(1280, 900)

    def _send(self, method, params, session):
        self._last_id += 1
        message = {'id': self._last_id, 'method': method, 'params': params}
        if session:
            message['sessionId'] = session
        data = json.dumps(message).encode() + b'\0'
        while data:
            data = data[os.write(self._out, data):]
        return self._last_id

    def _next_message(self, deadline):
        while b'\0' not in self._buffer:
            ready, _, _ = select.select([self._in], [], [], max(0, deadline - time.monotonic()))
            if not ready:
                raise TimeoutError('the browser does not answer')
            data = os.read(self._in, 1 << 20)
            if not data:
                raise EOFError('the browser has ended')
            self._buffer += data
        text, self._buffer = self._buffer.split(b'\0', 1)
        return json.loads(text)

    def _notice(self, message):
        method, params = message.get('method'), message.get('params', {})
        if method == 'Runtime.exceptionThrown':
            details = params['exceptionDetails']
            self.problems.append(details.get('exception', {}).get('description') or details['text'])
        elif method == 'Runtime.consoleAPICalled' and params['type'] in ('error', 'warning', 'assert'):
            self.problems.append(' '.join(str(argument.get('value')) for argument in params['args']))
        elif method == 'Network.requestWillBeSent':
            self.requests.append(params['request']['url'])
        elif method == 'Log.entryAdded' and params['entry']['level'] in ('error', 'warning'):
            self.problems.append(params['entry']['text'])

    def call(self, method, at_browser=False, **params):
        """Calls a method of the protocol and returns its result."""
        sent = self._send(method, params, None if at_browser else self._session)
        deadline = time.monotonic() + PATIENCE
        while True:
            message = self._next_message(deadline)
            if message.get('id') != sent:
                self._notice(message)
            elif 'error' in message:
                raise RuntimeError(f'{method}: {message["error"]["message"]}')
            else:
                return message['result']

    def set_size(self, width, height):
        self.call('Emulation.setDeviceMetricsOverride', width=width, height=height, deviceScaleFactor=1, mobile=False)

    def open(self, path):
        """Opens a file, and waits until its element `body` has the attribute data-ready."""
        self.open_address('file://' + os.path.abspath(path))

    def open_address(self, address):
        """The same for a page of a service."""
        self.call('Page.navigate', url=address)
        self.wait_for('document.body?.dataset.ready === "yes"')

    def evaluate(self, expression):
        """The value of an expression in the page; of a promise, what it resolves to."""
        result = self.call('Runtime.evaluate', expression=expression, awaitPromise=True, returnByValue=True)
        if 'exceptionDetails' in result:
            details = result['exceptionDetails']
            raise RuntimeError(details.get('exception', {}).get('description') or details['text'])
        return result['result'].get('value')

    def wait_for(self, condition):
        """Waits until a condition in the page holds, looked at before each frame is drawn."""
        deadline = time.monotonic() + PATIENCE
        while True:
            try:
                if self.evaluate(f'new Promise(done => requestAnimationFrame(() => setTimeout(() => done(Boolean({condition})))))'):
                    return
            except RuntimeError as error:  # the page was being replaced
                if 'context' not in str(error) and 'navigated' not in str(error):
                    raise
            if time.monotonic() > deadline:
                raise TimeoutError(f'never true: {condition}; problems: {self.problems}')

    def click(self, selector):
        """Clicks into the middle of an element with the mouse."""
        at = self.evaluate(f'''(() => {{
          const found = document.querySelector({json.dumps(selector)});
          found.scrollIntoView({{block: "center"}});
          const box = found.getBoundingClientRect();
          return [box.x + box.width / 2, box.y + box.height / 2];
        }})()''')
        self.click_at(*at)

    def click_at(self, x, y):
        for kind in ('mouseMoved', 'mousePressed', 'mouseReleased'):
            self.call('Input.dispatchMouseEvent', type=kind, x=x, y=y, button='none' if kind == 'mouseMoved' else 'left', clickCount=1)

    def key(self, key):
        """Presses a key: a character, or a name such as Enter or ArrowRight."""
        text = {'Enter': '\r'}.get(key, key if len(key) == 1 else '')
        code = {'Enter': 13, 'Escape': 27, 'Tab': 9, 'ArrowLeft': 37, 'ArrowUp': 38, 'ArrowRight': 39, 'ArrowDown': 40}.get(key, 0)
        self.call('Input.dispatchKeyEvent', type='keyDown', key=key, text=text, windowsVirtualKeyCode=code)
        self.call('Input.dispatchKeyEvent', type='keyUp', key=key, windowsVirtualKeyCode=code)

    def screenshot(self, path):
        data = self.call('Page.captureScreenshot', format='png')['data']
        with open(path, 'wb') as file:
            file.write(base64.b64decode(data))
