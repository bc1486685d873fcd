// SPDX-License-Identifier: Apache-2.0
// The connection with the language server, `launch lsp`.
'use strict';

const { LanguageClient } = require('vscode-languageclient/node');
const { PATTERN } = require('./launch_files');

// `program`: the LaunchProgram; `runPython`: whether the server may run Python launch files.
function makeClient(program, runPython) {
  const { command, args } = program.commandLine(['lsp']);
  return new LanguageClient('launch', 'Launch files', { command, args }, {
    documentSelector: [{ scheme: 'file', pattern: PATTERN }],
    initializationOptions: { runPython },
    outputChannelName: 'Launch files',
  });
}

module.exports = { makeClient };
