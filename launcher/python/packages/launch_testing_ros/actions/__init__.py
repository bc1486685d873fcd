# SPDX-License-Identifier: Apache-2.0
"""Actions of tests of ROS nodes."""

import functools
import os
import socket

from launch import _environment
from launch.actions import OpaqueFunction, SetEnvironmentVariable

__all__ = ['EnableRmwIsolation']

_FIRST_PORT = 32768
_DOMAINS = 101  # 1 to 101; 0 is what people work with
_leases = []  # until the end of this process


@functools.lru_cache(maxsize=None)
def _lease():
    """
    Return a ROS domain that nobody else has leased; it is one for all launches of this process.

    The lease is a bound TCP port, 32768 plus the domain, as `launch test` and ROS 2's own tests have it.
    """
    for index in range(_DOMAINS):
        domain = 1 + (os.getpid() + index) % _DOMAINS
        port = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        try:
            port.bind(('', _FIRST_PORT + domain))
        except OSError:
            port.close()
            continue
        _leases.append(port)
        return str(domain)
    raise RuntimeError(f'no ROS domain is free: 1 to {_DOMAINS} are leased')


class EnableRmwIsolation(OpaqueFunction):
    """
    Give the test a ROS domain of its own.

    The domain is that of the processes that are started after this action, and of the tests themselves.
    """

    def __init__(self, **kwargs):
        domain = _lease()
        _environment.of_process()['ROS_DOMAIN_ID'] = domain
        super().__init__(function=lambda context: [SetEnvironmentVariable('ROS_DOMAIN_ID', domain)], **kwargs)
