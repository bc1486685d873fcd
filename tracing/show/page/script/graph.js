// SPDX-License-Identifier: Apache-2.0
// The graph of nodes and topics, with rates and latencies. A click on a box chooses it for all views.

const graphOptions = {internal: false};
const kSmallestScale = 0.7;  // at which texts can still be read

// What flows along each edge: [{node, topic, publishes, count, first, last, latencies}].
function graphEdges(data) {
  const edges = new Map();
  const edge = (node, topic, publishes) => {
    const key = `${node} ${topic} ${publishes}`;
    if (!edges.has(key)) edges.set(key, {node, topic, publishes, count: 0, first: Infinity, last: -Infinity, latencies: []});
    return edges.get(key);
  };
  for (const end of data.publishers) if (end.node !== null) edge(end.node, end.topic, true);
  for (const end of data.subscriptions) if (end.node !== null) edge(end.node, end.topic, false);
  const count = (line, time) => {
    ++line.count;
    line.first = Math.min(line.first, time);
    line.last = Math.max(line.last, time);
  };
  const {messages, instances} = data;
  for (let i = 0; i < messages.count; ++i) {
    const publisher = data.publishers[messages.publisher[i]];
    const subscription = data.subscriptions[messages.subscription[i]];
    if (publisher && publisher.node !== null && !messages.repeated[i]) count(edge(publisher.node, publisher.topic, true), messages.published[i]);
    if (!subscription || subscription.node === null) continue;
    const taken = edge(subscription.node, subscription.topic, false);
    count(taken, messages.taken[i]);
    if (messages.to[i] >= 0) taken.latencies.push(instances.start[messages.to[i]] - messages.published[i]);
  }
  return [...edges.values()];
}

function graphView(data) {
  const internal = element('input', {type: 'checkbox', onchange: event => { graphOptions.internal = event.target.checked; draw(); }});
  internal.checked = graphOptions.internal;
  const place = element('div', {class: 'graph'});
  const all = graphEdges(data);
  const draw = () => place.replaceChildren(drawGraph(data, all.filter(edge => graphOptions.internal || !isInternalTopic(data.topics[edge.topic]))));
  draw();
  const view = panel('Nodes and topics', element('div', {class: 'tools'}, element('label', {}, internal, 'internal topics'),
    element('span', {class: 'faint'}, 'Choose a box to see only what belongs to it, here and in the other views.')), place);
  view.refresh = draw;
  return [view];
}

function shortName(name) {
  return name.length <= 30 ? name : `${name.slice(0, 14)}…${name.slice(-15)}`;
}

function drawGraph(data, edges) {
  const boxes = [];
  const boxOf = new Map();
  const box = (kind, id, name, rate) => {
    const key = `${kind} ${id}`;
    if (!boxOf.has(key)) {
      boxOf.set(key, boxes.length);
      boxes.push({kind, id, name, rate, width: Math.max(7.1 * shortName(name).length, 6.3 * rate.length) + 20, height: rate ? 38 : 26});
    }
    return boxOf.get(key);
  };
  const topics = topicStatistics(data);
  const lines = edges.map(edge => {
    const topic = topics[edge.topic];
    const rate = topic.rate + (topic.latency.count ? ` · p99 ${formatDuration(topic.latency.p99)}` : '');
    const node = box('node', edge.node, nodeName(data, edge.node), '');
    const other = box('topic', edge.topic, topic.name, topic.published ? rate : 'no messages');
    return edge.publishes ? {...edge, from: node, to: other} : {...edge, from: other, to: node};
  });
  const room = document.documentElement.clientWidth - 72;
  const {width, height} = layOut(boxes, lines, room / kSmallestScale);
  const near = nearBoxes(boxes, lines);
  const dim = id => near !== null && !near.has(id);
  const scale = Math.min(1, Math.max(kSmallestScale, room / width));
  return svgElement('svg', {width: width * scale, height: height * scale, viewBox: `0 0 ${width} ${height}`, role: 'group', 'aria-label': 'Graph of nodes and topics'},
    svgElement('defs', {}, svgElement('marker', {id: 'tip', viewBox: '0 0 8 8', refX: 7, refY: 4, markerWidth: 7, markerHeight: 7, orient: 'auto'},
      svgElement('path', {d: 'M0 0 L8 4 L0 8 z', style: `fill: ${color('arrow')}; stroke: none`}))),
    ...lines.map(line => drawLine(data, line, boxes, dim(line.from) || dim(line.to))),
    ...boxes.map((shape, id) => drawBox(shape, dim(id))));
}

// The chosen boxes and their neighbours; null if none is chosen.
function nearBoxes(boxes, lines) {
  const chosen = boxes.map((box, id) => isChosenBox(box) ? id : -1).filter(id => id >= 0);
  if (chosen.length === 0) return null;
  const near = new Set(chosen);
  for (const {from, to} of lines) {
    if (chosen.includes(from)) near.add(to);
    if (chosen.includes(to)) near.add(from);
  }
  return near;
}

function isChosenBox(box) {
  return selection[box.kind] === box.id;
}

function drawBox(box, dim) {
  const choose = () => select({[box.kind]: isChosenBox(box) ? null : box.id});
  const active = isChosenBox(box);
  return svgElement('g', {
    class: `box ${box.kind} ${active ? 'active' : ''} ${dim ? 'dim' : ''}`, transform: `translate(${box.x} ${box.y})`, tabindex: 0, role: 'button',
    'aria-pressed': active ? 'true' : 'false', 'aria-label': `${box.kind} ${box.name} ${box.rate}`, 'data-box': `${box.kind} ${box.name}`, onclick: choose,
    onkeydown: event => { if (event.key === 'Enter' || event.key === ' ') { event.preventDefault(); choose(); refocus(box); } },
  }, svgElement('title', {}, box.name),
  svgElement('rect', {x: -box.width / 2, y: -box.height / 2, width: box.width, height: box.height, rx: box.kind === 'node' ? 13 : 3}),
  svgElement('text', {y: box.rate ? -3 : 4}, shortName(box.name)), box.rate ? svgElement('text', {class: 'rate', y: 13}, box.rate) : null);
}

// Choosing draws the graph anew; the focus stays with the box.
function refocus(box) {
  document.querySelector(`[data-box=${JSON.stringify(`${box.kind} ${box.name}`)}]`)?.focus();
}

function drawLine(data, line, boxes, dim) {
  const points = line.points.map(point => ({...point}));
  const [first, last] = [points[0], points[points.length - 1]];
  const side = line.isBack ? -1 : 1;
  const [along, extent] = line.isDown ? ['y', 'height'] : ['x', 'width'];
  first[along] += side * boxes[line.from][extent] / 2;
  last[along] -= side * boxes[line.to][extent] / 2;
  let path = `M${first.x} ${first.y}`;
  for (let i = 1; i < points.length; ++i) {
    const [a, b] = [points[i - 1], points[i]];
    const [x, y] = [(a.x + b.x) / 2, (a.y + b.y) / 2];
    path += line.isDown ? ` C${a.x} ${y} ${b.x} ${y} ${b.x} ${b.y}` : ` C${x} ${a.y} ${x} ${b.y} ${b.x} ${b.y}`;
  }
  const latency = summary(Float64Array.from(line.latencies));
  const text = `${line.publishes ? 'published' : 'taken'} ${formatCount(line.count)}, ${formatRate(rateOf(line.count, line.first, line.last, data.duration))}` +
    (latency.count ? `; latency p50 ${formatDuration(latency.p50)}, p99 ${formatDuration(latency.p99)}` : '');
  return svgElement('path', {d: path, class: dim ? 'dim' : null, 'marker-end': 'url(#tip)', 'stroke-dasharray': line.count === 0 ? '3 4' : null}, svgElement('title', {}, text));
}
