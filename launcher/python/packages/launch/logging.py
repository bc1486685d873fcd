# SPDX-License-Identifier: Apache-2.0
"""Messages of launch files, in the launcher's own log."""

import logging as _logging
import logging.handlers as handlers
import os
import sys
from logging import *  # noqa: F401,F403  as ROS 2's module does
from logging import CRITICAL, DEBUG, ERROR, INFO, WARNING

import _launch_engine
from launch import _outside

_LEVELS = {DEBUG: 'debug', INFO: 'info', WARNING: 'warning', ERROR: 'error', CRITICAL: 'critical'}


class _LaunchHandler(_logging.Handler):

    def emit(self, record):
        level = max(known for known in _LEVELS if known <= max(record.levelno, DEBUG))
        if _launch_engine.is_running():
            _launch_engine.message(_LEVELS[level], record.name, record.getMessage())
        elif hasattr(_launch_engine, 'IS_PROGRAM') and level > DEBUG:
            # A Python program of the user's, in another thread or before its launch.
            print(f'[{_LEVELS[level].upper()}] [{record.name}]: {record.getMessage()}', flush=True)


_handler = _LaunchHandler()


def get_logger(name=None):
    logger = _logging.getLogger(name or 'launch')
    if _handler not in logger.handlers:
        logger.addHandler(_handler)
        logger.setLevel(DEBUG)
        logger.propagate = False
    return logger


class LaunchConfig:

    @property
    def log_dir(self):
        if _outside.is_here():  # no launch has a folder of its own yet
            return os.environ.get('ROS_LOG_DIR') or os.path.join(
                os.environ.get('ROS_HOME') or os.path.expanduser('~/.ros'), 'log')
        return _launch_engine.log_directory()

    @property
    def level(self):
        return INFO

    @level.setter
    def level(self, _value):
        pass  # `launch --debug` decides

    @property
    def log_handler_factory(self):
        return lambda *_arguments, **_options: _handler

    @log_handler_factory.setter
    def log_handler_factory(self, _value):
        pass  # the launcher writes the files

    def reset(self):
        """The launcher's own settings of its log stay as they are."""

    def get_log_file_path(self, file_name='launch.log'):
        return os.path.join(self.log_dir, file_name)

    def get_screen_handler(self):
        return _handler

    def get_log_file_handler(self, _file_name='launch.log'):
        return _handler

    # The launcher decides how its lines look and where they go.
    def set_screen_format(self, _format, **_options):
        pass

    def set_log_format(self, _format, **_options):
        pass


launch_config = LaunchConfig()


def get_output_loggers(process_name, output_config=None):
    """The loggers of a process's output and errors."""
    return get_logger(f'{process_name}-stdout'), get_logger(f'{process_name}-stderr')


def log_launch_config(*, logger=None):
    (logger or get_logger()).info('All log files can be found below %s', launch_config.log_dir)


def reset():
    """The launcher's own settings of its log stay as they are."""


# A module of its own in ROS 2, with the classes of Python's.
sys.modules[__name__ + '.handlers'] = handlers
__path__ = []  # so that `import launch.logging.handlers` looks for it
