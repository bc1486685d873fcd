// SPDX-License-Identifier: Apache-2.0
// The view with the time chart, what it tells of the chosen callback, and the way of its message.

// What the reader has set; it stays when the view changes.
const timeChartOptions = {by: 'thread', arrows: true, view: null};

// Of one chart, or of two that move together: `act` gets {chart, setArrows}.
const kTimeChartKeys = [
  {keys: ['w', '+', '='], shown: ['w', '+'], what: 'zoom in', act: ({chart}) => chart.zoom(0.6)},
  {keys: ['s', '-'], what: 'zoom out', act: ({chart}) => chart.zoom(1 / 0.6)},
  {keys: ['a', 'ArrowLeft'], what: 'move left', act: ({chart}) => chart.pan(-0.2)},
  {keys: ['d', 'ArrowRight'], what: 'move right', act: ({chart}) => chart.pan(0.2)},
  {keys: ['ArrowUp'], what: 'row above', act: ({chart}) => chart.moveRow(-1)},
  {keys: ['ArrowDown'], what: 'row below', act: ({chart}) => chart.moveRow(1)},
  {keys: ['n'], what: 'next callback of the row', act: ({chart}) => chart.step(1)},
  {keys: ['p'], what: 'previous callback of the row', act: ({chart}) => chart.step(-1)},
  {keys: ['f'], what: 'all of the chosen message\'s way', act: ({chart}) => chart.showFlow()},
  {keys: ['m'], what: 'arrows of messages on and off', act: ({chart, setArrows}) => setArrows(!chart.arrows)},
  {keys: ['0', 'Home'], what: 'the whole trace', act: ({chart}) => chart.showAll()},
];
keysOf.time = kTimeChartKeys;
kPointerHelp.time = [
  {keys: ['drag'], what: 'move'}, {keys: ['Ctrl + wheel'], what: 'zoom'}, {keys: ['wheel'], what: 'scroll the rows'},
  {keys: ['Shift + wheel'], what: 'move'}, {keys: ['click'], what: 'choose a callback, show its message\'s way'}, {keys: ['double click'], what: 'zoom in'},
];

function timeChartView(data) {
  const note = element('span', {class: 'faint', 'aria-live': 'polite'});
  const details = element('div', {class: 'details', 'aria-live': 'polite'});
  const flow = element('div', {class: 'flow'});
  timeChartOptions.view ??= {begin: 0, end: Math.max(1, data.duration), top: 0};
  const chart = new TimeChart(data, {
    by: timeChartOptions.by, arrows: timeChartOptions.arrows, view: timeChartOptions.view,
    isShown: callback => isChosen(data, callback), chosen: () => selection.instance, marked: () => selection.callback, choose: instance => select({instance}), onMove: writeAddressSoon,
    onDraw: () => {
      note.textContent = chart.rows.length === 0 ? 'No callbacks to show.' :
        chart.arrowsHidden ? `${plural(chart.arrowsHidden, 'message')} in this time: zoom in to see arrows.` : '';
    },
  });

  function setArrows(shown) {
    chart.arrows = timeChartOptions.arrows = arrows.checked = shown;
    chart.redraw();
  }

  const by = element('select', {'aria-label': 'Rows', onchange: () => { chart.by = timeChartOptions.by = by.value; refresh(); }},
    element('option', {value: 'thread'}, 'threads'), element('option', {value: 'callback'}, 'callbacks'));
  by.value = timeChartOptions.by;
  const arrows = element('input', {type: 'checkbox', onchange: () => setArrows(arrows.checked)});
  arrows.checked = chart.arrows;
  const button = (text, title, act) => element('button', {title, 'aria-label': title, onclick: act}, text);

  function refresh(change = {node: 0}) {
    if ('node' in change || 'topic' in change) chart.makeRows();
    details.replaceChildren(instanceDetails(data, selection.instance, instance => chart.show(instance)));
    flow.replaceChildren(...flowList(data, chart.flow, instance => chart.show(instance), () => chart.showFlow()));
    flow.parentElement.hidden = !chart.flow;
    chart.redraw();
    return true;
  }

  const view = panel('Time chart', element('div', {class: 'tools'}, element('label', {}, 'rows', by), element('label', {}, arrows, 'messages'),
    button('+', 'Zoom in', () => chart.zoom(0.6)), button('−', 'Zoom out', () => chart.zoom(1 / 0.6)), button('All', 'Show the whole trace', () => chart.showAll()), stateKey(data), note),
  chart.element, element('p', {class: 'note'}, ...keyHelp()));
  const flowPanel = panel('Way of the message', flow);
  view.refresh = refresh;
  view.chart = chart;
  view.keyTarget = {chart, setArrows};
  view.first = chart.canvas;
  refresh({});
  return [view, panel('Chosen callback', details), flowPanel];
}

function keyHelp() {
  const help = [[['w', 's'], 'zoom'], [['a', 'd'], 'move'], [['↑', '↓'], 'row'], [['n', 'p'], 'next and previous callback'], [['f'], 'way of the message'], [['0'], 'everything'],
    [['Ctrl + wheel'], 'zoom'], [['drag'], 'move'], [['?'], 'all keys']];
  return help.flatMap(([keys, what]) => [...keys.flatMap(key => [element('kbd', {}, key), ' ']), `${what}   `]);
}
