// SPDX-License-Identifier: Apache-2.0
// Chains as stacked bars: how much of the way from the first callback to the last is spent where, as a mean or at a
// percentile, and all percentiles of each part as a table.

const kHopColors = {callback: 212, transport: 38, executor: 8, taken: 350};
const kStatistics = [['p50', 'median (p50)'], ['p90', 'p90'], ['p99', 'p99'], ['max', 'longest'], ['mean', 'mean']];
const kShares = {p50: 0.5, p90: 0.9, p99: 0.99, max: 1};
const chainOptions = {statistic: 'p50', order: 'p99', open: new Set()};

function choiceOf(label, choices, value, onchange) {
  const list = element('select', {'aria-label': label, onchange: () => onchange(list.value)}, ...choices.map(([key, text]) => element('option', {value: key}, text)));
  list.value = value;
  return list;
}

function chainsView(data) {
  const chains = data.chains
    .filter(chain => selection.node === null || chain.steps.some(step => data.callbacks[step.callback].node === selection.node))
    .filter(chain => selection.topic === null || chain.steps.some(step => step.topic === selection.topic))
    .filter(chain => selection.callback === null || chain.steps.some(step => step.callback === selection.callback));
  const order = choiceOf('Order', [['p99', '99th percentile'], ['p50', 'median'], ['mean', 'mean time'], ['max', 'longest time'], ['count', 'number of runs']], chainOptions.order,
    value => { chainOptions.order = value; draw(); });
  const statistic = choiceOf('Bars show', kStatistics, chainOptions.statistic, value => { chainOptions.statistic = value; draw(); });
  const list = element('div');
  const draw = () => {
    const shown = chains.slice().sort((a, b) => b.response[order.value] - a.response[order.value]).slice(0, 20);
    const longest = Math.max(1, ...shown.map(chain => timeOf(hopsOf(data, chain), statistic.value)));
    list.replaceChildren(...shown.map(chain => chainBar(data, chain, longest, statistic.value)));
  };
  draw();
  const swatch = ([kind, text]) => element('span', {}, element('i', {style: `background: ${hopColor(kind)}`}), text);
  const nothing = data.chains.length === 0 ? 'No message that a callback published reached another callback.' : 'No chain goes through what is chosen.';
  return [panel('Chains', element('div', {class: 'tools'}, element('label', {}, 'bars', statistic), element('label', {}, 'order', order), element('span', {class: 'key'},
    ...[['callback', 'callback, until it publishes'], ['transport', 'on the way'], ['executor', 'waiting for the executor'], ['taken', 'taken, before the callback']].map(swatch))),
  ...data.unseen_chains.map(name => element('p', {class: 'bad'}, `Chain ${name}: no callbacks were seen that cause one another in this order.`)),
  chains.length === 0 ? element('p', {class: 'faint'}, nothing) : list,
  element('p', {class: 'note'}, 'Each part of a bar is as long as its own percentile, of all outputs. The parts of one run are seldom slow all at once, so above the median their sum is more than ' +
    'the percentile of the response. Response: from the begin of the first callback to the first end of the last one that it causes. ' +
    'Reaction: the same, for something that just missed the input. Age: to the last end that it causes.' +
    (data.has_all_chains ? '' : ' The trace has more chains than are followed.')))];
}

function hopColor(kind) {
  return `hsl(${kHopColors[kind]} 62% ${color('bar-lightness')})`;
}

// [{kind, name, times}, …] from the first callback to the end of the last one. `times` have mean, percentiles and max.
function hopsOf(data, chain) {
  const hops = [];
  const add = (kind, name, times) => { if (times && times.max > 0) hops.push({kind, name, times}); };
  chain.steps.forEach((step, i) => {
    const next = chain.steps[i + 1];
    add('callback', callbackName(data, step.callback), next ? next.until_publish : chain.last_callback);
    if (!next) return;
    const topic = data.topics[next.topic] ?? '';
    add('transport', next.executor ? `${topic}: on the way` : `${topic}: on the way and waiting for the executor`, next.transport);
    add('executor', `${topic}: waiting for the executor`, next.executor);
    add('taken', `${topic}: taken, before the callback`, next.take);
  });
  return hops;
}

// A message that is kept may cause several outputs. The parts are those of all of them, so their sum can be more than the
// mean response, which ends with the first output.
function timeOf(hops, statistic) {
  return hops.reduce((sum, hop) => sum + hop.times[statistic], 0);
}

// Opens the time chart at the run whose response is at the percentile.
function runButton(data, chain, statistic) {
  const name = {p50: 'run at p50', p90: 'run at p90', p99: 'run at p99', max: 'longest run'}[statistic];
  if (statistic === 'max') {
    const slowest = longestRun(data, chain);
    return element('button', {disabled: slowest < 0, onclick: () => showInTime(data, slowest, chain.longest_end - chain.response.max)}, name);
  }
  const button = element('button', {onclick: () => {
    const run = runAt(chainRuns(data, chain), kShares[statistic]);
    if (run) showInTime(data, run.last, data.instances.start[run.first]);
    button.disabled = !run;
    button.title = run ? '' : 'The page does not hold its runs';
  }}, name);
  return button;
}

// The instance at the end of the longest run, or -1 when the page does not hold it.
function longestRun(data, chain) {
  const {end} = data.instances;
  const last = chain.steps[chain.steps.length - 1].callback;
  return data.instancesOf(last).find(i => end[i] === chain.longest_end) ?? -1;
}

function timesText(name, {mean, p50, p90, p99, max}) {
  return `${name} p50 ${formatDuration(p50)}, p90 ${formatDuration(p90)}, p99 ${formatDuration(p99)}, max ${formatDuration(max)}, mean ${formatDuration(mean)}`;
}

function chainBar(data, chain, longest, statistic) {
  const hops = hopsOf(data, chain);
  const nodeOf = step => nodeName(data, data.callbacks[step.callback].node);
  const label = hops.map(hop => `${hop.name} ${formatDuration(hop.times[statistic])}`).join('; ');
  const whole = timeOf(hops, statistic);
  const key = chain.steps.map(step => `${step.topic} ${step.callback}`).join();
  const parts = element('details', {open: chainOptions.open.has(key), ontoggle: () => chainOptions.open[parts.open ? 'add' : 'delete'](key)},
    element('summary', {}, 'Percentiles of each part'), hopTable(hops, chain));
  return element('div', {class: 'chain'},
    element('div', {class: 'head'}, element('b', {}, `${chain.name ? chain.name + ': ' : ''}${nodeOf(chain.steps[0])} → ${nodeOf(chain.steps[chain.steps.length - 1])}`),
      element('span', {}, `${plural(chain.steps.length, 'callback')}, ${plural(chain.response.count, 'run')}${chain.estimated ? ' (an estimate)' : ''}${chain.doubtful ? ' (events were lost)' : ''}`),
      element('span', {}, timesText('response', chain.response)),
      chain.budget === null ? null : element('span', {class: chain.over_budget > 0 ? 'bad' : 'good'}, `${formatCount(chain.over_budget)} over the budget of ${formatDuration(chain.budget)}`),
      ...['max', 'p50', 'p90', 'p99'].map(which => runButton(data, chain, which))),
    element('div', {class: 'hops', role: 'img', 'aria-label': label, style: `width: ${Math.max(2, 100 * whole / longest)}%`},
      ...hops.map(hop => element('div', {title: `${hop.name}\n${timesText('', hop.times).trim()}`,
        style: `flex: ${Math.max(hop.times[statistic], 1)} 1 0; background: ${hopColor(hop.kind)}`},
      hop.times[statistic] / longest > 0.05 ? `${hop.name.split(' · ')[0].split(':')[0]} ${formatDuration(hop.times[statistic])}` : ''))),
    element('div', {class: 'note'}, chain.steps.map((step, i) => (i > 0 ? ` → ${data.topics[step.topic] ?? ''} → ` : '') + nodeOf(step)).join('')),
    chain.reaction || chain.age ? element('div', {class: 'note'},
      [chain.reaction ? timesText('reaction', chain.reaction) : null, chain.age ? timesText('age', chain.age) : null].filter(Boolean).join('; ')) : null,
    parts);
}

// All percentiles of all parts, in the order of the way.
function hopTable(hops, chain) {
  const cells = times => [times.p50, times.p90, times.p99, times.max, times.mean].map(time => element('td', {}, formatDuration(time)));
  const row = (name, times, swatch = null) => element('tr', {}, element('td', {class: 'text wide'}, swatch ? element('i', {class: 'swatch', style: `background: ${swatch}`}) : null, name), ...cells(times));
  return element('div', {class: 'scroll'}, element('table', {class: 'parts'},
    element('thead', {}, element('tr', {}, ...['Part', 'p50', 'p90', 'p99', 'Max', 'Mean'].map((title, i) => element('th', {class: i ? null : 'text', scope: 'col'}, title)))),
    element('tbody', {}, ...hops.map(hop => row(hop.name, hop.times, hopColor(hop.kind))), row('response', chain.response))));
}
