# SPDX-License-Identifier: Apache-2.0
"""
Random trees of Python objects, each visited by an OpaqueFunction of its own (fuzz_python_objects.py).

RANDOM_OBJECTS is "FIRST COUNT PROGRESS": the seeds of the trees, and a file that gets the seed which is being tried.
"""

import inspect
import os
import pathlib
import random

import launch
import launch.actions
import launch.conditions
import launch.descriptions
import launch.event_handlers
import launch.events
import launch.events.process
import launch.frontend
import launch.launch_description_sources
import launch.substitutions
import launch_ros.actions
import launch_ros.descriptions
import launch_ros.event_handlers
import launch_ros.events.lifecycle
import launch_ros.parameter_descriptions
import launch_ros.substitutions
import tracetools_launch.action

MODULES = (launch, launch.actions, launch.conditions, launch.descriptions, launch.event_handlers, launch.events,
           launch.events.process, launch.frontend, launch.launch_description_sources, launch.substitutions,
           launch_ros.actions, launch_ros.descriptions, launch_ros.event_handlers, launch_ros.events.lifecycle,
           launch_ros.parameter_descriptions, launch_ros.substitutions, tracetools_launch.action)
# A launch service of one's own is an error; a prefix of gdb and the like is no matter here.
CLASSES = sorted({thing for module in MODULES for name, thing in vars(module).items()
                  if isinstance(thing, type) and name[0] != '_' and thing.__module__.startswith(('launch', 'tracetools'))},
                 key=lambda cls: (cls.__module__, cls.__qualname__))
ACTIONS = [cls for cls in CLASSES if issubclass(cls, launch.Action)]
SUBSTITUTIONS = [cls for cls in CLASSES if issubclass(cls, launch.Substitution)]
TEXTS = ('', 'a', 'true', 'False', '0', '1.5', '/a/b', '$(var a)', '$(', "it's", 'a b', '\n', '{a: 1}', '[1, 2]', 'ä€😀', '~',
         'x' * 5000, '\0', '\ud800', 'log', 'screen', 'shutdown', '__ns:=/x', '/*/x', '..')
NUMBERS = (0, 1, -1, 2**31, 2**63, -2**63 - 1, 2**200, 0.5, float('nan'), float('inf'), True, False)


class Strange:
    """Has a text, a number, items and a length that raise an error."""

    def __str__(self):
        raise ValueError('no text')

    __repr__ = __iter__ = __len__ = __fspath__ = __index__ = __bool__ = __eq__ = __str__

    def __hash__(self):
        return 1


class Text(str):
    pass


class OwnSubstitution(launch.Substitution):

    def __init__(self, result):
        self._result = result  # without super().__init__(), as files do

    def perform(self, context):
        return self._result() if callable(self._result) else self._result

    def describe(self):
        return self._result


class OwnAction(launch.Action):

    def __init__(self, result, **kwargs):
        super().__init__(**kwargs)
        self._result = result

    def execute(self, context):
        return self._result


class OwnVisit(launch.Action):

    def __init__(self, result):
        self._result = result

    def visit(self, context):
        return self._result


class Grower:
    """Makes a tree from a seed."""

    def __init__(self, seed):
        self._random = random.Random(seed)
        self._left = 60  # objects
        self._made = []

    def value(self, depth=0):
        choose = self._random
        self._left -= 1
        if self._left <= 0 or depth > 7:
            return choose.choice([None, 'a', 1])
        if self._made and choose.random() < 0.08:
            return choose.choice(self._made)  # an object in two places, or inside of itself
        made = choose.choices(
            [self.plain, self.container, self.object_of, self.function, self.own], [5, 3, 6, 1, 1])[0](depth + 1)
        if not isinstance(made, (str, int, float)) and made is not None:
            self._made.append(made)
        return made

    def plain(self, _depth):
        choose = self._random
        return choose.choice([None, choose.choice(TEXTS), choose.choice(TEXTS), choose.choice(NUMBERS), b'bytes', object(),
                              Strange(), Text('text'), pathlib.Path('/tmp/x'), pathlib.Path, choose.choice(CLASSES), ...])

    def container(self, depth):
        choose = self._random
        values = [self.value(depth) for _ in range(choose.randrange(4))]
        kind = choose.randrange(7)
        if kind == 0:
            return tuple(values)
        if kind == 1:
            return (value for value in values)
        if kind in (2, 3):
            return {choose.choice(['a', 'b.c', 'both', 'stdout', 'name', 1, None]): value for value in values}
        if kind == 4 and all(isinstance(value, (str, int)) for value in values):
            return set(values)
        if choose.random() < 0.05:
            values.append(values)
        return values

    def function(self, depth):
        value = self.value(depth)
        return lambda *_args, **_kwargs: value

    def own(self, depth):
        choose = self._random
        return choose.choice([OwnSubstitution, OwnAction, OwnVisit, launch.LaunchDescription])(self.value(depth))

    def object_of(self, depth):
        """An object of a class, with arguments that suit it more or less; a plain value if the class refuses them."""
        choose = self._random
        cls = choose.choice(choose.choice([ACTIONS, SUBSTITUTIONS, CLASSES]))
        parameters = [each for each in inspect.signature(cls.__init__).parameters.values()][1:]
        positional = [self.likely(each.name, depth) for each in parameters
                      if each.kind is each.POSITIONAL_OR_KEYWORD and (each.default is each.empty or choose.random() < 0.5)]
        keywords = {each.name: self.likely(each.name, depth) for each in parameters if each.kind is each.KEYWORD_ONLY
                    and (each.default is each.empty or choose.random() < 0.4)}
        if choose.random() < 0.3:
            keywords[choose.choice(['condition', 'name', 'cwd', 'env', 'output', 'on_exit', 'respawn', 'nonsense'])] = (
                self.value(depth))
        try:
            return cls(*positional, **keywords)
        except (Exception, RecursionError):  # what a launch file may catch
            return choose.choice([None, 'a', launch.substitutions.LaunchConfiguration('a', default='b')])

    def use(self, value):
        """Something to visit that holds the value."""
        choose = self._random
        if isinstance(value, (launch.Action, launch.LaunchDescription)) or choose.random() < 0.1:
            return [value]
        use = choose.randrange(6)
        if use == 0:
            return [launch.actions.LogInfo(msg=value)]
        if use == 1:
            return [launch.actions.ExecuteProcess(cmd=['/bin/true', value], additional_env={'A': value})]
        if use == 2:
            return [launch_ros.actions.Node(executable='/bin/true', name='n', parameters=[{'a': value}, value])]
        if use == 3:
            return [launch.actions.EmitEvent(event=value)]
        if use == 4:
            return [launch.actions.RegisterEventHandler(value)]
        return [launch.actions.GroupAction([value], condition=launch.conditions.IfCondition(value))]

    def likely(self, name, depth):
        choose = self._random
        if choose.random() < 0.35:
            return self.value(depth)
        if name in ('actions', 'entities', 'initial_entities', 'on_exit', 'on_start', 'on_completion', 'on_shutdown'):
            return [self.object_of(depth) for _ in range(choose.randrange(3))] if self._left > 0 else []
        if name in ('cmd', 'arguments', 'ros_arguments', 'args'):
            return [choose.choice(TEXTS), self.value(depth)]
        if name in ('parameters',):
            return [{'a': self.value(depth)}, self.value(depth)]
        if name in ('condition', 'predicate', 'matcher', 'function'):
            return choose.choice([launch.conditions.IfCondition('true'), lambda *_args: True])
        return choose.choice(TEXTS)


def generate_launch_description():
    first, count, progress = os.environ['RANDOM_OBJECTS'].split(' ', 2)

    def visited(seed):
        def function(context):
            pathlib.Path(progress).write_text(str(seed))
            grower = Grower(seed)
            tree = [grower.value() for _ in range(3)]
            for each in tree:  # what files ask of objects
                for ask in ('describe', 'get_sub_entities', 'describe_sub_entities', 'get_launch_arguments'):
                    try:
                        getattr(each, ask)()
                    except Exception:
                        pass
            # Each by itself: an error of one hides nothing of the next.
            return [launch.actions.OpaqueFunction(function=lambda context, each=each: grower.use(each)) for each in tree]
        return launch.actions.OpaqueFunction(function=function)

    return launch.LaunchDescription([visited(seed) for seed in range(int(first), int(first) + int(count))])
