# SPDX-License-Identifier: Apache-2.0
from rclpy import Handle, record
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.timer import Timer


class Node:
    def __init__(self, name):
        self.handle = Handle()
        record('rcl_node_init', self.handle.pointer, self.handle.pointer + 8, name.encode(), b'/')

    def create_subscription(self, msg_type, topic, callback, qos_profile):
        handle = Handle()
        record('rcl_subscription_init', handle.pointer, self.handle.pointer, handle.pointer + 8, topic.encode(), 10)
        return Subscription(handle, msg_type, topic, callback, None, qos_profile)

    def create_service(self, srv_type, srv_name, callback):
        handle = Handle()
        record('rcl_service_init', handle.pointer, self.handle.pointer, handle.pointer + 8, srv_name.encode())
        return Service(handle, srv_type, srv_name, callback, None, None)

    def create_timer(self, timer_period_sec, callback):
        return Timer(callback, None, int(timer_period_sec * 1e9), None)
