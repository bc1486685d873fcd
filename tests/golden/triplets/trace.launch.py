from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration
from launch_extensions import OnLate, OnLoss, OnRate, OnSilence, RestartProcess, RestorePriority, SetPriority
from launch_ros.actions import Node
from tracetools_launch.action import Trace


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('name', default_value='run'),
        Trace(
            session_name=LaunchConfiguration('name'), base_path='/traces', append_trace=True,
            events_ust=['ros2:*', 'dds:* except dds:b'], events_kernel=['sched_switch'], syscalls=['open'],
            context_fields=['vpid'], subbuffer_size_ust=65536, subbuffer_size_kernel=262144, subbuffer_count_ust=4,
            fail_on_loss=True, report=True),
        Trace(session_name='black_box', snapshot_mode=True, base_path='/traces', events_python=['planner:*', 'costs level ERR'],
              tracetools='theirs'),
        Trace(session_name='channels', base_path='/traces', events_ust=['ros2:rcl_init'], channels=[
            {'name': 'callbacks', 'events_ust': ['ros2:callback_*'], 'context_fields': ['vtid'],
             'subbuffer_size': 65536, 'overwrite': True}], chains=[
            {'name': 'reaction', 'nodes': ['/talker', '/listener*'], 'budget': 12.5}]),
        Node(package='demo_nodes', executable='talker'),
        OnSilence([RestartProcess('talker')], topic='/chatter', for_='2s', cool_down='30s', name='chatter'),
        OnSilence([LogInfo(msg=LaunchConfiguration('event.process'))], node='/talker', for_='500ms', once=True),
        OnRate([LogInfo(msg=LaunchConfiguration('event.rate'))], topic='/chatter', below=5, window='2s', grace='1min'),
        OnRate([LogInfo(msg=LaunchConfiguration('event.above'))], topic='/chatter', above=20.5),
        OnLate([LogInfo(msg=LaunchConfiguration('event.took'))], topic='/chatter', max='20ms', share=0.99, window='5s'),
        OnLate([LogInfo(msg=LaunchConfiguration('event.max'))], node='/talker', max='1.5s', name='slow'),
        OnLate([LogInfo(msg=LaunchConfiguration('event.share'))], service='/plan', max='500us', once=True),
        OnLate([LogInfo(msg=LaunchConfiguration('event.action'))], action='/drive', max='30s'),
        OnLate([SetPriority('talker', nice=5, cpus='0')], timer='/talker', max='5ms'),
        OnLate([SetPriority('talker', sched_policy='rr', sched_priority=1)], chain='/talker -> listener -> *', max='50ms', share=0.9),
        OnLoss([RestorePriority('talker')], topic='/chatter', above=0.01, window='10s'),
    ])
