# SPDX-License-Identifier: Apache-2.0
"""Actions on launch arguments, configurations and the environment."""

import _launch_engine
from launch._entities import entity
from launch._values import WrongKind, boolean, items, literal, mapping, number, pairs, text
from launch.action import Action
from launch.condition import Condition
from launch.substitutions import parts_of


class DeclareLaunchArgument(Action):
    _tag = 'arg'

    def __init__(self, name, *, default_value=None, description=None, choices=None, **kwargs):
        super().__init__(**kwargs)
        self.name = name
        self.choices = None if choices is None else items(choices, 'choices')
        self._name = literal(name, 'name')
        if isinstance(default_value, (bool, int, float)):
            raise WrongKind(f"default_value of '{name}' must be text, got {type(default_value).__name__}",
                            f"write '{str(default_value)}'")
        self._default = None if default_value is None else text(default_value, f"default_value of '{name}'")
        self._description = None if description is None else text(description, 'description')

    @property
    def default_value(self):
        return None if self._default is None else parts_of(self._default)

    @property
    def description(self):
        given = ''.join(part if isinstance(part, str) else part.describe()
                        for part in self._description or ('no description given',))
        return given if self.choices is None else f'{given}. Valid choices are: {self.choices}'

    def describe(self):
        return f"DeclareLaunchArgument('{self.name}')"

    def _tags(self):
        choices = [entity('choice', self._place(), [('value', literal(choice, 'a choice'))])
                   for choice in self.choices or []]
        return [entity(self._tag, self._place(),
                       self._with_places([('name', self._name), ('default', self._default),
                                          ('description', self._description), *self._when()]), choices)]


class DeclareBooleanLaunchArgument(DeclareLaunchArgument):
    """An argument that is true or false."""

    _tag = 'bool_arg'

    def __init__(self, name, *, default_value=None, **kwargs):
        if isinstance(default_value, bool):
            default_value = str(default_value)
        super().__init__(name, default_value=default_value, **kwargs)


class _Given:
    """An attribute of an action, as the list of substitutions that ROS 2 makes of it."""

    def __init__(self, attribute):
        self._attribute = attribute

    def __get__(self, action, _owner=None):
        if action is None:
            return self
        value = dict(action._content[1])[self._attribute]
        return value if isinstance(value, list) else parts_of((value,) if isinstance(value, str) else value)


class _Simple(Action):
    """An action whose attributes are known when it is made."""

    def __init__(self, tag, attributes, children=(), **kwargs):
        super().__init__(**kwargs)
        self._content = (tag, attributes, children)

    def _tags(self):
        tag, attributes, children = self._content
        place = self._place()
        return [entity(tag, place, self._with_places([*attributes, *self._when()]),
                       [entity(item, place, item_attributes) for item, item_attributes in children])]


def _named(tag, values, what):
    return [(tag, [('name', name), ('value', value)]) for name, value in pairs(values, what)]


class SetLaunchConfiguration(_Simple):
    name = _Given('name')
    value = _Given('value')

    def __init__(self, name, value, **kwargs):
        super().__init__('let', [('name', text(name, 'name')), ('value', text(value, 'value'))], **kwargs)


class UnsetLaunchConfiguration(_Simple):
    name = _Given('name')

    def __init__(self, name, **kwargs):
        super().__init__('unset', [('name', text(name, 'name'))], **kwargs)


class ResetLaunchConfigurations(_Simple):

    def __init__(self, launch_configurations=None, **kwargs):
        super().__init__('reset', [], _named('keep', mapping(launch_configurations, 'launch_configurations'),
                                             'launch_configurations'), **kwargs)


class SetEnvironmentVariable(_Simple):
    name = _Given('name')
    value = _Given('value')

    def __init__(self, name, value, **kwargs):
        super().__init__('set_env', [('name', text(name, 'name')), ('value', text(value, 'value'))], **kwargs)


class UnsetEnvironmentVariable(_Simple):
    name = _Given('name')

    def __init__(self, name, **kwargs):
        super().__init__('unset_env', [('name', text(name, 'name'))], **kwargs)


class AppendEnvironmentVariable(_Simple):
    name = _Given('name')
    value = _Given('value')
    prepend = _Given('prepend')
    separator = _Given('separator')

    def __init__(self, name, value, prepend=False, separator=':', **kwargs):
        super().__init__('append_env', [('name', text(name, 'name')), ('value', text(value, 'value')),
                                        ('prepend', boolean(prepend, 'prepend')),
                                        ('separator', text(separator, 'separator'))], **kwargs)


class ResetEnvironment(_Simple):

    def __init__(self, **kwargs):
        super().__init__('reset_env', [], **kwargs)


class ReplaceEnvironmentVariables(_Simple):

    def __init__(self, environment=None, **kwargs):
        super().__init__('rep_env', [], _named('env', mapping(environment, 'environment'), 'environment'), **kwargs)


class _IsCanceled(Condition):

    def __init__(self, timer):
        super().__init__()
        self._timer = timer

    def evaluate(self, context):
        return self._timer._is_canceled


class TimerAction(Action):

    def __init__(self, *, period, actions, name=None, cancel_on_shutdown=True, **kwargs):
        super().__init__(**kwargs)
        self._period = number(period, 'period')
        self._cancel = boolean(cancel_on_shutdown, 'cancel_on_shutdown')
        self._actions = actions
        self._is_canceled = False
        self._unless_canceled = ('unless', _IsCanceled(self), None)

    _tag = 'timer'

    @property
    def period(self):
        return parts_of((self._period,) if isinstance(self._period, str) else self._period)

    @property
    def actions(self):
        return self._actions

    def cancel(self):
        """The timer, if it has not fired, visits nothing."""
        self._is_canceled = True

    def handle(self, _context):
        return self._actions

    def describe(self):
        return f'{type(self).__name__}(period={self.period}, actions=<actions>)'

    def describe_conditional_sub_entities(self):
        return [(f'{self.period} seconds pass without being canceled', self._actions)]

    def _tags(self):
        from launch._dispatch import told_if_wanted
        from launch._entities import entities
        from launch.events import TimerEvent
        return [entity(self._tag, self._place(),
                       self._with_places([('period', self._period), ('cancel_on_shutdown', self._cancel),
                                          *self._when()]),
                       [entity('group', self._place(), [('scoped', 'false'), self._unless_canceled],
                               [told_if_wanted(TimerEvent(timer_action=self), self._place()),
                                *entities(self._actions, self._place())])])]

    # It is complete when it has fired.
    def _tell_of_completion(self, found):
        _tag, _place, _attributes, children, *_rest = found[-1]
        super()._tell_of_completion(children)


class _OfEngine(Action):
    """An action that changes the launch's state."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)

    def execute(self, context):
        self._do()


class PushEnvironment(_OfEngine):

    def _do(self):
        _launch_engine.push(True)


class PopEnvironment(_OfEngine):

    def _do(self):
        _launch_engine.pop(True)


class PushLaunchConfigurations(_OfEngine):

    def _do(self):
        _launch_engine.push(False)


class PopLaunchConfigurations(_OfEngine):

    def _do(self):
        _launch_engine.pop(False)
