# SPDX-License-Identifier: Apache-2.0
"""
What became of the messages of each subscription and topic, computed from the events with nothing of the analysis of this project.
`docs/report.md` says what each figure means.
"""

import collections
import dataclasses
import math


@dataclasses.dataclass(eq=False)
class Publisher:
    process: int
    node: str
    topic: str
    is_reliable: bool = None
    history: int = None
    is_filtered: bool = False
    sent: list = dataclasses.field(default_factory=list)  # times of publications through the middleware
    within: int = 0  # publications to subscriptions of its own process


@dataclasses.dataclass(eq=False)
class Subscription:
    process: int
    node: str
    topic: str
    depth: int
    handle: int
    is_reliable: bool = None
    history: int = None
    is_filtered: bool = False
    objects: set = dataclasses.field(default_factory=set)  # of rclcpp: a second one takes messages within the process
    last: dict = dataclasses.field(default_factory=dict)  # place of the last message of each publisher
    counts: collections.Counter = dataclasses.field(default_factory=collections.Counter)

    @property
    def room(self):
        if self.history is None:
            return max(self.depth, 1)
        return self.history or math.inf


@dataclasses.dataclass(eq=False)
class Taken:
    subscription: Subscription
    publisher: Publisher  # None: its publication is not in the trace
    place: int
    is_within: bool
    is_executed: bool
    newest: int = 0  # so many messages the topic had at this time


class Deliveries:
    COLUMNS = ('received', 'intra_process', 'delivered', 'not_executed', 'overwritten', 'overwritten_in_buffer', 'lost',
               'lost_by_publisher', 'lost_in_transport', 'filtered', 'before_first', 'after_last')
    TOPIC_COLUMNS = ('publishers', 'subscriptions', 'published', 'received', 'published_only', 'received_only',
                     'intra_process_published', 'intra_process_received')

    def __init__(self, events):
        events = [event for event in events if event[1]]
        self.node_of, self.publisher_of, self.subscription_of = {}, {}, {}  # by process and handle of rcl
        self.quality_of = {}  # events, by process and handle of rmw
        self.gone = set()
        self.of_rmw = {}  # both, by process and handle
        self.of_object, self.object_of_callback, self.buffer_of, self.object_of_buffer = {}, {}, {}, {}
        self.publishers, self.subscriptions = [], []
        self.messages = {}  # publisher and place, by topic and timestamp
        self.sent_on = collections.defaultdict(list)  # times, by topic
        self.topics = collections.defaultdict(collections.Counter)
        self.untaken = {}  # topics, by topic and timestamp
        self.pending, self.executing, self.within, self.slots = {}, {}, {}, {}
        self.tells_executions = any(name == 'rclcpp_executor_execute' for _, name, _ in events)
        self.has_waited = set()
        for time, name, fields in events:
            if handler := getattr(self, name, None):
                handler(time, fields['vpid'], (fields['vpid'], fields['vtid']), fields)
        for thread in list(self.pending):
            self.give(thread, False)
        for subscription in self.subscriptions:
            for publisher, place in subscription.last.items():
                subscription.counts['after_last'] += len(publisher.sent) - 1 - place
        for topic in self.untaken.values():
            self.topics[topic]['published_only'] += 1

    # Objects. A session that begins late is told again what there is.

    def rcl_node_init(self, time, process, thread, f):
        self.node_of[process, f['node_handle']] = f['namespace'].rstrip('/') + '/' + f['node_name']

    def rcl_publisher_init(self, time, process, thread, f):
        known = self.publisher_of.get((process, f['publisher_handle']))
        if known and self.of_rmw.get((process, f['rmw_publisher_handle'])) is known:
            return
        publisher = Publisher(process, self.node_of.get((process, f['node_handle'])), f['topic_name'])
        self.publishers.append(publisher)
        self.publisher_of[process, f['publisher_handle']] = self.of_rmw[process, f['rmw_publisher_handle']] = publisher
        self.topics[publisher.topic]['publishers'] += 1
        self.give_quality(publisher, self.quality_of.pop((process, f['rmw_publisher_handle']), None))

    def rcl_publisher_fini(self, time, process, thread, f):
        self.has_gone(self.publisher_of.pop((process, f['publisher_handle']), None))

    def rcl_subscription_init(self, time, process, thread, f):
        known = self.subscription_of.get((process, f['subscription_handle']))
        if known and self.of_rmw.get((process, f['rmw_subscription_handle'])) is known:
            return
        subscription = Subscription(process, self.node_of.get((process, f['node_handle'])), f['topic_name'], f['queue_depth'],
                                    f['subscription_handle'])
        self.subscriptions.append(subscription)
        self.subscription_of[process, f['subscription_handle']] = subscription
        self.of_rmw[process, f['rmw_subscription_handle']] = subscription
        self.topics[subscription.topic]['subscriptions'] += 1
        self.give_quality(subscription, self.quality_of.pop((process, f['rmw_subscription_handle']), None))

    def rcl_subscription_fini(self, time, process, thread, f):
        self.has_gone(self.subscription_of.pop((process, f['subscription_handle']), None))

    # The middleware tells the quality of service before rcl tells of the object, and again when a filter changes.

    def rmw_publisher_qos(self, time, process, thread, f):
        self.quality_of[process, f['rmw_publisher_handle']] = f
        self.give_quality(self.of_rmw.get((process, f['rmw_publisher_handle'])), f)

    def rmw_subscription_qos(self, time, process, thread, f):
        self.quality_of[process, f['rmw_subscription_handle']] = f
        self.give_quality(self.of_rmw.get((process, f['rmw_subscription_handle'])), f)

    def has_gone(self, one):
        """Another one may be where it was: what the middleware tells of that place from now on is not about this one."""
        if one:
            self.gone.add(one)

    def give_quality(self, one, f):
        if one and f and one not in self.gone:
            one.is_reliable, one.history, one.is_filtered = bool(f['reliable']), f['history_depth'], bool(f.get('is_filtered'))

    def rclcpp_subscription_init(self, time, process, thread, f):
        if subscription := self.subscription_of.get((process, f['subscription_handle'])):
            subscription.objects.add(f['subscription'])
            self.of_object[process, f['subscription']] = subscription

    def rclcpp_subscription_callback_added(self, time, process, thread, f):
        self.object_of_callback[process, f['callback']] = process, f['subscription']

    def rclcpp_buffer_to_ipb(self, time, process, thread, f):
        self.buffer_of[process, f['ipb']] = f['buffer']

    def rclcpp_ipb_to_subscription(self, time, process, thread, f):
        if buffer := self.buffer_of.get((process, f['ipb'])):
            self.object_of_buffer[process, buffer] = f['subscription']

    # Publications.

    def rmw_publish(self, time, process, thread, f):
        publisher = self.of_rmw.get((process, f['rmw_publisher_handle']))
        if publisher is None:
            return
        publisher.sent.append(time)
        self.sent_on[publisher.topic].append(time)
        self.topics[publisher.topic]['published'] += 1
        self.messages[publisher.topic, f['timestamp']] = publisher, len(publisher.sent) - 1
        self.untaken[publisher.topic, f['timestamp']] = publisher.topic

    def rclcpp_intra_publish(self, time, process, thread, f):
        publisher = self.publisher_of.get((process, f['publisher_handle']))
        self.within[thread] = publisher
        if publisher:
            publisher.within += 1
            self.topics[publisher.topic]['intra_process_published'] += 1

    # Deliveries.

    def rclcpp_executor_execute(self, time, process, thread, f):
        self.executing[thread] = f['handle']

    def rclcpp_executor_wait_for_work(self, time, process, thread, f):
        self.give(thread, False)
        self.has_waited.add(thread)

    def is_executed(self, thread, subscription):
        if self.tells_executions:
            return self.executing.get(thread) == subscription.handle
        return thread in self.has_waited

    def rmw_take(self, time, process, thread, f):
        self.give(thread, False)
        subscription = self.of_rmw.get((process, f['rmw_subscription_handle']))
        if not subscription or not f['taken']:
            return
        topic, key = self.topics[subscription.topic], (subscription.topic, f['source_timestamp'])
        topic['received'] += 1
        publisher, place = self.messages.get(key, (None, None))
        if publisher is None:
            topic['received_only'] += 1
        self.untaken.pop(key, None)
        self.pending[thread] = Taken(subscription, publisher, place, False, self.is_executed(thread, subscription),
                                     len(self.sent_on[subscription.topic]))
        self.executing.pop(thread, None)  # what is taken after it, the program takes

    def rclcpp_ring_buffer_enqueue(self, time, process, thread, f):
        object_ = self.object_of_buffer.get((process, f['buffer']))
        if f['overwritten'] and (subscription := self.of_object.get((process, object_))):
            subscription.counts['overwritten_in_buffer'] += 1
        self.slots[process, f['buffer'], f['index']] = self.within.get(thread)

    def rclcpp_ring_buffer_clear(self, time, process, thread, f):
        for slot in [slot for slot in self.slots if slot[:2] == (process, f['buffer'])]:
            del self.slots[slot]

    def rclcpp_ring_buffer_dequeue(self, time, process, thread, f):
        self.give(thread, False)
        subscription = self.of_object.get((process, self.object_of_buffer.get((process, f['buffer']))))
        publisher = self.slots.pop((process, f['buffer'], f['index']), None)
        if subscription:
            self.pending[thread] = Taken(subscription, publisher, None, publisher is not None, True)

    def callback_start(self, time, process, thread, f):
        if taken := self.pending.get(thread):
            self.give(thread, self.of_object.get(self.object_of_callback.get((process, f['callback']))) is taken.subscription, time)

    def give(self, thread, has_callback, time=None):
        """The message that the thread has taken goes to its callback, or to none."""
        taken = self.pending.pop(thread, None)
        if taken is None:
            return
        subscription, publisher = taken.subscription, taken.publisher
        needs_callback = taken.is_within or taken.is_executed and subscription.objects
        is_copy = (not has_callback and needs_callback and not taken.is_within and len(subscription.objects) >= 2
                   and publisher and publisher.process == subscription.process and publisher.within)
        if is_copy:
            return
        counts = subscription.counts
        counts['received'] += 1
        counts['delivered' if has_callback or not needs_callback else 'not_executed'] += 1
        if taken.is_within:
            counts['intra_process'] += 1
            self.topics[subscription.topic]['intra_process_received'] += 1
        elif publisher:
            self.find_missing(subscription, publisher, taken.place, taken.newest)

    def find_missing(self, subscription, publisher, place, newest):
        counts = subscription.counts
        if publisher not in subscription.last:
            counts['before_first'] += place
            subscription.last[publisher] = place
            return
        missing = range(subscription.last[publisher] + 1, place)
        if place <= subscription.last[publisher]:
            return
        subscription.last[publisher] = place
        if subscription.is_filtered:
            counts['filtered'] += len(missing)
            return
        sent = self.sent_on[subscription.topic]
        for one in missing:
            newer = newest - 1 - sent.index(publisher.sent[one])
            if newer >= subscription.room:
                counts['overwritten'] += 1
                continue
            counts['lost'] += 1
            if None not in (publisher.is_reliable, subscription.is_reliable):
                both = publisher.is_reliable and subscription.is_reliable
                counts['lost_by_publisher' if both else 'lost_in_transport'] += 1

    # What follows from it.

    def subscription_rows(self):
        return [(one.process, one.node, one.topic, *(one.counts[column] for column in self.COLUMNS)) for one in self.subscriptions
                if one.counts['received'] or one.counts['overwritten_in_buffer']]

    def topic_rows(self):
        return [(name, *(counts[column] for column in self.TOPIC_COLUMNS)) for name, counts in self.topics.items()]

    def quality_rows(self):
        """Of publishers and subscriptions, as the middleware has agreed to it."""
        return [(kind, one.process if one.node else None, one.topic, None if one.is_reliable is None else int(one.is_reliable), one.history,
                 int(one.is_filtered) if kind == 'subscription' and one.is_reliable is not None else None)
                for kind, table in (('publisher', self.publishers), ('subscription', self.subscriptions)) for one in table]
