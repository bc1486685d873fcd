# SPDX-License-Identifier: Apache-2.0
"""Event handlers of test descriptions."""

from launch import _names
from launch.event_handlers import OnProcessIO


class StdoutReadyListener(OnProcessIO):
    """Visits the actions when a process has written the text to its standard output."""

    def __init__(self, *, target_action=None, ready_txt, actions):
        self._text = ready_txt
        self._actions = list(actions)
        self._is_over = False
        super().__init__(target_action=target_action, on_stdout=self._on_stdout)

    def _on_stdout(self, event):
        if self._is_over or self._text not in event.text.decode(errors='replace'):
            return None
        self._is_over = True
        return self._actions


_names.one_class_modules(__name__)
