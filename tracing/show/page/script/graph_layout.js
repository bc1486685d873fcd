// SPDX-License-Identifier: Apache-2.0
// Places boxes in columns from left to right, so that edges point to the right as far as the graph allows it, and cross
// little (Sugiyama's method: break cycles, assign columns, order each column).
//
// layOut(boxes, edges): boxes are [{width, height}], edges are [{from, to}] with indices of boxes. Sets x and y (centres)
// of boxes, and `points` of edges. Returns {width, height}. If the result is wider than `room`, the columns become rows,
// and edges point down.
function layOut(boxes, edges, room = Infinity) {
  const size = layOutColumns(boxes, edges);
  if (size.width <= room) return size;
  boxes.forEach(turn);
  const {width, height} = layOutColumns(boxes, edges);
  boxes.forEach(turn);
  for (const edge of edges) {
    edge.points.forEach(turn);
    edge.isDown = true;
  }
  return {width: height, height: width};
}

function turn(shape) {
  [shape.x, shape.y] = [shape.y, shape.x];
  [shape.width, shape.height] = [shape.height, shape.width];
}

function layOutColumns(boxes, edges) {
  const column = assignColumns(boxes.length, edges);
  const items = boxes.map((box, id) => ({box, column: column[id], before: [], after: []}));
  // An edge over several columns passes through an invisible item in each column between.
  const routes = edges.map(edge => {
    let [left, right] = [items[edge.from], items[edge.to]];
    const isBack = left.column > right.column;
    if (isBack) [left, right] = [right, left];
    const route = [left];
    for (let c = left.column + 1; c < right.column; ++c) route.push({box: {width: 0, height: 10}, column: c, before: [], after: []});
    if (right !== left) route.push(right);
    route.slice(1, -1).forEach(item => items.push(item));
    for (let i = 0; i + 1 < route.length; ++i) {
      route[i].after.push(route[i + 1]);
      route[i + 1].before.push(route[i]);
    }
    return {edge, route, isBack};
  });
  const columns = [];
  for (const item of items) (columns[item.column] ??= []).push(item);
  orderColumns(columns);
  const size = placeItems(columns);
  for (const {edge, route, isBack} of routes) {
    const points = route.map(({box}) => ({x: box.x, y: box.y, width: box.width}));
    edge.points = isBack ? points.reverse() : points;
    edge.isBack = isBack;
  }
  return size;
}

// The longest path from the sources; edges that would close a cycle are left out.
function assignColumns(count, edges) {
  const out = Array.from({length: count}, () => []);
  const incoming = new Array(count).fill(0);
  for (const {from, to} of edges) {
    if (from === to) continue;
    out[from].push(to);
    ++incoming[to];
  }
  const state = new Array(count).fill(0);  // 1: on the current path, 2: done
  const forward = Array.from({length: count}, () => []);
  const finished = [];
  const visit = root => {
    const path = [[root, 0]];
    state[root] = 1;
    while (path.length > 0) {
      const top = path[path.length - 1];
      const [id, next] = top;
      if (next === out[id].length) {
        state[id] = 2;
        finished.push(id);
        path.pop();
        continue;
      }
      ++top[1];
      const to = out[id][next];
      if (state[to] === 1) continue;
      forward[id].push(to);
      if (state[to] === 0) {
        state[to] = 1;
        path.push([to, 0]);
      }
    }
  };
  for (let id = 0; id < count; ++id) if (incoming[id] === 0 && state[id] === 0) visit(id);
  for (let id = 0; id < count; ++id) if (state[id] === 0) visit(id);
  const column = new Array(count).fill(0);
  for (const id of finished.reverse()) for (const to of forward[id]) column[to] = Math.max(column[to], column[id] + 1);
  return column;
}

// Moves each item towards the mean place of its neighbours, column by column, there and back.
function orderColumns(columns) {
  const number = () => columns.forEach(list => list.forEach((item, i) => { item.order = i - list.length / 2; }));
  const mean = (neighbours, own) => neighbours.length === 0 ? own : neighbours.reduce((sum, n) => sum + n.order, 0) / neighbours.length;
  number();
  for (let sweep = 0; sweep < 24; ++sweep) {
    const forward = sweep % 2 === 0;
    for (const list of forward ? columns : columns.slice().reverse()) {
      for (const item of list) item.wish = mean(forward ? item.before : item.after, item.order);
      list.sort((a, b) => a.wish - b.wish);
      list.forEach((item, i) => { item.order = i - list.length / 2; });
    }
  }
}

function placeItems(columns) {
  const [gapX, gapY, margin] = [40, 16, 16];
  let x = margin;
  let height = 0;
  for (const list of columns) {
    const width = Math.max(...list.map(({box}) => box.width));
    let y = margin;
    for (const {box} of list) {
      box.x = x + width / 2;
      box.y = y + box.height / 2;
      y += box.height + gapY;
    }
    height = Math.max(height, y);
    x += width + gapX;
  }
  // Short columns move to where their neighbours are, without changing the order.
  for (let sweep = 0; sweep < 8; ++sweep) {
    for (const list of sweep % 2 === 0 ? columns : columns.slice().reverse()) straighten(list, height, gapY, margin);
  }
  return {width: x - gapX + margin, height: height + margin - gapY};
}

function straighten(list, height, gap, margin) {
  for (const item of list) {
    const neighbours = item.before.concat(item.after);
    if (neighbours.length > 0) item.box.y = neighbours.reduce((sum, n) => sum + n.box.y, 0) / neighbours.length;
  }
  let top = margin;
  for (const {box} of list) {
    box.y = Math.max(box.y, top + box.height / 2);
    top = box.y + box.height / 2 + gap;
  }
  let bottom = height;
  for (const {box} of list.slice().reverse()) {
    box.y = Math.min(box.y, bottom - box.height / 2);
    bottom = box.y - box.height / 2 - gap;
  }
}
