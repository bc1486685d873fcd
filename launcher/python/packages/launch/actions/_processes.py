# SPDX-License-Identifier: Apache-2.0
"""Actions that run programs."""

import os

from launch._entities import entity
from launch._values import LaunchFileError, WrongKind, boolean, literal, mapping, number, pairs, reject, text
from launch.action import Action
from launch.descriptions import Executable
from launch.substitution import Substitution
from launch.substitutions import parts_of

_OUTPUT_FORMAT = '[{this.process_description.final_name}] {line}'


_names_given = {}
actions_by_name = {}  # all whose processes an event can be about


def name_of_process(action, what):
    """A name by which event handlers and commands refer to the processes of this one action."""
    if not isinstance(action, _Process):
        raise LaunchFileError(f'{what} must be an action that runs a process, got {type(action).__name__}')
    if action._spoken_of is None:
        file, line, *_ = action._place() or ('', 0)
        name = f'{type(action).__name__} of {os.path.basename(file)}:{line}'
        count = _names_given[name] = _names_given.get(name, 0) + 1
        action._spoken_of = name if count == 1 else f'{name} ({count})'
        actions_by_name[action._spoken_of] = action
    return (action._spoken_of,)


def forget():
    """Forgets what earlier launches of a program have told its actions, before another one begins."""
    for action in actions_by_name.values():
        action._forget_process()


def _items(tag, given, action, example):
    """The items of a tag: mappings with the attributes of XML. `process` may be an action."""
    items = []
    given = [given] if isinstance(given, dict) else given or []
    for dependency in given:
        if not isinstance(dependency, dict):
            raise LaunchFileError(f'{tag} must hold mappings, got {type(dependency).__name__}', f'write {example}')
        attributes = []
        for name, value in dependency.items():
            if name == 'process' and isinstance(value, Action):
                value = name_of_process(value, f"'process' of {tag}")
            elif isinstance(value, bool) or not isinstance(value, (int, float)):
                value = text(value, f'{name!r} of {tag}')
            else:
                value = number(value, name)
            attributes.append((name, value))
        items.append(entity(tag, action._place_of(tag) or action._place(), attributes))
    return items


class _Option:
    """An option of a process as ROS 2 gives it back: a text as a list of substitutions, anything else as it is."""

    def __init__(self, name, default):
        self._name = name
        self._default = default

    def __get__(self, action, _owner=None):
        if action is None:
            return self
        value = action._options.get(self._name, self._default)
        return parts_of(text(value, self._name)) if isinstance(value, (str, Substitution, list, tuple)) else value


class _Process(Action):
    """What programs and nodes have in common."""

    shell = _Option('shell', False)
    emulate_tty = _Option('emulate_tty', False)
    sigterm_timeout = _Option('sigterm_timeout', '5')
    sigkill_timeout = _Option('sigkill_timeout', '5')
    output = _Option('output', 'log')

    @property
    def process_details(self):
        """name, pid and cmd of the process in the event that is being handled; None before its start."""
        return self._details

    @property
    def return_code(self):
        return self._return_code

    @property
    def cmd(self):
        return self.process_description.cmd

    @property
    def name(self):
        return (self._details or {}).get('name') or self.process_description.name

    @property
    def cwd(self):
        return self.process_description.cwd

    @property
    def env(self):
        return self.process_description.env

    @property
    def additional_env(self):
        return self.process_description.additional_env

    def get_stdout(self):
        """What the process has written until now. Needs cached_output=True."""
        return self._cached('stdout')

    def get_stderr(self):
        return self._cached('stderr')

    def _cached(self, stream):
        if not self._options.get('cached_output'):
            raise RuntimeError(f'the output of {type(self).__name__} is not kept: make it with cached_output=True')
        return ''.join(self._output_lines[stream])

    def _keep_line(self, event):
        self._output_lines['stdout' if event.from_stdout else 'stderr'].append(event.text.decode(errors='replace'))

    def get_sub_entities(self):
        on_exit = self._options.get('on_exit')
        return on_exit if isinstance(on_exit, list) else []

    def prepare(self, context):
        self.process_description.prepare(context, self)

    _ARGUMENTS = ('name', 'cwd', 'env', 'additional_env', 'prefix', 'shell', 'sigterm_timeout', 'sigkill_timeout',
                  'emulate_tty', 'output', 'output_format', 'log_cmd', 'cached_output', 'on_exit', 'respawn',
                  'respawn_delay', 'respawn_max_retries', 'condition')
    # Arguments that only this launcher has, named as in XML, with "_" for "-".
    _EXTENSIONS = ('stdout', 'stderr', 'required', 'respawn_backoff', 'respawn_max_delay', 'nice', 'sched_policy',
                   'sched_priority', 'cpus', 'memory_limit', 'open_files_limit', 'trace', 'leave_running',
                   'allowed_exit_codes', 'crash_dir', 'stdin', 'start_limit', 'start_limit_interval',
                   'start_limit_cool_down', 'on_start_limit', 'sched_runtime', 'sched_deadline', 'sched_period',
                   'timer_slack', 'locked_memory_limit', 'oom_score_adj', 'memory_max', 'memory_high', 'cpu_quota',
                   'cpu_weight', 'io_weight', 'pids_max', 'scalable', 'tty', 'machine')

    _DASHED = ('leave_running', 'allowed_exit_codes', 'crash_dir')

    def _take(self, options, known=(), former=None):
        """Keeps the options of the process; `known` are the arguments that the caller handles itself."""
        options_known = (*self._ARGUMENTS, *self._EXTENSIONS, 'depends_on', 'watch')
        unknown = [name for name in options if name not in options_known]
        reject(type(self), unknown, [*options_known, *known], former)
        Action.__init__(self, condition=options.get('condition'))
        if options.get('output_format', _OUTPUT_FORMAT) != _OUTPUT_FORMAT:
            raise LaunchFileError('output_format is not supported: lines begin with the name of the process')
        self._options = options
        self._dependencies = [
            *_items('depends_on', options.get('depends_on'), self, "{'process': action, 'condition': 'exited'}"),
            *_items('watch', options.get('watch'), self, "{'kind': 'executor', 'timeout': 5}")]
        self._spoken_of = None
        self._was_read = False
        self._forget_process()

    def _forget_process(self):
        self._details = None
        self._return_code = None
        self._output_lines = {'stdout': [], 'stderr': []}

    def _process_attributes(self):
        options = self._options

        def given(name, convert):
            value = options.get(name)
            return None if value is None else convert(value, name)

        attributes = [('cwd', given('cwd', text)), ('launch-prefix', given('prefix', text)),
                      ('respawn', given('respawn', boolean)), ('respawn_delay', given('respawn_delay', number)),
                      ('respawn_max_retries', given('respawn_max_retries', number)), ('shell', given('shell', boolean)),
                      ('emulate_tty', given('emulate_tty', boolean)),
                      ('sigterm_timeout', given('sigterm_timeout', number)),
                      ('sigkill_timeout', given('sigkill_timeout', number))]
        for name in self._EXTENSIONS:
            value = options.get(name)
            if value is not None:
                convert = boolean if isinstance(value, bool) else number
                named = name.replace('_', '-') if name in self._DASHED else name
                attributes.append((named, convert(value, name)))
        if options.get('env') is not None:
            attributes.append(('clean_env', 'true'))
        return attributes + self._output() + self._on_exit() + self._when()

    def _output(self):
        output = self._options.get('output')
        if output is None:
            return []
        if not isinstance(output, dict):
            return [('output', text(output, 'output'))]
        unknown = set(output) - {'stdout', 'stderr', 'both'}
        if unknown:
            raise LaunchFileError(f'output has no stream {sorted(unknown)[0]!r}', "it has 'stdout', 'stderr' and 'both'")

        def targets(stream):
            found = []
            for given in (output.get('both', ()), output.get(stream, ())):
                found += [given] if isinstance(given, str) else given
            for target in found:
                literal(target, f"a target of {stream!r} in output")
            return ','.join(dict.fromkeys(found)) or 'none'

        return [(stream, targets(stream)) for stream in ('stdout', 'stderr')]

    def _on_exit(self):
        return [('on_exit', 'shutdown')] if self._ends_launch() else []

    def _ends_launch(self):
        from launch.actions import Shutdown
        action = self._options.get('on_exit')
        if isinstance(action, (list, tuple)) and len(action) == 1:
            action = action[0]
        return type(action) is Shutdown and action.condition is None

    def _with_handlers(self, tag, attributes, items):
        """The process, and before it the handlers for its output and its end."""
        from launch.event_handlers import OnProcessExit, OnProcessIO
        handlers = []
        if self._options.get('cached_output'):
            keeper = OnProcessIO(target_action=self, on_stdout=self._keep_line, on_stderr=self._keep_line)
            keeper._made_at = self._made_at
            handlers = keeper._tags(self._place(), [])
        on_exit = self._options.get('on_exit')
        if on_exit is not None and not self._ends_launch():
            handler = OnProcessExit(target_action=self, on_exit=on_exit)
            handler._made_at = self._made_at
            handlers += handler._tags(self._place(), [])
        self._was_read = True
        return [*handlers, entity(tag, self._place(), self._with_places([*attributes, *self._process_attributes()]),
                                  [*self._environment_items(), *self._dependencies, *items],
                                  process_name=name_of_process(self, 'the process')[0])]

    def _environment_items(self):
        place = self._place()
        return [entity('env', place, [('name', name), ('value', value)])
                for given in ('env', 'additional_env')
                for name, value in pairs(mapping(self._options.get(given), given), given)]


class ExecuteLocal(_Process):

    def __init__(self, *, process_description, **kwargs):
        if not isinstance(process_description, Executable):
            raise WrongKind(f'process_description must be an Executable, got {type(process_description).__name__}')
        self._take({**process_description._options, **kwargs}, ['process_description'])
        self.process_description = process_description

    def _tags(self):
        name = self._options.get('name')
        command = self.process_description._command
        return self._with_handlers(
            'executable', [('cmd', command), ('name', None if name is None else text(name, 'name'))], [])


class ExecuteProcess(ExecuteLocal):

    def __init__(self, *, cmd, **kwargs):
        of_executable = {name: kwargs.pop(name) for name in Executable._OPTIONS if name in kwargs}
        super().__init__(process_description=Executable(cmd=cmd, **of_executable), **kwargs)



