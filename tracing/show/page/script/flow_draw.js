// SPDX-License-Identifier: Apache-2.0
// Draws the way of a message on the time chart.

const kFlowColors = {sending: 265, way: 38, taken: 350};

function stageColor(kind) {
  return `hsl(${kFlowColors[kind]} 75% ${color('bar-lightness')})`;
}

// The chosen instance, and the messages that led to it and from it.
function drawFlow(context, chart, style) {
  const {data, index, flow} = chart;
  if (!flow) return;
  const {instances, messages} = data;
  context.save();
  context.beginPath();
  context.rect(labelWidth(chart), 0, chart.width, chart.height);
  context.clip();
  context.strokeStyle = context.fillStyle = style.accent;
  for (const instance of flow.instances) {
    const row = index.rowOf(instance);
    if (row < 0) continue;
    const x = timeX(chart, instances.start[instance]);
    const w = Math.max(2, timeX(chart, instances.end[instance]) - x);
    context.lineWidth = instance === flow.instance ? 3 : 1.5;
    context.strokeRect(x, rowTop(chart, row) + 2, w, heightOfBars(data) + 2);
  }
  context.lineWidth = 2;
  for (const message of flow.messages) {
    const ends = arrowEnds(chart, message);
    if (ends) drawArrow(context, ends);
  }
  for (const message of flow.messages) drawStages(context, chart, style, message);
  context.restore();
}

// Below the callbacks: in the row that publishes, the time in publish(); in the row that takes, the way until the take, and
// from there to the callback.
function drawStages(context, chart, style, message) {
  const {data, index} = chart;
  const {messages, instances} = data;
  const stage = (row, from, to, kind, name) => {
    if (row < 0 || Number.isNaN(to)) return;
    const [x0, x1] = [timeX(chart, from), timeX(chart, to)];
    const y = rowTop(chart, row) + kRowHeight - 5 - (data.states.count > 0 ? kStateHeight + 1 : 0);
    context.fillStyle = stageColor(kind);
    context.fillRect(Math.min(x0, x1), y, Math.max(1, Math.abs(x1 - x0)), 4);
    context.fillRect(x1 - 0.75, y - 4, 1.5, 8);
    const text = `${name} ${formatDuration(to - from)}`;
    if (Math.abs(x1 - x0) < context.measureText(text).width + 8) return;
    context.font = '10px system-ui, "DejaVu Sans", sans-serif';
    const left = Math.max(x0, labelWidth(chart)) + 4;
    context.globalAlpha = 0.8;
    context.fillStyle = style.panel;
    context.fillRect(left - 2, y - 11, context.measureText(text).width + 4, 11);
    context.globalAlpha = 1;
    context.fillStyle = style.text;
    context.fillText(text, left, y - 5);
    context.font = '12px system-ui, "DejaVu Sans", sans-serif';
  };
  const from = messages.from[message] >= 0 ? index.rowOf(messages.from[message]) : index.rowOfThread(messages.thread[message]);
  stage(from, messages.called[message], messages.published[message] + Math.max(0, messages.written[message]), 'sending', 'publish');
  const to = messages.to[message];
  if (to < 0) return;
  stage(index.rowOf(to), messages.published[message], messages.taken[message], 'way', 'on the way, in the queue');
  stage(index.rowOf(to), messages.taken[message], instances.start[to], 'taken', 'taken');
}
