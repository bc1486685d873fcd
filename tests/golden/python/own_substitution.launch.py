from launch import LaunchDescription, Substitution
from launch.actions import LogInfo


class Answer(Substitution):
    def perform(self, context):
        return 42


def generate_launch_description():
    return LaunchDescription([LogInfo(msg=['answer ', Answer()])])
