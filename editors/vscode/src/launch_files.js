// SPDX-License-Identifier: Apache-2.0
// Which files are launch files, and what can be done with them.
'use strict';

const PATTERN = '**/*launch.{xml,yaml,yml,py}';
const NAME = /launch\.(xml|ya?ml|py)$/;

const isLaunchFile = (path) => NAME.test(path);

const isPython = (path) => path.endsWith('.py');

// Whether it may hold tests: `<test name="…">`, or `- test:` in YAML.
const hasTests = (text) => /<test[\s>]|^\s*-\s*test\s*:/m.test(text);

// The words of `launch` for a task.
function wordsOf({ command = 'run', file, arguments: given = [] }) {
  const before = { run: [], check: ['check'], test: ['test'] }[command];
  if (before === undefined) {
    throw new Error(`a launch task has the command "${command}": run, check and test are known`);
  }
  return [...before, file, ...given];
}

module.exports = { PATTERN, isLaunchFile, isPython, hasTests, wordsOf };
