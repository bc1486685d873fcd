# SPDX-License-Identifier: Apache-2.0
"""What `launch serve` does with clients that send too much, too slowly, or too often."""

import json
import socket
import time
import unittest

from own_launches import PATIENCE
from served import TOKEN, Served


class Limits(Served):
    def raw(self, data=b''):
        connection = socket.create_connection(('127.0.0.1', self.port), PATIENCE)
        self.addCleanup(connection.close)
        connection.sendall(data)
        return connection

    # The status of what comes; None if the connection ends before.
    def status(self, connection):
        received = b''
        try:
            while b'\r\n' not in received:
                data = connection.recv(4096)
                if not data:
                    return None
                received += data
        except ConnectionError:
            return None
        return int(received.split()[1])

    def as_soon_as_there_is_room(self):
        """The service refuses connections until it has seen the end of older ones."""
        end = time.monotonic() + PATIENCE
        while True:
            try:
                return self.request('GET', '/api/launches')
            except ConnectionError:
                self.assertLess(time.monotonic(), end)

    def test_a_big_request_is_refused(self):
        self.serve('--allow-control')
        for size, status in ((64 * 1024, 400), (64 * 1024 + 1, 413), (10 * 1024 * 1024, 413)):
            with self.subTest(size):
                self.assertEqual(self.request('POST', '/api/launches/1', 'x' * size, Content_Type='application/json').status, status)
        head = f'POST /api/launches/1 HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer {TOKEN}\r\n'
        chunk = b'8000\r\n' + b'x' * 0x8000 + b'\r\n'
        chunked = self.raw((head + 'Transfer-Encoding: chunked\r\n\r\n').encode() + chunk * 3 + b'0\r\n\r\n')
        self.assertEqual(self.status(chunked), 413)
        self.assertIn(self.status(self.raw((head + 'X: ' + 'y' * 100_000 + '\r\n\r\n').encode())), (400, 413, 431, None))
        self.assertEqual(self.request('GET', '/api/launches').status, 200)

    def test_what_is_no_request_does_no_harm(self):
        self.serve()
        for data in (b'\r\n\r\n', b'nonsense\r\n\r\n', b'\x16\x03\x01\x02\x00\x01\x00', b'GET / HTTP/9.9\r\n\r\n', bytes(range(256)) * 8,
                     b'GET / HTTP/1.1\r\n\r\n', b'GET /%00%ff/../.. HTTP/1.1\r\nHost: localhost\r\n\r\n',
                     b'POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: -5\r\n\r\n'):
            with self.subTest(data[:20]):
                connection = self.raw(data)
                connection.shutdown(socket.SHUT_WR)
                self.assertNotEqual(self.status(connection), 200)
        twice = self.raw(f'GET /api/launches HTTP/1.1\r\nHost: localhost\r\nHost: evil.example\r\nAuthorization: Bearer {TOKEN}\r\n\r\n'.encode())
        self.assertEqual(self.status(twice), 400)
        self.assertEqual(self.request('GET', '/api/launches').status, 200)

    def test_a_slow_client_is_cut_and_holds_nobody_up(self):
        self.serve()
        slow = self.raw(b'GET / HTTP/1.1\r\nHost: localhost\r\nX: ')
        silent = self.raw()
        answered = 0
        slow.settimeout(0.2)
        while True:
            # It always sends something, so it is never idle.
            try:
                slow.sendall(b'y')
                if slow.recv(100) == b'':
                    break
            except TimeoutError:
                self.assertEqual(self.request('GET', '/api/launches').status, 200)
                answered += 1
            except ConnectionError:
                break
        self.assertGreater(answered, 0)
        silent.settimeout(PATIENCE)
        self.assertEqual(silent.recv(100), b'')

    def test_connections_of_one_address_are_limited(self):
        service = self.serve()
        many = [self.raw() for _ in range(40)]
        # They are taken in this order. Those beyond the limit end at once.
        for connection in many[32:]:
            self.assertIsNone(self.status(connection))
        request = f'GET /api/launches HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nAuthorization: Bearer {TOKEN}\r\n\r\n'.encode()
        for connection in many[:32]:
            connection.sendall(request)
        for connection in many[:32]:
            self.assertEqual(self.status(connection), 200)
            connection.close()
        self.assertIsNone(service.poll())
        self.assertEqual(self.as_soon_as_there_is_room().status, 200)

    def test_pages_that_follow_are_limited(self):
        launch = self.start_launch()
        self.serve()
        streams = [self.events(f'/api/launches/{launch.pid}/events') for _ in range(16)]
        for stream in streams:
            self.assertEqual(next(stream)[0], 'ps')
        answer = self.request('GET', f'/api/launches/{launch.pid}/events')
        self.assertEqual((answer.status, json.loads(answer.text)['error']), (503, '16 pages follow launches already'))
        self.assertEqual(self.request('GET', f'/api/launches/{launch.pid}').status, 200)


if __name__ == '__main__':
    unittest.main()
