# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# A trace in ten cells: `launch launch_examples 12_reference_system.launch.xml`, then open this file as a notebook, or
# `python3 analysis_notebook.py DIRECTORY`. Jupyter (with Jupytext), VS Code and Spyder run the cells one by one.

# %% 1. The trace
import sys

import launch_trace

run = launch_trace.open(sys.argv[1] if len(sys.argv) > 1 else 'traces/run')
run

# %% 2. Is all there?
for row in run.verdict:
    print('complete' if row['complete'] else f'incomplete: {run.error} {run.remarks.to_list("text")}')

# %% 3. What is worth a look
for finding in run.findings:
    print(finding['kind'], finding['subject'], finding['figures'], sep=': ')

# %% 4. Who talks to whom
nodes, topics = run.nodes.to_list('name'), run.topics.to_list('name')
for end in run.subscriptions:
    if end['node'] is not None:
        print(topics[end['topic']], '→', nodes[end['node']])

# %% 5. The callbacks that take longest
slowest = sorted(run.callback_statistics.rows('duration_p99_ns', 'node', 'short_symbol'), key=lambda row: -(row[0] or 0))
for p99, node, symbol in slowest[:5]:
    print(f'{(p99 or 0) / 1e6:8.3f} ms', node, symbol)

# %% 6. Chains
steps = run.chain_steps.rows('chain', 'node')
for chain in run.chains:
    route = ' → '.join(node or '?' for of, node in steps if of == chain['id'])
    print(f"{chain['response_count']:6} times, p99 {chain['response_p99_ns'] / 1e6:.3f} ms: {route}")

# %% 7. The slowest chain, from its first to its last node
route = [node for of, node in steps if of == 0]
chain = run.chain(route[0], route[-1])
print(chain, chain.summary())

# %% 8. Where the time of its slowest instance went
begin, end, _, hops = max(chain.first_ways(), key=lambda way: way[1] - way[0])
for label, nanoseconds in chain.parts(hops):
    print(f'{nanoseconds / 1e6:8.3f} ms', label)

# %% 9. Where messages got lost
for row in run.subscription_statistics:
    lost = row['not_executed'] + row['overwritten'] + row['overwritten_in_buffer'] + row['lost']
    if lost:
        print(row['topic'], row['node'], lost)

# %% 10. Pictures, if matplotlib is there
try:
    import matplotlib.pyplot as pictures
except ImportError:
    print('no pictures: matplotlib is not installed')
else:
    chain.plot()
    chain.plot_flow()
    run.plot.outliers(chain)
    run.plot.over_time(chain.steps[1].topic)
    run.plot.histogram(chain.steps[0].node)
    run.plot.scheduling(seconds=0.2)
    pictures.show()
