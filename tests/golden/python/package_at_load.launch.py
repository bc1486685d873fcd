from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription


def generate_launch_description():
    share = get_package_share_directory('no_such_package')
    return LaunchDescription([share])
