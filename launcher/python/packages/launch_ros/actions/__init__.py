# SPDX-License-Identifier: Apache-2.0
"""Actions for ROS nodes."""

from launch import _names
from launch_ros.actions._nodes import (
    ComposableNodeContainer, LifecycleNode, LifecycleTransition, LoadComposableNodes, Node)
from launch_ros.actions._settings import (
    PushROSNamespace, PushRosNamespace, ROSTimer, RosTimer, SetParameter, SetParametersFromFile, SetRemap, SetROSLogDir,
    SetUseSimTime)

_names.one_class_modules(__name__)
