# SPDX-License-Identifier: Apache-2.0
"""
The rows of what a trace holds, computed from its events with nothing of the reader and the analysis of this project: nodes and what
they have, ways of messages, calls, goals, states, chains with their hops.
"""

import collections
import dataclasses
import re

GOAL, RESULT = '/_action/send_goal', '/_action/get_result'


@dataclasses.dataclass(eq=False)
class Instance:
    """A run of a callback. `message` began it."""
    process: int
    thread: int
    callback: int
    begin: int
    end: int = None
    message: 'Message' = None

    def __iter__(self):
        return iter((self.process, self.callback, self.begin))


@dataclasses.dataclass(eq=False)
class Message:
    """
    A publication. `instance` was running in its thread; the times are those of the functions of each layer. `causes` are the runs
    of callbacks that it comes from: this one, and of a publisher with a link the last one of each linked subscription.
    """
    process: int
    topic: str
    published: int
    rclcpp: int
    rcl: int
    instance: Instance
    causes: list

    @property
    def called(self):
        return next(time for time in (self.rclcpp, self.rcl, self.published) if time is not None)


def handles(array):
    """The elements of an array that babeltrace2 has printed."""
    return [int(element, 0) for element in re.findall(r'= (\w+)', array)]


def words(parts):
    return parts and ' '.join(map(str, parts))


class Rows:
    """Each attribute is a list of rows, in no order. Nodes are pairs of process and name."""

    def __init__(self, events):
        self.nodes, self.publishers, self.subscriptions, self.timers = [], [], [], []
        self.services, self.clients, self.lifecycle_states, self.received = [], [], [], []
        self.event_counts = collections.Counter()
        self.calls = {}  # by client's gid and sequence number
        self.instances = []
        self.waits = collections.defaultdict(list)  # by process and thread
        self.taken = {}  # message and time of its take, by instance
        self.stays = {}
        self.known = set()
        self.node_of = {}  # by process and handle of rcl
        self.object_of = {}  # rows of endpoints by process and handle of rmw
        self.gid_of = {}
        self.running = collections.defaultdict(list)
        self.calling = {}
        self.publications = {}
        self.pending = {}
        self.topic_of_rcl, self.rcl_handle_of, self.subscription_of = {}, {}, {}
        self.links = {}  # subscriptions by process and handle of the publisher
        self.last_run = {}  # of callbacks, by process and handle of their subscription
        self.within = {}  # the last publication of each thread within its process
        self.slots = {}  # of ring buffers
        self.waiting = {}
        self.end = max((time for time, _, _ in events), default=0)
        for time, name, fields in events:
            if name:
                self.event_counts[fields['vpid'], name] += 1
            if handler := name and getattr(self, name, None):
                handler(time, fields['vpid'], (fields['vpid'], fields['vtid']), fields)
        self.lifecycle_states += [(*stay, self.end) for stay in self.stays.values()]

    # What there is. A session that begins late is told again what there is.

    def add(self, table, handle, row):
        if (handle, *row) not in self.known:
            self.known.add((handle, *row))
            table.append(row)

    def rcl_node_init(self, time, process, thread, f):
        name = f['namespace'].rstrip('/') + '/' + f['node_name']
        self.node_of[process, f['node_handle']] = name
        self.add(self.nodes, f['node_handle'], (process, name))

    def rcl_publisher_init(self, time, process, thread, f):
        row = process, self.node_of.get((process, f['node_handle'])), f['topic_name'], f['queue_depth']
        self.add(self.publishers, f['publisher_handle'], row)
        self.topic_of_rcl[process, f['publisher_handle']] = f['topic_name']
        self.rcl_handle_of[process, f['rmw_publisher_handle']] = f['publisher_handle']
        self.object_of[process, f['rmw_publisher_handle']] = row

    def rcl_subscription_init(self, time, process, thread, f):
        row = process, self.node_of.get((process, f['node_handle'])), f['topic_name'], f['queue_depth']
        self.add(self.subscriptions, f['subscription_handle'], row)
        self.object_of[process, f['rmw_subscription_handle']] = row

    def rcl_service_init(self, time, process, thread, f):
        row = process, self.node_of.get((process, f['node_handle'])), f['service_name']
        self.add(self.services, f['service_handle'], row)
        self.object_of[process, f['rmw_service_handle']] = row

    def rcl_client_init(self, time, process, thread, f):
        row = process, self.node_of.get((process, f['node_handle'])), f['service_name']
        self.add(self.clients, f['client_handle'], row)
        self.object_of[process, f['rmw_client_handle']] = row

    def rmw_client_init(self, time, process, thread, f):
        self.gid_of[process, f['rmw_client_handle']] = f['gid']

    def rcl_timer_init(self, time, process, thread, f):
        if (process, f['timer_handle'], f['period']) not in self.known:
            row = [process, None, f['period']]
            self.add(self.timers, f['timer_handle'], row)
            self.known.add((process, f['timer_handle'], f['period']))
            self.object_of[process, f['timer_handle']] = row

    def rclcpp_subscription_init(self, time, process, thread, f):
        self.subscription_of[process, f['subscription']] = process, f['subscription_handle']

    def rclcpp_subscription_callback_added(self, time, process, thread, f):
        self.subscription_of[process, f['callback']] = self.subscription_of.get((process, f['subscription']))

    def message_link_partial_sync(self, time, process, thread, f):
        for publisher in handles(f['pubs']):
            self.links[process, publisher] = [(process, one) for one in handles(f['subs'])]

    message_link_periodic_async = message_link_partial_sync

    def rclcpp_timer_link_node(self, time, process, thread, f):
        self.object_of[process, f['timer_handle']][1] = self.node_of.get((process, f['node_handle']))

    def rcl_lifecycle_state_machine_init(self, time, process, thread, f):
        self.stays[process, f['state_machine']] = process, self.node_of.get((process, f['node_handle'])), 'unconfigured', time

    def rcl_lifecycle_state_machine_fini(self, time, process, thread, f):
        if stay := self.stays.pop((process, f['state_machine']), None):
            self.lifecycle_states.append((*stay, time))

    def rcl_lifecycle_transition(self, time, process, thread, f):
        key = process, f['state_machine']
        _, node, _, begin = self.stays[key]
        self.lifecycle_states.append((process, node, f['start_label'], begin, time))
        self.stays[key] = process, node, f['goal_label'], time

    # What happened.

    def callback_start(self, time, process, thread, f):
        instance = Instance(process, thread[1], f['callback'], time)
        self.running[thread].append(instance)
        self.instances.append(instance)
        self.last_run[self.subscription_of.get((process, f['callback']))] = instance
        if thread in self.pending:
            message, at, is_intra_process = self.pending.pop(thread)
            if is_intra_process == f['is_intra_process']:
                instance.message = message
                self.taken[instance] = at
                self.received.append((message, at, instance, is_intra_process))

    def callback_end(self, time, process, thread, f):
        for instance in reversed(self.running[thread]):
            if instance.callback == f['callback']:
                instance.end = time
                self.running[thread].remove(instance)
                break

    def rclcpp_publish(self, time, process, thread, f):
        self.calling[thread] = {'message': f['message'], 'rclcpp': time}

    def rcl_publish(self, time, process, thread, f):
        call = self.calling.get(thread)
        if call is None or call['message'] != f['message']:
            call = self.calling[thread] = {'message': f['message']}
        call['rcl'] = time

    def publication(self, time, process, thread, topic, message, publisher):
        call = self.calling.pop(thread, {})
        if call.get('message') != message:
            call = {}
        inner = self.running[thread][-1] if self.running[thread] else None
        causes = [inner] if inner else []
        if linked := self.links.get((process, publisher)):
            causes += [self.last_run[one] for one in linked if self.last_run.get(one) not in (None, inner)]
        return Message(process, topic, time, call.get('rclcpp'), call.get('rcl'), inner, causes)

    def rmw_publish(self, time, process, thread, f):
        if owner := self.object_of.get((process, f['rmw_publisher_handle'])):
            self.publications[owner[2], f['timestamp']] = self.publication(
                time, process, thread, owner[2], f['message'], self.rcl_handle_of[process, f['rmw_publisher_handle']])

    def rmw_take(self, time, process, thread, f):
        self.pending.pop(thread, None)
        owner = self.object_of.get((process, f['rmw_subscription_handle']))
        if owner and f['taken'] and (message := self.publications.get((owner[2], f['source_timestamp']))):
            self.pending[thread] = message, time, 0

    def rclcpp_intra_publish(self, time, process, thread, f):
        topic = self.topic_of_rcl.get((process, f['publisher_handle']))
        self.within[thread] = self.publication(time, process, thread, topic, f['message'], f['publisher_handle'])

    def rclcpp_ring_buffer_enqueue(self, time, process, thread, f):
        self.slots[process, f['buffer'], f['index']] = self.within.get(thread)

    def rclcpp_ring_buffer_dequeue(self, time, process, thread, f):
        if message := self.slots.pop((process, f['buffer'], f['index']), None):
            self.pending[thread] = message, time, 1

    def rclcpp_executor_wait_for_work(self, time, process, thread, f):
        self.pending.pop(thread, None)
        self.waiting[thread] = time

    def rclcpp_executor_get_next_ready(self, time, process, thread, f):
        if thread in self.waiting:
            self.waits[thread].append((self.waiting.pop(thread), time))

    # Calls.

    def call(self, gid, f):
        return self.calls.setdefault((gid, f['sequence_number']), {})

    def rmw_send_request(self, time, process, thread, f):
        client = process, f['rmw_client_handle']
        if client in self.gid_of and client in self.object_of:
            self.call(self.gid_of[client], f).update(client=self.object_of[client], sent=time)

    def rmw_take_request(self, time, process, thread, f):
        if f['taken']:
            self.call(f['client_gid'], f).update(service=self.object_of.get((process, f['rmw_service_handle'])), taken=time)

    def rmw_send_response(self, time, process, thread, f):
        self.call(f['client_gid'], f).update(answered=time)

    def rmw_take_response(self, time, process, thread, f):
        client = process, f['rmw_client_handle']
        if f['taken'] and client in self.gid_of:
            self.call(self.gid_of[client], f).update(received=time)

    # What follows from it.

    def of_nodes(self, table):
        """Without those whose node the trace does not tell, and an action server's timer for its results, which no node runs."""
        return [tuple(row) for row in table if row[1]]

    def count_rows(self):
        return [(process, name, count) for (process, name), count in self.event_counts.items()]

    def way_rows(self):
        return [(message.topic, message.called, message.rclcpp, message.rcl, message.published, words(message.instance), at,
                 words(instance), is_intra_process) for message, at, instance, is_intra_process in self.received]

    def call_rows(self):
        return [(words(call.get('client')), words(call.get('service')),
                 *(call.get(name) for name in ('sent', 'taken', 'answered', 'received'))) for call in self.calls.values()]

    def goal_rows(self):
        """A goal has no identity in the trace: its result is asked for after this answer and before the next one."""
        rows = []
        for client in {call['client'] for call in self.calls.values() if call.get('client', ('', '', ''))[2].endswith(GOAL)}:
            process, node, name = client
            name = name.removesuffix(GOAL)
            goals = sorted((call for call in self.calls.values() if call.get('client') == client), key=lambda call: call['sent'])
            results = [call for call in self.calls.values() if call.get('client') == (process, node, name + RESULT)]
            answers = sorted(call['received'] for call in goals if 'received' in call)
            for call in goals:
                answered = call.get('received')
                until = next((one for one in answers if answered is not None and one > answered), None)
                result = next((one for one in results if answered is not None and one['sent'] > answered
                               and (until is None or one['sent'] < until)), {})
                rows.append((name, process, node, call['sent'], answered, result.get('sent'), result.get('received')))
        return rows

    def way_to(self, instance, callbacks, has_name):
        """The runs of these callbacks, each by a message of the one before, that led to this one; none if others did."""
        way = [instance]
        for key in callbacks[-2::-1]:
            causes = way[0].message.causes if way[0].message else []
            cause = next((one for one in causes if (one.process, one.callback) == key), None)
            if cause is None:
                return None
            way.insert(0, cause)
        return way if has_name or not (way[0].message and way[0].message.causes) else None

    def executor_time(self, instance):
        """Of the way of its message, the time in which its thread did not wait for work; in a process with one such thread."""
        message, taken = instance.message, self.taken[instance]
        waits = self.waits.get((instance.process, instance.thread), [])
        if not waits or waits[0][0] > message.published:
            return None  # whether it waited before is not in a session that began later
        waited = sum(max(0, min(end, taken) - max(begin, message.published)) for begin, end in waits)
        return taken - message.published - waited

    def hops_of(self, callbacks, has_name):
        """For each output of the chain of these callbacks: of each step begin, duration, message's publication, executor, take."""
        result = []
        for last in self.instances:
            if last.end is None or (last.process, last.callback) != callbacks[-1]:
                continue
            way = self.way_to(last, callbacks, has_name)
            if way is None:
                continue
            hops = []
            for before, one in zip([None, *way], way):
                hop = [one.begin, None if one.end is None else one.end - one.begin]
                if before:
                    message = one.message
                    hop += [message.published - before.begin, one.begin - message.published,
                            self.executor_time(one) if self.has_one_executor(one.process) else None, one.begin - self.taken[one]]
                hops.append(tuple(hop))
            result.append(tuple(hops))
        return result

    def has_one_executor(self, process):
        """Otherwise threads wait for one another, and more than the waits of the taking thread counts."""
        return len([thread for owner, thread in self.waits if owner == process]) == 1
