// SPDX-License-Identifier: Apache-2.0
// Places boxes in columns from left to right, so that edges point to the right as far as the graph allows it, and cross
// little (Sugiyama's method: break cycles, assign columns, order each column).
//
// layOut(boxes, edges, room): boxes are [{width, height}], edges are [{from, to}] with indices of boxes. Sets x and y (centres)
// of boxes, `points` and `isBack` of edges, and `isDown` if the columns are rows, and edges point down. Returns {width, height}
// of the way of placing them that can be shown largest in the room, {width, height}.
function layOut(boxes, edges, room) {
  const {columns, routes} = arrange(boxes, edges);
  let best = null;
  const attempt = (isDown, most, bands, gain) => {
    const size = placeItems(columns, routes, {isDown, most, bands});
    const scale = Math.min(1, room.width / size.width, room.height / size.height);
    if (!best || scale > gain * best.scale) best = {isDown, most, bands, scale};
  };
  attempt(false, Infinity, 1, 1);
  attempt(true, Infinity, 1, 1);
  // Columns of very many boxes become several columns, and very many columns become lines below one another, as in a text.
  const kGain = 1.2;
  if (best.scale < 0.5) {
    for (const isDown of [false, true]) {
      for (const most of [Infinity, 40, 20, 10]) for (const bands of [1, 2, 3, 4, 6, 8, 12, 16]) attempt(isDown, most, bands, kGain);
    }
  }
  const size = placeItems(columns, routes, best);
  for (const {edge, route, isBack} of routes) {
    const points = route.filter(item => !item.isLeftOut).map(({box}) => ({x: box.x, y: box.y}));
    Object.assign(edge, {points: isBack ? points.reverse() : points, isBack, isDown: best.isDown});
  }
  return size;
}

function turn(shape) {
  [shape.x, shape.y] = [shape.y, shape.x];
  [shape.width, shape.height] = [shape.height, shape.width];
}

// The columns, each a list of items in its order, and the items that each edge passes.
function arrange(boxes, edges) {
  const column = assignColumns(boxes.length, edges);
  const items = boxes.map((box, id) => ({box, column: column[id], before: [], after: []}));
  // An edge over several columns passes through an invisible item in each column between.
  const routes = edges.map(edge => {
    let [left, right] = [items[edge.from], items[edge.to]];
    const isBack = left.column > right.column;
    if (isBack) [left, right] = [right, left];
    const route = [left];
    for (let c = left.column + 1; c < right.column; ++c) route.push({box: {width: 0, height: 0}, isEdge: true, column: c, before: [], after: []});
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
  return {columns, routes};
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

const kGap = {column: 40, box: 16, edge: 6, band: 44, margin: 16};

// Places the items: columns of at most `most` boxes, in so many lines (bands). An edge from line to line goes straight.
function placeItems(columns, routes, {isDown, most, bands}) {
  const shapes = columns.flat().map(({box}) => box);
  if (isDown) shapes.forEach(turn);
  let [width, top] = [0, 0];
  const lines = inBands(columns.flatMap(list => inParts(list, most)), bands);
  for (const {route} of routes) {
    const isStraight = route.some(({band}) => band !== route[0].band);
    for (const item of route) item.isLeftOut = item.isEdge && isStraight;
  }
  for (const band of lines.map(lists => lists.map(list => list.filter(item => !item.isLeftOut)).filter(list => list.length > 0))) {
    const size = placeBand(band);
    for (const {box} of band.flat()) box.y += top;
    top += size.height + kGap.band - 2 * kGap.margin;
    width = Math.max(width, size.width);
  }
  const height = top - kGap.band + 2 * kGap.margin;
  if (!isDown) return {width, height};
  shapes.forEach(turn);
  return {width: height, height: width};
}

function inParts(list, most) {
  const parts = [[]];
  let boxes = 0;
  for (const item of list) {
    if (!item.isEdge && ++boxes > most) {
      parts.push([]);
      boxes = 1;
    }
    parts[parts.length - 1].push(item);
  }
  return parts;
}

// The columns in lines of about equal width.
function inBands(columns, count) {
  const widthOf = list => Math.max(...list.map(({box}) => box.width)) + kGap.column;
  const whole = columns.reduce((sum, list) => sum + widthOf(list), 0);
  const bands = [];
  let x = 0;
  for (const list of columns) {
    const band = Math.min(count - 1, Math.floor((x + widthOf(list) / 2) / whole * count));
    (bands[band] ??= []).push(list);
    for (const item of list) item.band = band;
    x += widthOf(list);
  }
  return bands.filter(Boolean);
}

function placeBand(columns) {
  let x = kGap.margin;
  let height = 0;
  for (const list of columns) {
    const width = Math.max(...list.map(({box}) => box.width));
    let y = kGap.margin;
    for (const item of list) {
      item.box.x = x + width / 2;
      item.box.y = y + item.box.height / 2;
      y += item.box.height + gapBelow(item);
    }
    height = Math.max(height, y);
    x += width + kGap.column;
  }
  // Short columns move to where their neighbours are, without changing the order.
  for (let sweep = 0; sweep < 8; ++sweep) {
    for (const list of sweep % 2 === 0 ? columns : columns.slice().reverse()) straighten(list, height);
  }
  return {width: x - kGap.column + kGap.margin, height: height + kGap.margin - kGap.edge};
}

function gapBelow(item) {
  return item.isEdge ? kGap.edge : kGap.box;
}

function straighten(list, height) {
  for (const item of list) {
    let [sum, count] = [0, 0];
    for (const neighbours of [item.before, item.after]) {
      for (const {band, isLeftOut, box} of neighbours) {
        if (band !== item.band || isLeftOut) continue;
        sum += box.y;
        ++count;
      }
    }
    if (count > 0) item.box.y = sum / count;
  }
  let top = kGap.margin;
  for (const item of list) {
    item.box.y = Math.max(item.box.y, top + item.box.height / 2);
    top = item.box.y + item.box.height / 2 + gapBelow(item);
  }
  let bottom = height;
  for (const item of list.slice().reverse()) {
    item.box.y = Math.min(item.box.y, bottom - item.box.height / 2);
    bottom = item.box.y - item.box.height / 2 - gapBelow(item);
  }
}
