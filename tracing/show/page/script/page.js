// SPDX-License-Identifier: Apache-2.0
// The page: one view at a time, chosen by its tab, its key (1 to 9), or the address (#time). A page of two runs has a view
// of both, and one of them is chosen for the other views.

const kViews = [
  ['overview', 'Overview', overviewView], ['graph', 'Graph', graphView], ['time', 'Time chart', timeChartView],
  ['callbacks', 'Callbacks', callbacksView], ['topics', 'Topics', topicsView], ['services', 'Services', servicesView],
  ['chains', 'Chains', chainsView], ['lifecycle', 'Lifecycle', lifecycleView], ['processes', 'Processes', processesView],
];

// `runs`: one, or two that are compared, the one before first. `data` is the run whose views are shown.
const kCompareView = ['compare', 'Comparison', compareView];
const page = {data: null, runs: [], comparison: null, shown: null};

const kPageKeys = [
  ...kViews.map(([id, title], i) => ({keys: [String(i + 1)], what: title, act: () => showView(id)})),
  {keys: ['c'], what: 'Comparison, in a page of two runs', act: () => { if (page.comparison) showView('compare'); }},
  {keys: ['Escape'], what: 'take back what is chosen: the callback of the time chart, then the rest', act: takeBack},
  {keys: ['Tab', 'Enter'], what: 'go through tables and buttons, choose', act: null},
  {keys: ['?'], what: 'this help', act: showKeys},
];

function views() {
  return page.comparison ? [kCompareView, ...kViews] : kViews;
}

function viewOf(name) {
  return views().find(([candidate]) => candidate === name) ?? views()[0];
}

function showView(name) {
  drawView(name);
  writeAddress(true);
}

function drawView(name) {
  const [id,, make] = viewOf(name);
  const isNew = page.shown !== id;
  if (isNew) window.scrollTo(0, 0);
  page.shown = id;
  for (const tab of document.querySelectorAll('[role=tab]')) {
    const isShown = tab.dataset.view === id;
    tab.setAttribute('aria-selected', isShown);
    tab.tabIndex = isShown ? 0 : -1;
  }
  const view = document.getElementById('view');
  view.replaceChildren(...make(page.data).filter(Boolean));
  showSelection(page.data, document.getElementById('selection'), id);
  // So that arrow keys are those of the view, not those of its tab.
  if (isNew) view.firstElementChild?.first?.focus({preventScroll: true});
}

// A view draws itself anew if it can; the others are made anew.
function onSelect(change) {
  showSelection(page.data, document.getElementById('selection'), page.shown);
  if (!document.getElementById('view').firstElementChild?.refresh?.(change) && ['node', 'topic', 'callback'].some(what => what in change)) drawView(page.shown);
  writeAddress(['node', 'topic', 'callback'].some(what => what in change));
}

// The chosen run of a callback first, where it is in sight; then everything.
function takeBack() {
  if (page.shown === 'time' && selection.instance !== null) select({instance: null});
  else if (isAnythingChosen()) select(kNothingChosen);
}

function showKeys() {
  showHelp(kPageKeys, new Map(views().map(([id, title]) => [id, title])));
}

function makeTabs() {
  const tabs = document.getElementById('tabs');
  const keyOf = id => id === 'compare' ? 'c' : kViews.findIndex(([view]) => view === id) + 1;
  for (const [id, title] of views()) tabs.append(element('button', {role: 'tab', 'data-view': id, title: `Key ${keyOf(id)}`, onclick: () => showView(id)}, title));
  arrowKeys(tabs, () => [...tabs.children]);
  document.getElementById('others').append(runChoice(), element('button', {title: 'Keys: ?', 'aria-label': 'Keys', onclick: showKeys}, '?'));
  listenToKeys(kPageKeys);
}

// Which of two runs the other views are of.
function runChoice() {
  if (!page.comparison) return '';
  const list = element('select', {'aria-label': 'Run', title: 'The run that the other views show', onchange: () => { chooseRun(kSides.indexOf(list.value)); }},
    ...kSides.map(side => element('option', {value: side}, side)));
  list.value = kSides[page.runs.indexOf(page.data)];
  return list;
}

// The choice goes along, as far as the other run has what is chosen.
function chooseRun(side) {
  const [old, data] = [page.data, page.runs[side]];
  if (old === data) return;
  const find = (list, wanted, name) => wanted === null ? null : [list.findIndex((_, id) => name(id) === wanted)].map(id => id < 0 ? null : id)[0];
  const {node, topic, callback} = selection;
  Object.assign(selection, {
    node: find(data.nodes, node === null ? null : nodeName(old, node), id => nodeName(data, id)),
    topic: find(data.topics, topic === null ? null : old.topics[topic], id => data.topics[id]),
    callback: find(data.callbacks, callback === null ? null : callbackName(old, callback), id => callbackName(data, id)), instance: null,
  });
  page.data = data;
  timeChartOptions.view = null;
  drawView(page.shown);
  writeAddress(true);
}

// The reader went back, or changed the address.
function onAddress() {
  if (location.hash === addressText()) return;
  const name = readAddress();
  const choice = document.querySelector('#others select');
  if (choice) choice.value = kSides[page.runs.indexOf(page.data)];
  drawView(name);
}

async function main() {
  const view = document.getElementById('view');
  try {
    page.data = await loadData();
    page.runs = [page.data];
    if (document.getElementById('comparison')) {
      page.comparison = JSON.parse(document.getElementById('comparison').textContent);
      page.runs.unshift(await loadData('-before'));
      connectRuns(page.comparison, page.runs);
    }
  } catch (error) {
    view.append(element('p', {class: 'panel trouble', role: 'alert'}, `The page could not read its data: ${error.message}`));
    throw error;
  }
  const nameOf = data => data.directory.split('/').filter(Boolean).pop() ?? 'trace';
  const name = page.runs.map(nameOf).join(' and ');
  document.getElementById('title').textContent = name;
  document.title = `${name} – trace`;
  selection.listeners.push(onSelect);
  for (const event of ['hashchange', 'popstate']) addEventListener(event, onAddress);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => drawView(page.shown));
  const shown = readAddress();
  makeTabs();
  drawView(shown);
  document.body.dataset.ready = 'yes';
}

main();
