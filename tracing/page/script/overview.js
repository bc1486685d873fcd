// SPDX-License-Identifier: Apache-2.0
// The view that comes first: is the trace complete, how large is it, what is worth looking at.

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
    showView({slowest_chain: 'chains', over_budget: 'chains', slowest_start: 'processes', memory_in_active: 'lifecycle', unanswered: 'graph'}[kind] ?? 'time');
  }
}

function overviewView(data) {
  const {overview} = data;
  const lost = lossText(overview);
  const nodes = data.nodes.length;
  const topics = data.topics.filter(name => !isInternalTopic(name)).length;
  const found = data.findings;
  return [
    data.error ? element('div', {class: 'panel trouble', role: 'alert'}, `The trace could not be read to its end: ${data.error}`) : null,
    data.is_open ? element('div', {class: 'panel', role: 'alert'}, 'The trace was still being written when this page was made. It holds what was complete then.') : null,
    data.whole ? element('div', {class: 'panel'}, `This page holds ${formatDuration(data.duration)} of ${formatDuration(data.whole.end - data.whole.begin)}, ` +
      `from ${formatTime(-data.whole.begin)} on. launch report --html FILE --from +SECONDS --to +SECONDS chooses another part. Findings, chains, and the numbers of events and losses are those of the whole trace.`) : null,
    element('div', {class: 'tiles'},
      tile(formatDuration(data.duration), 'recorded'), tile(formatCount(overview.events), 'events'),
      tile(lost, lost === 'none' ? 'events lost' : 'lost', lost === 'none' ? 'good' : 'bad'),
      tile(formatCount(data.processes.filter(process => process.events > 0).length), 'processes'), tile(formatCount(nodes), 'nodes'), tile(formatCount(topics), 'topics'),
      tile(formatCount(data.instances.count), 'callbacks run'), tile(formatCount(data.messages.count), 'messages')),
    panel('Worth looking at', found.length === 0 ? element('p', {class: 'faint'}, 'Nothing stands out.') :
      element('ul', {class: 'findings'}, ...found.map(finding => element('li', {}, element('button', {onclick: () => openFinding(finding)},
        element('span', {class: 'what'}, finding.title), element('span', {class: 'subject'}, finding.subject), element('span', {}, finding.figures)))))),
    panel('Trace', element('div', {class: 'facts'}, element('dl', {}, ...[
      ['Directory', data.directory],
      ['Begin', new Date(data.begin_ms).toISOString().replace('T', ' ').replace('Z', ' UTC')],
      ['Most frequent events', overview.event_counts.slice().sort((a, b) => b.total - a.total).slice(0, 5).map(e => `${e.name} ${formatCount(e.total)}`).join(', ')],
      ...data.warnings.map(warning => ['Warning', warning]),
    ].flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)])))),
    overview.losses.length === 0 ? null : panel('Losses', dataTable(overview.losses, [
      {title: 'Stream', value: loss => loss.stream, wide: true},
      {title: 'Events', value: loss => loss.events, show: loss => (loss.uncounted ? 'at least ' : '') + formatCount(loss.events)},
      {title: 'Packets', value: loss => loss.packets},
      {title: 'From', value: loss => loss.begin ?? NaN, show: loss => loss.begin === null ? '–' : formatTime(loss.begin)},
      {title: 'To', value: loss => loss.end ?? NaN, show: loss => loss.end === null ? '–' : formatTime(loss.end)},
    ], {name: 'stream', sort: 1, descending: true})),
  ];
}
