// SPDX-License-Identifier: Apache-2.0
// Draws the time chart on a canvas.

const kRowHeight = 22;
const kHeadHeight = 24;      // of a heading
const kScaleHeight = 26;     // of the time scale
const kMapHeight = 34;       // of the whole trace above it
const kLabelWidth = 200;     // of the names of rows; less where there is little room
const kStateHeight = 4;      // of the strip that tells what a thread did
const kMostArrows = 400;

// `chart` is a TimeChart. Its `view.top` is how far rows are scrolled.
function drawTimeChart(context, chart) {
  const {width, height} = chart;
  const style = {};
  for (const name of ['panel', 'text', 'faint', 'line', 'row', 'accent', 'arrow', 'bad', ...kStates.map(state => state.color)]) style[name] = color(name);
  style.lightness = color('callback-lightness');
  context.fillStyle = style.panel;
  context.fillRect(0, 0, width, height);
  context.font = '12px system-ui, "DejaVu Sans", sans-serif';
  context.textBaseline = 'middle';
  drawMap(context, chart, style);
  drawScale(context, chart, style);
  context.save();
  context.beginPath();
  context.rect(0, kMapHeight + kScaleHeight, width, height - kMapHeight - kScaleHeight);
  context.clip();
  drawRows(context, chart, style);
  chart.arrowsHidden = drawArrows(context, chart, style);
  drawFlow(context, chart, style);
  context.restore();
  drawLauncherEvents(context, chart, style);
}

function rowTop(chart, i) {
  return kMapHeight + kScaleHeight + chart.tops[i] - chart.view.top;
}

function labelWidth(chart) {
  return Math.min(kLabelWidth, Math.round(chart.width * 0.35));
}

function timeX(chart, time) {
  const {begin, end} = chart.view;
  return labelWidth(chart) + (time - begin) / (end - begin) * (chart.width - labelWidth(chart));
}

// How busy the whole trace is, with the part that is shown.
function drawMap(context, chart, style) {
  const {map, width, view, limits} = chart;
  const span = width - labelWidth(chart);
  const x = time => labelWidth(chart) + (time - limits.begin) / (limits.end - limits.begin) * span;
  const step = chart.duration / map.length;
  const most = Math.max(...map, 1e-9);
  context.fillStyle = style.row;
  context.fillRect(labelWidth(chart), 0, span, kMapHeight - 6);
  context.fillStyle = style.faint;
  map.forEach((share, i) => {
    const height = share / most * (kMapHeight - 8);
    context.fillRect(x(i * step), kMapHeight - 6 - height, Math.max(1, x(step) - x(0)), height);
  });
  const [x0, x1] = [x(view.begin), x(view.end)];
  context.globalAlpha = 0.18;
  context.fillStyle = style.accent;
  context.fillRect(x0, 0, Math.max(2, x1 - x0), kMapHeight - 6);
  context.globalAlpha = 1;
  context.strokeStyle = style.accent;
  context.strokeRect(x0 + 0.5, 0.5, Math.max(2, x1 - x0) - 1, kMapHeight - 7);
  context.fillStyle = style.faint;
  context.fillText('whole trace', 4, kMapHeight / 2 - 3);
}

// Steps of 1, 2 or 5 times a power of ten.
function niceStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * [1, 2, 5, 10].find(factor => factor * power >= least);
}

function drawScale(context, chart, style) {
  const {begin, end} = chart.view;
  const step = Math.max(1, niceStep((end - begin) / Math.max(2, (chart.width - labelWidth(chart)) / 110)));
  const middle = kMapHeight + kScaleHeight / 2;
  context.textAlign = 'center';
  for (let time = Math.ceil(begin / step) * step; time <= end; time += step) {
    const x = Math.round(timeX(chart, time)) + 0.5;
    context.fillStyle = style.line;
    context.fillRect(x, kMapHeight + kScaleHeight - 5, 1, chart.height);
    context.fillStyle = style.faint;
    context.fillText(formatTime(time, step), Math.min(x, chart.width - 30), middle - 2);
  }
  context.textAlign = 'left';
  context.fillText(`${formatDuration(end - begin)} shown`, 4, middle);
}

function drawRows(context, chart, style) {
  const {rows, view, width, data} = chart;
  const span = width - labelWidth(chart);
  const marked = chart.options.marked();
  rows.forEach((row, i) => {
    const top = rowTop(chart, i);
    const height = row.heading ? kHeadHeight : kRowHeight;
    if (top + height < kMapHeight || top > chart.height) return;
    if (row.heading) {
      context.fillStyle = style.row;
      context.fillRect(0, top + 2, width, height - 4);
      context.fillStyle = style.text;
      context.font = '600 12px system-ui, "DejaVu Sans", sans-serif';
      context.fillText(row.text, 6, top + height / 2);
      context.font = '12px system-ui, "DejaVu Sans", sans-serif';
      return;
    }
    if (i === chart.row) {
      context.globalAlpha = 0.1;
      context.fillStyle = style.accent;
      context.fillRect(0, top, width, height);
      context.globalAlpha = 1;
    }
    context.fillStyle = row.alone ? style.text : style.faint;
    context.fillText(fitted(context, row.text, labelWidth(chart) - (row.alone ? 14 : 22)), row.alone ? 6 : 14, top + height / 2);
    context.fillStyle = style.line;
    context.fillRect(0, top + height - 1, width, 1);
    const barHeight = heightOfBars(data);
    if (row.states) drawStates(context, chart, style, row.states, top + height - 2 - kStateHeight);
    const draw = (intervals, inset) => intervals.draw(view.begin, view.end, span, (from, to, id, share) => {
      const x = Math.max(from, 0);
      const w = Math.max(Math.min(to, span) - x, 1);
      const callback = data.instances.callback[id];
      context.globalAlpha = (0.35 + 0.65 * share) * (marked === null || marked === callback ? 1 : 0.3);  // what is short can be seen, too
      context.fillStyle = barColor(data.callbacks[callback].color, style.lightness);
      context.fillRect(labelWidth(chart) + x, top + 3 + inset, w, barHeight - inset);
      if (data.states.count > 0 && row.callback !== undefined && share === 1 && w > 2) {
        drawStates(context, chart, style, statesOf(data, data.instances.thread[id]), top + height - 2 - kStateHeight, id);
      }
      if (w > 60 && share === 1 && inset === 0) {
        context.fillStyle = '#10151d';
        context.fillText(fitted(context, data.callbacks[callback].label, w - 10), labelWidth(chart) + x + 5, top + 3 + barHeight / 2);
      }
    });
    for (let intervals = row.intervals, inset = 0; intervals; intervals = intervals.nested, inset = Math.min(inset + 5, 10)) draw(intervals, inset);
    context.globalAlpha = 1;
  });
}

// A strip for the states of threads needs a part of the row.
function heightOfBars(data) {
  return kRowHeight - 6 - (data.states.count > 0 ? kStateHeight + 1 : 0);
}

// A strip that tells what a thread did on the machine; within one instance, if one is given.
function drawStates(context, chart, style, states, top, instance = -1) {
  if (!states) return;
  const {view, width, data: {instances}} = chart;
  const span = width - labelWidth(chart);
  const begin = instance < 0 ? view.begin : Math.max(view.begin, instances.start[instance]);
  const end = instance < 0 ? view.end : Math.min(view.end, instances.end[instance]);
  if (end <= begin) return;
  const [left, right] = [timeX(chart, begin), timeX(chart, end)];
  kStates.map((_, state) => state).reverse().forEach(state => {
    context.fillStyle = style[kStates[state].color];
    states.lines[state].draw(begin, end, Math.max(1, Math.round(right - left)), (from, to, id, share) => {
      const x = Math.max(left + from, left);
      context.globalAlpha = share;
      context.fillRect(x, top, Math.max(Math.min(left + to, right) - x, 0.5), kStateHeight);
    });
  });
  context.globalAlpha = 1;
}

function fitted(context, text, width) {
  if (context.measureText(text).width <= width) return text;
  let length = text.length;
  while (length > 1 && context.measureText(`${text.slice(0, length)}…`).width > width) length = Math.floor(length * 0.9);
  return `${text.slice(0, length)}…`;
}

// The ends of a message's arrow, or null if one of its rows is not shown.
function arrowEnds(chart, message) {
  const {data: {messages, instances}, index} = chart;
  if (messages.to[message] < 0) return null;
  const from = messages.from[message] >= 0 ? index.rowOf(messages.from[message]) : index.rowOfThread(messages.thread[message]);
  const to = index.rowOf(messages.to[message]);
  if (from < 0 || to < 0) return null;
  const middle = row => rowTop(chart, row) + kRowHeight / 2;
  return {x0: timeX(chart, messages.published[message]), y0: middle(from), x1: timeX(chart, instances.start[messages.to[message]]), y1: middle(to)};
}

function drawArrow(context, {x0, y0, x1, y1}) {
  context.beginPath();
  context.moveTo(x0, y0);
  const bend = Math.min(40, Math.abs(x1 - x0) / 2 + 6);
  context.bezierCurveTo(x0 + bend, y0, x1 - bend, y1, x1, y1);
  context.stroke();
  context.beginPath();
  context.moveTo(x1, y1);
  context.lineTo(x1 - 6, y1 - 3);
  context.lineTo(x1 - 6, y1 + 3);
  context.fill();
}

// Returns the number of messages whose arrows were left out, because they would cover everything.
function drawArrows(context, chart, style) {
  const {data: {messages}, view} = chart;
  if (!chart.arrows) return 0;
  const first = lowerBound(messages.published, view.begin - messages.slowest);
  const last = lowerBound(messages.published, view.end);
  if (last - first > 20 * kMostArrows) return last - first;
  const visible = [];
  for (let i = first; i < last; ++i) {
    const ends = arrowEnds(chart, i);
    if (ends && ends.x1 >= labelWidth(chart)) visible.push(ends);
  }
  if (visible.length > kMostArrows) return visible.length;
  context.save();
  context.beginPath();
  context.rect(labelWidth(chart), 0, chart.width, chart.height);
  context.clip();
  context.strokeStyle = context.fillStyle = style.arrow;
  context.globalAlpha = visible.length > 150 ? 0.4 : 0.75;
  for (const ends of visible) drawArrow(context, ends);
  context.restore();
  return 0;
}
