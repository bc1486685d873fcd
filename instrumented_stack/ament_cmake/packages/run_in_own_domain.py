# SPDX-License-Identifier: Apache-2.0
"""Runs a command in a ROS domain that nobody else has leased: python3 run_in_own_domain.py COMMAND [ARGUMENT...]

The lease is a bound TCP port, 32768 plus the domain, as `launch test` and ROS 2's own tests have it. The command inherits the
socket, so the lease ends with the last process of the test.
"""

import os
import socket
import sys

FIRST_PORT = 32768
DOMAINS = 101  # 1 to 101; 0 is what people work with


def lease() -> int:
    """Returns a free domain. Leases that are taken at the same time begin at different places."""
    for index in range(DOMAINS):
        domain = 1 + (os.getpid() + index) % DOMAINS
        taken = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        try:
            taken.bind(('', FIRST_PORT + domain))
        except OSError:
            taken.close()
            continue
        taken.set_inheritable(True)
        taken.detach()
        return domain
    sys.exit(f'run_in_own_domain: no ROS domain is free: 1 to {DOMAINS} are leased')


if __name__ == '__main__':
    os.environ['ROS_DOMAIN_ID'] = str(lease())
    try:
        os.execvp(sys.argv[1], sys.argv[1:])
    except OSError as error:
        sys.exit(f'run_in_own_domain: cannot run {sys.argv[1]}: {error.strerror}')
