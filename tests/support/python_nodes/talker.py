# SPDX-License-Identifier: Apache-2.0
"""A node whose callbacks are executed a hundred times each. Of each kind there is one."""

import functools
import os
import threading

from rclpy.node import Node


class Talker(Node):
    def __init__(self):
        super().__init__('py_talker')
        self.timer = self.create_timer(0.01, self.talk)
        self.subscription = self.create_subscription(str, '/orders', functools.partial(self.order, 'kind'), 10)
        self.service = self.create_service(str, '/add', self.add)
        self.failing = self.create_timer(0.02, self.fail)

    def talk(self):
        sum(range(1000))

    def order(self, kind, message):
        assert (kind, message) == ('kind', 'message')

    async def add(self, request, response):
        assert await Pause() == 'awake'
        return response

    def fail(self):
        raise ValueError('as it should')


class Pause:
    def __await__(self):
        return (yield)


def await_result(coroutine):
    assert coroutine.send(None) is None
    try:
        coroutine.send('awake')
    except StopIteration as done:
        return done.value


def spin(node):
    for _ in range(100):
        node.timer.callback()
        node.subscription.callback('message')
        assert await_result(node.service.callback('request', 'response')) == 'response'
        try:
            node.failing.callback()
        except ValueError:
            pass


talker = Talker()
assert talker.subscription.arguments == 1
thread = threading.Thread(target=spin, args=(talker,))
thread.start()
thread.join()
if os.fork() == 0:
    talker.timer.callback()
    os._exit(0)
os.wait()
print('all was executed')
