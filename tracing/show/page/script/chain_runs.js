// SPDX-License-Identifier: Apache-2.0
// The single runs of a chain that the page holds: found from the messages, back from the last callback.

// The runs, by the time of their end: [{first, last: instances, response}]. Of an input that has several outputs, the first
// one counts.
function chainRuns(data, chain) {
  const computed = computedOf(data);
  computed.chains ??= new Map();
  if (!computed.chains.has(chain)) computed.chains.set(chain, findRuns(data, chain));
  return computed.chains.get(chain);
}

function findRuns(data, chain) {
  const {instances, messages} = data;
  const {steps} = chain;
  const runs = [];
  let newest = -1;
  for (const last of data.instancesOf(steps[steps.length - 1].callback)) {
    if (!instances.finished(last)) continue;
    let first = last;
    for (let k = steps.length - 1; k > 0 && first >= 0; --k) {
      const message = instances.message[first];
      first = message < 0 || topicOf(data, message) !== steps[k].topic ? -1 :
        causesOf(data, message).find(cause => instances.callback[cause] === steps[k - 1].callback) ?? -1;
    }
    const isLonger = first >= 0 && !chain.name && instances.message[first] >= 0 && causesOf(data, instances.message[first]).length > 0;
    if (first <= newest || isLonger) continue;  // none, or overtaken by a newer input; or a part of a longer chain
    newest = first;
    runs.push({first, last, response: instances.end[last] - instances.start[first]});
  }
  return runs;
}

// The run whose response is the percentile of all of them, or null.
function runAt(runs, share) {
  if (runs.length === 0) return null;
  const sorted = runs.slice().sort((a, b) => a.response - b.response);
  return sorted[Math.max(0, Math.ceil(share * sorted.length) - 1)];
}
