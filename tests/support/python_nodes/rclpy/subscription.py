# SPDX-License-Identifier: Apache-2.0
import inspect


class Subscription:
    def __init__(self, subscription_impl, msg_type, topic, callback, callback_group, qos_profile, raw=False):
        self.__subscription = subscription_impl
        self.topic = topic
        self.callback = callback
        self.arguments = len(inspect.signature(callback).parameters)

    @property
    def handle(self):
        return self.__subscription
