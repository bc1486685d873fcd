from launch import LaunchDescription

description = LaunchDescription([])
