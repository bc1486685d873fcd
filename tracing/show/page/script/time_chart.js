// SPDX-License-Identifier: Apache-2.0
// The time chart: which callback ran when in which thread, and which messages went between them. The wheel scrolls, with
// Ctrl it zooms; dragging moves; keys do the same.

// What the reader has set; it stays when the view changes.
const timeChartOptions = {by: 'thread', arrows: true, view: null};

function timeChartView(data) {
  const canvas = element('canvas', {tabindex: 0, role: 'img', 'aria-label': 'Time chart of callbacks; keys are listed below'});
  const tip = element('div', {class: 'tip', hidden: true});
  const note = element('span', {class: 'faint', 'aria-live': 'polite'});
  const details = element('div', {class: 'details', 'aria-live': 'polite'});
  const chart = {data, duration: Math.max(1, data.duration), width: 0, height: 0, row: -1, arrows: timeChartOptions.arrows};
  chart.view = timeChartOptions.view ??= {begin: 0, end: chart.duration, top: 0};
  let waiting = false;

  function makeRows() {
    chart.rows = timeChartRows(data, timeChartOptions.by);
    chart.index = rowIndex(data, chart.rows, timeChartOptions.by);
    chart.tops = [];
    let top = 0;
    for (const row of chart.rows) {
      chart.tops.push(top);
      top += row.heading ? kHeadHeight : kRowHeight;
    }
    chart.rowsHeight = top;
    chart.row = -1;
    const steps = 300;
    const lines = chart.rows.filter(row => row.intervals);
    chart.map = Array.from({length: steps}, (_, i) => lines.reduce(
      (sum, row) => sum + row.intervals.busyTime(i * chart.duration / steps, (i + 1) * chart.duration / steps), 0));
  }

  function redraw() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      if (!canvas.isConnected) return;
      resize();
      const context = canvas.getContext('2d');
      const scale = window.devicePixelRatio;
      context.setTransform(scale, 0, 0, scale, 0, 0);
      drawTimeChart(context, chart);
      note.textContent = chart.rows.length === 0 ? 'No callbacks to show.' :
        chart.arrowsHidden ? `${plural(chart.arrowsHidden, 'message')} in this time: zoom in to see arrows.` : '';
    });
  }

  function resize() {
    chart.width = canvas.parentElement.clientWidth;
    chart.height = Math.min(kMapHeight + kScaleHeight + chart.rowsHeight + 8, Math.max(260, window.innerHeight - 230));
    const scale = window.devicePixelRatio;
    if (canvas.width === Math.round(chart.width * scale) && canvas.height === Math.round(chart.height * scale)) return;
    canvas.width = Math.round(chart.width * scale);
    canvas.height = Math.round(chart.height * scale);
    canvas.style.height = `${chart.height}px`;
  }

  function setView(begin, end, top = chart.view.top) {
    const span = Math.min(Math.max(end - begin, 100), chart.duration);
    const from = Math.min(Math.max(begin + (end - begin - span) / 2, 0), chart.duration - span);
    const room = Math.max(0, chart.rowsHeight + 8 - (chart.height - kMapHeight - kScaleHeight));
    Object.assign(chart.view, {begin: from, end: from + span, top: Math.min(Math.max(top, 0), room)});
    redraw();
  }

  const span = () => chart.view.end - chart.view.begin;
  const timeAt = x => chart.view.begin + (x - labelWidth(chart)) / (chart.width - labelWidth(chart)) * span();
  const zoom = (factor, time = (chart.view.begin + chart.view.end) / 2) =>
    setView(time - (time - chart.view.begin) * factor, time + (chart.view.end - time) * factor);
  const pan = share => setView(chart.view.begin + share * span(), chart.view.end + share * span());

  function rowAt(y) {
    const at = y - kMapHeight - kScaleHeight + chart.view.top;
    if (y < kMapHeight + kScaleHeight) return -1;
    return chart.rows.findIndex((row, i) => at >= chart.tops[i] && at < chart.tops[i] + (row.heading ? kHeadHeight : kRowHeight));
  }

  function instanceAt(x, y) {
    const row = chart.rows[rowAt(y)];
    if (!row?.intervals || x < labelWidth(chart)) return -1;
    return row.intervals.at(timeAt(x), 4 * span() / (chart.width - labelWidth(chart)));
  }

  // What the thread of a row or of an instance did at a place, or -1.
  function stateAt(x, y, instance) {
    const row = chart.rows[rowAt(y)];
    if (!row || x < labelWidth(chart)) return -1;
    const states = instance < 0 ? row.states : statesOf(data, data.instances.thread[instance]);
    return states?.at(timeAt(x)) ?? -1;
  }

  // Chooses an instance and moves it into sight.
  function show(instance) {
    const {start, end} = data.instances;
    const row = chart.index.rowOf(instance);
    select({instance});
    if (row < 0) return;
    chart.row = row;
    const [begin, length] = [start[instance], span()];
    const isShown = begin >= chart.view.begin && end[instance] <= chart.view.end;
    const rowsShown = chart.height - kMapHeight - kScaleHeight - kRowHeight;
    const top = Math.min(Math.max(chart.view.top, chart.tops[row] - rowsShown), chart.tops[row]);
    const width = Math.max(length, (end[instance] - begin) * 1.2);
    if (isShown) setView(chart.view.begin, chart.view.end, top);
    else setView(begin - width / 3, begin + 2 * width / 3, top);
  }

  // The next or the previous instance in the chosen row; the first that is shown, if none is chosen.
  function step(by) {
    let row = chart.rows[chart.row];
    if (!row?.intervals) {
      chart.row = chart.rows.findIndex(candidate => candidate.intervals);
      row = chart.rows[chart.row];
    }
    if (!row) return;
    const {ids, start} = row.intervals;
    const current = selection.instance === null || chart.index.rowOf(selection.instance) !== chart.row ? -1 : lowerBound(ids, selection.instance);
    const next = current < 0 ? Math.min(lowerBound(start, chart.view.begin), ids.length - 1) : current + by;
    if (next >= 0 && next < ids.length) show(ids[next]);
  }

  function moveRow(by) {
    for (let i = chart.row + by; i >= 0 && i < chart.rows.length; i += by) {
      if (chart.rows[i].heading) continue;
      chart.row = i;
      const room = chart.height - kMapHeight - kScaleHeight - kRowHeight;
      setView(chart.view.begin, chart.view.end, Math.min(Math.max(chart.view.top, chart.tops[i] - room), chart.tops[i]));
      return;
    }
  }

  function setArrows(shown) {
    chart.arrows = timeChartOptions.arrows = arrows.checked = shown;
    redraw();
  }

  const keys = {
    '+': () => zoom(0.6), '=': () => zoom(0.6), w: () => zoom(0.6), '-': () => zoom(1 / 0.6), s: () => zoom(1 / 0.6),
    ArrowLeft: () => pan(-0.2), a: () => pan(-0.2), ArrowRight: () => pan(0.2), d: () => pan(0.2),
    ArrowUp: () => moveRow(-1), ArrowDown: () => moveRow(1), Home: () => setView(0, chart.duration), 0: () => setView(0, chart.duration),
    n: () => step(1), p: () => step(-1), m: () => setArrows(!chart.arrows), Escape: () => select({instance: null}),
  };
  canvas.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });

  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    const isZoom = event.ctrlKey || event.metaKey || (!event.shiftKey && chart.rowsHeight + 8 <= chart.height - kMapHeight - kScaleHeight);
    if (isZoom) zoom(1.0015 ** event.deltaY, timeAt(Math.max(event.offsetX, labelWidth(chart))));
    else if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) pan((event.deltaX || event.deltaY) / 1000);
    else setView(chart.view.begin, chart.view.end, chart.view.top + event.deltaY);
  }, {passive: false});

  let drag = null;
  canvas.addEventListener('pointerdown', event => {
    canvas.setPointerCapture(event.pointerId);
    drag = {x: event.offsetX, y: event.offsetY, ...chart.view, moved: false, inMap: event.offsetY < kMapHeight};
    if (drag.inMap) moveMap(event.offsetX);
  });
  const moveMap = x => {
    const middle = (x - labelWidth(chart)) / (chart.width - labelWidth(chart)) * chart.duration;
    setView(middle - span() / 2, middle + span() / 2);
  };
  canvas.addEventListener('pointermove', event => {
    if (drag?.inMap) return moveMap(event.offsetX);
    if (drag) {
      const [dx, dy] = [event.offsetX - drag.x, event.offsetY - drag.y];
      if (Math.abs(dx) + Math.abs(dy) > 3) drag.moved = true;
      const shift = -dx / (chart.width - labelWidth(chart)) * (drag.end - drag.begin);
      if (drag.moved) setView(drag.begin + shift, drag.end + shift, drag.top - dy);
      return;
    }
    const instance = instanceAt(event.offsetX, event.offsetY);
    const state = stateAt(event.offsetX, event.offsetY, instance);
    tip.hidden = instance < 0 && state < 0;
    if (tip.hidden) return;
    tip.textContent = [instance < 0 ? null : instanceText(data, instance), state < 0 ? null : `here: ${stateText(data, state)}`].filter(Boolean).join('\n');
    tip.style.left = `${Math.min(event.offsetX + 14, chart.width - tip.offsetWidth - 4)}px`;
    tip.style.top = `${event.offsetY + 16}px`;
  });
  canvas.addEventListener('pointerup', event => {
    if (drag && !drag.moved && !drag.inMap) {
      const instance = instanceAt(event.offsetX, event.offsetY);
      chart.row = rowAt(event.offsetY);
      select({instance: instance < 0 ? null : instance});
    }
    drag = null;
  });
  canvas.addEventListener('pointerleave', () => { tip.hidden = true; });
  canvas.addEventListener('dblclick', event => zoom(0.25, timeAt(Math.max(event.offsetX, labelWidth(chart)))));

  const by = element('select', {'aria-label': 'Rows', onchange: () => { timeChartOptions.by = by.value; refresh(); }},
    element('option', {value: 'thread'}, 'threads'), element('option', {value: 'callback'}, 'callbacks'));
  by.value = timeChartOptions.by;
  const arrows = element('input', {type: 'checkbox', onchange: () => setArrows(arrows.checked)});
  arrows.checked = chart.arrows;
  const button = (text, title, act) => element('button', {title, 'aria-label': title, onclick: act}, text);

  function refresh(change = {node: 0}) {
    if ('node' in change || 'topic' in change) makeRows();
    details.replaceChildren(instanceDetails(data, selection.instance, show));
    redraw();
  }

  new ResizeObserver(redraw).observe(canvas);
  refresh();
  const view = panel('Time chart', element('div', {class: 'tools'}, element('label', {}, 'rows', by), element('label', {}, arrows, 'messages'),
    button('+', 'Zoom in', () => zoom(0.6)), button('−', 'Zoom out', () => zoom(1 / 0.6)), button('All', 'Show the whole trace', () => setView(0, chart.duration)), stateKey(data), note),
  element('div', {class: 'time'}, canvas, tip),
  element('p', {class: 'note'}, ...keyHelp()));
  view.refresh = refresh;
  view.chart = chart;
  return [view, panel('Chosen callback', details)];
}

function keyHelp() {
  const help = [[['w', 's'], 'zoom'], [['a', 'd'], 'move'], [['↑', '↓'], 'row'], [['n', 'p'], 'next and previous callback'], [['m'], 'messages'], [['0'], 'everything'],
    [['Ctrl + wheel'], 'zoom'], [['drag'], 'move']];
  return help.flatMap(([keys, what]) => [...keys.flatMap(key => [element('kbd', {}, key), ' ']), `${what}   `]);
}
