// SPDX-License-Identifier: Apache-2.0
// The part of the interface of Visual Studio Code that the extension uses. It keeps what the extension registers and shows.
'use strict';

class EventEmitter {
  constructor() {
    this.listeners = [];
    this.event = (listener) => {
      this.listeners.push(listener);
      return { dispose() {} };
    };
  }

  fire(value) {
    return Promise.all(this.listeners.map((listener) => listener(value)));
  }
}

class Uri {
  constructor(path) {
    this.fsPath = path;
  }

  static file(path) {
    return new Uri(path);
  }

  static parse(text) {
    return new Uri(decodeURIComponent(new URL(text).pathname));
  }
}

class TreeItem {
  constructor(label, collapsibleState) {
    Object.assign(this, { label, collapsibleState });
  }
}

class Task {
  constructor(definition, scope, name, source, execution, problemMatchers) {
    Object.assign(this, { definition, scope, name, source, execution, problemMatchers });
  }
}

class ProcessExecution {
  constructor(process, args) {
    Object.assign(this, { process, args });
  }
}

class ThemeIcon {
  constructor(id) {
    this.id = id;
  }
}

class Position {
  constructor(line, character) {
    Object.assign(this, { line, character });
  }
}

class Range {
  constructor(start, end) {
    Object.assign(this, { start, end });
  }
}

// `settings`: of the section `launch`; `folder`: of the workspace; `files`: its launch files.
function makeStub({ settings = {}, folder, files = [] }) {
  const seen = { commands: {}, views: {}, providers: {}, errors: [], tabs: [], terminals: [], executed: [], opened: [], saved: [] };
  const events = { editor: new EventEmitter(), save: new EventEmitter(), configuration: new EventEmitter() };
  const vscode = {
    EventEmitter, Uri, TreeItem, Task, ProcessExecution, ThemeIcon, Position, Range,
    TreeItemCollapsibleState: { None: 0, Collapsed: 1, Expanded: 2 },
    TaskScope: { Workspace: 2 },
    TaskGroup: { Build: 'build', Test: 'test' },
    ViewColumn: { Active: -1 },
    ProgressLocation: { Notification: 15 },
    commands: {
      registerCommand(name, run) {
        seen.commands[name] = run;
        return { dispose() {} };
      },
    },
    tasks: {
      registerTaskProvider(type, provider) {
        seen.providers[type] = provider;
        return { dispose() {} };
      },
      executeTask: async (task) => seen.executed.push(task),
    },
    window: {
      activeTextEditor: undefined,
      onDidChangeActiveTextEditor: events.editor.event,
      createTreeView(id, { treeDataProvider }) {
        const visibility = new EventEmitter();
        seen.views[id] = { provider: treeDataProvider, visibility };
        return { visible: false, onDidChangeVisibility: visibility.event, dispose() {} };
      },
      createWebviewPanel(type, title, column, options) {
        const panel = { title, options, webview: { html: '' } };
        seen.tabs.push(panel);
        return panel;
      },
      createTerminal(options) {
        seen.terminals.push(options);
        return { show() {} };
      },
      showErrorMessage: (text) => seen.errors.push(text),
      showOpenDialog: async () => undefined,
      showQuickPick: async (choices) => choices[3],
      showTextDocument: async (uri, options) => seen.opened.push({ uri, options }),
      withProgress: (options, run) => run(),
    },
    workspace: {
      workspaceFolders: folder ? [{ uri: Uri.file(folder) }] : undefined,
      getConfiguration: () => ({ get: (name, otherwise) => (name in settings ? settings[name] : otherwise) }),
      onDidSaveTextDocument: events.save.event,
      onDidChangeConfiguration: events.configuration.event,
      findFiles: async () => files.map((file) => Uri.file(file)),
      asRelativePath: (uri) => uri.fsPath.replace(`${folder}/`, ''),
      getWorkspaceFolder: () => undefined,
      fs: { readFile: async (uri) => require('node:fs').readFileSync(uri.fsPath) },
    },
  };
  return { vscode, seen, events };
}

module.exports = { makeStub };
