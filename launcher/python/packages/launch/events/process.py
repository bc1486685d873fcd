# SPDX-License-Identifier: Apache-2.0
"""Events of processes: those that handlers get, and those that ask something of a process."""

from launch import _names
from launch._entities import entity
from launch._places import Located
from launch._values import LaunchFileError, WrongKind, text
from launch.event import Event


class ProcessEvent(Event):
    """
    What happened to a process.

    `action` is the action that the handler was registered for, None for a handler of every process.
    """

    def __init__(self, action, values):
        self.action = action
        self.process_name = values['process']
        self.pid = int(values['pid']) if values.get('pid') else None
        self.cmd = getattr(action, '_command', None)
        self.cwd = None
        self.env = None


class ProcessStarted(ProcessEvent):
    name = 'launch.events.process.ProcessStarted'


class ProcessExited(ProcessEvent):
    """`returncode` is -N when signal N ended the process."""

    name = 'launch.events.process.ProcessExited'

    def __init__(self, action, values):
        super().__init__(action, values)
        self.returncode = int(values['exit_code'])


class ProcessIO(ProcessEvent):
    """One line, as bytes with its end."""

    name = 'launch.events.process.ProcessIO'

    def __init__(self, action, values):
        super().__init__(action, values)
        self.text = values['text'].encode(errors='surrogateescape') + b'\n'
        self.from_stdout = values['stream'] == 'stdout'
        self.from_stderr = not self.from_stdout
        self.from_stdin = False
        self.fd = 1 if self.from_stdout else 2


class ProcessStdin(ProcessIO):
    """An event of ROS 2. It never happens, because launched processes get no input."""


class ProcessStdout(ProcessIO):
    pass


class ProcessStderr(ProcessIO):
    pass


class _ProcessTargetedEvent(Located, Event):

    def __init__(self, *, process_matcher):
        if not isinstance(process_matcher, _Matcher):
            raise LaunchFileError('process_matcher must be one of this package\'s',
                                  'write launch.events.matches_action(action)')
        self.process_matcher = process_matcher
        process_matcher._process()  # an action gets its name before it is read


ProcessTargetedEvent = _ProcessTargetedEvent
RunningProcessEvent = ProcessEvent


class ShutdownProcess(_ProcessTargetedEvent):

    def _tags(self, place, when):
        return [entity('stop', place, [('process', self.process_matcher._process()), *when])]


class SignalProcess(_ProcessTargetedEvent):

    def __init__(self, *, signal_number, process_matcher):
        super().__init__(process_matcher=process_matcher)
        if isinstance(signal_number, bool) or not isinstance(signal_number, (int, str)):
            raise WrongKind(f'signal_number must be an int or a str, got {type(signal_number).__name__}')
        self.signal = signal_number

    def _tags(self, place, when):
        number = self.signal if isinstance(self.signal, str) else str(int(self.signal))
        return [entity('signal', place, [('process', self.process_matcher._process()), ('signal', number), *when])]


class _Matcher(Located):
    """Tells which process an event is for."""

    def __init__(self, process, action=None):
        self._process = process
        self._action = action


def matches_action(target_action):
    from launch.actions._processes import name_of_process
    return _Matcher(lambda: name_of_process(target_action, 'the action to match'), target_action)


def matches_name(name):
    return _Matcher(lambda: text(name, 'name'))


def matches_pid(_pid):
    raise LaunchFileError('a process can\'t be meant by its number here', 'write launch.events.matches_action(action)')


def matches_executable(executable):
    return matches_name(executable)


_names.one_class_modules(__name__)
