// SPDX-License-Identifier: Apache-2.0
// Tasks of type "launch": to run, check and test launch files, with their errors in the list of problems.
'use strict';

const vscode = require('vscode');
const { PATTERN, hasTests, wordsOf } = require('./launch_files');

const MOST_FILES = 200;  // for which tasks are offered

const TITLES = { run: 'run', check: 'check', test: 'test' };

function taskOf(definition, program, scope = vscode.TaskScope.Workspace) {
  const { command, args } = program.commandLine(wordsOf(definition));
  const name = `${TITLES[definition.command || 'run']} ${definition.file}`;
  const task = new vscode.Task(definition, scope, name, 'launch', new vscode.ProcessExecution(command, args), ['$launch']);
  if (definition.command === 'check') {
    task.group = vscode.TaskGroup.Build;
  } else if (definition.command === 'test') {
    task.group = vscode.TaskGroup.Test;
  }
  return task;
}

class LaunchTasks {
  constructor(program) {
    this.program = program;
  }

  async provideTasks() {
    const files = await vscode.workspace.findFiles(PATTERN, '**/{build,install,log}/**', MOST_FILES);
    const tasks = [];
    for (const file of files) {
      const name = vscode.workspace.asRelativePath(file);
      const text = Buffer.from(await vscode.workspace.fs.readFile(file)).toString();
      const folder = vscode.workspace.getWorkspaceFolder(file);
      for (const command of hasTests(text) ? ['run', 'check', 'test'] : ['run', 'check']) {
        tasks.push(taskOf({ type: 'launch', file: name, command }, this.program(), folder));
      }
    }
    return tasks;
  }

  resolveTask(task) {
    return taskOf(task.definition, this.program(), task.scope);
  }
}

module.exports = { LaunchTasks, taskOf };
