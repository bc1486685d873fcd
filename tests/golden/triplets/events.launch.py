import signal

from launch import LaunchDescription
from launch.actions import EmitEvent, ExecuteProcess, LogInfo, RegisterEventHandler, UnregisterEventHandler
from launch.event_handlers import OnProcessExit, OnProcessStart, OnShutdown
from launch.events import matches_action
from launch.events.process import ShutdownProcess, SignalProcess
from launch.substitutions import LaunchConfiguration
from launch_extensions import OnHealthChange, OnMemory, OnOverload, OnStartLimit, RestartProcess, WaitFor
from launch_ros.actions import LifecycleNode, LifecycleTransition, Node
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition


def generate_launch_description():
    first = ExecuteProcess(cmd=['echo', 'ready'], name='first', leave_running=True,
                           allowed_exit_codes='1, SIGTERM', crash_dir='/crashes', stdin='terminal')
    second = ExecuteProcess(cmd=['second'], output={'stdout': ['screen', 'own_log']}, env={'PATH': '/bin'},
                            required=True, nice=5)
    managed = LifecycleNode(package='demo_nodes', executable='talker', name='other', namespace='/left')
    waits = Node(package='demo_nodes', executable='listener', trace=False, depends_on=[
        {'process': first, 'condition': 'exited', 'exit_code': 0, 'timeout': 2.5}, {'service': '/left/s'}])
    watched = Node(package='demo_nodes', executable='talker', name='watched', respawn=True, start_limit=5,
                   start_limit_interval=30, start_limit_cool_down=90, watch=[
                       {'kind': 'executor', 'timeout': 2.5, 'interval': 0.5, 'on_unhealthy': 'restart'},
                       {'kind': 'output', 'pattern': '^tick', 'stream': 'stdout', 'start_period': 10, 'failures': 2},
                       {'kind': 'blocked', 'timeout': 20, 'on_unhealthy': 'signal', 'signal': 'SIGQUIT'},
                       {'kind': 'command', 'cmd': "check 'a b'", 'on_unhealthy': 'shutdown'}])
    on_transition = OnStateTransition(
        target_lifecycle_node=managed, start_state='configuring', goal_state='inactive', handle_once=True,
        entities=[EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_action(managed),
                                              transition_id=Transition.TRANSITION_ACTIVATE))])
    return LaunchDescription([
        first,
        second,
        RegisterEventHandler(OnProcessStart(target_action=first, on_start=[LogInfo(msg='started')])),
        RegisterEventHandler(OnProcessExit(
            target_action=first, handle_once=True,
            on_exit=[ExecuteProcess(cmd=['third']), LogInfo(msg='over')])),
        RegisterEventHandler(OnProcessExit(on_exit=[
            EmitEvent(event=ShutdownProcess(process_matcher=matches_action(second))),
            EmitEvent(event=SignalProcess(process_matcher=matches_action(second), signal_number=signal.SIGUSR1)),
        ])),
        RegisterEventHandler(OnShutdown(on_shutdown=LogInfo(msg='good bye'))),
        Node(package='demo_nodes', executable='talker', name='managed', namespace='/left'),
        LifecycleTransition(lifecycle_node_names=['/left/managed'], transition_ids=[
            Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE]),
        managed,
        RegisterEventHandler(on_transition),
        RegisterEventHandler(OnStateTransition(target_lifecycle_node=managed, transition='shutdown',
                                               entities=[UnregisterEventHandler(on_transition)])),
        waits,
        WaitFor([RestartProcess(waits)], topic='/scan', message=True),
        watched,
        ExecuteProcess(cmd=['behind'], respawn=True, start_limit=3, on_start_limit='shutdown',
                       depends_on={'process': watched, 'condition': 'healthy'}),
        OnHealthChange([LogInfo(msg='unhealthy')], process=watched, to='unhealthy', once=True),
        OnStartLimit([LogInfo(msg='given up')], process=watched),
        OnMemory([RestartProcess(watched)], process=watched, above='512M', for_='10s', cool_down='1min'),
        OnMemory([LogInfo(msg=LaunchConfiguration('event.growth'))], process=watched, growth='50M', window='5min', once=True),
        OnOverload([LogInfo(msg=LaunchConfiguration('event.share'))], process=watched, above='90%', name='busy'),
    ])
