// SPDX-License-Identifier: Apache-2.0
// The address of the page holds what it shows, so that a link, a bookmark, or a reload shows the same:
// #time&node=/filter&from=0.5&to=0.6. Objects are named as the page names them.

function addressText() {
  const {node, topic, callback, instance} = selection;
  const data = page.data;
  const view = page.shown === 'time' ? timeChartOptions.view : null;
  const isPart = view && (view.begin > 0 || view.end < Math.max(1, data.duration));
  const seconds = ns => `${+(ns / 1e9).toFixed(9)}`;
  const parts = [
    ['run', page.runs.length > 1 && data === page.runs[0] ? 'before' : null],
    ['node', node === null ? null : nodeName(data, node)], ['topic', topic === null ? null : data.topics[topic]],
    ['callback', callback === null ? null : callbackName(data, callback)], ['at', instance],
    ['from', isPart ? seconds(view.begin) : null], ['to', isPart ? seconds(view.end) : null],
  ].filter(([, value]) => value !== null);
  return '#' + [page.shown, ...parts.map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll('%2F', '/')}`)].join('&');
}

// `isStep`: the reader can go back to what was shown before.
function writeAddress(isStep) {
  const text = addressText();
  if (text === location.hash) return;
  try {
    history[isStep ? 'pushState' : 'replaceState'](null, '', text);
  } catch {
    location.replace(text);  // some browsers do not allow it to local files
  }
}

// Moves of the time chart come many at a time.
let addressTimer = 0;
function writeAddressSoon() {
  clearTimeout(addressTimer);
  addressTimer = setTimeout(() => writeAddress(false), 300);
}

// Takes the choice from the address, and returns the name of the view. What the page does not have is left out.
function readAddress() {
  const [view, ...parts] = location.hash.slice(1).split('&');
  const given = new Map(parts.map(part => [part.slice(0, part.indexOf('=')), part.slice(part.indexOf('=') + 1)]));
  const text = key => {
    try {
      return given.has(key) ? decodeURIComponent(given.get(key)) : null;
    } catch {
      return null;
    }
  };
  if (page.runs.length > 1) page.data = page.runs[text('run') === 'before' ? 0 : 1];
  const data = page.data;
  const find = (key, count, name) => {
    const wanted = text(key);
    for (let id = 0; wanted !== null && id < count; ++id) if (name(id) === wanted) return id;
    return null;
  };
  const instance = text('at') === null ? NaN : Number(text('at'));
  Object.assign(selection, {
    node: find('node', data.nodes.length, id => nodeName(data, id)), topic: find('topic', data.topics.length, id => data.topics[id]),
    callback: find('callback', data.callbacks.length, id => callbackName(data, id)),
    instance: Number.isInteger(instance) && instance >= 0 && instance < data.instances.count ? instance : null,
  });
  const [from, to] = ['from', 'to'].map(key => Math.round(Number(text(key) ?? NaN) * 1e9));
  const isPart = from >= 0 && to > from && from < data.duration;
  if (isPart) timeChartOptions.view = {begin: from, end: Math.min(to, Math.max(1, data.duration)), top: timeChartOptions.view?.top ?? 0};
  return view;
}
