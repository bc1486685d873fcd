# SPDX-License-Identifier: Apache-2.0
"""Events of processes: those that handlers get, and those that ask something of a process."""

import os

from launch import _names
from launch._dispatch import _Step
from launch._entities import entity
from launch._places import Located, name_of_function
from launch._values import WrongKind, function, text
from launch.event import Event


def action_named(values):
    """The action of the process that an event is about; None for a process of an XML or YAML file."""
    from launch.actions._processes import actions_by_name
    return actions_by_name.get(values.get('action'))


def command_line(pid):
    """The words of the command line of a running process; None when it has ended."""
    try:
        with open(f'/proc/{pid}/cmdline', encoding='utf-8', errors='surrogateescape') as file:
            return file.read().split('\0')[:-1] or None
    except OSError:
        return None


class ProcessEvent(Event):
    """What happened to a process. `action` is None for a process of an XML or YAML file. Tests make some with keywords of ROS 2."""

    def __init__(self, action, values=None, **given):
        values = values or _values_of(given)
        self.action = action
        self.execute_process_action = action
        self.process_name = values['process']
        self.pid = int(values['pid']) if values.get('pid') else (getattr(action, '_details', None) or {}).get('pid')
        # Tests of launches learn the words of the command line when the process starts.
        self.cmd = getattr(action, '_final_cmd', None) or getattr(action, 'cmd', None)
        self.cwd = None
        self.env = None
        if given:
            self.cmd, self.cwd, self.env = given.get('cmd'), given.get('cwd'), given.get('env')
        elif action is not None:
            action._details = {'action': action, 'name': self.process_name, 'pid': self.pid, 'cmd': self.cmd}


def _values_of(given):
    """What the launcher would tell of an event with these keywords."""
    text = given.get('text', b'')
    return {'process': given.get('name'), 'pid': given.get('pid'), 'exit_code': given.get('returncode', 0),
            'text': text.decode(errors='surrogateescape') if isinstance(text, bytes) else text,
            'stream': 'stderr' if given.get('fd') == 2 else 'stdout'}


class ProcessStarted(ProcessEvent):
    name = 'launch.events.process.ProcessStarted'


class ProcessExited(ProcessEvent):
    """`returncode` is -N when signal N ended the process."""

    name = 'launch.events.process.ProcessExited'

    def __init__(self, action, values=None, **given):
        super().__init__(action, values, **given)
        self.returncode = int((values or _values_of(given))['exit_code'])
        if action is not None and not given:
            action._return_code = self.returncode


class ProcessIO(ProcessEvent):
    """One line, as bytes with its end."""

    name = 'launch.events.process.ProcessIO'

    def __init__(self, action, values=None, **given):
        super().__init__(action, values, **given)
        values, end = (values, b'\n') if values else (_values_of(given), b'')
        self.text = values['text'].encode(errors='surrogateescape') + end
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
    """Asks something of the processes that the matcher accepts."""

    def __init__(self, *, process_matcher):
        self.process_matcher = function(process_matcher, 'process_matcher')
        action = getattr(process_matcher, 'action', None)
        if action is not None:
            _name_of(action)  # an action gets its name before it is read

    # The tag for one process, which has this name.
    def _tag(self, place, process, when):
        raise NotImplementedError

    def _tags(self, place, when):
        action = getattr(self.process_matcher, 'action', None)
        if action is not None:
            name = _name_of(action)
            tag, *given, _process_name = self._tag(place, name, when)
            return [(tag, *given, name[0])]
        name = getattr(self.process_matcher, 'process_name', None)
        if name is not None:
            return [self._tag(place, name, when)]
        step = _Chosen(self)
        step._made_at = None
        return [entity('', place, when, obj=step)]


class _Chosen(_Step):
    """The processes that a matcher accepts, when it is asked."""

    def __init__(self, event):
        self._event = event

    def _calls(self):
        return name_of_function(self._event.process_matcher)

    def _do(self, context):
        from launch.actions._processes import actions_by_name
        return [self._event._tag(None, (name,), []) for name, action in list(actions_by_name.items())
                if action._was_read and self._event.process_matcher(action)]


ProcessTargetedEvent = _ProcessTargetedEvent
RunningProcessEvent = ProcessEvent  # the two are one here


class ShutdownProcess(_ProcessTargetedEvent):
    name = 'launch.events.process.ShutdownProcess'

    def _tag(self, place, process, when):
        return entity('stop', place, [('process', process), *when])


class SignalProcess(_ProcessTargetedEvent):
    name = 'launch.events.process.SignalProcess'

    def __init__(self, *, signal_number, process_matcher):
        super().__init__(process_matcher=process_matcher)
        if isinstance(signal_number, bool) or not isinstance(signal_number, (int, str)):
            raise WrongKind(f'signal_number must be an int or a str, got {type(signal_number).__name__}')
        self.signal = signal_number

    @property
    def signal_name(self):
        if isinstance(self.signal, str):
            return self.signal
        from signal import Signals
        return Signals(self.signal).name

    def _tag(self, place, process, when):
        number = self.signal if isinstance(self.signal, str) else str(int(self.signal))
        return entity('signal', place, [('process', process), ('signal', number), *when])


class _Matcher:
    """A function of an action. Where it means one action or one name, the launcher finds the process itself."""

    def __init__(self, accepts, action=None, process_name=None):
        self._accepts = accepts
        self.action = action
        self.process_name = process_name

    def __call__(self, action):
        return self._accepts(action)


def _name_of(action):
    from launch.actions._processes import name_of_process
    return name_of_process(action, 'the action to match')


def matches_action(target_action):
    return _Matcher(lambda action: action is target_action, action=target_action)


def matches_name(name):
    return _Matcher(lambda action: (action.process_details or {}).get('name') == name, process_name=text(name, 'name'))


def matches_pid(pid):
    return lambda action: (action.process_details or {}).get('pid') == pid


def matches_executable(executable):
    return _Matcher(lambda action: os.path.basename(str((action.process_details or {}).get('name'))) == executable,
                    process_name=text(executable, 'executable'))


_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.process_matchers')
__path__ = []  # so that `import launch.events.process.process_matchers` looks for it
