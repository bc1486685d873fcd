# SPDX-License-Identifier: Apache-2.0
"""The transitions of a managed life cycle that a launch file can ask for, by their names."""

from launch._values import LaunchFileError
from lifecycle_msgs.msg import Transition

NAMES = {Transition.TRANSITION_CONFIGURE: 'configure', Transition.TRANSITION_CLEANUP: 'cleanup',
         Transition.TRANSITION_ACTIVATE: 'activate', Transition.TRANSITION_DEACTIVATE: 'deactivate',
         Transition.TRANSITION_UNCONFIGURED_SHUTDOWN: 'shutdown', Transition.TRANSITION_INACTIVE_SHUTDOWN: 'shutdown',
         Transition.TRANSITION_ACTIVE_SHUTDOWN: 'shutdown'}


def name_of_transition(transition_id):
    if transition_id not in NAMES:
        raise LaunchFileError(f'a launch file can\'t ask for the transition {transition_id!r}')
    return NAMES[transition_id]
