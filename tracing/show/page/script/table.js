// SPDX-License-Identifier: Apache-2.0
// A table that the reader sorts and filters.
//
// columns: [{title, value: row => number or text, show: row => text or element (default: the value), order: row => number
// by which it is sorted instead, wide}]. A column is one of texts if the value of its first row is a text. options: {sort: index of the column, descending, choose: row => …,
// isActive: row => boolean, limit: rows that are shown at first, name: what the rows are}.
function dataTable(rows, columns, options = {}) {
  let sort = options.sort ?? 0;
  let descending = options.descending ?? false;
  let limit = options.limit ?? 200;
  const isText = columns.map(column => rows.length > 0 && typeof column.value(rows[0]) === 'string');
  const filter = element('input', {type: 'search', placeholder: 'Filter', 'aria-label': `Filter ${options.name ?? 'rows'}`, oninput: () => update()});
  const count = element('span', {class: 'faint', 'aria-live': 'polite'});
  const headers = columns.map((column, i) => element('th', {class: isText[i] ? 'text' : null, scope: 'col'},
    element('button', {onclick: () => sortBy(i)}, column.title)));
  const body = element('tbody', {class: options.choose ? 'clickable' : null});
  const more = element('button', {onclick: () => { limit *= 10; update(); }}, 'Show more');
  arrowKeys(body, () => [...body.children]);

  function sortBy(column) {
    descending = column === sort ? !descending : !isText[column];
    sort = column;
    update();
  }

  function matching() {
    const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    if (words.length === 0) return rows.slice();
    return rows.filter(row => {
      const text = columns.map(column => column.show ? column.show(row) : column.value(row)).map(cell => cell instanceof Node ? cell.textContent : String(cell)).join(' ').toLowerCase();
      return words.every(word => text.includes(word));
    });
  }

  function compare(left, right) {
    const value = columns[sort].order ?? columns[sort].value;
    const [a, b] = [value(left), value(right)];
    if (typeof a === 'string') return a.localeCompare(b, 'en', {numeric: true});
    // What has no value comes last.
    if (Number.isNaN(a) || Number.isNaN(b)) return (Number.isNaN(a) - Number.isNaN(b)) * (descending ? -1 : 1);
    return a - b;
  }

  function rowElement(row) {
    const cells = columns.map((column, i) => element('td', {class: [isText[i] ? 'text' : '', column.wide ? 'wide' : ''].join(' ').trim() || null},
      column.show ? column.show(row) : String(column.value(row))));
    const choose = options.choose && (() => options.choose(row));
    return element('tr', {
      class: options.isActive?.(row) ? 'active' : null, tabindex: options.choose ? 0 : null, onclick: choose,
      onkeydown: event => { if (choose && (event.key === 'Enter' || event.key === ' ')) { event.preventDefault(); choose(); } },
    }, ...cells);
  }

  function update() {
    const shown = matching().sort((a, b) => (descending ? -1 : 1) * compare(a, b));
    headers.forEach((header, i) => {
      if (i === sort) header.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
      else header.removeAttribute('aria-sort');
      header.firstChild.textContent = columns[i].title + (i !== sort ? '' : descending ? ' ↓' : ' ↑');
    });
    count.textContent = `${formatCount(shown.length)} of ${plural(rows.length, options.name ?? 'row')}`;
    body.replaceChildren(...shown.slice(0, limit).map(rowElement));
    more.hidden = shown.length <= limit;
  }

  update();
  const table = element('div', {class: 'table'}, element('div', {class: 'tools'}, filter, count),
    element('div', {class: 'scroll'}, element('table', {}, element('thead', {}, element('tr', {}, ...headers)), body), more));
  table.update = update;
  return table;
}
