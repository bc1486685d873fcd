// SPDX-License-Identifier: Apache-2.0
// The two trees of the side bar: what a launch file starts, and the launches that run.
'use strict';

const vscode = require('vscode');
const { isLaunchFile, isPython } = require('./launch_files');
const { launchesOf } = require('./running_launches');
const { treeOf } = require('./launch_tree');

const REFRESH_MS = 2000;  // of the launches that run, while they are shown

class ItemTree {
  constructor() {
    this.items = [];
    this.changed = new vscode.EventEmitter();
    this.onDidChangeTreeData = this.changed.event;
  }

  show(items) {
    this.items = items;
    this.changed.fire();
  }

  getChildren(item) {
    return item ? item.children : this.items;
  }

  getTreeItem(item) {
    const hasChildren = item.children.length > 0;
    const shown = new vscode.TreeItem(
      item.label, hasChildren ? vscode.TreeItemCollapsibleState.Expanded : vscode.TreeItemCollapsibleState.None);
    shown.description = item.detail;
    shown.tooltip = item.detail ? `${item.label}: ${item.detail}` : item.label;
    shown.iconPath = new vscode.ThemeIcon(item.icon);
    shown.contextValue = item.kind;
    shown.id = item.kind ? `${item.launch} ${item.kind === 'launch' ? '' : item.name}` : undefined;
    if (item.place && item.place.file) {
      shown.command = { command: 'launch.running.open', title: 'Go to its place', arguments: [item] };
    }
    return shown;
  }
}

// What the launch file in the active editor starts.
class LaunchFileView extends ItemTree {
  // `program()`: the LaunchProgram of the settings of now; `mayRunPython()`: whether a Python file may run for it.
  constructor(program, mayRunPython) {
    super();
    this.program = program;
    this.mayRunPython = mayRunPython;
    this.file = undefined;
    this.asked = 0;
  }

  async showFile(file) {
    if (!isLaunchFile(file)) {
      return;  // another editor: the tree of the last launch file stays
    }
    this.file = file;
    if (isPython(file) && !this.mayRunPython()) {
      this.show([{ label: 'A Python launch file is a program', detail: 'the setting launch.runPython allows to run it for this',
                   icon: 'info', children: [] }]);
      return;
    }
    const asked = ++this.asked;
    const { output, errors } = await this.program().run(['--dry-run=json', file]);
    if (asked !== this.asked) {
      return;  // a later question has been asked
    }
    this.show(this.itemsOf(file, output, errors));
  }

  itemsOf(file, output, errors) {
    try {
      return treeOf(file, JSON.parse(output));
    } catch {
      const line = errors.split('\n').find((one) => one !== '') || 'no answer';
      return [{ label: 'It does not start', detail: line, icon: 'error', children: [] }];
    }
  }
}

// The launches that run. Asked every two seconds while they are shown, and after each command.
class RunningView extends ItemTree {
  constructor(program) {
    super();
    this.program = program;
    this.timer = undefined;
    this.shown = '';
  }

  setVisible(visible) {
    clearInterval(this.timer);
    this.timer = visible ? setInterval(() => this.refresh(), REFRESH_MS) : undefined;
    if (visible) {
      this.refresh();
    }
  }

  async refresh() {
    const { output } = await this.program().run(['ps', '--json']);
    let items = [];
    try {
      items = launchesOf(JSON.parse(output));
    } catch {
      // No launch runs: the command prints nothing.
    }
    const text = JSON.stringify(items);
    if (text !== this.shown) {
      this.shown = text;
      this.show(items);
    }
  }

  dispose() {
    clearInterval(this.timer);
  }
}

module.exports = { LaunchFileView, RunningView };
