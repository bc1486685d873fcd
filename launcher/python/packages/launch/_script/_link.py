# SPDX-License-Identifier: Apache-2.0
"""
The connection of a LaunchService with its launcher. Messages are JSON, one a line.

The launcher calls, and waits for the value. While a call is served, this side may ask the launcher back. At any other
time this side has to wish for a turn first: it writes a byte, and the launcher calls `step` when it comes to it.
"""

import concurrent.futures
import contextlib
import json
import os
import select
import socket
import threading

from launch._script import _values

current = None  # the connection of the launch that runs in this process


def of_this_thread():
    """The connection, in the thread of its loop; elsewhere None."""
    return current if current is not None and current.is_of_this_thread() else None


class LaunchHasEnded(RuntimeError):
    """There is no launcher that could be asked."""

    def __init__(self):
        super().__init__('the launch has ended')


class Link:

    def __init__(self, loop, serve):
        """`serve` is called with a call of the launcher and gives its value. Errors of it go to the launcher."""
        self.loop = loop
        self.objects = _values.Objects()
        self._serve_call = serve
        self._socket, self._of_launcher = socket.socketpair()
        self._wake, self._wake_of_launcher = socket.socketpair()
        self._wake.setblocking(False)
        self._received = b''
        self._thread = threading.get_ident()
        self._depth = 0  # of calls that are being served
        self.is_open = True

    def descriptors(self):
        """Of the launcher: the connection, and where wishes come."""
        return self._of_launcher.fileno(), self._wake_of_launcher.fileno()

    def leave_to_launcher(self):
        """Called when the launcher has its descriptors."""
        self._of_launcher.close()
        self._wake_of_launcher.close()
        self.loop.add_reader(self._socket, self._on_readable)

    def close(self):
        if self.is_open:
            self.is_open = False
            self.loop.remove_reader(self._socket)
        self._socket.close()
        self._wake.close()

    def is_of_this_thread(self):
        return threading.get_ident() == self._thread

    # Messages.

    def _send(self, message):
        try:
            self._socket.sendall(json.dumps(message).encode() + b'\n')
        except OSError:
            raise LaunchHasEnded from None

    def _receive(self):
        while b'\n' not in self._received:
            try:
                data = self._socket.recv(65536)
            except OSError:
                data = b''
            if not data:
                raise LaunchHasEnded
            self._received += data
        line, self._received = self._received.split(b'\n', 1)
        return json.loads(line)

    def _on_readable(self):
        # What was there when the loop looked may have been served in a turn since.
        poll = select.poll()
        poll.register(self._socket, select.POLLIN)
        if not poll.poll(0):
            return
        try:
            self._serve(self._receive())
        except LaunchHasEnded:
            self.is_open = False
            self.loop.remove_reader(self._socket)

    # Calls of the launcher.

    def _serve(self, call):
        self._answer(call, lambda: self._serve_call(call))

    def _answer(self, call, value_of):
        from launch import _environment, _explain
        self.objects.drop(call['drop'])
        outer, self._depth = self._depth, self._depth + 1
        outer_environ, os.environ = os.environ, _environment.environment
        try:
            answer = {'value': value_of()}
        except LaunchHasEnded:
            raise
        except BaseException as error:
            message, place, help_, traceback, number = _explain.explain(error, error.__traceback__, call['tracebacks'])
            answer = {'error': {'message': message, 'place': place, 'help': help_, 'traceback': traceback,
                                'failure': number}}
        finally:
            self._depth = outer
            os.environ = outer_environ
        self._send(answer)

    # What this side asks.

    def ask(self, question):
        """The launcher's answer. May be called by any thread."""
        return self.run(lambda: self._ask(question))

    def _ask(self, question):
        self._send(question)
        while True:
            message = self._receive()
            if 'call' not in message:
                break
            self._serve(message)
        if 'failure' in message:
            from launch.substitutions import SubstitutionFailure
            failure = SubstitutionFailure(message['what'])
            failure._number = message['failure']
            raise failure
        return message['value']

    def run(self, function):
        """Calls the function in a turn, on the thread of the loop. May be called by any thread."""
        if not self.is_open:
            raise LaunchHasEnded
        if not self.is_of_this_thread():
            return self._run_in_loop(function)
        if self._depth > 0:
            return function()
        with self._turn():
            return function()

    def _run_in_loop(self, function):
        done = concurrent.futures.Future()

        def run():
            try:
                done.set_result(self.run(function))
            except BaseException as error:
                done.set_exception(error)

        self.loop.call_soon_threadsafe(run)
        return done.result()

    def wish(self):
        """Has the launcher call `step` when it comes to it."""
        # A full pipe holds wishes enough, and a closed one none that anybody would hear.
        with contextlib.suppress(OSError):
            self._wake.send(b'w')

    @contextlib.contextmanager
    def _turn(self):
        self.wish()
        while (call := self._receive())['call'] != 'step':
            self._serve(call)
        self.objects.drop(call['drop'])
        self._depth += 1
        try:
            yield
        finally:
            self._depth -= 1
            self._answer({**call, 'drop': []}, lambda: self._serve_call(call))

    # The end of the launcher's process.

    def ended(self, process):
        """A future of the exit code of the launcher."""
        future = self.loop.create_future()
        descriptor = os.pidfd_open(process.pid)

        def on_end():
            self.loop.remove_reader(descriptor)
            os.close(descriptor)
            code = process.wait()
            if not future.done():
                future.set_result(code)

        self.loop.add_reader(descriptor, on_end)
        return future
