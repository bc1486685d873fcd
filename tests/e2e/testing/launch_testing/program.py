# SPDX-License-Identifier: Apache-2.0
"""A program under test: prints its arguments and some lines, and ends by itself or with Ctrl-C."""

import signal
import sys


def main():
    print('Starting Up', flush=True)
    if sys.argv[1:]:
        print(f'Called with arguments {sys.argv[1:]}', flush=True)
    print('a complaint', file=sys.stderr, flush=True)
    if '--exception' in sys.argv:
        raise RuntimeError('asked to fail')
    for i in range(4):
        print(f'\033[1mLoop\033[0m {i}', flush=True)
    if '--wait' in sys.argv:
        stopped = []
        signal.signal(signal.SIGINT, lambda *_: stopped.append(True))
        print('Waiting', flush=True)
        while not stopped:
            signal.pause()
    print('Shutting Down', flush=True)


if __name__ == '__main__':
    main()
