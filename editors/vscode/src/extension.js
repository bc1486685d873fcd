// SPDX-License-Identifier: Apache-2.0
// What the editor calls: activate() makes everything, deactivate() ends the language server.
'use strict';

const vscode = require('vscode');
const { isLaunchFile } = require('./launch_files');
const { LaunchProgram } = require('./launch_program');
const { makeClient } = require('./language_client');
const { showGraph, showReport } = require('./pages');
const { wordsFor } = require('./running_launches');
const { LaunchTasks, taskOf } = require('./tasks');
const { LaunchFileView, RunningView } = require('./views');

let client;

const settings = () => vscode.workspace.getConfiguration('launch');

function program() {
  const folders = vscode.workspace.workspaceFolders;
  return new LaunchProgram({ path: settings().get('path', 'launch'), setup: settings().get('setup', ''),
                             directory: folders && folders.length > 0 ? folders[0].uri.fsPath : undefined });
}

async function startServer() {
  client = makeClient(program(), settings().get('runPython', false));
  try {
    await client.start();
  } catch (error) {
    vscode.window.showErrorMessage(
      `The language server of launch files does not start: ${error.message}. The setting launch.path names the launch command.`);
  }
}

async function restartServer() {
  if (client) {
    await client.stop().catch(() => {});  // one that never started can't be stopped
  }
  await startServer();
}

// The launch file that a command is for: the one that it was given, that of the active editor, or one that is asked for.
async function fileFor(given) {
  if (typeof given === 'string') {
    return given.startsWith('file:') ? vscode.Uri.parse(given).fsPath : given;
  }
  if (given && given.fsPath) {
    return given.fsPath;
  }
  const editor = vscode.window.activeTextEditor;
  if (editor && isLaunchFile(editor.document.uri.fsPath)) {
    return editor.document.uri.fsPath;
  }
  const chosen = await vscode.window.showOpenDialog({ title: 'Launch file', filters: { 'Launch files': ['xml', 'yaml', 'yml', 'py'] } });
  return chosen && chosen[0].fsPath;
}

async function execute(command, given) {
  const file = await fileFor(given);
  if (file) {
    const editor = vscode.window.activeTextEditor;
    if (editor && editor.document.uri.fsPath === file && editor.document.isDirty) {
      await editor.document.save();
    }
    await vscode.tasks.executeTask(taskOf({ type: 'launch', command, file }, program()));
  }
}

async function open(item) {
  const { file, line = 1, column = 1 } = item.place || {};
  if (file) {
    const at = new vscode.Position(Math.max(line - 1, 0), Math.max(column - 1, 0));
    await vscode.window.showTextDocument(vscode.Uri.file(file), { selection: new vscode.Range(at, at) });
  }
}

async function steer(running, action, item, more = []) {
  const { code, errors } = await program().run(wordsFor(action, item, more));
  if (code !== 0) {
    vscode.window.showErrorMessage(errors.trim() || `launch ${action} has failed`);
  }
  await running.refresh();
}

async function signal(running, item) {
  const name = await vscode.window.showQuickPick(['SIGINT', 'SIGTERM', 'SIGHUP', 'SIGUSR1', 'SIGUSR2', 'SIGSTOP', 'SIGCONT', 'SIGKILL'],
                                                 { title: `Signal for ${item.name}` });
  if (name) {
    await steer(running, 'signal', item, [name]);
  }
}

function logs(item) {
  const { command, args } = program().commandLine(wordsFor('logs', item));
  vscode.window.createTerminal({ name: item.label, shellPath: command, shellArgs: args }).show();
}

async function report(given) {
  const chosen = given && given.fsPath ? [given]
    : await vscode.window.showOpenDialog({ title: 'Directory of a trace', canSelectFiles: false, canSelectFolders: true });
  if (chosen) {
    await vscode.window.withProgress({ location: vscode.ProgressLocation.Notification, title: 'Reading the trace' },
                                     () => showReport(program(), chosen[0].fsPath));
  }
}

async function graph(given) {
  const file = await fileFor(given);
  if (file) {
    await showGraph(program(), 'Launch graph', [file]);
  }
}

async function activate(context) {
  const tree = new LaunchFileView(program, () => settings().get('runPython', false));
  const running = new RunningView(program);
  const shown = vscode.window.createTreeView('launch.running', { treeDataProvider: running });
  const showEditor = (editor) => editor && tree.showFile(editor.document.uri.fsPath);
  const commands = {
    'launch.run': (given) => execute('run', given),
    'launch.check': (given) => execute('check', given),
    'launch.test': (given) => execute('test', given),
    'launch.graph': graph,
    'launch.liveGraph': () => showGraph(program(), 'What runs now', ['--live']),
    'launch.report': report,
    'launch.restartServer': restartServer,
    'launch.tree.refresh': () => tree.file && tree.showFile(tree.file),
    'launch.running.refresh': () => running.refresh(),
    'launch.running.stop': (item) => steer(running, 'stop', item),
    'launch.running.start': (item) => steer(running, 'start', item),
    'launch.running.restart': (item) => steer(running, 'restart', item),
    'launch.running.reload': (item) => steer(running, 'reload', item),
    'launch.running.shutdown': (item) => steer(running, 'shutdown', item),
    'launch.running.signal': (item) => signal(running, item),
    'launch.running.logs': logs,
    'launch.running.open': open,
  };
  context.subscriptions.push(
    shown, running,
    shown.onDidChangeVisibility(({ visible }) => running.setVisible(visible)),
    vscode.window.createTreeView('launch.tree', { treeDataProvider: tree }),
    vscode.window.onDidChangeActiveTextEditor(showEditor),
    vscode.workspace.onDidSaveTextDocument((document) => document.uri.fsPath === tree.file && tree.showFile(tree.file)),
    vscode.workspace.onDidChangeConfiguration((change) => change.affectsConfiguration('launch') && restartServer()),
    vscode.tasks.registerTaskProvider('launch', new LaunchTasks(program)),
    ...Object.entries(commands).map(([name, run]) => vscode.commands.registerCommand(name, run)));
  running.setVisible(shown.visible);
  showEditor(vscode.window.activeTextEditor);
  await startServer();
}

const deactivate = () => client && client.stop().catch(() => {});

module.exports = { activate, deactivate };
