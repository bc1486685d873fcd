# SPDX-License-Identifier: Apache-2.0
"""
The tables of sums that a report makes of callbacks, nodes, executors, services and actions, computed from the events and from the
rows of `rows_truth`, with nothing of the analysis of this project.
"""

import collections

GOAL, RESULT, CANCEL, FEEDBACK = '/_action/send_goal', '/_action/get_result', '/_action/cancel_goal', '/_action/feedback'
ENDS = {'service': 'rmw_send_response', 'client': 'rclcpp_client_callback_end'}


def between(calls, begin, end):
    return [max(call[end] - call[begin], 0) for call in calls if begin in call and end in call]


def summary(values):
    """Number, sum, smallest and largest."""
    return (len(values), sum(values), min(values, default=None), max(values, default=None))


class Served:

    def __init__(self, events, rows):
        self.rows = rows
        self.node_of, self.owner_of_rcl, self.object_of = {}, {}, {}  # by process and handle
        self.callbacks = {}  # kind, node, topic, service and period, by process and address
        self.executions = collections.defaultdict(lambda: [0, []])
        self.owners = collections.defaultdict(set)  # of an address: another object may have it later
        self.client_runs = []  # process, node, time that the callback took
        executing, answering = {}, {}
        for time, name, f in events:
            if not name:
                continue
            process, thread = f['vpid'], (f['vpid'], f['vtid'])
            if name == 'rcl_node_init':
                self.node_of[process, f['node_handle']] = f['namespace'].rstrip('/') + '/' + f['node_name']
            elif name in ('rcl_subscription_init', 'rcl_service_init', 'rcl_client_init'):
                kind = name.split('_')[1]
                what = f['topic_name'] if kind == 'subscription' else f['service_name']
                self.owner_of_rcl[process, f[f'{kind}_handle']] = kind, self.node_of.get((process, f['node_handle'])), what
            elif name == 'rcl_timer_init':
                self.owner_of_rcl[process, f['timer_handle']] = 'timer', None, f['period']
            elif name == 'rclcpp_timer_link_node':
                kind, _, period = self.owner_of_rcl[process, f['timer_handle']]
                owner = kind, self.node_of.get((process, f['node_handle'])), period
                self.owner_of_rcl[process, f['timer_handle']] = owner
                self.own(process, f['timer_handle'], owner)
            elif name == 'rclcpp_subscription_init':
                owner = self.owner_of_rcl.get((process, f['subscription_handle']))
                self.object_of[process, f['subscription']] = owner
                self.own(process, f['subscription'], owner)
            elif name == 'rclcpp_subscription_callback_added':
                self.add(process, f['callback'], self.object_of.get((process, f['subscription'])), f['subscription'])
            elif name in ('rclcpp_service_callback_added', 'rclcpp_timer_callback_added'):
                handle = f['service_handle' if 'service_handle' in f else 'timer_handle']
                self.add(process, f['callback'], self.owner_of_rcl.get((process, handle)), handle)
            elif name == 'rclcpp_client_callback_start':
                answering[thread] = f['client_handle'], time
            elif name == 'rclcpp_client_callback_end' and thread in answering:
                handle, begin = answering.pop(thread)
                self.client_runs.append((process, self.owner_of_rcl.get((process, handle), (None, None))[1], time - begin))
                self.end_execution(executing, thread, name, time)
            elif name.startswith('rclcpp_executor_execute_'):
                kind = name.removeprefix('rclcpp_executor_execute_')
                handle = f['waitable' if kind == 'waitable' else f'{kind}_handle']
                _, node, what = self.owner_of_rcl.get((process, handle), (None, None, None)) if kind != 'waitable' else (None, None, None)
                served = process, node, kind, what, handle if kind == 'waitable' else None
                self.executions[served][0] += 1
                executing[thread] = served, time
            else:
                self.end_execution(executing, thread, name, time)

    def end_execution(self, executing, thread, name, time):
        if thread in executing and name == ENDS.get(executing[thread][0][2]):
            served, begin = executing.pop(thread)
            self.executions[served][1].append(time - begin)

    def own(self, process, handle, owner):
        """The owner of the callbacks that were added to the object before is known."""
        for key, (_, of_handle) in list(self.callbacks.items()):
            if key[0] == process and of_handle == handle:
                self.callbacks[key] = owner, handle
                self.owners[key].add(owner)

    def add(self, process, callback, owner, handle=None):
        self.callbacks[process, callback] = owner, handle
        if owner:
            self.owners[process, callback].add(owner)

    def is_reused(self, key):
        return len({owner[1:] for owner in self.owners[key] if owner[1]}) > 1

    def callback_rows(self):
        """Of callbacks that ran, and whose address is that of no other one."""
        ran = {(one.process, one.callback) for one in self.rows.instances}
        rows = []
        for (process, callback), (owner, _) in self.callbacks.items():
            if owner and (process, callback) in ran and not self.is_reused((process, callback)):
                kind, node, what = owner
                rows.append((process, callback, kind, node, what))
        return rows

    def node_rows(self):
        """Of nodes all of whose callbacks have an address of their own."""
        result = {tuple(row): [0, 0] for row in self.rows.nodes}
        doubtful = set()
        for one in self.rows.instances:
            owner, _ = self.callbacks.get((one.process, one.callback), (None, None))
            if owner is None or owner[1] is None:
                continue
            key = one.process, owner[1]
            if self.is_reused((one.process, one.callback)):
                doubtful |= {(one.process, node) for _, node, _ in self.owners[one.process, one.callback]}
            if one.end is not None and key in result:
                result[key][0] += 1
                result[key][1] += one.end - one.begin
        for process, node, took in self.client_runs:
            if (process, node) in result:
                result[process, node][0] += 1
                result[process, node][1] += took
        return [(*key, *sums) for key, sums in result.items() if key not in doubtful], doubtful

    def call_rows(self):
        groups = collections.defaultdict(list)
        for call in self.rows.calls.values():
            groups[call.get('client'), call.get('service')].append(call)
        return [(*(of_client or (None, None)), *(of_service or (None, None)), (client or service)[2], len(calls),
                 sum('received' in call or 'sent' not in call and 'answered' in call for call in calls),
                 *summary(between(calls, 'sent', 'received')), *summary(between(calls, 'sent', 'taken')),
                 *summary(between(calls, 'taken', 'answered')), *summary(between(calls, 'answered', 'received')))
                for (client, service), calls in groups.items() if client or service
                for of_client, of_service in [(client and client[:2], service and service[:2])]]

    def action_rows(self, published):
        """`published`: messages on each topic."""
        actions = collections.defaultdict(lambda: collections.defaultdict(list))
        for call in self.rows.calls.values():
            if client := call.get('client'):
                for what in (GOAL, RESULT, CANCEL):
                    if client[2].endswith(what):
                        actions[client[2].removesuffix(what), client[0], client[1]][what].append(call)
        return [(*key, len(calls[GOAL]), sum('received' in call for call in calls[GOAL]),
                 sum('received' in call for call in calls[RESULT]), len(calls[CANCEL]), published[key[0] + FEEDBACK],
                 *summary(between(calls[GOAL], 'sent', 'received')), *summary(between(calls[RESULT], 'sent', 'received')))
                for key, calls in actions.items()]

    def execution_rows(self):
        return [(*served[:4], count, *summary(durations)) for served, (count, durations) in self.executions.items()]

    def stay_rows(self):
        return [tuple(stay) for stay in self.rows.lifecycle_states]
