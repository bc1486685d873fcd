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
    {title: 'Nodes', value: row => row.nodes.map(({node}) => node.name).join(', ') || '–', wide: true},
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
  data.starts.length === 0 ? null : startBars(data)];
}

// From the first exec on: a bar for each process, until its first node and until it is ready.
function startBars(data) {
  const first = Math.min(...data.starts.map(start => start.exec));
  const whole = Math.max(1, ...data.starts.map(start => start.exec - first + Math.max(start.node_after ?? 0, start.ready_after ?? 0)));
  const part = (begin, end, hue, name) => end > begin ? element('div', {
    style: `left: ${100 * begin / whole}%; width: ${100 * (end - begin) / whole}%; background: hsl(${hue} 50% ${color('bar-lightness')})`,
    title: `${name}\n${formatDuration(end - begin)}`}, name) : null;
  const bars = data.starts.slice().sort((a, b) => a.exec - b.exec).flatMap(start => {
    const begin = start.exec - first;
    const node = begin + (start.node_after ?? 0);
    return [element('div', {title: `${start.file}:${start.line}`}, start.name),
      element('div', {class: 'track'}, part(begin, node, 212, 'until its node'), start.ready_after === null ? null : part(node, begin + start.ready_after, 145, 'until ready'))];
  });
  return panel('Start', element('div', {class: 'bars'}, ...bars), element('p', {class: 'note'}, `The whole width is ${formatDuration(whole)}.`));
}
