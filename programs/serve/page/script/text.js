// SPDX-License-Identifier: Apache-2.0
// How numbers, states and events are written, as `launch ps` writes them.

function memoryText(bytes) {
  let value = bytes / 1024;
  let unit = 'KiB';
  for (const larger of ['MiB', 'GiB', 'TiB']) {
    if (value >= 1024) {
      value /= 1024;
      unit = larger;
    }
  }
  return `${value.toFixed(1)} ${unit}`;
}

function durationText(seconds) {
  const whole = Math.max(0, Math.floor(seconds));
  const two = number => String(number).padStart(2, '0');
  const hours = Math.floor(whole / 3600);
  const rest = `${hours ? two(Math.floor(whole / 60) % 60) : Math.floor(whole / 60)}:${two(whole % 60)}`;
  if (hours >= 24) {
    return `${Math.floor(hours / 24)} d ${hours % 24}:${two(Math.floor(whole / 60) % 60)}`;
  }
  return hours ? `${hours}:${rest}` : rest;
}

function endText(end) {
  return end.signal ?? `exit code ${end.exit_code}`;
}

function stateText(process) {
  if (process.state === 'running' && process.health) {
    return `running, ${process.health}`;
  }
  return process.state === 'ended' && process.last_end ? `ended: ${endText(process.last_end)}` : process.state;
}

// The class of the badge of a process.
function stateClass(process) {
  if (process.state === 'running') {
    return process.health === 'unhealthy' ? 'bad' : process.health === 'starting' ? '' : 'good';
  }
  if (process.state === 'ended' || process.state === 'skipped') {
    return process.last_end && (process.last_end.signal || process.last_end.exit_code) ? 'bad' : 'idle';
  }
  return process.state === 'waiting' ? 'idle' : '';
}

function filesText(launch) {
  return (launch.files ?? []).map(file => file.slice(file.lastIndexOf('/') + 1)).join(', ') || 'launch';
}

const EVENT_TEXTS = {
  started: event => `${event.process} has started, PID ${event.pid}`,
  start_failed: event => `${event.process} could not be started: ${event.error}`,
  signalled: event => `${event.process} got ${event.signal}`,
  exited: event => `${event.process} has ended: ${endText(event)}${event.expected ? ', as asked' : ''}`,
  left_running: event => `${event.process} could not be ended`,
  respawn_slowed: event => `${event.process} has ended at once ${event.runs} times`,
  health: event => `${event.process} is ${event.health}${event.reason ? `: ${event.reason}` : ''}`,
  start_limit: event => `${event.process} was started ${event.starts} times, and is given up`,
  waits_for_terminal: event => `${event.process} waits for the terminal`,
  done: event => `${event.process} will not start again by itself`,
  ending: event => `the launch ends: ${event.reason}`,
  dropped: event => `${event.lines} lines came too fast`,
};

function eventText(event) {
  return EVENT_TEXTS[event.event]?.(event) ?? `${event.event} ${event.process ?? ''}`;
}

function isBad(event) {
  return ['start_failed', 'left_running', 'start_limit', 'respawn_slowed'].includes(event.event) ||
    event.event === 'exited' && !event.expected && Boolean(event.signal || event.exit_code) ||
    event.event === 'health' && event.health === 'unhealthy';
}
