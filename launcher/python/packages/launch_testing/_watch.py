# SPDX-License-Identifier: Apache-2.0
"""What tests are told of the processes of their launch."""

from launch.actions import RegisterEventHandler
from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart
from launch.events.process import command_line
from launch_testing._known_process import ForeignProcess
from launch_testing.io_handler import ActiveIoHandler
from launch_testing.proc_info_handler import ActiveProcInfoHandler


class ProcessWatch:
    """
    Keeps starts, exits and output. Its functions are called on the launch's thread.

    `then` is called after a start or an exit, with whether it is a start.
    """

    def __init__(self, then=lambda is_start: None):
        self._then = then
        self.proc_info = ActiveProcInfoHandler()
        self.proc_output = ActiveIoHandler()
        self.running = set()  # process ids
        self._foreign = {}  # processes of XML and YAML files, by name

    def handlers(self):
        """Actions for the begin of the launch description."""
        return [RegisterEventHandler(handler) for handler in (
            OnProcessStart(on_start=self.on_start), OnProcessExit(on_exit=self.on_exit),
            OnProcessIO(on_stdout=self.on_line, on_stderr=self.on_line))]

    def named(self, event):
        if event.action is None:
            event.action = self._foreign.setdefault(event.process_name, ForeignProcess(event.process_name))
        return event

    def on_start(self, event, context):
        words = command_line(event.pid)
        if words is None and event.action is not None:
            words = [context.perform_substitution(part) if not isinstance(part, list) else
                     ''.join(map(context.perform_substitution, part)) for part in event.action.cmd]
        self.named(event)
        if words:
            event.action._final_cmd = words
            event.action.process_details['cmd'] = words
        self.running.add(event.pid)
        self.proc_output.track(event.action)
        self.proc_info.append(event)
        self._then(True)

    def on_exit(self, event, _context):
        self.running.discard(event.pid)
        self.proc_info.append(self.named(event))
        self._then(False)

    def on_line(self, event):
        self.proc_output.append(self.named(event))

    def output_of_failed(self):
        """What the processes that failed have written."""
        lines = []
        for event in self.proc_info:
            if getattr(event, 'returncode', 0) == 0:
                continue
            lines.append(f"Process '{event.process_name}' exited with {event.returncode}\n")
            lines.append(f"##### '{event.process_name}' output #####\n")
            lines += (line.text.decode(errors='replace') for line in self.proc_output[event.action])
            lines.append('#' * (len(event.process_name) + 21) + '\n')
        return ''.join(lines)
