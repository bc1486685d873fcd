// SPDX-License-Identifier: Apache-2.0
// The processes: their place in the launch file, how long they took to start, how much they did.

function processesView(data) {
  const rows = data.processes.map((process, id) => {
    const start = data.starts.find(candidate => candidate.process === id);
    const nodes = data.nodes.map((node, node_id) => ({node, node_id})).filter(({node}) => node.process === id);
    let busy = 0;
    data.threads.forEach((thread, thread_id) => { if (thread.process === id) busy += threadUse(data, thread_id).busy; });
    return {process, start, busy, nodes};
  }).filter(row => row.process.events > 0 && (selection.node === null || row.nodes.some(({node_id}) => node_id === selection.node)));
  const after = (title, value) => ({title, value: row => value(row) ?? NaN, show: row => formatDuration(value(row) ?? NaN)});
  const columns = [
    {title: 'Process', value: row => row.start?.name ?? row.process.name},
    {title: 'Id', value: row => row.process.vpid},
    {title: 'Nodes', value: row => row.nodes.map(({node_id}) => nodeName(data, node_id)).join(', ') || '–', wide: true},
    {title: 'Events', value: row => row.process.events, show: row => formatCount(row.process.events) + (row.process.doubtful ? ' (some lost)' : '')},
    {title: 'In callbacks', value: row => row.busy, show: row => formatDuration(row.busy)},
    after('First node after', row => row.start?.node_after), after('Ready after', row => row.start?.ready_after),
    {title: 'Launch file', value: row => row.start ? `${row.start.file}:${row.start.line}` : '–', wide: true},
  ];
  const table = dataTable(rows, columns, {name: 'process', sort: 0,
    choose: row => select({node: row.nodes.length === 1 && selection.node !== row.nodes[0].node_id ? row.nodes[0].node_id : null}),
    isActive: row => row.nodes.some(({node_id}) => node_id === selection.node)});
  return [panel('Processes', table, element('p', {class: 'note'},
    'Ready: everything exists that the program makes before it waits for work for the first time. Times count from when its program began to run.')),
  foldedProcesses(data), data.starts.length === 0 ? null : startBars(data), data.startup ? criticalPath(data.startup) : null];
}

// Those that have events of the kernel alone; those of one name are one row.
function foldedProcesses(data) {
  if (data.folded.length === 0) return null;
  const count = data.folded.reduce((sum, row) => sum + row.count, 0);
  return panel(`${plural(count, 'process')} more of the kernel's events`, dataTable(data.folded, [
    {title: 'Name', value: row => row.name || 'without a name', wide: true}, ...(data.hasSeveralHosts ? [{title: 'Machine', value: row => row.host || '?'}] : []),
    {title: 'Processes', value: row => row.count, show: row => formatCount(row.count)},
    {title: 'Events', value: row => row.events, show: row => formatCount(row.events)},
  ], {name: 'name', sort: data.hasSeveralHosts ? 3 : 2, descending: true, limit: 20}), element('p', {class: 'note'}, 'They have no events of ROS 2. Those of one name are one row.'));
}

// The phases of a start, in their order: until what, and a hue.
const kStartPhases = [['init_after', 'until rcl_init', 265], ['node_after', 'until its node', 212], ['ready_after', 'until ready', 145],
  ['callback_after', 'until its first callback', 95], ['publication_after', 'until its first message', 45]];

function barPart(begin, end, whole, hue, name) {
  return end > begin ? element('div', {
    style: `left: ${100 * begin / whole}%; width: ${100 * (end - begin) / whole}%; background: hsl(${hue} 50% ${color('bar-lightness')})`,
    title: `${name}\n${formatDuration(end - begin)}`}, (end - begin) / whole > 0.05 ? name : '') : null;
}

// From the first spawn on: a bar for each process, with the phases of its start.
function startBars(data) {
  const firstOf = start => start.spawn ?? start.exec;
  const lastOf = start => start.exec + Math.max(...kStartPhases.map(([phase]) => start[phase] ?? 0));
  const first = Math.min(...data.starts.map(firstOf));
  const whole = Math.max(1, ...data.starts.map(start => lastOf(start) - first));
  const bars = data.starts.slice().sort((a, b) => a.exec - b.exec).flatMap(start => {
    const parts = [barPart(firstOf(start) - first, start.exec - first, whole, 0, 'until exec')];
    let from = 0;
    // A callback or a message may come before the executor looks for work.
    const phases = kStartPhases.filter(([phase]) => start[phase] !== null).sort(([a], [b]) => start[a] - start[b]);
    for (const [phase, name, hue] of phases) {
      parts.push(barPart(start.exec - first + from, start.exec - first + start[phase], whole, hue, name));
      from = start[phase];
    }
    return [element('div', {title: `${start.file}:${start.line}`}, start.name), element('div', {class: 'track'}, ...parts)];
  });
  return panel('Start', element('div', {class: 'bars'}, ...bars), element('p', {class: 'note'}, `The whole width is ${formatDuration(whole)}.`));
}

// What the process that was ready last had to wait for. The steps have no gaps.
function criticalPath({duration, path}) {
  const whole = Math.max(1, duration);
  const bars = path.flatMap((step, i) => [
    element('div', {}, `${step.process || 'launcher'}: ${step.what} `, element('span', {class: 'faint'}, formatDuration(step.end - step.begin))),
    element('div', {class: 'track'}, barPart(step.begin, step.end, whole, step.process ? 145 + 40 * (i % 3) : 212, ''))]);
  return panel(`Critical path of the start, ${formatDuration(duration)}`, element('div', {class: 'bars path'}, ...bars), element('p', {class: 'note'},
    'Had one of these steps been shorter, the system would have been ready earlier, up to the next process.'));
}
