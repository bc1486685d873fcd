// SPDX-License-Identifier: Apache-2.0
// What a launch file starts, as a tree: of `launch --dry-run=json`, by file.
'use strict';

const path = require('node:path');

const nodeName = (node) => `${(node.namespace || '/').replace(/\/$/, '')}/${node.name || node.executable || node.plugin || ''}`;

const itemOf = (process) => {
  const node = process.node;
  return {
    label: node && node.name ? nodeName(node) : process.name,
    detail: node && node.package ? `${node.package} ${node.executable}` : (process.argv || []).join(' '),
    icon: node ? 'circle-filled' : 'terminal',
    place: process.source,
    children: [],
  };
};

const componentOf = (component) => {
  const node = component.node || component;
  return {
    label: node.name ? nodeName(node) : node.plugin || '?',
    detail: [node.package, node.plugin].filter(Boolean).join(' '),
    icon: 'symbol-class',
    place: component.source,
    children: [],
  };
};

// `file`: the path of the launch file; `description`: what the dry run printed. Files in the order in which they come.
function treeOf(file, description) {
  const roots = new Map();
  const of = (name) => {
    if (!roots.has(name)) {
      roots.set(name, { label: path.basename(name), detail: '', icon: 'file', place: { file: name, line: 1 }, children: [] });
    }
    return roots.get(name);
  };
  of(file);
  const add = (entries, make) => {
    for (const entry of entries || []) {
      of((entry.source && entry.source.file) || file).children.push(make(entry));
    }
  };
  add(description.processes, itemOf);
  add(description.composable, componentOf);
  const items = [...roots.values()];
  for (const item of items) {
    item.detail = item.children.length === 1 ? '1 process' : `${item.children.length} processes`;
  }
  return items.filter((item, index) => index === 0 || item.children.length > 0);
}

module.exports = { treeOf };
