from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import LifecycleNode, Node
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue


def generate_launch_description():
    rate = LaunchConfiguration('rate')
    return LaunchDescription([
        DeclareLaunchArgument('rate', default_value='10'),
        Node(
            package='demo_nodes', executable='talker', name='ear', namespace='left', exec_name='speaker',
            arguments=['-v', rate], ros_arguments=['--log-level', 'warn'],
            # A mapping is one parameter file. Here each parameter is a mapping of its own, as in the XML file.
            parameters=[
                {'rate': rate},
                {'text': '1'},
                {'scale': ParameterValue(rate, value_type=float)},
                Parameter('gains', [1.0, 2.5]),
                {'inner': {'on': True, 'names': ['a', 'b']}},
                ParameterFile('/does/not/exist.yaml'),
            ],
            remappings=[('chatter', ['/out_', rate]), ('a', 'b')],
            additional_env={'COLOUR': 'blue'}),
        LifecycleNode(package='demo_nodes', executable='listener', name='managed', namespace=''),
    ])
