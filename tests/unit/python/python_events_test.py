# SPDX-License-Identifier: Apache-2.0
"""
Events and handlers of Python launch files, in launches of real processes. LAUNCH_PROGRAM is the launcher.
"""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

LAUNCH = os.environ['LAUNCH_PROGRAM']
IMPORTS = '''
import asyncio
import os
from launch import Action, BaseEventHandler, Event, EventHandler, LaunchDescription
from launch.actions import *
from launch.event_handlers import *
from launch.events import matches_action
from launch.events.process import *
from launch.substitutions import *


class Called(Event):
    name = 'called'

    def __init__(self, text):
        self.text = text


def say(text):
    return LogInfo(msg=text)


def generate_launch_description():
'''


class PythonEvents(unittest.TestCase):
    maxDiff = None

    def launch(self, body, before='', words=()):
        """What `log` actions and print() have said, in order."""
        with tempfile.TemporaryDirectory() as directory:
            path = pathlib.Path(directory) / 'system.launch.py'
            body = ''.join(f'    {line}\n' for line in body.strip('\n').split('\n'))
            path.write_text(IMPORTS.replace('\n\ndef generate', f'{before}\n\ndef generate') + body)
            done = subprocess.run([LAUNCH, *words, str(path)], capture_output=True, text=True, timeout=300,
                                  stdin=subprocess.DEVNULL,
                                  env={**os.environ, 'ROS_LOG_DIR': directory, 'HOME': directory})
        self.exit_code, self.output = done.returncode, done.stdout + done.stderr
        said = re.findall(r'^(?:\[INFO\] \[launch\.user\]: |said: )(.*)$', self.output, re.MULTILINE)
        self.assertNotIn('Traceback', self.output)
        return said

    def test_a_handler_of_the_file_gets_the_event_of_a_timer(self):
        said = self.launch('''
from launch.events import TimerEvent
timer = TimerAction(period=0.01, actions=[say('fired')])
return LaunchDescription([
    RegisterEventHandler(EventHandler(
        matcher=lambda event: isinstance(event, TimerEvent) and event.timer_action is timer,
        handle_once=True, entities=[say('told')])),
    TimerAction(period=0.05, actions=[say('another')]),
    timer,
])
''')
        self.assertEqual(sorted(said), ['another', 'fired', 'told'])
        self.assertEqual(self.exit_code, 0)

    def test_an_event_is_handled_after_the_traversal_by_the_newest_handler_first(self):
        said = self.launch('''
def is_called(event):
    return isinstance(event, Called)

return LaunchDescription([
    RegisterEventHandler(EventHandler(matcher=is_called, entities=[say('old')])),
    RegisterEventHandler(EventHandler(matcher=is_called, handle_once=True, entities=[
        OpaqueFunction(function=lambda context: [say('once ' + context.locals.event.text)])])),
    EmitEvent(event=Called('first')),
    EmitEvent(event=Called('second')),
    say('traversed'),
])''')
        self.assertEqual(said, ['traversed', 'once first', 'old', 'old'], self.output)

    def test_a_handler_of_a_class_of_the_file_gets_events_of_processes(self):
        said = self.launch('''
class Ends(BaseEventHandler):
    def matches(self, event):
        return isinstance(event, ProcessExited) and event.returncode == 3

    def handle(self, event, context):
        super().handle(event, context)
        return [say(f'{event.process_name} {event.returncode} {event.action is process}')]

process = ExecuteProcess(cmd=['sh', '-c', 'exit 3'], name='three')
return LaunchDescription([RegisterEventHandler(Ends()), process, ExecuteProcess(cmd=['true'], name='zero')])''')
        self.assertEqual(said, ['three-1 3 True'], self.output)

    def test_every_action_can_be_waited_for(self):
        said = self.launch('''
log, process = say('log'), ExecuteProcess(cmd=['true'])
timer = TimerAction(period=0.01, actions=[say('fired')])
return LaunchDescription([
    RegisterEventHandler(OnExecutionComplete(target_action=log, on_completion=[say('after log')])),
    RegisterEventHandler(OnExecutionComplete(target_action=timer, on_completion=[say('after timer'), process])),
    RegisterEventHandler(OnExecutionComplete(target_action=process, on_completion=lambda event, context: say(
        f'after process {event.action is process}'))),
    log, timer])''')
        # Which comes first, the event of the log or the timer, is a matter of how busy the machine is.
        self.assertEqual([line for line in said if 'log' in line], ['log', 'after log'], self.output)
        self.assertEqual([line for line in said if 'log' not in line], ['fired', 'after timer', 'after process True'], self.output)

    def test_a_handler_sees_what_was_set_after_it_and_what_it_sets_stays(self):
        said = self.launch('''
first, second = ExecuteProcess(cmd=['true']), ExecuteProcess(cmd=['true'])
return LaunchDescription([
    RegisterEventHandler(OnProcessExit(target_action=first, on_exit=[
        say([EnvironmentVariable('LATE'), ' ', LaunchConfiguration('late')]),
        SetLaunchConfiguration('late', 'changed'), second])),
    RegisterEventHandler(OnProcessExit(target_action=second, on_exit=[say(LaunchConfiguration('late'))])),
    SetEnvironmentVariable('LATE', 'seen'), SetLaunchConfiguration('late', 'too'), first])''')
        self.assertEqual(said, ['seen too', 'changed'], self.output)

    def test_a_function_chooses_the_processes_to_stop(self):
        said = self.launch('''
one = ExecuteProcess(cmd=['sleep', '1000'], name='one')
two = ExecuteProcess(cmd=['sleep', '1000'], name='two')
return LaunchDescription([
    RegisterEventHandler(OnProcessStart(target_action=lambda action: action is two, on_start=[
        EmitEvent(event=ShutdownProcess(process_matcher=lambda action: action is one))])),
    RegisterEventHandler(OnProcessExit(target_action=one, on_exit=[say('one'), EmitEvent(event=SignalProcess(
        signal_number='SIGTERM', process_matcher=matches_action(two)))])),
    RegisterEventHandler(OnProcessExit(
        target_action=two, on_exit=lambda event, context: say(f'two {event.returncode}'))),
    one, two])''')
        self.assertEqual(said, ['one', 'two -15'], self.output)

    def test_an_event_for_an_action_means_what_it_has_started(self):
        """Before and behind it, where its name is gone, and where its condition did not hold."""
        emit = 'EmitEvent(event=ShutdownProcess(process_matcher=matches_action({})))'
        handler = ('RegisterEventHandler(OnProcessExit(target_action={0}, on_exit=lambda event, context: '
                   'say("{0}: %s %s" % (event.process_name, event.action is {0}))))')
        said = self.launch(f'''
    def sleeper(name, condition='true'):
        return ExecuteProcess(cmd=['sleep', '100'], name=LaunchConfiguration(name), condition=IfCondition(condition))

    first, second, never = sleeper('a'), sleeper('b'), sleeper('c', 'false')
    return LaunchDescription([
        {handler.format('first')}, {emit.format('first')}, {emit.format('never')},
        GroupAction([SetLaunchConfiguration('a', 'one'), SetLaunchConfiguration('b', 'two'), first, second, never]),
        {handler.format('second')}, {emit.format('second')},
    ])
''', before='''
from launch.actions import ExecuteProcess, GroupAction, SetLaunchConfiguration
from launch.conditions import IfCondition
from launch.event_handlers import OnProcessExit
from launch.events import matches_action
from launch.events.process import ShutdownProcess
from launch.substitutions import LaunchConfiguration
''')
        self.assertEqual(sorted(said), ['first: one-1 True', 'second: two-2 True'])

    def test_handlers_are_made_and_ended_during_the_launch(self):
        said = self.launch('''
process, other = ExecuteProcess(cmd=['true']), ExecuteProcess(cmd=['true'])
never = OnProcessExit(target_action=process, on_exit=[say('never')])
neither = EventHandler(matcher=lambda event: True, entities=[say('neither')])
return LaunchDescription([
    process, RegisterEventHandler(never), RegisterEventHandler(neither), UnregisterEventHandler(never),
    UnregisterEventHandler(neither),
    OpaqueFunction(function=lambda context: [
        RegisterEventHandler(OnProcessExit(target_action=process, on_exit=[say('later')]))])])''')
        self.assertEqual(said, ['later'], self.output)

    def test_an_action_overrides_visit_and_keeps_the_launch_going(self):
        said = self.launch('''
class Visited(Action):
    def visit(self, context):
        self.future = context.asyncio_loop.create_future()
        context.add_completion_future(self.future)
        return [say('visited'), TimerAction(period=0.05, actions=[OpaqueFunction(function=self.end)])]

    def end(self, context):
        self.future.set_result(None)
        return [say('done')]

canceled = TimerAction(period=0.01, actions=[say('never')])
return LaunchDescription([Visited(), canceled, OpaqueFunction(function=lambda context: canceled.cancel())])''')
        self.assertEqual(said, ['visited', 'done'], self.output)

    def test_a_change_of_state_at_the_end_is_left_out_with_a_warning(self):
        said = self.launch('''
from launch_ros.actions import LifecycleNode
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition
node = LifecycleNode(executable='/bin/true', name='n', namespace='')
return LaunchDescription([
    RegisterEventHandler(OnShutdown(on_shutdown=[say('ends'), EmitEvent(event=ChangeState(
        lifecycle_node_matcher=lambda action: True, transition_id=Transition.TRANSITION_ACTIVE_SHUTDOWN))])),
    node])''')
        self.assertEqual(said, ['ends'], self.output)
        self.assertIn('states not changed any more, because the system ends', self.output)
        self.assertEqual(self.exit_code, 0)

    def test_a_plan_calls_no_matcher(self):
        self.launch('''
return LaunchDescription([
    RegisterEventHandler(EventHandler(matcher=lambda event: print('said: matcher'), entities=[say('never')])),
    EmitEvent(event=Called('x')), ExecuteProcess(cmd=['true'])])''', words=['--dry-run'])
        self.assertNotIn('matcher\n', self.output)
        self.assertIn('function the handlers of Called', self.output)


if __name__ == '__main__':
    unittest.main()
