// SPDX-License-Identifier: Apache-2.0
// What the launcher saw and did while the system ran: a list, and lines in the time chart.

// Those that do not belong to each launch.
function launcherEvents(data) {
  return data.launcher_events.filter(event => !event.ordinary);
}

function launcherEventText({subject, sentence}) {
  return `${subject}: ${sentence}`;
}

// Each one leads to its time in the time chart.
function launcherEventPanel(data) {
  const events = launcherEvents(data);
  if (events.length === 0) return null;
  return panel('While it ran', dataTable(events, [
    {title: 'Time', value: event => event.time, show: event => event.time < 0 || event.time > data.duration ? formatTime(event.time) :
      element('button', {onclick: () => showTime(data, event.time)}, formatTime(event.time))},
    {title: 'Of', value: event => event.subject, wide: true}, {title: 'What', value: event => event.sentence, wide: true},
    {title: 'Asked for in', value: event => event.file && `${event.file}:${event.line}`},
  ], {name: 'event', sort: 0}));
}

// A second around a time, in the time chart.
function showTime(data, time) {
  const span = Math.min(1e9, Math.max(1, data.duration));
  const begin = Math.min(Math.max(time - span / 2, 0), Math.max(1, data.duration) - span);
  timeChartOptions.view = {begin, end: begin + span, top: 0};
  showView('time');
}

// The one whose line is near a place of the chart, or undefined.
function launcherEventAt(chart, x, y) {
  const {begin, end} = chart.view;
  const near = event => Math.abs(timeX(chart, event.time) - x);
  if (x < labelWidth(chart) || y < kMapHeight) return undefined;
  return launcherEvents(chart.data).filter(event => event.time >= begin && event.time <= end && near(event) < 4).sort((a, b) => near(a) - near(b))[0];
}

// A line over all rows for each of them, and a short one in the map.
function drawLauncherEvents(context, chart, style) {
  const {limits, width, height, view} = chart;
  const span = width - labelWidth(chart);
  for (const event of launcherEvents(chart.data)) {
    context.fillStyle = event.kind === 'scheduling' ? style.accent : style.bad;
    if (event.time >= limits.begin && event.time <= limits.end) {
      context.fillRect(labelWidth(chart) + (event.time - limits.begin) / (limits.end - limits.begin) * span, 0, 1, kMapHeight - 6);
    }
    if (event.time >= view.begin && event.time <= view.end) {
      context.fillRect(timeX(chart, event.time), kMapHeight + kScaleHeight - 8, 1.5, height);
    }
  }
}
