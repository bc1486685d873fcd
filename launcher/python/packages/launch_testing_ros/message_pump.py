# SPDX-License-Identifier: Apache-2.0
"""A thread on which a node of rclpy spins."""

import threading


def executors_of_rclpy(what):
    """The module rclpy.executors. Raises RuntimeError when there is no rclpy."""
    try:
        import rclpy.executors
    except ModuleNotFoundError as error:
        raise RuntimeError(f'{what} needs the Python package rclpy of ROS 2, which is not installed here and is no part of '
                           'this launcher') from error
    return rclpy.executors


class MessagePump:
    """Spins the node on a thread from start() to stop()."""

    _PATIENCE = 5.0  # seconds that the end of the thread may take

    def __init__(self, node, context=None):
        self._executors = executors_of_rclpy('launch_testing_ros.MessagePump')
        self._node = node
        self._context = context
        self._is_over = threading.Event()
        self._thread = threading.Thread(target=self._spin, name='msg_pump_thread', daemon=True)

    def start(self):
        self._thread.start()

    def stop(self):
        self._is_over.set()
        self._thread.join(timeout=self._PATIENCE)
        if self._thread.is_alive():
            raise Exception('Timed out waiting for message pump to stop')

    def _spin(self):
        executor = self._executors.SingleThreadedExecutor(context=self._context)
        executor.add_node(self._node)
        while not self._is_over.is_set():
            executor.spin_once(timeout_sec=1.0)
