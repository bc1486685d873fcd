// SPDX-License-Identifier: Apache-2.0
// The table of processes. Its rows stay the same elements, so that the focus and a finger stay where they are.

const SPARK_POINTS = 60;
const COLUMNS = [
  ['name text', ''], ['state text', ''], ['pid number', 'PID'], ['cpu number', 'CPU'], ['memory number', 'Memory'],
  ['restarts number', 'Restarts'], ['lines number', 'Lines/s'], ['time number', 'Time'], ['steering', ''],
];
const VERBS = [['start', 'Start'], ['restart', 'Restart'], ['stop', 'Stop']];

function byId(id) {
  return document.getElementById(id);
}

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

function svg(tag, attributes) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) {
    made.setAttribute(name, value);
  }
  return made;
}

// Writes only what has changed: a text that is marked stays marked.
function setText(target, text) {
  if (target.textContent !== text) {
    target.textContent = text;
  }
}

class ProcessTable {
  // `choose(name)` and `steer(verb, name)` are called for what the user presses.
  constructor(body, choose, steer) {
    this.body = body;
    this.choose = choose;
    this.steer = steer;
    this.rows = new Map();
    this.search = '';
    this.chosen = '';
    this.steers = false;
  }

  clear() {
    this.body.replaceChildren();
    this.rows.clear();
  }

  // `answer` is what the event "ps" has.
  update(answer) {
    const names = new Set(answer.processes.map(process => process.name));
    for (const [name, row] of this.rows) {
      if (!names.has(name)) {
        row.line.remove();
        this.rows.delete(name);
      }
    }
    for (const process of answer.processes) {
      const row = this.rows.get(process.name) ?? this.addRow(process.name);
      this.updateRow(row, process, answer.time);
    }
    this.show();
  }

  addRow(name) {
    const cells = COLUMNS.map(([kind, label]) => {
      const cell = element('td', {className: kind});
      cell.dataset.label = label;
      return cell;
    });
    const title = element('button', {type: 'button', title: 'Shows what it prints'}, name);
    title.addEventListener('click', () => this.choose(name));
    cells[0].append(title);
    const badge = element('span', {className: 'badge'});
    cells[1].append(badge);
    const spark = svg('polyline', {points: ''});
    const picture = svg('svg', {viewBox: '0 0 60 16', preserveAspectRatio: 'none', 'aria-hidden': 'true'});
    picture.append(spark);
    const cpu = element('span');
    cells[3].append(picture, cpu);
    const buttons = VERBS.map(([verb, label]) => {
      const button = element('button', {type: 'button'}, label);
      button.dataset.verb = verb;
      button.setAttribute('aria-label', `${label} ${name}`);
      button.addEventListener('click', () => this.steer(verb, name));
      return button;
    });
    cells[8].append(element('div', {}, ...buttons));
    const line = element('tr', {}, ...cells);
    line.dataset.process = name;
    this.body.append(line);
    const row = {line, cells, title, badge, spark, cpu, buttons, used: [], before: null};
    this.rows.set(name, row);
    return row;
  }

  updateRow(row, process, time) {
    const runs = process.pid > 0;
    const {before} = row;
    const passed = before && before.pid === process.pid ? time - before.time : 0;
    const used = runs && passed > 0 ? Math.max(0, (process.cpu - before.cpu) / passed * 100) : null;
    const lines = before ? Math.max(0, ((process.lines ?? 0) - before.lines) / Math.max(time - before.time, 0.001)) : 0;
    row.before = {time, pid: process.pid, cpu: process.cpu ?? 0, lines: process.lines ?? 0};
    row.state = stateText(process);
    row.usage = {cpu: used ?? 0, memory: runs ? process.memory ?? 0 : 0};
    setText(row.badge, row.state);
    row.badge.className = `badge ${stateClass(process)}`;
    row.badge.title = process.health_reason ?? '';
    setText(row.cells[2], runs ? String(process.pid) : '-');
    setText(row.cpu, used === null ? '-' : `${used.toFixed(1)} %`);
    setText(row.cells[4], runs && process.memory !== undefined ? memoryText(process.memory) : '-');
    setText(row.cells[5], process.restarts >= 0 ? String(process.restarts) : '-');
    setText(row.cells[6], runs ? lines.toFixed(lines < 10 ? 1 : 0) : '-');
    setText(row.cells[7], runs ? durationText(process.running_for) : '-');
    row.used.push(used ?? 0);
    row.used.splice(0, row.used.length - SPARK_POINTS);
    const most = Math.max(5, ...row.used);
    row.spark.setAttribute('points', row.used.map((value, i) =>
      `${SPARK_POINTS - row.used.length + i},${(15 - value / most * 14).toFixed(1)}`).join(' '));
    const alive = ['starting', 'running', 'stopped', 'respawning'].includes(process.state);
    const [start, restart, stop] = row.buttons;
    start.disabled = alive || process.state === 'stopping' || process.state === 'waiting';
    restart.disabled = !alive;
    stop.disabled = !alive && process.state !== 'waiting';
  }

  show() {
    const wanted = this.search.toLowerCase();
    for (const [name, row] of this.rows) {
      row.line.hidden = !`${name} ${row.state}`.toLowerCase().includes(wanted);
      row.line.classList.toggle('active', name === this.chosen);
      row.title.setAttribute('aria-pressed', String(name === this.chosen));
      row.cells[8].hidden = !this.steers;
    }
  }

  total() {
    return [...this.rows.values()].reduce(
      (sum, row) => ({cpu: sum.cpu + row.usage.cpu, memory: sum.memory + row.usage.memory}), {cpu: 0, memory: 0});
  }
}
