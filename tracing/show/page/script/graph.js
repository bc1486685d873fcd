// SPDX-License-Identifier: Apache-2.0
// The graph of nodes and topics, with rates and latencies. It can be zoomed and moved. A click on a box chooses it for all
// views.

const graphOptions = {internal: false, place: null};  // place: what PictureZoom shows; null: all of it
const kLineLength = 28;     // of a name in a box; longer ones have several lines
const kLineHeight = 15;

keysOf.graph = [
  {keys: ['+', '=', 'w'], shown: ['w', '+'], what: 'zoom in', act: zoom => zoom.zoom(1.4)},
  {keys: ['-', 's'], shown: ['s', '-'], what: 'zoom out', act: zoom => zoom.zoom(1 / 1.4)},
  {keys: ['ArrowLeft', 'a'], shown: ['a', 'ArrowLeft'], what: 'move left', act: zoom => zoom.pan(-0.15, 0)},
  {keys: ['ArrowRight', 'd'], shown: ['d', 'ArrowRight'], what: 'move right', act: zoom => zoom.pan(0.15, 0)},
  {keys: ['ArrowUp'], what: 'move up', act: zoom => zoom.pan(0, -0.15)},
  {keys: ['ArrowDown'], what: 'move down', act: zoom => zoom.pan(0, 0.15)},
  {keys: ['0', 'f', 'Home'], shown: ['0', 'f'], what: 'all of it', act: zoom => zoom.fit()},
];
kPointerHelp.graph = [
  {keys: ['wheel'], what: 'zoom'}, {keys: ['drag'], what: 'move'}, {keys: ['Tab', 'Enter'], what: 'go from box to box, choose one'},
];

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
  const internal = element('input', {type: 'checkbox', onchange: event => { graphOptions.internal = event.target.checked; draw(true); }});
  internal.checked = graphOptions.internal;
  const place = element('div', {class: 'graph'});
  const all = graphEdges(data);
  const button = (text, title, act) => element('button', {title, 'aria-label': title, onclick: act}, text);
  const view = panel('Nodes and topics', element('div', {class: 'tools'}, element('label', {}, internal, 'internal topics'),
    button('+', 'Zoom in', () => view.keyTarget.zoom(1.4)), button('−', 'Zoom out', () => view.keyTarget.zoom(1 / 1.4)),
    button('Fit', 'Show all of it', () => view.keyTarget.fit()),
    element('span', {class: 'faint'}, 'Choose a box to see only what belongs to it, here and in the other views.')), place);
  const draw = isNew => {
    if (isNew) graphOptions.place = null;
    const edges = all.filter(edge => graphOptions.internal || !isInternalTopic(data.topics[edge.topic]));
    if (edges.length === 0) return place.replaceChildren(element('p', {class: 'faint'}, 'No publisher or subscription of a node is in the trace.'));
    const {svg, group, size} = drawGraph(data, edges);
    place.replaceChildren(svg);
    view.keyTarget = new PictureZoom(svg, group, size, graphOptions.place, changed => { graphOptions.place = changed; });
  };
  view.first = document.getElementById('view');
  draw(false);
  view.refresh = () => {
    const {kind, name} = document.activeElement?.dataset.box ? splitKey(document.activeElement.dataset.box) : {};
    draw(false);
    if (name) document.querySelector(`[data-box=${JSON.stringify(`${kind} ${name}`)}]`)?.focus({preventScroll: true});
    return true;
  };
  return [view];
}

function splitKey(key) {
  return {kind: key.slice(0, key.indexOf(' ')), name: key.slice(key.indexOf(' ') + 1)};
}

// The whole of a name in lines, broken where its words end.
function nameLines(name) {
  const lines = [''];
  for (const part of name.split(/(?<=[^/_.:\- ])(?=[/_.:\- ])/)) {
    for (let rest = part; rest;) {
      const last = lines.length - 1;
      if (lines[last] && lines[last].length + rest.length > kLineLength) {
        lines.push('');
        continue;
      }
      lines[last] += rest.slice(0, kLineLength);
      rest = rest.slice(kLineLength);
    }
  }
  return lines;
}

// How wide texts are in the graph.
function textMeasure() {
  const context = new OffscreenCanvas(1, 1).getContext('2d');
  return (text, size) => {
    context.font = `${size}px system-ui, "DejaVu Sans", sans-serif`;
    return context.measureText(text).width;
  };
}

function drawGraph(data, edges) {
  const boxes = [];
  const boxOf = new Map();
  const widthOf = textMeasure();
  const box = (kind, id, name, rate) => {
    const key = `${kind} ${id}`;
    if (!boxOf.has(key)) {
      boxOf.set(key, boxes.length);
      const lines = nameLines(name);
      const width = Math.max(...lines.map(line => widthOf(line, 12)), widthOf(rate, 11)) + 24;
      boxes.push({kind, id, name, rate, lines, width, height: 11 + kLineHeight * (lines.length + (rate ? 1 : 0))});
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
  const room = {width: document.documentElement.clientWidth - 72, height: Math.max(320, window.innerHeight - 210)};
  const size = layOut(boxes, lines, room);
  const near = nearBoxes(boxes, lines);
  const dim = id => near !== null && !near.has(id);
  const group = svgElement('g', {}, ...lines.map(line => drawLine(data, line, boxes, dim(line.from) || dim(line.to))), ...boxes.map((shape, id) => drawBox(shape, dim(id))));
  const needed = size.height * Math.min(1, room.width / size.width);
  const svg = svgElement('svg', {width: '100%', height: Math.round(Math.min(room.height, needed)), role: 'group', 'aria-label': 'Graph of nodes and topics'},
    svgElement('defs', {}, svgElement('marker', {id: 'tip', viewBox: '0 0 8 8', refX: 7, refY: 4, markerWidth: 7, markerHeight: 7, orient: 'auto'},
      svgElement('path', {class: 'tip-of-arrow', d: 'M0 0 L8 4 L0 8 z'}))), group);
  return {svg, group, size};
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
  const top = -box.height / 2 + kLineHeight + 1;
  // What has the focus is moved into sight.
  const reveal = event => {
    const zoom = document.getElementById('view').firstElementChild?.keyTarget;
    if (!zoom?.place || !event.target.matches(':focus-visible')) return;
    const [outer, inner] = [zoom.svg.getBoundingClientRect(), event.target.getBoundingClientRect()];
    const isSeen = inner.left >= outer.left && inner.right <= outer.right && inner.top >= outer.top && inner.bottom <= outer.bottom;
    if (!isSeen) zoom.center(box, zoom.place.scale);
  };
  return svgElement('g', {
    class: `box ${box.kind} ${active ? 'active' : ''} ${dim ? 'dim' : ''}`, transform: `translate(${box.x} ${box.y})`, tabindex: 0, role: 'button',
    'aria-pressed': active ? 'true' : 'false', 'aria-label': `${box.kind} ${box.name} ${box.rate}`, 'data-box': `${box.kind} ${box.name}`, onclick: choose,
    onfocus: reveal, onkeydown: event => { if (event.key === 'Enter' || event.key === ' ') { event.preventDefault(); choose(); } },
  }, svgElement('title', {}, box.name),
  svgElement('rect', {x: -box.width / 2, y: -box.height / 2, width: box.width, height: box.height, rx: box.kind === 'node' ? 13 : 3}),
  ...box.lines.map((line, i) => svgElement('text', {y: top + i * kLineHeight}, line)),
  box.rate ? svgElement('text', {class: 'rate', y: top + box.lines.length * kLineHeight}, box.rate) : null);
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
  // The line below it is as wide as a pointer needs.
  return svgElement('g', {class: dim ? 'edge dim' : 'edge'}, svgElement('title', {}, text), svgElement('path', {class: 'reach', d: path}),
    svgElement('path', {class: 'line', d: path, 'marker-end': 'url(#tip)', 'stroke-dasharray': line.count === 0 ? '3 4' : null}));
}
