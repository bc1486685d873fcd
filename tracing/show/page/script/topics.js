// SPDX-License-Identifier: Apache-2.0
// The topics as a table, and of the chosen one its latencies and intervals as plots.

function topicsView(data) {
  const ofNode = topic => selection.node === null || publishes(data, selection.node, topic.id) || subscribes(data, selection.node, topic.id);
  const rows = topicStatistics(data).filter(ofNode);
  const plots = element('div');
  const latency = (title, value) => ({title, value: row => row.latency.count ? value(row.latency) : NaN, show: row => row.latency.count ? formatDuration(value(row.latency)) : '–'});
  const count = (title, value) => ({title, value, show: row => formatCount(value(row))});
  const table = dataTable(rows, [
    {title: 'Topic', value: row => row.name, show: row => row.name + (row.isEstimated ? ' ~' : ''), wide: true},
    count('Publishers', row => row.publishers), count('Subscriptions', row => row.subscriptions),
    count('Published', row => row.published), count('Taken', row => row.taken), count('Not taken', row => row.missed),
    {title: 'Rate', value: row => row.published, show: row => row.rate},
    latency('Latency mean', l => l.mean), latency('p50', l => l.p50), latency('p90', l => l.p90), latency('p99', l => l.p99), latency('Max', l => l.max),
  ], {name: 'topic', sort: 10, descending: true, isActive: row => row.id === selection.topic,
    choose: row => select({topic: row.id === selection.topic ? null : row.id})});

  function showPlots() {
    const row = rows.find(candidate => candidate.id === selection.topic);
    plots.replaceChildren(row ? topicPlots(row) : element('p', {class: 'note'}, 'Choose a topic to see its latencies over time.'));
  }

  showPlots();
  const view = panel('Topics', table, element('p', {class: 'note'},
    'Latency: from the publication (rmw_publish) to the start of the callback. Not taken: by any subscription in the trace, although there is one.' +
    (data.estimates.length > 0 ? ' ~: an estimate. The trace has no timestamps of publications; which one a message is was found by its time.' : '')));
  view.refresh = change => {
    if ('node' in change) return false;
    table.update();
    showPlots();
    return true;
  };
  return [view, plots];
}

function topicPlots(topic) {
  const {latency} = topic;
  return panel(topic.name, element('div', {class: 'plots'},
    timePlot('Latency over time', topic.times, topic.values, 'latency'),
    timePlot('Interval of publications', topic.publishedAt.slice(1), topic.between, 'interval'),
    distributionPlot('Distribution of latencies', latency.sorted, 'latency'),
    cumulativePlot('Latencies, cumulated', latency.sorted, 'latency')));
}
