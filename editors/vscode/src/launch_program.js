// SPDX-License-Identifier: Apache-2.0
// Runs the launch command, in the environment of a workspace.
'use strict';

const { execFile } = require('node:child_process');

// The largest output that is read of one command, in bytes: a report of a long recording is a few MiB.
const LARGEST_OUTPUT = 256 * 1024 * 1024;

class LaunchProgram {
  // `path`: the command; `setup`: a shell file that is sourced before, or empty; `directory`: where it runs.
  constructor({ path = 'launch', setup = '', directory = undefined } = {}) {
    this.path = path;
    this.setup = setup;
    this.directory = directory;
  }

  // The words of a command line, without a shell where none is needed.
  commandLine(words) {
    if (this.setup === '') {
      return { command: this.path, args: words };
    }
    return { command: 'bash', args: ['-c', '. "$0" && exec "$@"', this.setup, this.path, ...words] };
  }

  // Runs `launch WORDS` to its end. Never rejects: a command that can't be started has code -1 and says why in `errors`.
  run(words) {
    const { command, args } = this.commandLine(words);
    return new Promise((resolve) => {
      execFile(command, args, { cwd: this.directory, maxBuffer: LARGEST_OUTPUT }, (error, output, errors) => {
        const code = error ? (typeof error.code === 'number' ? error.code : -1) : 0;
        resolve({ code, output, errors: code === -1 && errors === '' ? this.whyNot(error) : errors });
      });
    });
  }

  whyNot(error) {
    if (error.code === 'ENOENT') {
      return `${this.path}: no such program. The setting launch.path names it, launch.setup the workspace that has it.`;
    }
    return error.message;
  }
}

module.exports = { LaunchProgram };
