// SPDX-License-Identifier: Apache-2.0
// What the page asks the service (docs/remote.md).

// The answer as JSON. Throws an Error with a sentence.
async function ask(address, request) {
  const options = request && {
    method: 'POST', headers: {'Content-Type': 'application/json'}, body: JSON.stringify({version: 1, ...request}),
  };
  let response;
  let answer;
  try {
    response = await fetch(address, {cache: 'no-store', ...options});
    answer = await response.json();
  } catch {
    throw Object.assign(new Error('no connection to the service'), {offline: true});
  }
  if (response.status === 401) {
    location.reload();  // the session has ended: the login comes
  }
  if (!response.ok) {
    throw Object.assign(new Error([answer.error, answer.help].filter(Boolean).join('; ')), {gone: response.status === 404});
  }
  return answer;
}

// Follows what nodes do. Calls `told` with the lines of its tables, and `lost` when the connection ends. Returns a function
// that stops it.
function followNodes(told, lost) {
  const source = new EventSource('/api/nodes');
  source.addEventListener('nodes', message => told(JSON.parse(message.data).lines));
  source.addEventListener('error', () => {
    source.close();
    lost();
  });
  return () => source.close();
}

// Follows a launch, with the lines of one process or none. Calls a function of `told` with the name of each event: `ps`,
// `event`, `output`, `end`, and `lost` when the connection ends. Returns a function that stops it.
function follow(pid, process, told) {
  const query = process ? `?output=${encodeURIComponent(process)}` : '';
  const source = new EventSource(`/api/launches/${pid}/events${query}`);
  for (const name of ['ps', 'event', 'output', 'end']) {
    source.addEventListener(name, message => {
      if (name === 'end') {
        source.close();
      }
      told[name](JSON.parse(message.data));
    });
  }
  source.addEventListener('error', () => {
    source.close();
    told.lost();
  });
  return () => source.close();
}
