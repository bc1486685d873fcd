// SPDX-License-Identifier: Apache-2.0
// Zooms and moves a picture (an SVG element with one group in it): by wheel, by dragging, by two fingers, by functions.
//
// `place` is {scale, x, y}: where the picture's corner is, in pixels of the element. `size` is that of the picture.
// onChange(place) is told of each change by the reader, with null for "all of it".
class PictureZoom {
  constructor(svg, group, size, place, onChange) {
    Object.assign(this, {svg, group, size, onChange, place});
    svg.addEventListener('wheel', event => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      this.zoom(1.0015 ** (-event.deltaY * lines), this.pointOf(event));
    }, {passive: false});
    this.pointers = new Map();
    svg.addEventListener('pointerdown', event => this.begin(event));
    svg.addEventListener('pointermove', event => this.move(event));
    for (const name of ['pointerup', 'pointercancel']) svg.addEventListener(name, event => this.end(event));
    // A click that ends a drag chooses nothing.
    svg.addEventListener('click', event => {
      if (!this.moved) return;
      event.stopPropagation();
      this.moved = false;
    }, true);
    new ResizeObserver(() => this.apply()).observe(svg);
    this.apply();  // at once, if the picture is in the page already
  }

  pointOf(event) {
    const box = this.svg.getBoundingClientRect();
    return {x: event.clientX - box.x, y: event.clientY - box.y};
  }

  // All of the picture in the middle, not larger than it is.
  whole() {
    const [width, height] = [this.svg.clientWidth, this.svg.clientHeight];
    const scale = Math.min(1, width / this.size.width, height / this.size.height);
    return {scale, x: (width - this.size.width * scale) / 2, y: (height - this.size.height * scale) / 2};
  }

  apply() {
    if (this.svg.clientWidth === 0) return;
    const {scale, x, y} = this.place ?? this.whole();
    this.group.setAttribute('transform', `translate(${x} ${y}) scale(${scale})`);
  }

  set(place) {
    if (place) {
      // A part of the picture stays in sight.
      const [width, height] = [this.svg.clientWidth, this.svg.clientHeight];
      const rest = 60;
      place.x = Math.min(width - rest, Math.max(rest - this.size.width * place.scale, place.x));
      place.y = Math.min(height - rest, Math.max(rest - this.size.height * place.scale, place.y));
    }
    this.place = place;
    this.apply();
    this.onChange(place);
  }

  zoom(factor, at = {x: this.svg.clientWidth / 2, y: this.svg.clientHeight / 2}) {
    const old = this.place ?? this.whole();
    const least = Math.min(0.5 * this.whole().scale, 0.5);
    const scale = Math.min(4, Math.max(least, old.scale * factor));
    const ratio = scale / old.scale;
    this.set({scale, x: at.x - (at.x - old.x) * ratio, y: at.y - (at.y - old.y) * ratio});
  }

  // By a share of what is shown.
  pan(dx, dy) {
    const old = this.place ?? this.whole();
    this.set({...old, x: old.x - dx * this.svg.clientWidth, y: old.y - dy * this.svg.clientHeight});
  }

  fit() {
    this.set(null);
  }

  // In its own size, with this point of the picture in the middle.
  center(point, scale = 1) {
    this.set({scale, x: this.svg.clientWidth / 2 - point.x * scale, y: this.svg.clientHeight / 2 - point.y * scale});
  }

  begin(event) {
    if (event.button !== 0) return;
    this.pointers.set(event.pointerId, this.pointOf(event));
    this.moved = false;
  }

  move(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const at = this.pointOf(event);
    if (!this.moved && Math.abs(at.x - last.x) + Math.abs(at.y - last.y) < 4) return;
    if (!this.moved) this.svg.setPointerCapture(event.pointerId);
    this.moved = true;
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, point]) => point);
    this.pointers.set(event.pointerId, at);
    if (others.length > 0) {
      const distance = point => Math.hypot(point.x - others[0].x, point.y - others[0].y) || 1;
      this.zoom(distance(at) / distance(last), others[0]);
      return;
    }
    const old = this.place ?? this.whole();
    this.set({...old, x: old.x + at.x - last.x, y: old.y + at.y - last.y});
  }

  end(event) {
    this.pointers.delete(event.pointerId);
  }
}
