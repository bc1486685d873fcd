// SPDX-License-Identifier: Apache-2.0
// The lines of a process, and what has happened. What a process prints is text, whatever it looks like.

const MOST_LINES = 2000;
const MOST_EVENTS = 100;
const COLOURS = /\x1b\[[0-9;:?]*[ -/]*[@-~]/g;

class LineLog {
  constructor(box, followBox) {
    this.box = box;
    this.followBox = followBox;
    this.search = '';
    this.waiting = [];
    this.drawing = false;
    // Who scrolls up wants to read.
    box.addEventListener('scroll', () => {
      this.followBox.checked = box.scrollHeight - box.scrollTop - box.clientHeight < 30;
    });
  }

  clear() {
    this.waiting = [];
    this.box.replaceChildren();
    this.followBox.checked = true;
  }

  add(text, kind) {
    this.waiting.push([text.replace(COLOURS, ''), kind]);
    if (this.waiting.length > MOST_LINES) {
      this.waiting.splice(0, this.waiting.length - MOST_LINES);
    }
    if (!this.drawing) {
      this.drawing = true;
      requestAnimationFrame(() => this.draw());
    }
  }

  draw() {
    this.drawing = false;
    const follows = this.followBox.checked;
    const lines = document.createDocumentFragment();
    for (const [text, kind] of this.waiting) {
      const line = element('div', {className: kind, textContent: text});
      line.hidden = !this.matches(text);
      lines.append(line);
    }
    this.waiting = [];
    this.box.append(lines);
    for (let left = this.box.childElementCount - MOST_LINES; left > 0; --left) {
      this.box.firstChild.remove();
    }
    if (follows) {
      this.scrollDown();
    }
  }

  matches(text) {
    return text.toLowerCase().includes(this.search.toLowerCase());
  }

  find(text) {
    this.search = text;
    for (const line of this.box.children) {
      line.hidden = !this.matches(line.textContent);
    }
    this.scrollDown();
  }

  scrollDown() {
    this.box.scrollTop = this.box.scrollHeight;
  }
}

class EventList {
  constructor(list, empty) {
    this.list = list;
    this.empty = empty;
  }

  add(event) {
    this.empty.hidden = true;
    const time = new Date(event.time * 1000);
    const line = element('li', {}, element('time', {dateTime: time.toISOString()}, time.toLocaleTimeString()),
      element('span', {className: isBad(event) ? 'bad' : ''}, eventText(event)));
    this.list.prepend(line);
    for (let left = this.list.childElementCount - MOST_EVENTS; left > 0; --left) {
      this.list.lastChild.remove();
    }
  }

  clear() {
    this.list.replaceChildren();
    this.empty.hidden = false;
  }
}
