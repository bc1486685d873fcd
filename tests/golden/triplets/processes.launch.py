from launch import LaunchDescription
from launch.actions import ExecuteLocal, ExecuteProcess, SetLaunchConfiguration, Shutdown
from launch.conditions import IfCondition, UnlessCondition
from launch.descriptions import Executable
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('word', 'two words'),
        ExecuteLocal(
            process_description=Executable(
                cmd=['echo', 'one', '--x=a b', LaunchConfiguration('word')], name='greeter', cwd='/tmp',
                prefix='nice -n 5', additional_env={'COLOUR': 'blue'}),
            output='screen'),
        ExecuteProcess(cmd=['echo', '$HOME', '|', 'cat'], shell=True, respawn=True, respawn_delay=2.5,
                       respawn_max_retries=3),
        ExecuteProcess(cmd=['true'], on_exit=Shutdown(), emulate_tty=True, tty=True, sigterm_timeout='1', sigkill_timeout=2,
                       condition=IfCondition('1')),
        ExecuteProcess(cmd=['false'], condition=UnlessCondition('true')),
    ])
