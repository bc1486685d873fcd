# SPDX-License-Identifier: Apache-2.0
"""Changes messages on their way from one topic to another."""


class DataRepublisher:
    """
    Publishes on `publish_topic` what `transform_fn` makes of each message of `listen_topic`; None drops the message.

    `node` is a node of rclpy, which the test spins.
    """

    _DEPTH = 10

    def __init__(self, node, listen_topic, publish_topic, msg_type, transform_fn):
        self._node = node
        self._transform = transform_fn
        self._received = 0
        self._republished = []
        self._publisher = node.create_publisher(msg_type, publish_topic, self._DEPTH)
        self._subscription = node.create_subscription(msg_type, listen_topic, self._on_message, self._DEPTH)

    def _on_message(self, message):
        self._received += 1
        changed = self._transform(message)
        if changed:
            self._republished.append(message)
            self._publisher.publish(changed)

    def shutdown(self):
        self._node.destroy_subscription(self._subscription)
        self._node.destroy_publisher(self._publisher)

    def get_num_received(self):
        return self._received

    def get_num_republished(self):
        return len(self._republished)

    def get_republished(self):
        """The messages that were changed and sent on, as they came."""
        return self._republished
