// SPDX-License-Identifier: Apache-2.0
// The view of two runs: what the comparison found, a table of what both have, and their time charts below one another.

const compareOptions = {kind: 'callback', share: 'p99', subject: null, by: 'thread', arrows: true, view: null, lag: 0, chosen: [null, null], marked: null};
const kComparedKinds = [['callback', 'callbacks'], ['hop', 'hops of messages'], ['chain', 'chains'], ['call', 'calls of services']];

keysOf.compare = [...kTimeChartKeys, {keys: ['b'], what: 'the chart that keys of rows act on: before, after', act: pair => {
  pair.current = 1 - pair.current;
  pair.charts[pair.current].canvas.focus({preventScroll: true});
}}];
kPointerHelp.compare = kPointerHelp.time;

function sideLabel(side) {
  return element('span', {}, element('i', {class: 'swatch', style: `background: var(--${kSides[side]})`}), kSides[side]);
}

function compareView() {
  const {comparison, runs} = page;
  const subjects = comparedSubjects(runs).map(subject => ({...subject, verdict: verdictOf(comparison, subject)}));
  const place = element('div');
  const plots = element('div', {class: 'plots'});
  const ways = element('div', {class: 'two'});
  const pair = new ChartPair(runs, compareOptions, () => showWays());

  function choose(row) {
    compareOptions.subject = compareOptions.subject === row.subject ? null : row.subject;
    update(true);
  }

  // `isNew`: another subject, whose runs are to be shown.
  function update(isNew) {
    const rows = subjects.filter(({kind}) => kind === compareOptions.kind);
    place.replaceChildren(rows.length === 0 ? element('p', {class: 'faint'}, 'Neither run has any.') : subjectTable(rows, choose));
    const row = rows.find(({subject}) => subject === compareOptions.subject);
    const ids = row && row.kind === 'callback' ? row.sides.map(side => side?.id ?? null) : null;
    compareOptions.marked = ids;
    plots.replaceChildren(...(row ? distributionOfBoth(row) : []));
    if (isNew && row) pair.show(row.sides.map((side, k) => exampleOf(runs[k], side, row.kind, kShares[compareOptions.share])));
    showWays();
  }

  function showWays() {
    ways.replaceChildren(...pair.charts.map((chart, side) => chart.flow === null ? null : element('div', {class: 'panel'}, element('h2', {}, sideLabel(side), ': way of the message'),
      ...flowList(chart.data, chart.flow, instance => chart.show(instance), () => chart.showFlow()))).filter(Boolean));
    pair.redraw();
  }

  const by = choiceOf('Rows', [['thread', 'threads'], ['callback', 'callbacks']], compareOptions.by, value => pair.setRows(value));
  const arrows = element('input', {type: 'checkbox', onchange: () => pair.setArrows(arrows.checked)});
  arrows.checked = compareOptions.arrows;
  const setArrows = shown => pair.setArrows(arrows.checked = shown);
  const button = (text, title, act) => element('button', {title, 'aria-label': title, onclick: act}, text);
  const first = comparisonHead(comparison, subjects);
  first.keyTarget = {get chart() { return pair.chart; }, get current() { return pair.current; }, set current(side) { pair.current = side; }, charts: pair.charts, setArrows};
  first.first = pair.charts[0].canvas;
  first.pair = pair;
  first.refresh = () => true;  // the choices of the other views are of one run
  const kinds = choiceOf('What', kComparedKinds, compareOptions.kind, value => { Object.assign(compareOptions, {kind: value, subject: null}); update(false); });
  const shares = choiceOf('Percentile', kStatistics.slice(1, 4), compareOptions.share, value => { compareOptions.share = value; update(true); });
  update(false);
  return [first,
    comparedPanel('What both runs have', element('div', {class: 'tools'}, element('label', {}, 'show', kinds), element('label', {}, 'beside the median', shares),
      element('span', {class: 'faint'}, 'A click on a row shows the run of it that is at this percentile, in both charts.')), place, plots),
    panel('Time charts', element('div', {class: 'tools'}, element('label', {}, 'rows', by), element('label', {}, arrows, 'messages'),
      button('+', 'Zoom in', () => pair.chart.zoom(0.6)), button('−', 'Zoom out', () => pair.chart.zoom(1 / 0.6)), button('All', 'Show both runs', () => pair.charts[0].showAll()),
      button('Align begins', 'Align the first events of both', () => pair.align(0, 0)),
      button('Align chosen', 'Align the begins of the chosen callbacks', () => {
        const times = pair.charts.map(chart => chart.chosen === null ? NaN : chart.flow.begin);
        if (!times.some(Number.isNaN)) pair.align(...times);
      })),
    ...pair.charts.map((chart, side) => element('div', {class: 'side'}, element('h3', {}, sideLabel(side)), chart.element)),
    element('p', {class: 'note'}, 'Both charts move together. A callback has the same colour in both.')), ways];
}

// The verdict in words: the sides, what was compared, and how many subjects have changed.
function comparisonHead(comparison, subjects) {
  const run = (side, k) => {
    const [{events, duration_ns, remark}] = side.runs;
    return [element('dt', {}, sideLabel(k)), element('dd', {}, `${side.source}: ${plural(events, 'event')} in ${formatDuration(duration_ns)}`, remark ? element('span', {class: 'bad'}, `, ${remark}`) : null)];
  };
  const count = list => new Set(list.map(({kind, subject}) => `${kind} ${subject}`)).size;
  const changed = count(comparison.changes);
  const likely = count(comparison.likely);
  const slower = comparison.changes.some(({shift_ns}) => shift_ns > 0);
  const result = changed === 0 ? 'no change holds' : `${plural(changed, 'subject')} ${changed === 1 ? 'has' : 'have'} changed; with a confidence of ${+(comparison.confidence * 100).toPrecision(6)} % none of them by chance`;
  const overall = comparison.overall;
  return panel('Comparison', element('div', {class: 'facts'}, element('dl', {}, ...run(comparison.before, 0), ...run(comparison.after, 1),
    element('dt', {}, 'Compared'), element('dd', {}, `${plural(comparison.compared, 'subject')} in ${plural(comparison.tests, 'test')}` + (comparison.too_few_samples ? `; ${formatCount(comparison.too_few_samples)} quantities have too few samples` : '') + (comparison.undecided ? `; ${formatCount(comparison.undecided)} depend on which message comes last` : '')),
    element('dt', {}, 'Result'), element('dd', {}, element('b', {class: slower ? 'slower' : 'faster'}, result), likely ? `; ${formatCount(likely)} more with less confidence` : ''),
    ...(overall ? [element('dt', {}, 'Overall'), element('dd', {}, `${formatCount(overall.ratio > 0 ? overall.slower : overall.callbacks - overall.slower)} of ${plural(overall.callbacks, 'callback')} take ${overall.ratio > 0 ? 'longer' : 'less time'}, the one in the middle by ${threeDigits(Math.abs(overall.ratio) * 100)} %`)] : []))),
  subjects.some(({sides}) => sides.some(side => side === null)) ? element('p', {class: 'note'}, 'Some subjects are in one run only: they are in the tables below.') : null);
}

function comparedPanel(title, ...children) {
  const section = panel(title, ...children);
  section.classList.add('compared');
  return section;
}

function subjectTable(rows, choose) {
  const time = (side, name) => row => row.sides[side]?.times[name] ?? NaN;
  const difference = name => ({title: 'Difference', value: row => time(1, name)(row) - time(0, name)(row), show: row => {
    const by = time(1, name)(row) - time(0, name)(row);
    if (Number.isNaN(by)) return '–';
    const ratio = time(1, name)(row) / time(0, name)(row);
    const share = !(ratio > 0 && ratio < Infinity) ? '' : ratio >= 10 ? ` (× ${threeDigits(ratio)})` : ` (${ratio > 1 ? '+' : ratio < 1 ? '−' : '±'}${threeDigits(Math.abs(ratio - 1) * 100)} %)`;
    const isMeant = row.verdict.kind === (by > 0 ? 'slower' : by < 0 ? 'faster' : '');
    return element('span', {class: isMeant ? row.verdict.kind : 'faint'}, signedDuration(by) + share);
  }});
  const both = name => ({title: name, value: time(1, name), show: row => `${formatDuration(time(0, name)(row))} → ${formatDuration(time(1, name)(row))}`});
  const of = name => [both(name), difference(name)];
  return dataTable(rows, [
    {title: 'Subject', value: row => row.subject, show: row => element('div', {}, labelOf(row), ...reasons(row.verdict).map(text => element('div', {class: 'note'}, text))), wide: true},
    {title: 'Verdict', value: row => row.verdict.word, show: row => element('b', {class: `verdict ${row.verdict.kind}`}, row.verdict.word),
      order: row => row.verdict.rank - Math.min(0.9, Math.max(0, ...row.verdict.changes.map(change => Math.abs(change.shift_ns))) / 1e12)},
    ...of('p50'), ...of(compareOptions.share),
    {title: 'Count', value: row => row.sides[1]?.times.count ?? 0, show: row => row.sides.map(side => formatCount(side?.times.count ?? 0)).join(' → ')},
  ], {name: 'subject', sort: 1, choose, isActive: row => row.subject === compareOptions.subject});
}

// A chain with its name, if a user has given it one.
function labelOf({subject, sides}) {
  const name = sides.map(side => side?.chain?.name).find(Boolean);
  return name ? `${name}: ${subject}` : subject;
}

// What has changed, and why, as far as that is known.
function reasons({changes}) {
  return [...changes.map(changeText), ...new Set(changes.flatMap(change => [change.cause, ...change.changed_steps.map(step => `through ${step}`)]))].filter(Boolean);
}

// Both distributions in one plot; a chain and a call have theirs in the report only.
function distributionOfBoth(row) {
  if (row.sides.some(side => !side?.sorted)) return [];
  return [cumulativeOfBoth(`${row.subject}: both runs, cumulated`, row.sides.map(side => side.sorted))];
}
