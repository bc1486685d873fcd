# SPDX-License-Identifier: Apache-2.0
from rclpy import Handle, record


class Timer:
    def __init__(self, callback, callback_group, timer_period_ns, clock, *, context=None, autostart=True):
        self.__timer = Handle()
        record('rcl_timer_init', self.__timer.pointer, timer_period_ns)
        self.callback = callback

    @property
    def handle(self):
        return self.__timer
