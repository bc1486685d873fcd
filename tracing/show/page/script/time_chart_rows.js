// SPDX-License-Identifier: Apache-2.0
// The rows of the time chart: a row for each thread or callback, below a heading for its process or node. A single row
// needs no heading.

// [{heading, text}] or [{text, intervals, thread or callback, states of the thread or null}]. `by`: 'thread' or 'callback'.
// `isShown(callback)`: whether the reader wants to see it.
function timeChartRows(data, by, isShown) {
  const groups = new Map();
  const groupOf = (key, heading) => {
    if (!groups.has(key)) groups.set(key, {heading, rows: []});
    return groups.get(key).rows;
  };
  const chosen = data.callbacks.map(isShown);
  if (by === 'thread') {
    data.threads.forEach((thread, id) => {
      const ids = data.instancesIn(id).filter(i => chosen[data.instances.callback[i]]);
      if (ids.length === 0) return;
      groupOf(thread.process, processHeading(data, thread.process)).push({text: thread.vtid === data.processes[thread.process].vpid ? 'main thread' : `thread ${thread.vtid}`, thread: id, ids});
    });
  } else {
    data.callbacks.forEach((callback, id) => {
      const ids = data.instancesOf(id);
      if (!chosen[id] || ids.length === 0) return;
      groupOf(`${callback.process} ${callback.node}`, nodeName(data, callback.node) || processName(data, callback.process))
        .push({text: callback.label, callback: id, ids});
    });
  }
  const rows = [];
  for (const {heading, rows: members} of groups.values()) {
    const alone = by === 'thread' && members.length === 1;
    if (!alone) rows.push({heading: true, text: heading});
    for (const row of members) rows.push({...row, alone, text: alone ? heading : row.text, intervals: new Intervals(data.instances, row.ids),
      states: row.thread === undefined ? null : statesOf(data, row.thread)});
  }
  return rows;
}

// With one node in the process its name says more than the program's.
function processHeading(data, process) {
  const nodes = [...data.nodes.keys()].filter(node => data.nodes[node].process === process);
  return nodes.length === 1 ? nodeName(data, nodes[0]) : processName(data, process);
}

// Row of each instance, for the ends of arrows: rowOf(instance) and rowOfThread(thread); -1 if it has none.
function rowIndex(data, rows, by, isShown) {
  const ofThread = new Int32Array(data.threads.length).fill(-1);
  const ofCallback = new Int32Array(data.callbacks.length).fill(-1);
  rows.forEach((row, i) => {
    if (row.thread !== undefined) ofThread[row.thread] = i;
    if (row.callback !== undefined) ofCallback[row.callback] = i;
  });
  const chosen = data.callbacks.map(isShown);
  const {instances} = data;
  return {
    rowOf: instance => by === 'thread'
      ? chosen[instances.callback[instance]] ? ofThread[instances.thread[instance]] : -1 : ofCallback[instances.callback[instance]],
    rowOfThread: thread => by === 'thread' ? ofThread[thread] : -1,
  };
}
