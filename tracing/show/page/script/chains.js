// SPDX-License-Identifier: Apache-2.0
// Chains as stacked bars: how much of the way from the first callback to the last is spent where.

const kHopColors = {callback: 212, transport: 38, executor: 8, taken: 350};

function chainsView(data) {
  const chains = data.chains
    .filter(chain => selection.node === null || chain.steps.some(step => data.callbacks[step.callback].node === selection.node))
    .filter(chain => selection.topic === null || chain.steps.some(step => step.topic === selection.topic));
  const order = element('select', {'aria-label': 'Order', onchange: () => draw()}, ...[['p99', '99th percentile'], ['mean', 'mean time'], ['max', 'longest time'], ['count', 'number of runs']].map(
    ([value, text]) => element('option', {value}, text)));
  const list = element('div');
  const draw = () => {
    const shown = chains.slice().sort((a, b) => b.response[order.value] - a.response[order.value]).slice(0, 20);
    const longest = Math.max(1, ...shown.map(chain => timeOf(hopsOf(data, chain))));
    list.replaceChildren(...shown.map(chain => chainBar(data, chain, longest)));
  };
  draw();
  const swatch = ([kind, text]) => element('span', {}, element('i', {style: `background: ${hopColor(kind)}`}), text);
  return [panel('Chains', element('div', {class: 'tools'}, element('label', {}, 'order', order), element('span', {class: 'key'},
    ...[['callback', 'callback, until it publishes'], ['transport', 'on the way'], ['executor', 'waiting for the executor'], ['taken', 'taken, before the callback']].map(swatch))),
  ...data.unseen_chains.map(name => element('p', {class: 'bad'}, `Chain ${name}: no callbacks were seen that cause one another in this order.`)),
  chains.length === 0 ? element('p', {class: 'faint'}, 'No message that a callback published reached another callback.') : list,
  element('p', {class: 'note'}, 'The bars show mean times of each part, of all outputs. Response: from the begin of the first callback to the first end of the last one that it causes. ' +
    'Reaction: the same, for something that just missed the input. Age: to the last end that it causes.' +
    (data.has_all_chains ? '' : ' The trace has more chains than are followed.')))];
}

function hopColor(kind) {
  return `hsl(${kHopColors[kind]} 62% ${color('bar-lightness')})`;
}

// [{kind, name, mean}, …] from the first callback to the end of the last one.
function hopsOf(data, chain) {
  const hops = [];
  const add = (kind, name, mean) => { if (mean > 0) hops.push({kind, name, mean}); };
  chain.steps.forEach((step, i) => {
    const {node, label} = data.callbacks[step.callback];
    const name = `${nodeName(data, node)} · ${label}`;
    const next = chain.steps[i + 1];
    add('callback', name, (next ? next.until_publish : chain.last_callback).mean);
    if (!next) return;
    const topic = data.topics[next.topic] ?? '';
    const waited = next.executor?.mean ?? 0;
    add('transport', next.executor ? `${topic}: on the way` : `${topic}: on the way and waiting for the executor`, next.transfer.mean - waited - next.take.mean);
    add('executor', `${topic}: waiting for the executor`, waited);
    add('taken', `${topic}: taken, before the callback`, next.take.mean);
  });
  return hops;
}

// A message that is kept may cause several outputs. The parts are the mean of all of them, so their sum can be more than
// the mean response, which ends with the first output.
function timeOf(hops) {
  return hops.reduce((sum, hop) => sum + hop.mean, 0);
}

// The instance at the end of the longest run, or -1 when the page does not hold it.
function longestRun(data, chain) {
  const {end} = data.instances;
  const last = chain.steps[chain.steps.length - 1].callback;
  return data.instancesOf(last).find(i => end[i] === chain.longest_end) ?? -1;
}

function chainBar(data, chain, longest) {
  const hops = hopsOf(data, chain);
  const nodeOf = step => nodeName(data, data.callbacks[step.callback].node);
  const slowest = longestRun(data, chain);
  const label = hops.map(hop => `${hop.name} ${formatDuration(hop.mean)}`).join('; ');
  const times = (name, {mean, p99, max}) => `${name} mean ${formatDuration(mean)}, p99 ${formatDuration(p99)}, max ${formatDuration(max)}`;
  return element('div', {class: 'chain'},
    element('div', {class: 'head'}, element('b', {}, `${chain.name ? chain.name + ': ' : ''}${nodeOf(chain.steps[0])} → ${nodeOf(chain.steps[chain.steps.length - 1])}`),
      element('span', {}, `${plural(chain.steps.length, 'callback')}, ${plural(chain.response.count, 'run')}${chain.doubtful ? ' (events were lost)' : ''}`),
      element('span', {}, times('response', chain.response)),
      chain.budget === null ? null : element('span', {class: chain.over_budget > 0 ? 'bad' : 'good'}, `${formatCount(chain.over_budget)} over the budget of ${formatDuration(chain.budget)}`),
      element('button', {disabled: slowest < 0, onclick: () => showInTime(data, slowest, chain.longest_end - chain.response.max)}, 'longest run')),
    element('div', {class: 'hops', role: 'img', 'aria-label': label, style: `width: ${Math.max(2, 100 * timeOf(hops) / longest)}%`},
      ...hops.map(hop => element('div', {title: `${hop.name}\n${formatDuration(hop.mean)}`,
        style: `flex: ${Math.max(hop.mean, 1)} 1 0; background: ${hopColor(hop.kind)}`},
      hop.mean / longest > 0.05 ? `${hop.name.split(' · ')[0].split(':')[0]} ${formatDuration(hop.mean)}` : ''))),
    element('div', {class: 'note'}, chain.steps.map((step, i) => (i > 0 ? ` → ${data.topics[step.topic] ?? ''} → ` : '') + nodeOf(step)).join('')),
    chain.reaction || chain.age ? element('div', {class: 'note'},
      [chain.reaction ? times('reaction', chain.reaction) : null, chain.age ? times('age', chain.age) : null].filter(Boolean).join('; ')) : null);
}
