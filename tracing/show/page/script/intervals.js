// SPDX-License-Identifier: Apache-2.0
// Many intervals on one line, prepared for drawing at any zoom.
//
// The cost of drawing depends on the width in pixels, not on the number of intervals: where several intervals fall into
// one pixel, a running sum of durations tells how much of the pixel is busy, and a binary search where its intervals
// begin.
class Intervals {
  // `ids` refer to instances, by their start. Intervals that lie within an earlier one are kept apart, in `nested`.
  constructor(instances, ids) {
    const [outer, nested] = [[], []];
    let until = -Infinity;
    for (const id of ids) {
      if (instances.start[id] < until) {
        nested.push(id);
        continue;
      }
      until = instances.end[id];
      outer.push(id);
    }
    this.ids = Uint32Array.from(outer);
    this.start = Float64Array.from(outer, id => instances.start[id]);
    this.end = Float64Array.from(outer, id => instances.end[id]);
    this.busy = new Float64Array(outer.length + 1);
    for (let i = 0; i < outer.length; ++i) this.busy[i + 1] = this.busy[i] + this.end[i] - this.start[i];
    this.nested = nested.length === 0 ? null : new Intervals(instances, nested);
  }

  // [first, end): the intervals that touch the time from `begin` to `end`.
  range(begin, end) {
    return [lowerBound(this.end, begin), lowerBound(this.start, end)];
  }

  busyTime(begin, end) {
    const [first, last] = this.range(begin, end);
    if (first >= last) return 0;
    const whole = this.busy[last] - this.busy[first];
    return whole - Math.max(0, begin - this.start[first]) - Math.max(0, this.end[last - 1] - end);
  }

  // Calls box(from, to, id, share) with pixels and the instance: one by one (share 1), or for each pixel with its busy
  // share if intervals are closer than pixels. `id` is then that of the first of them.
  draw(begin, end, width, box) {
    const scale = width / (end - begin);
    const [first, last] = this.range(begin, end);
    if (last - first <= width) {
      for (let i = first; i < last; ++i) box((this.start[i] - begin) * scale, (this.end[i] - begin) * scale, this.ids[i], 1);
      return;
    }
    for (let x = 0, i = first; x < width; ++x) {
      const [from, to] = [begin + x / scale, begin + (x + 1) / scale];
      i = lowerBound(this.end, from, i, last);
      if (i >= last) return;
      if (this.start[i] >= to) {
        x = Math.max(x, Math.floor((this.start[i] - begin) * scale) - 1);
        continue;
      }
      box(x, x + 1, this.ids[i], Math.max(0.15, this.busyTime(from, to) / (to - from)));
    }
  }

  // The instance at a time, innermost, or -1. `slack`: how far beside an interval still counts.
  at(time, slack) {
    const inner = this.nested?.at(time, 0) ?? -1;
    if (inner >= 0) return inner;
    const i = lowerBound(this.end, time);
    const candidates = [i - 1, i].filter(k => k >= 0 && k < this.ids.length);
    const away = k => Math.max(0, this.start[k] - time, time - this.end[k]);
    candidates.sort((a, b) => away(a) - away(b));
    return candidates.length > 0 && away(candidates[0]) <= slack ? this.ids[candidates[0]] : -1;
  }
}
