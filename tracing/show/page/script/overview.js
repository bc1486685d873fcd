// SPDX-License-Identifier: Apache-2.0
// The view that comes first: is the trace complete, how large is it, what is worth looking at.

// What the packets of the trace lack, or its verdict.
function lossText({lost_events: events, lost_packets: packets, lost_uncounted: uncounted}) {
  if (events === 0 && packets === 0) return uncounted ? 'some events lost' : 'none';
  const parts = [events ? formatCount(events) : '', packets ? plural(packets, 'packet') : ''].filter(Boolean);
  return (uncounted ? 'at least ' : '') + parts.join(', ');
}

function tile(figure, what, kind = '') {
  return element('div', {class: `tile ${kind}`}, element('b', {}, figure), element('span', {}, what));
}

// Goes to the view that shows what a finding is about.
function openFinding({kind, callback, topic}) {
  if (callback !== null) {
    select({callback});
    showView('callbacks');
  } else if (topic !== null) {
    select({topic});
    showView('topics');
  } else {
    showView({slowest_chain: 'chains', over_budget: 'chains', slowest_start: 'processes', memory_in_active: 'lifecycle', unanswered: 'services'}[kind] ?? 'time');
  }
}

function overviewView(data) {
  const {overview} = data;
  const counted = lossText(overview);
  const lost = counted === 'none' && (data.error || data.lost_unknown) ? 'unknown' : counted;
  const nodes = data.nodes.length;
  // Each one is there once for each subscription that took it; the further ones are marked.
  let published = 0;
  for (let i = 0; i < data.messages.count; ++i) published += data.messages.repeated[i] ? 0 : 1;
  const found = data.findings;
  const ofKernel = data.folded.reduce((sum, {count}) => sum + count, 0);
  return [
    data.error ? element('div', {class: 'panel trouble', role: 'alert'}, `The trace could not be read to its end: ${data.error}`) : null,
    data.is_open ? element('div', {class: 'panel', role: 'alert'}, 'The trace was still being written when this page was made. It holds what was complete then.') : null,
    data.whole ? element('div', {class: 'panel'}, `This page holds ${formatDuration(data.duration)} of ${formatDuration(data.whole.end - data.whole.begin)}, ` +
      `from ${formatTime(-data.whole.first)} on. launch report --html FILE --from +SECONDS --to +SECONDS chooses another part. Findings, chains, and the numbers of events and losses are those of the whole trace.`) : null,
    element('div', {class: 'tiles'},
      tile(formatDuration(data.duration), 'recorded'), tile(formatCount(overview.events), 'events'),
      tile(lost, lost === 'none' || lost === 'unknown' ? 'events lost' : 'lost', lost === 'none' ? 'good' : 'bad'),
      tile(formatCount(data.processes.filter(process => process.events > 0).length), ofKernel === 0 ? 'processes' : `processes, ${formatCount(ofKernel)} more of the kernel's events`), tile(formatCount(nodes), 'nodes'), tile(formatCount(data.topics.length), 'topics'),
      tile(formatCount(data.instances.count), 'callbacks run'), tile(formatCount(published), 'messages published')),
    data.absences.length + data.unseen_chains.length + data.overwritten.length === 0 ? null : panel('Not there', element('ul', {class: 'absences'},
      ...[...data.absences, ...data.overwritten, ...data.unseen_chains.map(name => `chain '${name}': no callbacks were seen that cause one another in this order`)]
        .map(text => element('li', {}, text)))),
    panel('Worth looking at', found.length === 0 ? element('p', {class: 'faint'}, 'Nothing stands out.') :
      element('ul', {class: 'findings'}, ...found.map(finding => element('li', {}, element('button', {onclick: () => openFinding(finding)},
        element('span', {class: 'what'}, finding.title), element('span', {class: 'subject'}, finding.subject), element('span', {}, finding.figures)),
      finding.next ? element('p', {class: 'next'}, `next: ${finding.next}`) : null)))),
    launcherEventPanel(data),
    panel('Trace', element('div', {class: 'facts'}, element('dl', {}, ...[
      ['Directory', data.directory],
      ['Begin', new Date(data.begin_ms).toISOString().replace('T', ' ').replace('Z', ' UTC')],
      ...data.others === 0 ? [] : [['Left out', `${plural(data.others, 'process')} of others: launch report --all`]],
      ['Most frequent events', overview.event_counts.slice().sort((a, b) => b.total - a.total).slice(0, 5).map(e => `${e.name} ${formatCount(e.total)}`).join(', ')],
      ...data.remarks.map(remark => ['Remark', remark]),
      ...data.warnings.map(warning => ['Warning', warning]),
    ].flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)])))),
    overview.losses.length === 0 ? null : panel('Losses', dataTable(overview.losses, [
      {title: 'Stream', value: loss => loss.stream, wide: true},
      {title: 'Events', value: loss => loss.events, show: loss => (loss.uncounted ? 'at least ' : '') + formatCount(loss.events)},
      {title: 'Packets', value: loss => loss.packets},
      {title: 'From', value: loss => loss.begin ?? NaN, show: loss => loss.begin === null ? '–' : formatTime(loss.begin)},
      {title: 'To', value: loss => loss.end ?? NaN, show: loss => loss.end === null ? '–' : formatTime(loss.end)},
    ], {name: 'stream', sort: 1, descending: true})),
    data.cost ? costPanel(data) : null,
  ];
}

// What tracing took of the processors, as the verdict of the recording estimates it.
function costPanel({cost: {ns_per_event: each, processes}, overview, duration, whole}) {
  const span = whole ? whole.end - whole.begin : duration;
  // The cost of events of the kernel is not measured; their names have no provider.
  const userspace = overview.event_counts.reduce((sum, event) => sum + (event.name.includes(':') ? event.total : 0), 0);
  const all = each * userspace;
  const rate = span > 0 ? `, ${formatPercent(all / span)} of a processor` : '';
  return panel('Cost of tracing', element('p', {}, `${formatDuration(all)}${rate}: ${formatDuration(each)} for each event${userspace < overview.events ? ', without the events of the kernel' : ''}.`),
    processes.length === 0 ? null : dataTable(processes, [
      {title: 'Process', value: row => row.name, wide: true}, {title: 'Id', value: row => row.vpid},
      {title: 'Events', value: row => row.events, show: row => formatCount(row.events)},
      {title: 'Time', value: row => row.seconds, show: row => formatDuration(row.seconds * 1e9)},
      {title: 'Of a processor', value: row => row.share, show: row => formatPercent(row.share)},
      {title: 'For each callback', value: row => row.ns_per_callback ?? NaN, show: row => formatDuration(row.ns_per_callback ?? NaN)},
    ], {name: 'process', sort: 3, descending: true}), element('p', {class: 'note'}, 'An estimate: the number of events times the cost of one on the machine of the recording.'));
}
