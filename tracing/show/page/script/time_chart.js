// SPDX-License-Identifier: Apache-2.0
// A time chart: which callback ran when in which thread, and which messages went between them. Here is what it shows and
// how that moves; time_chart_view.js makes a view of it, time_chart_draw.js draws it.
//
// options: {by: 'thread' or 'callback', arrows, view: {begin, end, top}, chosen: () => instance or null,
// marked: () => the callback that is not faded or null, choose: instance or null => …}, and optionally {onMove: chart => …,
// onDraw: () => …, isShown: callback => whether its row or bars are shown, most: () => its height in pixels at most, limits: {begin, end} of what can be shown}.
class TimeChart {
  constructor(data, options) {
    this.data = data;
    this.options = options;
    this.duration = Math.max(1, data.duration);
    this.limits = options.limits ?? {begin: 0, end: this.duration};
    Object.assign(this, {width: 0, height: 0, row: -1, by: options.by, arrows: options.arrows, view: options.view, arrowsHidden: 0});
    this.canvas = element('canvas', {tabindex: 0, role: 'img', 'aria-label': 'Time chart of callbacks; ? lists its keys'});
    this.tip = element('div', {class: 'tip', hidden: true});
    this.element = element('div', {class: 'time'}, this.canvas, this.tip);
    this.makeRows();
    listenToPointer(this);
    new ResizeObserver(() => this.redraw()).observe(this.element);
  }

  makeRows() {
    const isShown = this.options.isShown ?? (() => true);
    this.rows = timeChartRows(this.data, this.by, isShown);
    this.index = rowIndex(this.data, this.rows, this.by, isShown);
    this.tops = [];
    let top = 0;
    for (const row of this.rows) {
      this.tops.push(top);
      top += row.heading ? kHeadHeight : kRowHeight;
    }
    this.rowsHeight = top;
    this.row = -1;
    const steps = 300;
    const lines = this.rows.filter(row => row.intervals);
    this.map = Array.from({length: steps}, (_, i) => lines.reduce(
      (sum, row) => sum + row.intervals.busyTime(i * this.duration / steps, (i + 1) * this.duration / steps), 0));
    this.redraw();
  }

  get chosen() {
    return this.options.chosen();
  }

  // What came before the chosen instance, and what came of it.
  get flow() {
    const instance = this.chosen;
    if (this.drawnFlow?.instance !== instance) this.drawnFlow = instance === null ? null : messageFlow(this.data, instance);
    return this.drawnFlow;
  }

  redraw() {
    if (this.isWaiting || !this.element) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      if (!this.canvas.isConnected) return;
      this.resize();
      const context = this.canvas.getContext('2d');
      const scale = window.devicePixelRatio;
      context.setTransform(scale, 0, 0, scale, 0, 0);
      drawTimeChart(context, this);
      this.options.onDraw?.();
    });
  }

  resize() {
    this.width = this.element.clientWidth;
    this.height = Math.min(kMapHeight + kScaleHeight + this.rowsHeight + 8, Math.max(260, this.options.most?.() ?? window.innerHeight - 230));
    const scale = window.devicePixelRatio;
    if (this.canvas.width === Math.round(this.width * scale) && this.canvas.height === Math.round(this.height * scale)) return;
    this.canvas.width = Math.round(this.width * scale);
    this.canvas.height = Math.round(this.height * scale);
    this.canvas.style.height = `${this.height}px`;
  }

  setView(begin, end, top = this.view.top) {
    const {begin: first, end: last} = this.limits;
    const span = Math.min(Math.max(end - begin, 100), last - first);
    const from = Math.min(Math.max(begin + (end - begin - span) / 2, first), last - span);
    const room = Math.max(0, this.rowsHeight + 8 - this.rowsRoom());
    Object.assign(this.view, {begin: from, end: from + span, top: Math.min(Math.max(top, 0), room)});
    this.redraw();
    this.options.onMove?.(this);
  }

  rowsRoom() {
    return this.height - kMapHeight - kScaleHeight;
  }

  span() {
    return this.view.end - this.view.begin;
  }

  timeAt(x) {
    return this.view.begin + (x - labelWidth(this)) / (this.width - labelWidth(this)) * this.span();
  }

  zoom(factor, time = (this.view.begin + this.view.end) / 2) {
    this.setView(time - (time - this.view.begin) * factor, time + (this.view.end - time) * factor);
  }

  pan(share) {
    this.setView(this.view.begin + share * this.span(), this.view.end + share * this.span());
  }

  showAll() {
    this.setView(this.limits.begin, this.limits.end);
  }

  rowAt(y) {
    const at = y - kMapHeight - kScaleHeight + this.view.top;
    if (y < kMapHeight + kScaleHeight) return -1;
    return this.rows.findIndex((row, i) => at >= this.tops[i] && at < this.tops[i] + (row.heading ? kHeadHeight : kRowHeight));
  }

  instanceAt(x, y) {
    const row = this.rows[this.rowAt(y)];
    if (!row?.intervals || x < labelWidth(this)) return -1;
    return row.intervals.at(this.timeAt(x), 4 * this.span() / (this.width - labelWidth(this)));
  }

  // What the thread of a row or of an instance did at a place, or -1.
  stateAt(x, y, instance) {
    const row = this.rows[this.rowAt(y)];
    if (!row || x < labelWidth(this)) return -1;
    const states = instance < 0 ? row.states : statesOf(this.data, this.data.instances.thread[instance]);
    return states?.at(this.timeAt(x)) ?? -1;
  }

  // Chooses an instance and moves it into sight.
  show(instance) {
    const {start, end} = this.data.instances;
    const row = this.index.rowOf(instance);
    this.options.choose(instance);
    if (row < 0) return;
    this.row = row;
    const begin = start[instance];
    const isShown = begin >= this.view.begin && end[instance] <= this.view.end;
    const width = Math.max(this.span(), (end[instance] - begin) * 1.2);
    if (isShown) this.setView(this.view.begin, this.view.end, this.topFor(row));
    else this.setView(begin - width / 3, begin + 2 * width / 3, this.topFor(row));
  }

  // How far to scroll, at least, so that a row is in sight.
  topFor(row) {
    return Math.min(Math.max(this.view.top, this.tops[row] - this.rowsRoom() + kRowHeight), this.tops[row]);
  }

  // Shows all of the chosen message's way.
  showFlow() {
    const {flow} = this;
    if (!flow) return;
    const width = Math.max(100, flow.end - flow.begin);
    this.setView(flow.begin - width * 0.05, flow.end + width * 0.05);
  }

  // The next or the previous instance in the chosen row; the first that is shown, if none is chosen.
  step(by) {
    let row = this.rows[this.row];
    if (!row?.intervals) {
      this.row = this.rows.findIndex(candidate => candidate.intervals);
      row = this.rows[this.row];
    }
    if (!row) return;
    const {ids, start} = row.intervals;
    const current = this.chosen === null || this.index.rowOf(this.chosen) !== this.row ? -1 : lowerBound(ids, this.chosen);
    const next = current < 0 ? Math.min(lowerBound(start, this.view.begin), ids.length - 1) : current + by;
    if (next >= 0 && next < ids.length) this.show(ids[next]);
  }

  moveRow(by) {
    for (let i = this.row + by; i >= 0 && i < this.rows.length; i += by) {
      if (this.rows[i].heading) continue;
      this.row = i;
      this.setView(this.view.begin, this.view.end, this.topFor(i));
      return;
    }
  }
}

// The wheel scrolls, with Ctrl it zooms; dragging moves; two fingers zoom; a click chooses.
function listenToPointer(chart) {
  const {canvas, tip, data} = chart;
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    const isZoom = event.ctrlKey || event.metaKey || (!event.shiftKey && chart.rowsHeight + 8 <= chart.rowsRoom());
    if (isZoom) chart.zoom(1.0015 ** event.deltaY, chart.timeAt(Math.max(event.offsetX, labelWidth(chart))));
    else if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) chart.pan((event.deltaX || event.deltaY) / 1000);
    else chart.setView(chart.view.begin, chart.view.end, chart.view.top + event.deltaY);
  }, {passive: false});

  let drag = null;
  const fingers = new Map();  // where they are, by the id of the pointer
  const pinch = event => {
    const [, other] = [...fingers].find(([key]) => key !== event.pointerId);
    const distance = x => Math.max(10, Math.abs(x - other));
    chart.zoom(distance(fingers.get(event.pointerId)) / distance(event.offsetX), chart.timeAt((event.offsetX + other) / 2));
    fingers.set(event.pointerId, event.offsetX);
  };
  const moveMap = x => {
    const {begin, end} = chart.limits;
    const middle = begin + (x - labelWidth(chart)) / (chart.width - labelWidth(chart)) * (end - begin);
    chart.setView(middle - chart.span() / 2, middle + chart.span() / 2);
  };
  canvas.addEventListener('pointerdown', event => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, event.offsetX);
    drag = {x: event.offsetX, y: event.offsetY, ...chart.view, moved: false, inMap: event.offsetY < kMapHeight};
    if (drag.inMap) moveMap(event.offsetX);
  });
  canvas.addEventListener('pointermove', event => {
    if (fingers.size > 1 && fingers.has(event.pointerId)) {
      if (drag) drag.moved = true;
      return pinch(event);
    }
    if (drag?.inMap) return moveMap(event.offsetX);
    if (drag) {
      const [dx, dy] = [event.offsetX - drag.x, event.offsetY - drag.y];
      if (Math.abs(dx) + Math.abs(dy) > 3) drag.moved = true;
      const shift = -dx / (chart.width - labelWidth(chart)) * (drag.end - drag.begin);
      if (drag.moved) chart.setView(drag.begin + shift, drag.end + shift, drag.top - dy);
      return;
    }
    const instance = chart.instanceAt(event.offsetX, event.offsetY);
    const state = chart.stateAt(event.offsetX, event.offsetY, instance);
    const ofLauncher = launcherEventAt(chart, event.offsetX, event.offsetY);
    tip.hidden = instance < 0 && state < 0 && !ofLauncher;
    if (tip.hidden) return;
    tip.textContent = [ofLauncher ? launcherEventText(ofLauncher) : null, instance < 0 ? null : instanceText(data, instance), state < 0 ? null : `here: ${stateText(data, state)}`].filter(Boolean).join('\n');
    tip.style.left = `${Math.max(0, Math.min(event.offsetX + 14, chart.width - tip.offsetWidth - 4))}px`;
    tip.style.top = `${event.offsetY + 16}px`;
  });
  canvas.addEventListener('pointerup', event => {
    if (drag && !drag.moved && !drag.inMap) {
      const instance = chart.instanceAt(event.offsetX, event.offsetY);
      chart.row = chart.rowAt(event.offsetY);
      chart.options.choose(instance < 0 ? null : instance);
      chart.redraw();
    }
    fingers.delete(event.pointerId);
    drag = null;
  });
  canvas.addEventListener('pointercancel', () => {
    fingers.clear();
    drag = null;
  });
  canvas.addEventListener('pointerleave', () => { tip.hidden = true; });
  canvas.addEventListener('dblclick', event => chart.zoom(0.25, chart.timeAt(Math.max(event.offsetX, labelWidth(chart)))));
}
