# SPDX-License-Identifier: Apache-2.0
"""
The language server, driven as an editor drives it. LAUNCH_PROGRAM is the launcher.
"""

import json
import os
import pathlib
import random
import subprocess
import tempfile
import unittest

LAUNCH = os.environ['LAUNCH_PROGRAM']
BASE = '''<launch>
  <arg name="speed" default="1" description="metres a second"/>
  <arg name="mode" default="auto"><choice value="auto"/><choice value="manual"/></arg>
  <executable cmd="echo $(var speed) $(var mode)"/>
</launch>
'''
TOP = '''<launch>
  <arg name="robot" default="r1"/>
  <include file="$(dirname)/base.launch.xml">
    <arg name="speed" value="$(var robot)"/>
  </include>
  <executable cmd="echo $(var robot)" name="a"/>
</launch>
'''


class Editor:
    """Speaks the protocol with a server."""

    def __init__(self, directory, *words, options=None):
        self.directory = pathlib.Path(directory)
        self.process = subprocess.Popen([LAUNCH, 'lsp', *words], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        env={**os.environ, 'ROS_LOG_DIR': str(self.directory / 'log')})
        self.last = 0
        self.published = []
        self.capabilities = self.ask('initialize', {'processId': os.getpid(), 'rootUri': self.directory.as_uri(),
                                                    'capabilities': {}, 'initializationOptions': options})['capabilities']
        self.tell('initialized', {})

    def send(self, message):
        text = json.dumps({'jsonrpc': '2.0', **message}).encode()
        self.process.stdin.write(b'Content-Length: %d\r\n\r\n' % len(text) + text)
        self.process.stdin.flush()

    def read(self):
        length = None
        while (line := self.process.stdout.readline()) != b'\r\n':
            if not line:
                raise EOFError('the server has ended')
            name, _, value = line.partition(b':')
            length = int(value) if name.lower() == b'content-length' else length
        return json.loads(self.process.stdout.read(length))

    def answer(self, method, params):
        self.last += 1
        self.send({'id': self.last, 'method': method, 'params': params})
        while True:
            message = self.read()
            if message.get('id') == self.last:
                return message
            self.published.append(message['params'])

    def ask(self, method, params):
        return self.answer(method, params)['result']

    def tell(self, method, params):
        self.send({'method': method, 'params': params})

    def uri(self, name):
        return (self.directory / name).as_uri()

    def open(self, name, text):
        self.tell('textDocument/didOpen', {'textDocument': {'uri': self.uri(name), 'languageId': 'xml', 'version': 1, 'text': text}})

    def change(self, name, *changes):
        self.tell('textDocument/didChange', {'textDocument': {'uri': self.uri(name), 'version': 2}, 'contentChanges': list(changes)})

    def diagnostics(self, name):
        """The next ones of the document."""
        while True:
            for index, published in enumerate(self.published):
                if published['uri'] == self.uri(name):
                    return self.published.pop(index)['diagnostics']
            self.published.append(self.read()['params'])

    def at(self, method, name, line, character, **more):
        return self.ask(f'textDocument/{method}', {'textDocument': {'uri': self.uri(name)},
                                                   'position': {'line': line, 'character': character}, **more})

    def labels(self, name, line, character):
        return [item['label'] for item in self.at('completion', name, line, character)['items']]

    def end(self):
        self.ask('shutdown', None)
        self.tell('exit', None)
        self.process.stdin.close()
        code = self.process.wait()
        self.process.stdout.close()
        return code


def column(text, line, what, behind=0):
    return text.split('\n')[line].index(what) + behind


class LanguageServer(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name).resolve()
        (self.directory / 'base.launch.xml').write_text(BASE)

    def editor(self, *words, **options):
        editor = Editor(self.directory, *words, **options)
        self.addCleanup(editor.process.wait)
        self.addCleanup(editor.process.stdout.close)
        self.addCleanup(editor.process.stdin.close)
        self.addCleanup(editor.process.kill)
        return editor

    def test_diagnostics_come_while_typing_and_go_with_the_document(self):
        editor = self.editor()
        editor.open('a.launch.xml', '<launch>\n  <node pkg="p" exce="é"/>\n</launch>\n')
        found = editor.diagnostics('a.launch.xml')
        self.assertEqual(found[0], {
            'range': {'start': {'line': 1, 'character': 16}, 'end': {'line': 1, 'character': 20}}, 'severity': 1,
            'code': found[0]['code'], 'source': 'launch',
            'message': "unexpected attribute 'exce' in 'node'\ndid you mean 'exec'?", 'data': ['exec']})
        fixes = editor.ask('textDocument/codeAction', {
            'textDocument': {'uri': editor.uri('a.launch.xml')}, 'range': found[0]['range'], 'context': {'diagnostics': found[:1]}})
        self.assertEqual([fix['title'] for fix in fixes], ["Change to 'exec'"])
        edit = fixes[0]['edit']['changes'][editor.uri('a.launch.xml')][0]
        editor.change('a.launch.xml', {'range': edit['range'], 'text': edit['newText']})
        self.assertNotIn('exce', json.dumps(editor.diagnostics('a.launch.xml')))
        editor.change('a.launch.xml', {'text': '<launch/>'})
        self.assertEqual(editor.diagnostics('a.launch.xml'), [])
        editor.tell('textDocument/didClose', {'textDocument': {'uri': editor.uri('a.launch.xml')}})
        self.assertEqual(editor.diagnostics('a.launch.xml'), [])
        self.assertEqual(editor.end(), 0)

    def test_an_error_in_an_included_file_is_told_at_the_include(self):
        editor = self.editor()
        editor.open('top.launch.xml', TOP)
        self.assertEqual(editor.diagnostics('top.launch.xml'), [])
        editor.open('base.launch.xml', BASE.replace('<executable', '<executabel'))  # not saved
        [found] = editor.diagnostics('top.launch.xml')
        self.assertEqual(found['range']['start'], {'line': 2, 'character': 17})
        self.assertEqual(found['message'].split('\n')[0], "unrecognized entity of the type 'executabel'")
        [related] = found['relatedInformation']
        self.assertEqual(related['location']['uri'], editor.uri('base.launch.xml'))
        self.assertEqual(related['location']['range']['start'], {'line': 3, 'character': 3})

    def test_completion_knows_the_language_the_packages_and_the_arguments(self):
        editor = self.editor()
        text = TOP.replace('</launch>', '  <executable cmd="echo" output=""/>\n  <\n</launch>')
        editor.open('top.launch.xml', text)
        name = 'top.launch.xml'
        self.assertIn('group', editor.labels(name, 7, 3))
        self.assertIn('pkg', editor.labels(name, 7, 3) + self.attributes_of_node(editor))
        self.assertEqual(editor.labels(name, 3, column(text, 3, 'speed')), ['speed', 'mode'])
        self.assertEqual(editor.labels(name, 5, column(text, 5, 'robot)')), ['robot'])
        self.assertIn('base.launch.xml', editor.labels(name, 2, column(text, 2, 'base')))
        self.assertIn('screen', editor.labels(name, 6, column(text, 6, 'output="', 8)))
        self.assertIn('find-pkg-share', self.substitutions(editor))

    def attributes_of_node(self, editor):
        editor.open('n.launch.xml', '<launch>\n<node \n</launch>')
        return editor.labels('n.launch.xml', 1, 6)

    def substitutions(self, editor):
        editor.open('s.launch.xml', '<launch>\n<log message="$("/>\n</launch>')
        return editor.labels('s.launch.xml', 1, 16)

    def test_choices_of_an_argument_are_completed(self):
        editor = self.editor()
        text = TOP.replace('name="speed" value="$(var robot)"', 'name="mode" value=""')
        editor.open('top.launch.xml', text)
        self.assertEqual(editor.labels('top.launch.xml', 3, column(text, 3, 'value="', 7)), ['auto', 'manual'])

    def test_hover_tells_what_a_word_means_and_what_a_substitution_gives(self):
        editor = self.editor()
        editor.open('top.launch.xml', TOP)
        self.assertTrue(editor.at('hover', 'top.launch.xml', 2, 4)['contents']['value'].startswith('**include**: '))
        self.assertIn('gives `r1` here', editor.at('hover', 'top.launch.xml', 5, column(TOP, 5, 'robot'))['contents']['value'])
        self.assertIsNone(editor.at('hover', 'top.launch.xml', 5, column(TOP, 5, 'echo')))

    def test_definitions_lead_to_files_and_arguments(self):
        editor = self.editor()
        editor.open('top.launch.xml', TOP)
        to_file = editor.at('definition', 'top.launch.xml', 2, column(TOP, 2, 'base'))
        self.assertEqual(to_file['uri'], editor.uri('base.launch.xml'))
        to_argument = editor.at('definition', 'top.launch.xml', 3, column(TOP, 3, 'speed'))
        self.assertEqual((to_argument['uri'], to_argument['range']['start']),
                         (editor.uri('base.launch.xml'), {'line': 1, 'character': 13}))
        here = editor.at('definition', 'top.launch.xml', 5, column(TOP, 5, 'robot'))
        self.assertEqual((here['uri'], here['range']['start']), (editor.uri('top.launch.xml'), {'line': 1, 'character': 13}))

    def test_an_argument_is_renamed_in_all_files_that_give_it(self):
        (self.directory / 'top.launch.xml').write_text(TOP)
        (self.directory / 'other.launch.yaml').write_text(
            'launch:\n- include:\n    file: $(dirname)/base.launch.xml\n    arg:\n    - name: speed\n      value: "3"\n')
        (self.directory / 'unrelated.launch.xml').write_text('<launch><arg name="speed" default="2"/></launch>')
        editor = self.editor()
        editor.open('base.launch.xml', BASE)
        changes = editor.at('rename', 'base.launch.xml', 1, column(BASE, 1, 'speed'), newName='velocity')['changes']
        self.assertEqual({uri: len(edits) for uri, edits in changes.items()},
                         {editor.uri('base.launch.xml'): 2, editor.uri('top.launch.xml'): 1, editor.uri('other.launch.yaml'): 1})
        used = editor.at('references', 'base.launch.xml', 1, column(BASE, 1, 'speed'), context={'includeDeclaration': True})
        self.assertEqual(len(used), 4)
        wrong = editor.answer('textDocument/rename', {'textDocument': {'uri': editor.uri('base.launch.xml')},
                                                      'position': {'line': 1, 'character': 14}, 'newName': 'a b'})
        self.assertEqual(wrong['error'], {'code': -32602, 'message': "'a b' can't be the name of an argument"})

    def test_an_argument_does_not_get_the_name_of_another_one(self):
        editor = self.editor()
        editor.open('base.launch.xml', BASE)
        document = {'textDocument': {'uri': editor.uri('base.launch.xml')}, 'position': {'line': 1, 'character': 14}}
        self.assertEqual(editor.answer('textDocument/rename', {**document, 'newName': 'mode'})['error']['message'],
                         "'mode' is the name of another argument or configuration already")
        self.assertIn('changes', editor.ask('textDocument/rename', {**document, 'newName': 'speed'}))

    def test_symbols_are_the_tree(self):
        editor = self.editor()
        editor.open('top.launch.xml', TOP)
        [root] = editor.ask('textDocument/documentSymbol', {'textDocument': {'uri': editor.uri('top.launch.xml')}})
        self.assertEqual([symbol['name'] for symbol in root['children']],
                         ['arg robot', 'include $(dirname)/base.launch.xml', 'executable a'])
        folds = editor.ask('textDocument/foldingRange', {'textDocument': {'uri': editor.uri('top.launch.xml')}})
        self.assertEqual([(fold['startLine'], fold['endLine']) for fold in folds], [(0, 6), (2, 4)])

    def test_inlay_hints_show_values(self):
        editor = self.editor()
        editor.open('top.launch.xml', TOP)
        hints = editor.ask('textDocument/inlayHint', {
            'textDocument': {'uri': editor.uri('top.launch.xml')},
            'range': {'start': {'line': 3, 'character': 0}, 'end': {'line': 6, 'character': 0}}})
        self.assertEqual([hint['label'] for hint in hints], ['= r1', '= echo r1'])

    def test_semantic_tokens_are_the_words_of_the_language(self):
        text = '<launch>\n<log level="INFO" message="é $(var a) $(eval \'1\')"/>\n</launch>'
        editor = self.editor()
        legend = editor.capabilities['semanticTokensProvider']['legend']['tokenTypes']
        editor.open('a.launch.xml', text)
        data = editor.ask('textDocument/semanticTokens/full', {'textDocument': {'uri': editor.uri('a.launch.xml')}})['data']
        line, character, found = 0, 0, []
        for at in range(0, len(data), 5):
            character = data[at + 1] + (character if data[at] == 0 else 0)
            line += data[at]
            found.append((text.split('\n')[line][character:character + data[at + 2]], legend[data[at + 3]]))
        self.assertEqual(found, [('launch', 'class'), ('log', 'class'), ('level', 'property'), ('message', 'property'),
                                 ('var', 'function'), ('a', 'variable'), ('eval', 'function')])

    def test_lenses_have_commands_and_tell_how_many_processes_there_are(self):
        editor = self.editor()
        editor.open('base.launch.xml', BASE)
        self.assertEqual(editor.diagnostics('base.launch.xml'), [])
        lenses = editor.ask('textDocument/codeLens', {'textDocument': {'uri': editor.uri('base.launch.xml')}})
        path = str(self.directory / 'base.launch.xml')
        self.assertEqual([lens['command'] for lens in lenses],
                         [{'title': title, 'command': f'launch.{command}', 'arguments': [path]}
                          for title, command in (('run', 'run'), ('check', 'check'), ('1 process', 'graph'))])

    def test_the_files_of_the_folder_are_checked_though_they_are_not_open(self):
        (self.directory / 'part').mkdir()
        (self.directory / 'part/top.launch.xml').write_text('<launch><include file="$(dirname)/../base.launch.xml"/></launch>')
        (self.directory / 'wrong.launch.yaml').write_text('launch:\n- nope: {}\n')
        (self.directory / 'build').mkdir()
        (self.directory / 'build/copy.launch.yaml').write_text('launch:\n- nope: {}\n')
        editor = self.editor('--check-folder')
        self.assertEqual(editor.diagnostics('part/top.launch.xml'), [])
        [found] = editor.diagnostics('wrong.launch.yaml')
        self.assertEqual(found['message'].split('\n')[0], "unrecognized entity of the type 'nope'")
        self.assertEqual(editor.diagnostics('base.launch.xml'), [])
        (self.directory / 'base.launch.xml').write_text('<launch><nope/></launch>')
        editor.tell('textDocument/didSave', {'textDocument': {'uri': editor.uri('base.launch.xml')}})
        self.assertEqual(len(editor.diagnostics('part/top.launch.xml')), 1)
        (self.directory / 'wrong.launch.yaml').unlink()
        editor.tell('workspace/didChangeWatchedFiles', {'changes': []})
        self.assertEqual(editor.diagnostics('wrong.launch.yaml'), [])
        self.assertNotIn('copy.launch', json.dumps(editor.published))
        self.assertEqual(editor.end(), 0)

    def test_a_broken_file_also_tells_unknown_names(self):
        editor = self.editor()
        editor.open('a.launch.xml', '<launch>\n<node pkg="p" exce="e"/>\n<log message="$(varr x)"/>\n<group>\n<nope/>\n<let name="a\n</launch>\n')
        found = editor.diagnostics('a.launch.xml')
        self.assertEqual(sorted((one['range']['start']['line'], one['message'].split('\n')[0]) for one in found),
                         [(1, "unexpected attribute 'exce' in 'node'"), (2, "unknown substitution 'varr'"),
                          (4, "unrecognized entity of the type 'nope'"), (5, "the value of the attribute 'name' is not closed")])
        editor.open('a.launch.yaml', 'launch:\n- node:\n    pkg: p\n    exce: e\n- log:\n    message: "a\n')
        found = editor.diagnostics('a.launch.yaml')
        self.assertIn("unexpected attribute 'exce' in 'node'", [one['message'].split('\n')[0] for one in found])

    def test_python_runs_only_where_it_is_allowed_and_not_while_typing(self):
        source = 'import os\nopen("ran", "a").close()\nos.abort()\n'.replace('ran', str(self.directory / 'ran'))
        editor = self.editor()
        editor.open('a.launch.py', source)
        editor.open('b.launch.xml', '<launch><include file="$(dirname)/a.launch.py"/></launch>')
        self.assertEqual(editor.diagnostics('b.launch.xml'), [])
        self.assertFalse((self.directory / 'ran').exists())
        self.assertEqual(editor.end(), 0)
        editor = self.editor(options={'runPython': True})
        editor.open('a.launch.py', source)
        [found] = editor.diagnostics('a.launch.py')
        self.assertEqual((found['range']['start'], found['message'].split('\n')[0]),
                         ({'line': 2, 'character': 0}, 'Python ends here by SIGABRT'))

    def test_the_server_itself_runs_nothing(self):
        text = ('<launch>\n<arg name="a" default="$(eval \'__import__(&quot;os&quot;).abort()\')"/>\n'
                '<log level="INFO" message="$(eval \'__import__(&quot;os&quot;).abort()\') $(command true)"/>\n</launch>\n')
        editor = self.editor()
        editor.open('a.launch.xml', text)
        self.assertIsNotNone(editor.at('hover', 'a.launch.xml', 2, text.split('\n')[2].index('eval')))
        self.assertEqual(editor.ask('textDocument/inlayHint', {
            'textDocument': {'uri': editor.uri('a.launch.xml')},
            'range': {'start': {'line': 0, 'character': 0}, 'end': {'line': 3, 'character': 0}}}), [])
        self.assertIn('Python ends here by SIGABRT', json.dumps(editor.diagnostics('a.launch.xml')))
        editor.open('b.launch.xml', text.replace('eval', 'of-a-package'))  # packages in Python offer substitutions
        self.assertIsNone(editor.at('hover', 'b.launch.xml', 2, text.split('\n')[2].index('eval')))
        self.assertEqual(editor.end(), 0)

    def test_wrong_messages_have_answers(self):
        editor = self.editor()
        self.assertEqual(editor.answer('textDocument/nothing', {'textDocument': {'uri': editor.uri('a')}})['error']['code'], -32602)
        self.assertEqual(editor.answer('nothing', {})['error'], {'code': -32601, 'message': "'nothing' is not known here"})
        self.assertEqual(editor.answer('textDocument/hover', {})['error']['code'], -32602)
        self.assertEqual(editor.end(), 0)
        self.assertEqual(editor.process.returncode, 0)

    def test_what_is_no_protocol_ends_with_an_error(self):
        result = subprocess.run([LAUNCH, 'lsp'], input=b'hello\r\n\r\n', capture_output=True, check=False)
        self.assertEqual((result.returncode, result.stderr), (1, b'launch lsp: error: a message has no Content-Length\n'))
        result = subprocess.run([LAUNCH, 'lsp'], input=b'', capture_output=True, check=False)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (1, b'', b''))

    def test_after_each_edit_the_diagnostics_are_those_of_a_check(self):
        pieces = ['<', '>', '"', '/>', '$(', '$(var x)', ')', '\n', '<node pkg="', 'é', '😀', '- ', ':', '</group>', '<!--', '&', '&lt;', '']
        draw = random.Random(7)
        editor = self.editor()
        for name, text in (('r.launch.xml', TOP), ('r.launch.yaml', 'launch:\n- arg:\n    name: a\n    default: b\n- log:\n    message: $(var a)\n')):
            editor.open(name, text)
            editor.diagnostics(name)
            for _ in range(25):
                begin = draw.randrange(len(text) + 1)
                end = min(len(text), begin + draw.randrange(4))
                piece = draw.choice(pieces)
                editor.change(name, {'range': {'start': self.place(text, begin), 'end': self.place(text, end)}, 'text': piece})
                text = text[:begin] + piece + text[end:]
                found = sorted((one['code'], one['message'].split('\n')[0]) for one in editor.diagnostics(name))
                (self.directory / name).write_text(text, newline='')
                checked = subprocess.run([LAUNCH, 'check', '--format', 'json', str(self.directory / name)], capture_output=True,
                                         check=False)
                self.assertEqual(found, sorted((one['id'], one['message']) for one in json.loads(checked.stdout)), text)
                place = self.place(text, begin)
                for method in ('completion', 'hover', 'definition', 'references', 'prepareRename'):
                    editor.at(method, name, place['line'], place['character'])

    @staticmethod
    def place(text, offset):
        begin = text.rfind('\n', 0, offset) + 1
        return {'line': text.count('\n', 0, offset), 'character': len(text[begin:offset].encode('utf-16-le')) // 2}


if __name__ == '__main__':
    unittest.main()
