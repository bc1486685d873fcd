from launch import LaunchDescription
from launch.actions import ExecuteProcess, GroupAction, LogInfo, Shutdown
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_extensions import AssignMachine, Machine, OnMachineBack, OnMachineLost
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        Machine('arm', 'ssh -o BatchMode=yes arm.local', launch='/opt/launch/bin/launch',
                setup='/opt/ros/jazzy/setup.bash', keepalive=2, connect_timeout=10,
                on_disconnect='keep', keep_for=60),
        Machine('base', 'podman exec -i base', grace=1.5, condition=IfCondition('true')),
        AssignMachine('base', package='demo*', namespace='/wheels', process='left_*'),
        Node(package='demo', executable='driver', machine='arm', arguments=[FindPackageShare('demo')]),
        GroupAction([
            ExecuteProcess(cmd=['true']),
            ExecuteProcess(cmd=['false'], machine='local'),
        ], machine='base', ns='base'),
        OnMachineLost([Shutdown(reason=[LaunchConfiguration('event.machine'), ' is lost'])], machine='arm', once=True,
                      name='lost'),
        OnMachineBack([LogInfo(msg=[LaunchConfiguration('event.for'), ' ', LaunchConfiguration('event.dropped')])],
                      machine='arm'),
        OnMachineLost([LogInfo(msg=LaunchConfiguration('event.processes'))]),
    ])
