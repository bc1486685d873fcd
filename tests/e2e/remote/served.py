# SPDX-License-Identifier: Apache-2.0
"""`launch serve` on a free port, and requests to it."""

import http.client
import json
import re
import ssl
import subprocess

from own_launches import LAUNCH, PATIENCE, OwnLaunches

TOKEN = 'a-token-that-nobody-guesses'


class Served(OwnLaunches):
    def setUp(self):
        super().setUp()
        self.token_file = self.folder / 'token'
        self.token_file.write_text(TOKEN + '\n')
        self.token_file.chmod(0o600)
        self.tls = None

    def serve(self, *options, listen='127.0.0.1:0'):
        """Sets `url` and `port`."""
        service = self.start(LAUNCH, 'serve', '--listen', listen, '--token-file', str(self.token_file), *options)
        line = service.lines.wait_for(' launches at ')
        self.url = re.search(r'https?://\S+?(?=,)', line).group()
        self.port = int(re.search(r':(\d+)/', self.url).group(1))
        return service

    def make_certificate(self):
        """The paths of a certificate of its own and its key; the client trusts it from now on."""
        certificate, key = self.folder / 'certificate.pem', self.folder / 'key.pem'
        subprocess.run(['openssl', 'req', '-x509', '-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes', '-days', '1',
                        '-subj', '/CN=localhost', '-addext', 'subjectAltName=IP:127.0.0.1,DNS:localhost', '-keyout', key, '-out', certificate],
                       check=True, capture_output=True, timeout=PATIENCE)
        self.tls = ssl.create_default_context(cafile=certificate)
        return certificate, key

    def connect(self):
        connection = (http.client.HTTPSConnection('127.0.0.1', self.port, timeout=PATIENCE, context=self.tls) if self.tls else
                      http.client.HTTPConnection('127.0.0.1', self.port, timeout=PATIENCE))
        self.addCleanup(connection.close)
        return connection

    def request(self, method, path, body=None, token=TOKEN, **header):
        """The response, with its whole text in `text`. Underscores in names of headers are hyphens."""
        connection = self.connect()
        header = {name.replace('_', '-'): value for name, value in header.items()}
        if token:
            header['Authorization'] = f'Bearer {token}'
        if isinstance(body, dict):
            header.setdefault('Content-Type', 'application/json')
            body = json.dumps(body)
        connection.request(method, path, body=body, headers=header)
        response = connection.getresponse()
        response.text = response.read().decode()
        connection.close()
        return response

    def ask(self, path, body=None, status=200, **options):
        """The answer as JSON."""
        response = self.request('GET' if body is None else 'POST', path, body, **options)
        self.assertEqual(response.status, status, response.text)
        return json.loads(response.text)

    def events(self, path):
        """Yields the events of a stream: (name, data)."""
        connection = self.connect()
        connection.request('GET', path, headers={'Authorization': f'Bearer {TOKEN}'})
        response = connection.getresponse()
        self.assertEqual(response.status, 200)
        self.assertEqual(response.getheader('Content-Type'), 'text/event-stream')
        name = None
        for line in response:
            line = line.decode().rstrip('\n')
            if line.startswith('event: '):
                name = line[len('event: '):]
            elif line.startswith('data: '):
                yield name, json.loads(line[len('data: '):])
