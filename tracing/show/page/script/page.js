// SPDX-License-Identifier: Apache-2.0
// The page: one view at a time, chosen by its tab, its key (1 to 9), or the address (#time).

const kViews = [
  ['overview', 'Overview', overviewView], ['graph', 'Graph', graphView], ['time', 'Time chart', timeChartView],
  ['callbacks', 'Callbacks', callbacksView], ['topics', 'Topics', topicsView], ['services', 'Services', servicesView],
  ['chains', 'Chains', chainsView], ['lifecycle', 'Lifecycle', lifecycleView], ['processes', 'Processes', processesView],
];

const page = {data: null, shown: null};

function showView(name) {
  if (location.hash.slice(1) === name) drawView(name);
  else location.hash = name;
}

function drawView(name) {
  const [id,, make] = kViews.find(([candidate]) => candidate === name) ?? kViews[0];
  if (page.shown !== id) window.scrollTo(0, 0);
  page.shown = id;
  for (const tab of document.querySelectorAll('[role=tab]')) {
    const isShown = tab.dataset.view === id;
    tab.setAttribute('aria-selected', isShown);
    tab.tabIndex = isShown ? 0 : -1;
  }
  document.getElementById('view').replaceChildren(...make(page.data).filter(Boolean));
}

// A view draws itself anew if it can; the others are made anew.
function onSelect(change) {
  showSelection(page.data, document.getElementById('selection'));
  const refresh = document.getElementById('view').firstElementChild?.refresh;
  const isFilter = 'node' in change || 'topic' in change;
  if (refresh && (!isFilter || page.shown === 'graph' || page.shown === 'time' || (page.shown === 'topics' && !('node' in change)))) refresh(change);
  else if (isFilter) drawView(page.shown);
}

function makeTabs() {
  const tabs = document.getElementById('tabs');
  kViews.forEach(([id, title], i) => tabs.append(element('button', {role: 'tab', 'data-view': id, title: `Key ${i + 1}`, onclick: () => showView(id)}, title)));
  arrowKeys(tabs, () => [...tabs.children]);
  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)) return;
    const view = kViews[Number(event.key) - 1];
    if (view) showView(view[0]);
  });
}

async function main() {
  const view = document.getElementById('view');
  try {
    page.data = await loadData();
  } catch (error) {
    view.append(element('p', {class: 'panel trouble', role: 'alert'}, `The page could not read its data: ${error.message}`));
    throw error;
  }
  const name = page.data.directory.split('/').filter(Boolean).pop() ?? 'trace';
  document.getElementById('title').textContent = name;
  document.title = `${name} – trace`;
  makeTabs();
  selection.listeners.push(onSelect);
  addEventListener('hashchange', () => drawView(location.hash.slice(1)));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => drawView(page.shown));
  drawView(location.hash.slice(1));
  document.body.dataset.ready = 'yes';
}

main();
