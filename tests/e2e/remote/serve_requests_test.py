# SPDX-License-Identifier: Apache-2.0
"""`launch serve` over real HTTP: who may ask, what is answered, what a launch does then."""

import shutil
import signal
import ssl
import unittest

from own_launches import PATIENCE, TALKER
from served import TOKEN, Served


class Serve(Served):
    def test_programs_see_launches(self):
        launch = self.start_launch()
        self.serve()
        listed = self.ask('/api/launches')
        self.assertFalse(listed['control'])
        own = next(entry for entry in listed['launches'] if entry['pid'] == launch.pid)
        self.assertEqual(own['files'], [str(self.folder / 'system.launch.xml')])
        answer = self.ask(f'/api/launches/{launch.pid}')
        self.assertEqual([process['name'] for process in answer['processes']], ['talker-1', 'sleeper-2'])
        for process in answer['processes']:
            self.assertEqual(process['state'], 'running')
            self.assertGreater(process['memory'], 0)
            self.assertGreaterEqual(process['cpu'], 0)
        one = self.ask(f'/api/launches/{launch.pid}', {'do': 'ps', 'processes': ['slee*']})
        self.assertEqual([process['name'] for process in one['processes']], ['sleeper-2'])
        self.assertEqual(self.ask('/api/launches/1', status=404)['error'], 'launch 1 does not run')

    def test_a_wrong_token_sees_nothing(self):
        launch = self.start_launch()
        service = self.serve('--allow-control')
        for token in (None, 'wrong', TOKEN[:-1], TOKEN + 'x'):
            for method, path in (('GET', '/api/launches'), ('GET', f'/api/launches/{launch.pid}'),
                                 ('POST', f'/api/launches/{launch.pid}'), ('GET', f'/api/launches/{launch.pid}/events'), ('GET', '/other')):
                with self.subTest(token=token, path=path):
                    response = self.request(method, path, {'do': 'shutdown'} if method == 'POST' else None, token=token)
                    self.assertEqual(response.status, 401)
                    self.assertNotIn('talker', response.text)
        self.assertEqual(self.request('GET', f'/api/launches?token={TOKEN}', token=None).status, 401)
        page = self.request('GET', '/', token=None)
        self.assertEqual(page.status, 401)
        self.assertIn('<form', page.text)
        self.assertEqual(self.processes(launch)['talker-1']['state'], 'running')
        service.lines.wait_for('wrong token from 127.0.0.1')
        self.end(service)
        self.assertNotIn(TOKEN, '\n'.join(service.lines.seen))

    def test_without_permission_it_only_shows(self):
        launch = self.start_launch()
        self.serve()
        for what in ('stop', 'start', 'restart', 'signal', 'shutdown'):
            answer = self.ask(f'/api/launches/{launch.pid}', {'do': what, 'processes': ['talker'], 'signal': 'KILL'}, status=403)
            self.assertEqual(answer['error'], 'this service only shows launches')
            self.assertEqual(answer['help'], 'it steers them if it is started with --allow-control')
        self.assertEqual([process['restarts'] for process in self.processes(launch).values()], [0, 0])

    def test_it_steers(self):
        launch = self.start_launch()
        service = self.serve('--allow-control')
        address = f'/api/launches/{launch.pid}'
        self.assertTrue(self.ask('/api/launches')['control'])
        stream = self.events(f'{address}/events?output=talker-1')
        next(stream)
        before = self.pid_of(launch, 'sleeper-2')
        answer = self.ask(address, {'version': 1, 'do': 'restart', 'processes': ['sleeper']})
        self.assertEqual((answer['ok'], answer['done']), (True, ['sleeper-2']))
        started = next(data for name, data in stream if name == 'event' and data['event'] == 'started')
        self.assertNotEqual(started['pid'], before)
        self.assertEqual(self.pid_of(launch, 'sleeper-2'), started['pid'])
        self.ask(address, {'do': 'stop', 'processes': ['sleeper']})
        next(data for name, data in stream if name == 'event' and data['event'] == 'done')
        self.assertIsNone(self.pid_of(launch, 'sleeper-2'))
        self.ask(address, {'do': 'start', 'processes': ['sleeper']})
        next(data for name, data in stream if name == 'event' and data['event'] == 'started')
        self.ask(address, {'do': 'signal', 'processes': ['talker'], 'signal': 'USR1'})
        line = next(data for name, data in stream if name == 'output' and not data.get('past'))
        self.assertEqual((line['process'], line['line']), ('talker-1', 'got USR1'))
        counted = next(process for name, data in stream if name == 'ps' for process in data['processes'] if process.get('lines'))
        self.assertEqual((counted['name'], counted['lines']), ('talker-1', 1))
        self.assertIn("no process", self.ask(address, {'do': 'stop', 'processes': ['nobody']}, status=409)['error'])
        self.assertIn('version', self.ask(address, {'version': 99, 'do': 'ps'}, status=409)['error'])
        self.ask(address, {'do': 'shutdown'})
        self.assertEqual(list(stream)[-1], ('end', {}))
        launch.wait(PATIENCE)
        service.lines.wait_for(f'restart ["sleeper"] of launch {launch.pid}, for 127.0.0.1')

    def test_every_part_of_a_request_arrives(self):
        actions = (TALKER + '<group name="arm"><executable name="grip" cmd="sleep 1000"/></group>'
                   '<executable name="worker" cmd="sleep 1000" scalable="true"/>')
        launch = self.start_launch(actions)
        self.serve('--allow-control')
        address = f'/api/launches/{launch.pid}'
        stream = self.events(f'{address}/events')
        next(stream)
        grip = next(name for name in self.processes(launch) if name.startswith('grip'))
        self.assertEqual(self.ask(address, {'do': 'stop', 'groups': ['arm']})['done'], [grip])
        next(data for name, data in stream if name == 'event' and data['event'] == 'done')
        self.ask(address, {'do': 'scale', 'processes': ['worker'], 'count': 2})
        next(data for name, data in stream if name == 'event' and data['event'] == 'started')
        (self.folder / 'system.launch.xml').write_text('<launch></launch>')
        before = self.processes(launch)
        asked = self.ask(address, {'do': 'reload', 'dry_run': True})
        told = next(data for name, data in stream if name == 'event' and data['event'] == 'reload')
        self.assertEqual((told['reload'], told['dry_run']), (asked['reload'], True))
        self.assertEqual(self.processes(launch).keys(), before.keys())

    def test_a_stream_begins_with_what_was_printed_before(self):
        (self.folder / 'shouting.sh').write_text("for i in 1 2 3; do echo line $i; done; echo '<script>'; sleep 1000\n")
        launch = self.start_launch(TALKER + '<executable name="shouting" cmd="sh shouting.sh" output="both"/>')
        launch.lines.wait_for('[shouting-2] <script>')
        self.serve()
        lines = []
        for name, data in self.events(f'/api/launches/{launch.pid}/events?output=shouting-2'):
            if name == 'output':
                lines.append(data['line'])
            if lines and lines[-1] == '<script>':
                break
        self.assertEqual(lines, ['line 1', 'line 2', 'line 3', '<script>'])

    def test_it_ends_while_pages_follow(self):
        launch = self.start_launch()
        service = self.serve()
        streams = [self.events(f'/api/launches/{launch.pid}/events') for _ in range(3)]
        for stream in streams:
            self.assertEqual(next(stream)[0], 'ps')
        service.send_signal(signal.SIGINT)
        self.assertEqual(service.wait(PATIENCE), 0)
        for stream in streams:
            self.assertNotIn('end', [name for name, _ in stream])
        self.assertIsNone(launch.poll())

    def test_tls(self):
        if not shutil.which('openssl'):
            self.skipTest('skipped, because there is no openssl to make a certificate with')
        launch = self.start_launch()
        certificate, key = self.make_certificate()
        self.serve('--tls-cert', str(certificate), '--tls-key', str(key), listen='0.0.0.0:0')
        self.assertTrue(self.url.startswith('https://0.0.0.0:'))
        self.assertEqual(len(self.ask(f'/api/launches/{launch.pid}')['processes']), 2)
        login = self.request('POST', '/login', f'token={TOKEN}', token=None, Origin=f'https://127.0.0.1:{self.port}')
        self.assertIn('; Secure', login.getheader('Set-Cookie'))
        connection = self.connect()
        connection.request('GET', '/api/launches', headers={'Authorization': f'Bearer {TOKEN}'})
        self.assertIn(connection.sock.version(), ('TLSv1.2', 'TLSv1.3'))
        self.tls = ssl.create_default_context()  # nobody vouches for the certificate
        with self.assertRaises(ssl.SSLCertVerificationError):
            self.request('GET', '/')

    def test_what_can_not_be_served_is_told(self):
        def error(*words):
            result = self.launch('serve', *words)
            return result.returncode, result.stderr
        token = ('--token-file', self.token_file)
        self.assertEqual(error(), (2, 'launch serve: error: --token-file is required\n'
                                      '      = help: (umask 077; head -c 24 /dev/urandom | base64 > FILE)\n'
                                      "      = help: see 'launch serve --help'\n"))
        self.assertEqual(error(*token, '--listen', '0.0.0.0:0'), (
            1, 'launch serve: error: does not listen on 0.0.0.0:0 without TLS: others could read the token\n'
               "      = help: give --tls-cert and --tls-key, reach 127.0.0.1 through 'ssh -L', or say --insecure on a network of your own\n"))
        self.assertEqual(error(*token, '--listen', 'robot'), (
            2, "launch serve: error: --listen 'robot' is no ADDRESS:PORT\n"
               '      = help: an address is a number, such as 127.0.0.1:7411, 0.0.0.0:7411 or [::1]:7411\n'))
        self.assertEqual(error(*token, '--tls-cert', 'x'), (2, 'launch serve: error: --tls-cert and --tls-key belong together\n'
                                                               "      = help: see 'launch serve --help'\n"))
        self.assertEqual(error(*token, '--tls-cert', '/no/such', '--tls-key', '/no/such'), (
            1, "launch serve: error: can't read the certificate '/no/such': No such file or directory\n"))
        self.assertEqual(error(*token, '--tls-cert', self.token_file, '--tls-key', self.token_file), (
            1, "launch serve: error: the HTTPS server does not start: the certificate or its key can't be used, or they don't belong together\n"))
        self.serve()
        self.assertEqual(error(*token, '--listen', f'127.0.0.1:{self.port}'), (
            1, f"launch serve: error: can't listen on 127.0.0.1:{self.port}: Address already in use\n"))
        self.token_file.chmod(0o644)
        self.assertEqual(error(*token), (
            1, f"launch serve: error: others than its user may read or change the token file '{self.token_file}'\n"
               f'      = help: chmod 600 {self.token_file}, if nobody has read it so far\n'))

    def test_insecure_is_a_word_of_the_user(self):
        self.serve('--insecure', listen='0.0.0.0:0')
        self.assertTrue(self.url.startswith('http://0.0.0.0:'))
        self.assertEqual(self.request('GET', '/api/launches').status, 200)


class OtherSites(Served):
    """What a page of another site can make a browser send."""

    def log_in(self):
        response = self.request('POST', '/login', f'token={TOKEN}', token=None, Origin=f'http://127.0.0.1:{self.port}',
                                Content_Type='application/x-www-form-urlencoded')
        self.assertEqual((response.status, response.getheader('Location')), (303, '/'))
        cookie, *attributes = response.getheader('Set-Cookie').split('; ')
        self.assertEqual(attributes, ['Path=/', 'HttpOnly', 'SameSite=Strict'])
        return cookie

    def test_a_cookie_steers_for_its_own_page_only(self):
        launch = self.start_launch()
        self.serve('--allow-control')
        address, own = f'/api/launches/{launch.pid}', f'http://127.0.0.1:{self.port}'
        cookie = self.log_in()
        before = self.pid_of(launch, 'sleeper-2')
        self.assertEqual(self.request('GET', '/', token=None, Cookie=cookie).status, 200)
        request = {'do': 'restart', 'processes': ['sleeper']}
        for header in ({}, {'Origin': 'http://evil.example'}, {'Origin': 'null'}, {'Origin': own, 'Sec_Fetch_Site': 'cross-site'}):
            with self.subTest(header):
                answer = self.ask(address, request, status=403, token=None, Cookie=cookie, **header)
                self.assertEqual(answer['error'], 'this request comes from a page of another site')
        self.assertEqual(self.request('POST', address, '{"do": "shutdown"}', token=None, Cookie=cookie, Origin=own,
                                      Content_Type='text/plain').status, 415)
        self.assertEqual(self.pid_of(launch, 'sleeper-2'), before)
        self.ask(address, request, token=None, Cookie=cookie, Origin=own)
        self.assertEqual(self.request('POST', '/logout', '', token=None, Cookie=cookie, Origin=own).status, 303)
        self.ask(address, request, status=401, token=None, Cookie=cookie, Origin=own)

    def test_a_foreign_name_for_this_machine_is_refused(self):
        self.serve()
        cookie = self.log_in()
        for host in ('evil.example', f'evil.example:{self.port}', '', 'localhost.evil.example'):
            with self.subTest(host):
                answer = self.ask('/api/launches', status=421, Host=host, Cookie=cookie)
                self.assertEqual(answer['error'], 'this service is not asked for by this name')
        for host in (f'localhost:{self.port}', f'[::1]:{self.port}', f'10.0.0.1:{self.port}'):
            self.assertEqual(self.request('GET', '/api/launches', Host=host).status, 200)
        self.assertEqual(self.request('GET', '/api/launches', Host='robot.example').status, 421)

    def test_a_name_of_the_user_s_own_is_taken(self):
        self.serve('--host', 'robot.example', '--host', 'other.example')
        self.assertEqual(self.request('GET', '/api/launches', Host='robot.example').status, 200)
        self.assertEqual(self.request('GET', '/api/launches', Host='other.example:80').status, 200)

    def test_answers_say_what_browsers_may_do_with_them(self):
        self.serve()
        for path, token in (('/', TOKEN), ('/', None), ('/api/launches', TOKEN), ('/nothing', TOKEN)):
            response = self.request('GET', path, token=token)
            self.assertEqual(response.getheader('X-Content-Type-Options'), 'nosniff')
            self.assertEqual(response.getheader('X-Frame-Options'), 'DENY')
            self.assertEqual(response.getheader('Cache-Control'), 'no-store')
            self.assertEqual(response.getheader('Referrer-Policy'), 'same-origin')
            self.assertIsNone(response.getheader('Access-Control-Allow-Origin'))
            if path == '/':
                self.assertIn("default-src 'none'", response.getheader('Content-Security-Policy'))


if __name__ == '__main__':
    unittest.main()
