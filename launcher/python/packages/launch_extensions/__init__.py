# SPDX-License-Identifier: Apache-2.0
"""Actions that ROS 2 does not have. A launch file that imports them runs with this launcher alone."""

from launch._entities import entities, entity
from launch._values import number, text
from launch.action import Action


class WaitFor(Action):
    """Visits its actions once the ROS graph shows a node (in a state), a topic or a service; <wait_for> in XML."""

    def __init__(self, actions, *, node=None, topic=None, service=None, state=None, message=False, **kwargs):
        super().__init__(**kwargs)
        self._attributes = [(name, text(value, name)) for name, value in
                            (('node', node), ('topic', topic), ('service', service), ('state', state))
                            if value is not None]
        if message:
            self._attributes.append(('condition', 'message'))
        self._actions = actions

    def get_sub_entities(self):
        return self._actions

    def _tags(self):
        return [entity('wait_for', self._place(), self._with_places([*self._attributes, *self._when()]),
                       entities(self._actions, self._place()))]


class Machine(Action):
    """
    Declares another machine, on which the actions with `machine=name` run; <machine> in XML.

    `connect` is the command that leads there, such as 'ssh robot'. `keepalive`, `connect_timeout`, `grace` and `keep_for` are
    seconds. `on_disconnect` is 'stop' or 'keep'.
    """

    def __init__(self, name, connect, *, launch=None, setup=None, keepalive=None, connect_timeout=None, on_disconnect=None,
                 grace=None, keep_for=None, **kwargs):
        super().__init__(**kwargs)
        self._attributes = [('name', text(name, 'name')), ('connect', text(connect, 'connect'))]
        self._attributes += [(given, text(value, given)) for given, value in
                             (('launch', launch), ('setup', setup), ('on_disconnect', on_disconnect)) if value is not None]
        self._attributes += [(given, number(value, given)) for given, value in
                             (('keepalive', keepalive), ('connect_timeout', connect_timeout), ('grace', grace),
                              ('keep_for', keep_for)) if value is not None]

    def _tags(self):
        return [entity('machine', self._place(), self._with_places([*self._attributes, *self._when()]))]


class AssignMachine(Action):
    """Puts processes on a machine that launch files after it start; <assign_machine> in XML. The others are patterns."""

    def __init__(self, machine, *, package=None, namespace=None, process=None, **kwargs):
        super().__init__(**kwargs)
        self._attributes = [('machine', text(machine, 'machine'))]
        self._attributes += [(name, text(value, name)) for name, value in
                             (('package', package), ('namespace', namespace), ('process', process)) if value is not None]

    def _tags(self):
        return [entity('assign_machine', self._place(), self._with_places([*self._attributes, *self._when()]))]


def _name(process):
    """The name of a process that is given by its action, or by that name."""
    from launch.actions._processes import name_of_process
    return name_of_process(process, 'process') if isinstance(process, Action) else text(process, 'process')


class _OfProcess(Action):
    """Does something to the process of an action, or to the process with a name."""

    _TAG = None

    def __init__(self, process, attributes=(), **kwargs):
        super().__init__(**kwargs)
        self._process = _name(process)
        self._attributes = list(attributes)

    def _tags(self):
        return [entity(self._TAG, self._place(), [('process', self._process), *self._attributes, *self._when()])]


class RestartProcess(_OfProcess):
    """Ends the process of an action, or the process with a name, and starts it again; <restart> in XML."""

    _TAG = 'restart'


class SetPriority(_OfProcess):
    """
    Changes how all threads of a process that runs get processors; <set_priority> in XML.

    The process is that of an action, or the one with a name.
    """

    _TAG = 'set_priority'

    def __init__(self, process, *, nice=None, sched_policy=None, sched_priority=None, cpus=None, **kwargs):
        numbers = [(name, number(value, name)) for name, value in (('nice', nice), ('sched_priority', sched_priority))
                   if value is not None]
        texts = [(name, text(value, name)) for name, value in (('sched_policy', sched_policy), ('cpus', cpus)) if value is not None]
        super().__init__(process, numbers + texts, **kwargs)


class RestorePriority(_OfProcess):
    """Gives the threads of a process what they had before SetPriority; <restore_priority> in XML."""

    _TAG = 'restore_priority'


class _OfEvent(Action):
    """A handler of an event."""

    def __init__(self, actions, *, once=False, name=None, **kwargs):
        super().__init__(**kwargs)
        self._actions = actions
        self._attributes = []
        if once:
            self._attributes.append(('once', 'true'))
        if name is not None:
            self._attributes.append(('name', text(name, 'name')))

    def get_sub_entities(self):
        return self._actions

    def _tags(self):
        return [entity(self._TAG, self._place(), self._with_places([*self._attributes, *self._when()]),
                       entities(self._actions, self._place()))]


class _OfProcess(_OfEvent):
    """A handler of an event of the process of an action, of the process with a name, or of every process."""

    def __init__(self, actions, *, process=None, **kwargs):
        from launch.actions._processes import name_of_process
        super().__init__(actions, **kwargs)
        if process is not None:
            process = name_of_process(process, 'process') if isinstance(process, Action) else text(process, 'process')
            self._attributes.insert(0, ('process', process))


class OnHealthChange(_OfProcess):
    """Visits its actions each time a process has become healthy or unhealthy; <on_health_change> in XML."""

    _TAG = 'on_health_change'

    def __init__(self, actions, *, to=None, **kwargs):
        super().__init__(actions, **kwargs)
        if to is not None:
            self._attributes.append(('to', text(to, 'to')))


class _OfMachine(_OfEvent):
    """A handler of an event of another machine, or of every other machine."""

    def __init__(self, actions, *, machine=None, **kwargs):
        super().__init__(actions, **kwargs)
        if machine is not None:
            self._attributes.append(('machine', text(machine, 'machine')))


class OnMachineLost(_OfMachine):
    """Visits its actions when the connection to another machine is lost; <on_machine_lost> in XML."""

    _TAG = 'on_machine_lost'


class OnMachineBack(_OfMachine):
    """Visits its actions when a connection to another machine that was lost is made again; <on_machine_back> in XML."""

    _TAG = 'on_machine_back'


class OnStartLimit(_OfProcess):
    """Visits its actions when a process has been started as often as its start_limit allows; <on_start_limit> in XML."""

    _TAG = 'on_start_limit'


class _OfCondition(_OfEvent):
    """A handler of a condition on what nodes do or what processes use. Times are texts such as '2s'."""

    def __init__(self, actions, attributes, *, cool_down=None, grace=None, **kwargs):
        super().__init__(actions, **kwargs)
        self._attributes[:0] = [(name, text(value, name)) for name, value in
                                (*attributes, ('cool_down', cool_down), ('grace', grace)) if value is not None]


class OnMemory(_OfCondition):
    """
    Visits its actions each time a process has too much memory; <on_memory> in XML.

    The process, of an action or with a name, has more than `above` for the time `for_`, or `growth` more than at some time in
    `window`.
    """

    _TAG = 'on_memory'

    def __init__(self, actions, *, process, above=None, growth=None, for_=None, window=None, **kwargs):
        super().__init__(actions, (('above', above), ('growth', growth), ('for', for_), ('window', window)), **kwargs)
        self._attributes.insert(0, ('process', _name(process)))


class OnOverload(_OfCondition):
    """Visits its actions each time a process uses more than `above` of a processor; <on_overload> in XML."""

    _TAG = 'on_overload'

    def __init__(self, actions, *, process, above, for_=None, **kwargs):
        super().__init__(actions, (('above', above), ('for', for_)), **kwargs)
        self._attributes.insert(0, ('process', _name(process)))


class OnSilence(_OfCondition):
    """
    Visits its actions each time a topic or a node has been silent; <on_silence> in XML.

    Nothing was published on `topic` for the time `for_`, or no callback of `node` has ended.
    """

    _TAG = 'on_silence'

    def __init__(self, actions, *, for_, topic=None, node=None, **kwargs):
        super().__init__(actions, (('topic', topic), ('node', node), ('for', for_)), **kwargs)


class OnRate(_OfCondition):
    """Visits its actions each time the rate of a topic is below or above a limit in Hz; <on_rate> in XML."""

    _TAG = 'on_rate'

    def __init__(self, actions, *, topic, below=None, above=None, window=None, **kwargs):
        super().__init__(actions, (('topic', topic), ('window', window)), **kwargs)
        self._attributes[1:1] = [(name, number(value, name)) for name, value in (('below', below), ('above', above))
                                 if value is not None]


class OnLate(_OfCondition):
    """
    Visits its actions each time something takes longer than `max`; <on_late> in XML.

    That is a message on `topic` from sending to the callback, a callback of `node`, the call of a timer of the node
    `timer`, a response of `service`, a result of `action`, or the way through the nodes of `chain`, as in '/camera -> /brake'.
    In `window`, `share` of all may not take longer.
    """

    _TAG = 'on_late'

    def __init__(self, actions, *, max, topic=None, node=None, service=None, action=None, timer=None, chain=None, share=None,
                 window=None, **kwargs):
        super().__init__(actions, (('topic', topic), ('node', node), ('service', service), ('action', action), ('timer', timer),
                                   ('chain', chain), ('max', max), ('window', window)), **kwargs)
        if share is not None:
            self._attributes.insert(0, ('share', number(share, 'share')))


class OnLoss(_OfCondition):
    """Visits its actions each time more than the share `above` of the messages on `topic` are lost; <on_loss> in XML."""

    _TAG = 'on_loss'

    def __init__(self, actions, *, topic, above=None, window=None, **kwargs):
        super().__init__(actions, (('topic', topic), ('window', window)), **kwargs)
        if above is not None:
            self._attributes.insert(0, ('above', number(above, 'above')))


__all__ = ['AssignMachine', 'Machine', 'OnHealthChange', 'OnLate', 'OnLoss', 'OnMachineBack', 'OnMachineLost', 'OnMemory', 'OnOverload',
           'OnRate', 'OnSilence', 'OnStartLimit', 'RestartProcess', 'RestorePriority', 'SetPriority', 'WaitFor']
