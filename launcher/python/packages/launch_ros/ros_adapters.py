# SPDX-License-Identifier: Apache-2.0
"""A node of rclpy for actions that a launch file writes itself. It needs rclpy, which is no part of the launcher."""

import os
import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor

_ADAPTER = 'ros_adapter'


class ROSAdapter:
    """A node that a thread spins, with a context of its own."""

    def __init__(self, *, argv=None, autostart=True):
        self._argv = [] if argv is None else argv
        self._context = None
        self._node = None
        self._executor = None
        self._thread = None
        if autostart:
            self.start()

    argv = property(lambda self: self._argv)
    ros_context = property(lambda self: self._context)
    ros_node = property(lambda self: self._node)
    ros_executor = property(lambda self: self._executor)

    def start(self):
        """Makes the node and begins to spin it. RuntimeError if it spins already."""
        if self._thread is not None:
            raise RuntimeError('Cannot start a ROS adapter that is already running')
        self._context = rclpy.Context()
        rclpy.init(args=self._argv, context=self._context)
        self._node = rclpy.create_node(f'launch_ros_{os.getpid()}', context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._stops = threading.Event()
        self._thread = threading.Thread(target=self._spin, daemon=True)
        self._thread.start()

    def _spin(self):
        while not self._stops.is_set():
            self._executor.spin_once(timeout_sec=1.0)

    def shutdown(self):
        """Ends the thread and the node. RuntimeError if it does not spin."""
        if self._thread is None:
            raise RuntimeError('Cannot shutdown a ROS adapter that is not running')
        self._stops.set()
        if hasattr(self._executor, 'wake'):
            self._executor.wake()
        self._thread.join()
        self._thread = None
        self._executor.remove_node(self._node)
        self._node.destroy_node()
        rclpy.shutdown(context=self._context)


def get_ros_adapter(context):
    """The adapter of the launch. The first call makes it; it ends with the launch."""
    if not hasattr(context.locals, _ADAPTER):
        from launch.event_handlers import OnShutdown
        adapter = ROSAdapter()
        context.extend_globals({_ADAPTER: adapter})

        def end(_event, _context):
            adapter.shutdown()

        context.register_event_handler(OnShutdown(on_shutdown=end))
    return getattr(context.locals, _ADAPTER)


def get_ros_node(context):
    """The node of the launch's adapter."""
    return get_ros_adapter(context).ros_node
