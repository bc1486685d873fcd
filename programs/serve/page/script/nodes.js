// SPDX-License-Identifier: Apache-2.0
// What nodes do, as tables of text. They are recorded only while this is shown.

class NodeTables {
  constructor(panel, shown, tables) {
    this.panel = panel;
    this.shown = shown;
    this.tables = tables;
    this.stop = () => {};
    shown.addEventListener('change', () => this.follow());
  }

  allow(allowed) {
    this.panel.hidden = !allowed;
    if (!allowed && this.shown.checked) {
      this.shown.checked = false;
      this.follow();
    }
  }

  follow() {
    this.stop();
    this.stop = () => {};
    this.tables.hidden = !this.shown.checked;
    setText(this.tables, '');
    if (this.shown.checked) {
      this.stop = followNodes(lines => setText(this.tables, lines.join('\n')), () => {
        setText(this.tables, 'The connection has ended.');
        this.shown.checked = false;
      });
    }
  }
}
