// SPDX-License-Identifier: Apache-2.0
// The launches that run and their processes, as `launch ps --json` tells them (docs/control.md).
'use strict';

const path = require('node:path');

const DOWN = ['ended', 'skipped'];

const megabytes = (bytes) => `${(bytes / (1024 * 1024)).toFixed(1)} MiB`;

// `12:05`, `3:00:01`: as `launch ps` prints it.
function duration(seconds) {
  const whole = Math.floor(seconds);
  const two = (number) => String(number).padStart(2, '0');
  const minutes = Math.floor(whole / 60);
  const rest = two(whole % 60);
  return minutes < 60 ? `${minutes}:${rest}` : `${Math.floor(minutes / 60)}:${two(minutes % 60)}:${rest}`;
}

function processItem(process, launch) {
  const isDown = DOWN.some((state) => process.state.startsWith(state));
  const parts = [process.state];
  if (!isDown && process.pid) {
    parts.push(`${(100 * (process.cpu || 0) / Math.max(process.running_for || 0, 0.001)).toFixed(1)} %`);
    if (process.memory) {
      parts.push(megabytes(process.memory));
    }
  }
  if (process.restarts > 0) {
    parts.push(process.restarts === 1 ? '1 restart' : `${process.restarts} restarts`);
  }
  return {
    kind: isDown ? 'process.down' : 'process.up',
    name: process.name,
    launch,
    pid: process.pid,
    label: process.name,
    detail: parts.join(', '),
    icon: iconOf(process.state),
    place: process.place,
    children: [],
  };
}

function iconOf(state) {
  if (/unhealthy|exit code [^0]|signal|crash/.test(state)) {
    return 'error';
  }
  if (state.startsWith('running')) {
    return 'play-circle';
  }
  return DOWN.some((one) => state.startsWith(one)) ? 'circle-slash' : 'clock';
}

// `document`: the parsed output of `launch ps --json`.
function launchesOf(document) {
  return (document.launches || []).map(({ launch, processes }) => ({
    kind: 'launch',
    launch: launch.pid,
    name: String(launch.pid),
    label: (launch.files || []).map((file) => path.basename(file)).join(' ') || String(launch.pid),
    detail: `${launch.pid}, ${launch.state} for ${duration(launch.running_for)}`,
    icon: 'rocket',
    place: launch.files && launch.files.length > 0 ? { file: launch.files[0], line: 1, column: 1 } : undefined,
    children: (processes || []).map((process) => processItem(process, launch.pid)),
  }));
}

// The words of `launch` that do something with an item.
function wordsFor(action, item, more = []) {
  const of = ['--launch', String(item.launch)];
  switch (action) {
    case 'shutdown':
      return ['shutdown', ...of];
    case 'reload':
      return ['reload', String(item.launch)];
    case 'logs':
      return ['logs', '-f', ...of, item.name];
    case 'stop':
    case 'start':
    case 'restart':
    case 'signal':
      return [action, ...of, item.name, ...more];
    default:
      throw new Error(`nothing is known of "${action}"`);
  }
}

module.exports = { launchesOf, wordsFor, duration };
