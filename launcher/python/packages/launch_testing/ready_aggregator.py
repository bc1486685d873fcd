# SPDX-License-Identifier: Apache-2.0
"""One call when several things are ready."""

import threading


class ReadyAggregator:
    """Calls `ready_fn` when ready_fn() of this object has been called `target_count` times."""

    def __init__(self, ready_fn, target_count):
        self._ready_fn = ready_fn
        self._left = target_count
        self._lock = threading.Lock()

    def ready_fn(self):
        with self._lock:
            self._left -= 1
            is_last = self._left == 0
        if is_last:
            self._ready_fn()
