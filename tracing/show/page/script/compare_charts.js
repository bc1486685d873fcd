// SPDX-License-Identifier: Apache-2.0
// The time charts of two runs below one another. They zoom and move together; `lag` is how much later the same moment is in
// the run after: 0 if both are aligned at their begin.

class ChartPair {
  // onChange() is told when another instance is chosen.
  constructor(runs, options, onChange) {
    this.options = options;
    this.onChange = onChange;
    this.isMoving = false;
    this.current = 0;
    const length = Math.max(...runs.map(data => Math.max(1, data.duration)));
    options.view ??= {begin: 0, end: length};
    this.charts = runs.map((data, side) => new TimeChart(data, {
      by: options.by, arrows: options.arrows, view: {begin: options.view.begin + this.lagOf(side), end: options.view.end + this.lagOf(side), top: 0},
      chosen: () => options.chosen[side], marked: () => options.marked?.[side] ?? null,
      choose: instance => { options.chosen[side] = instance; this.current = side; onChange(); },
      onMove: chart => this.follow(chart, side), most: () => Math.max(180, (window.innerHeight - 260) / 2),
      limits: this.limitsOf(side, length),
    }));
    this.length = length;
    this.charts.forEach((chart, side) => chart.canvas.addEventListener('pointerdown', () => { this.current = side; }));
  }

  lagOf(side) {
    return side === 1 ? this.options.lag : 0;
  }

  // Both runs, wherever the other one lies.
  limitsOf(side, length) {
    const begin = Math.min(0, -this.options.lag) + this.lagOf(side);
    return {begin, end: begin + length + Math.abs(this.options.lag)};
  }

  follow(moved, side) {
    const {begin, end} = moved.view;
    const since = this.lagOf(side);
    Object.assign(this.options.view, {begin: begin - since, end: end - since});
    if (this.isMoving) return;
    this.isMoving = true;
    const other = this.charts[1 - side];
    other.setView(begin - since + this.lagOf(1 - side), end - since + this.lagOf(1 - side));
    this.isMoving = false;
  }

  // Moves the run after, so that a time of it stands below a time of the run before.
  align(before, after) {
    this.options.lag = after - before;
    this.charts.forEach((chart, side) => { chart.limits = this.limitsOf(side, this.length); });
    const {begin, end} = this.charts[0].view;
    this.charts[0].setView(begin, end);
  }

  // Shows these instances, {instance, since} of each run or null, and aligns where they begin.
  show(examples) {
    const {options} = this;
    options.chosen = examples.map(example => example?.instance ?? null);
    const shown = examples.map((example, side) => example && {begin: example.since, end: this.charts[side].data.instances.end[example.instance]});
    if (shown[0] && shown[1]) this.align(shown[0].begin, shown[1].begin);
    const side = shown[0] ? 0 : 1;
    if (shown[side]) {
      const length = Math.max(...shown.filter(Boolean).map(({begin, end}) => end - begin), 1e4);
      this.charts[side].setView(shown[side].begin - length * 0.3, shown[side].begin + length * 1.6);
    }
    examples.forEach((example, k) => {
      const chart = this.charts[k];
      const row = example ? chart.index.rowOf(example.instance) : -1;
      if (row < 0) return;
      chart.row = row;
      this.isMoving = true;
      chart.setView(chart.view.begin, chart.view.end, chart.topFor(row));
      this.isMoving = false;
    });
    this.onChange();
  }

  get chart() {
    return this.charts[this.current];
  }

  setArrows(shown) {
    this.options.arrows = shown;
    for (const chart of this.charts) {
      chart.arrows = shown;
      chart.redraw();
    }
  }

  setRows(by) {
    this.options.by = by;
    for (const chart of this.charts) {
      chart.by = by;
      chart.makeRows();
    }
  }

  redraw() {
    for (const chart of this.charts) chart.redraw();
  }
}
