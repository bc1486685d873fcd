// SPDX-License-Identifier: Apache-2.0
// The extension for Visual Studio Code, with the real launch command and a stand-in for the editor.
'use strict';

const assert = require('node:assert');
const { spawn } = require('node:child_process');
const fs = require('node:fs');
const Module = require('node:module');
const os = require('node:os');
const path = require('node:path');
const { after, before, test } = require('node:test');
const { makeStub } = require('./vscode_stub.cjs');

const ROOT = path.join(process.env.SOURCE_DIRECTORY, 'editors/vscode');
const LAUNCH = process.env.LAUNCH_PROGRAM;
const manifest = JSON.parse(fs.readFileSync(path.join(ROOT, 'package.json'), 'utf8'));
const directory = fs.mkdtempSync(path.join(os.tmpdir(), 'extension_test-'));
const clients = [];

before(() => {
  for (const name of ['home', 'run']) {
    fs.mkdirSync(path.join(directory, name), { mode: 0o700 });
  }
  Object.assign(process.env, { HOME: path.join(directory, 'home'), ROS_HOME: path.join(directory, 'home'),
                               XDG_RUNTIME_DIR: path.join(directory, 'run') });
});

after(() => fs.rmSync(directory, { recursive: true, force: true }));

// Loads a file of the extension with this stand-in for the editor, and one for the package of the language client.
function load(file, vscode) {
  class LanguageClient {
    constructor(id, name, server, options) {
      Object.assign(this, { id, name, server, options, running: false });
      clients.push(this);
    }

    async start() {
      this.running = true;
    }

    async stop() {
      this.running = false;
    }
  }
  const usual = Module._load;
  Module._load = (name, ...rest) => {
    if (name === 'vscode') {
      return vscode;
    }
    return name === 'vscode-languageclient/node' ? { LanguageClient } : usual(name, ...rest);
  };
  for (const known of Object.keys(require.cache).filter((name) => name.startsWith(ROOT))) {
    delete require.cache[known];
  }
  try {
    return require(path.join(ROOT, 'src', file));
  } finally {
    Module._load = usual;
  }
}

function write(name, text) {
  const file = path.join(directory, name);
  fs.writeFileSync(file, text);
  return file;
}

async function activated(options = {}) {
  const stub = makeStub({ settings: { path: LAUNCH }, folder: directory, ...options });
  const extension = load('extension.js', stub.vscode);
  const context = { subscriptions: [] };
  await extension.activate(context);
  return { ...stub, extension, context };
}

// Calls `question` again and again until its answer is one. A process that starts tells nobody of it but `launch ps`.
async function until(question) {
  for (;;) {
    const answer = await question();
    if (answer) {
      return answer;
    }
  }
}

const lines = (provider, items, depth = 0) => items.flatMap((item) => {
  const shown = provider.getTreeItem(item);
  return [`${'  '.repeat(depth)}${shown.label} | ${shown.description}`, ...lines(provider, provider.getChildren(item), depth + 1)];
});

test('each command of the manifest is there, and each that the extension has is in the manifest', async () => {
  const { seen, context } = await activated();
  assert.deepStrictEqual(Object.keys(seen.commands).sort(), manifest.contributes.commands.map(({ command }) => command).sort());
  assert.deepStrictEqual(Object.keys(seen.views).sort(), manifest.contributes.views.launch.map(({ id }) => id).sort());
  const known = new Set(Object.keys(seen.commands));
  for (const entry of Object.values(manifest.contributes.menus).flat()) {
    assert.ok(known.has(entry.command), entry.command);
  }
  assert.ok(context.subscriptions.every((one) => typeof one.dispose === 'function'));
});

test('the language server is the launch command of the settings', async () => {
  const { extension } = await activated({ settings: { path: '/opt/launch/bin/launch', setup: '/ws/install/setup.bash', runPython: true } });
  const client = clients.at(-1);
  assert.deepStrictEqual(client.server, { command: 'bash', args: ['-c', '. "$0" && exec "$@"', '/ws/install/setup.bash',
                                                                  '/opt/launch/bin/launch', 'lsp'] });
  assert.deepStrictEqual(client.options.initializationOptions, { runPython: true });
  assert.deepStrictEqual(client.options.documentSelector, [{ scheme: 'file', pattern: '**/*launch.{xml,yaml,yml,py}' }]);
  assert.ok(client.running);
  await extension.deactivate();
  assert.ok(!client.running);
});

test('the setting launch.setup is sourced before the command', async () => {
  const { LaunchProgram } = load('launch_program.js');
  const setup = write('setup.bash', 'export GREETING="two words"\n');
  const program = new LaunchProgram({ path: 'printenv', setup });
  assert.deepStrictEqual(await program.run(['GREETING']), { code: 0, output: 'two words\n', errors: '' });
});

test('a command that is not there is named, with the setting that names it', async () => {
  const { LaunchProgram } = load('launch_program.js');
  const { code, errors } = await new LaunchProgram({ path: '/nowhere/launch' }).run(['ps']);
  assert.strictEqual(code, -1);
  assert.strictEqual(errors, '/nowhere/launch: no such program. The setting launch.path names it, launch.setup the workspace that has it.');
});

test('the launch tree shows what a file starts, by file', async () => {
  write('inner.launch.xml', '<launch><executable cmd="sleep 100" name="napper"/></launch>');
  const file = write('outer.launch.xml', `<launch>
  <include file="$(dirname)/inner.launch.xml"/>
  <executable cmd="true" name="first"/>
  <executable cmd="false" name="second"/>
</launch>`);
  const { vscode, seen } = await activated();
  const { provider } = seen.views['launch.tree'];
  await provider.showFile(file);
  assert.deepStrictEqual(lines(provider, provider.getChildren()), [
    'outer.launch.xml | 2 processes', '  first | true', '  second | false', 'inner.launch.xml | 1 process', '  napper | sleep 100']);
  const [napper] = provider.getChildren(provider.getChildren()[1]);
  await seen.commands['launch.running.open'](napper);
  assert.strictEqual(seen.opened[0].uri.fsPath, path.join(directory, 'inner.launch.xml'));
  assert.deepStrictEqual(seen.opened[0].options.selection.start, new vscode.Position(0, 0));
});

test('the launch tree says why a file does not start', async () => {
  const file = write('wrong.launch.xml', '<launch>\n  <nod/>\n</launch>\n');
  const { seen } = await activated();
  const { provider } = seen.views['launch.tree'];
  await provider.showFile(file);
  assert.deepStrictEqual(lines(provider, provider.getChildren()),
                         [`It does not start | wrong.launch.xml:2:4: error: unrecognized entity of the type 'nod'`]);
});

test('a Python file does not run for the tree unless the setting allows it', async () => {
  const file = write('program.launch.py', `from launch import LaunchDescription
from launch.actions import ExecuteProcess
open(${JSON.stringify(path.join(directory, 'has_run'))}, 'w').close()
def generate_launch_description():
    return LaunchDescription([ExecuteProcess(cmd=['true'], name='only')])
`);
  let { seen } = await activated();
  let { provider } = seen.views['launch.tree'];
  await provider.showFile(file);
  assert.deepStrictEqual(lines(provider, provider.getChildren()),
                         ['A Python launch file is a program | the setting launch.runPython allows to run it for this']);
  assert.ok(!fs.existsSync(path.join(directory, 'has_run')));
  ({ seen } = await activated({ settings: { path: LAUNCH, runPython: true } }));
  ({ provider } = seen.views['launch.tree']);
  await provider.showFile(file);
  assert.deepStrictEqual(lines(provider, provider.getChildren()), ['program.launch.py | 1 process', '  only | true']);
});

test('the launches that run are shown, steered and ended', async () => {
  const file = write('runs.launch.xml', `<launch>
  <executable cmd="sleep 1000" name="napper"/>
  <executable cmd="true" name="short"/>
  <executable cmd="sleep 1000" name="other"/>
</launch>`);
  const { seen } = await activated();
  const { provider } = seen.views['launch.running'];
  // Root sees the launches of others, such as those of tests beside.
  const own = () => provider.getChildren().filter((item) => item.label === 'runs.launch.xml');
  await provider.refresh();
  assert.deepStrictEqual(own(), []);
  const launch = spawn(LAUNCH, [file], { stdio: 'ignore' });
  const ended = new Promise((resolve) => launch.on('exit', resolve));
  const state = (name) => {
    const item = own().flatMap((one) => one.children).find((one) => one.name === name);
    return item && { item, kind: item.kind, detail: item.detail };
  };
  await until(async () => {
    await provider.refresh();
    return state('napper-1')?.detail.startsWith('running') && state('short-2')?.kind === 'process.down';
  });
  const [running] = own();
  assert.strictEqual(running.label, 'runs.launch.xml');
  assert.match(running.detail, /^\d+, running for 0:\d\d$/);
  assert.match(state('napper-1').detail, /^running, \d+\.\d %, \d+\.\d MiB$/);
  assert.match(state('short-2').detail, /^ended/);

  await seen.commands['launch.running.restart'](state('napper-1').item);
  assert.match(state('napper-1').detail, /^running, .*, 1 restart$/);
  await seen.commands['launch.running.stop'](state('napper-1').item);
  assert.strictEqual(state('napper-1').kind, 'process.down');
  await seen.commands['launch.running.start'](state('napper-1').item);
  assert.strictEqual(state('napper-1').kind, 'process.up');
  await seen.commands['launch.running.signal'](state('napper-1').item);  // the stand-in chooses SIGUSR1
  await until(async () => {
    await provider.refresh();
    return state('napper-1').kind === 'process.down';
  });
  seen.commands['launch.running.logs'](state('napper-1').item);
  assert.deepStrictEqual(seen.terminals[0].shellArgs, ['logs', '-f', '--launch', String(running.launch), 'napper-1']);
  await seen.commands['launch.running.stop']({ ...state('napper-1').item, name: 'nobody' });
  assert.match(seen.errors.at(-1), /nobody/);
  await seen.commands['launch.running.shutdown'](running);
  await ended;
  assert.deepStrictEqual(own(), []);
});

test('tasks run, check and test the launch files of the workspace', async () => {
  const plain = write('plain.launch.xml', '<launch/>');
  const tested = write('tested.launch.yaml', 'launch:\n- test:\n    name: starts\n');
  const { seen } = await activated({ files: [plain, tested] });
  const tasks = await seen.providers.launch.provideTasks();
  assert.deepStrictEqual(tasks.map((task) => [task.name, ...task.execution.args]), [
    ['run plain.launch.xml', 'plain.launch.xml'],
    ['check plain.launch.xml', 'check', 'plain.launch.xml'],
    ['run tested.launch.yaml', 'tested.launch.yaml'],
    ['check tested.launch.yaml', 'check', 'tested.launch.yaml'],
    ['test tested.launch.yaml', 'test', 'tested.launch.yaml']]);
  assert.ok(tasks.every((task) => task.execution.process === LAUNCH && task.problemMatchers[0] === '$launch'));
  const own = seen.providers.launch.resolveTask({ definition: { type: 'launch', file: 'a.launch.xml', arguments: ['rate:=5'] } });
  assert.deepStrictEqual(own.execution.args, ['a.launch.xml', 'rate:=5']);
  await seen.commands['launch.check']({ fsPath: plain });
  assert.deepStrictEqual(seen.executed[0].execution.args, ['check', plain]);
  await seen.commands['launch.run'](`file://${plain}`);
  assert.deepStrictEqual(seen.executed[1].execution.args, [plain]);
});

test('a task of an unknown command is an error', () => {
  const { wordsOf } = load('launch_files.js');
  assert.throws(() => wordsOf({ command: 'fly', file: 'a.launch.xml' }),
                new Error('a launch task has the command "fly": run, check and test are known'));
});

test('the problem matcher finds the errors that the commands print', async () => {
  const { LaunchProgram } = load('launch_program.js');
  const [{ pattern }] = manifest.contributes.problemMatchers;
  const file = write('problems.launch.xml', '<launch>\n  <arg name="unused"/>\n  <nod/>\n</launch>\n');
  for (const [words, code] of [[['check', file], 'LF0101'], [[file], undefined]]) {
    const { output, errors } = await new LaunchProgram({ path: LAUNCH }).run(words);
    const found = (output + errors).split('\n').map((line) => new RegExp(pattern.regexp).exec(line)).find(
      (match) => match && match[pattern.severity] === 'error');
    assert.ok(found, output + errors);
    assert.deepStrictEqual([pattern.file, pattern.line, pattern.column, pattern.message, pattern.code].map((group) => found[group]),
                           [file, '3', '4', "unrecognized entity of the type 'nod'", code]);
  }
});

test('graphs and reports are shown in tabs that load nothing', async () => {
  const file = write('drawn.launch.xml', '<launch><executable cmd="true" name="drawn"/></launch>');
  const { seen } = await activated();
  await seen.commands['launch.graph']({ fsPath: file });
  const [graph] = seen.tabs;
  assert.strictEqual(graph.options.enableScripts, false);
  const svg = Buffer.from(/base64,([^"]+)/.exec(graph.webview.html)[1], 'base64').toString();
  assert.match(svg, /drawn/);
  await seen.commands['launch.report']({ fsPath: path.join(directory, 'no_trace') });
  assert.strictEqual(seen.tabs.length, 1);
  assert.match(seen.errors[0], /no_trace/);
  await seen.commands['launch.report']({ fsPath: process.env.EXAMPLE_TRACE });
  assert.match(seen.tabs[1].webview.html, /<head><meta http-equiv="Content-Security-Policy" content="default-src 'none'/);
  assert.doesNotMatch(seen.tabs[1].webview.html, /(src|href)="https?:/);
});

test('substitutions have the scopes of the grammar', async (context) => {
  const modules = path.join(process.env.SOURCE_DIRECTORY, 'build/editor/vscode/node_modules');
  if (!fs.existsSync(path.join(modules, 'vscode-textmate'))) {
    context.skip('because the packages of npm are not installed: ./dev editor');
    return;
  }
  const { Registry } = require(path.join(modules, 'vscode-textmate'));
  const oniguruma = require(path.join(modules, 'vscode-oniguruma'));
  await oniguruma.loadWASM(fs.readFileSync(path.join(modules, 'vscode-oniguruma/release/onig.wasm')).buffer);
  const injection = JSON.parse(fs.readFileSync(path.join(ROOT, 'syntaxes/substitution.injection.json'), 'utf8'));
  const xml = { scopeName: 'text.xml', patterns: [{ name: 'string.quoted.double.xml', begin: '"', end: '"' }] };
  const registry = new Registry({
    onigLib: Promise.resolve({ createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
                               createOnigString: (text) => new oniguruma.OnigString(text) }),
    loadGrammar: async (name) => ({ 'text.xml': xml, [injection.scopeName]: injection })[name],
    getInjections: (name) => (name === 'text.xml' ? [injection.scopeName] : undefined),
  });
  const grammar = await registry.loadGrammar('text.xml');
  const line = '<node exec="$(var which) $(find-pkg-share $(var \'p q\'))x" if="$(eval \'1 > 0\')"/> $(var outside)';
  const scopes = grammar.tokenizeLine(line).tokens
    .map(({ startIndex, endIndex, scopes: all }) => [line.slice(startIndex, endIndex), all.at(-1)])
    .filter(([, scope]) => scope.endsWith('.launch') && !scope.startsWith('meta') && !scope.startsWith('punctuation'));
  assert.deepStrictEqual(scopes.filter(([, scope]) => scope.startsWith('support')).map(([text]) => text),
                         ['var', 'find-pkg-share', 'var', 'eval']);
  assert.deepStrictEqual(scopes.filter(([, scope]) => scope.startsWith('variable')).map(([text]) => text), ['which']);
});
