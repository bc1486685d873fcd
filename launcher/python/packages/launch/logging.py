# SPDX-License-Identifier: Apache-2.0
"""Messages of launch files, in the launcher's own log."""

import logging as _logging
from logging import *  # noqa: F401,F403  as ROS 2's module does
from logging import CRITICAL, DEBUG, ERROR, INFO, WARNING

import _launch_engine

_LEVELS = {DEBUG: 'debug', INFO: 'info', WARNING: 'warning', ERROR: 'error', CRITICAL: 'critical'}


class _LaunchHandler(_logging.Handler):

    def emit(self, record):
        level = max(known for known in _LEVELS if known <= max(record.levelno, DEBUG))
        if _launch_engine.is_running():
            _launch_engine.message(_LEVELS[level], record.name, record.getMessage())


_handler = _LaunchHandler()


def get_logger(name=None):
    logger = _logging.getLogger(name or 'launch')
    if _handler not in logger.handlers:
        logger.addHandler(_handler)
        logger.setLevel(DEBUG)
        logger.propagate = False
    return logger


class _LaunchConfig:

    @property
    def log_dir(self):
        return _launch_engine.log_directory()

    @property
    def level(self):
        return INFO

    @level.setter
    def level(self, _value):
        pass  # `launch --debug` decides


launch_config = _LaunchConfig()
