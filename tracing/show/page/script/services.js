// SPDX-License-Identifier: Apache-2.0
// Who asks which service and which action, and how long the answers take. Of the whole trace.

function servicesView(data) {
  const ofNode = row => selection.node === null || [row.client, row.server].includes(data.nodes[selection.node].name);
  const calls = data.calls.filter(ofNode);
  const actions = data.actions.filter(ofNode);
  const known = name => name || '?';
  const count = (title, value) => ({title, value, show: row => formatCount(value(row))});
  const duration = (title, value) => ({title, value: row => value(row) ?? NaN, show: row => formatDuration(value(row) ?? NaN)});
  const ends = [{title: 'Asked by', value: row => known(row.client)}, {title: 'Served by', value: row => known(row.server)}];
  const callTable = () => dataTable(calls, [
    {title: 'Service', value: row => row.service, wide: true}, ...ends,
    count('Requests', row => row.requests), count('Unanswered', row => row.requests - row.responses - row.in_flight),
    duration('p50', row => row.round_trip?.p50), duration('p99', row => row.round_trip?.p99), duration('Max', row => row.round_trip?.max),
    duration('Request p50', row => row.request?.p50), duration('In service p50', row => row.in_service?.p50), duration('Response p50', row => row.response?.p50),
  ], {name: 'service', sort: 6, descending: true});
  const actionTable = () => dataTable(actions, [
    {title: 'Action', value: row => row.name, wide: true}, ...ends,
    count('Goals', row => row.goals), count('Results', row => row.results), count('Cancels', row => row.cancels), count('Feedback', row => row.feedback),
    duration('Acceptance p50', row => row.acceptance?.p50),
    duration('p50', row => row.execution?.p50), duration('p99', row => row.execution?.p99), duration('Max', row => row.execution?.max),
  ], {name: 'action', sort: 9, descending: true});
  return [
    panel('Services', calls.length === 0 ? element('p', {class: 'faint'}, 'No service was called in the trace.') : [callTable(), element('p', {class: 'note'},
      'p50, p99, Max: from rmw_send_request to rmw_take_response. Request: until the service takes it. Response: until the client takes it.')]),
    panel('Actions', actions.length === 0 ? element('p', {class: 'faint'}, 'No action was asked for in the trace.') : [actionTable(), element('p', {class: 'note'},
      'p50, p99, Max: from the request for a result to the result. Feedback: messages that the server published, for all clients.')]),
  ];
}
