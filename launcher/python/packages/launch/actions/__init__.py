# SPDX-License-Identifier: Apache-2.0
"""Actions."""

from launch import _names
from launch.actions._configurations import (
    AppendEnvironmentVariable, DeclareBooleanLaunchArgument, DeclareLaunchArgument, PopEnvironment,
    PopLaunchConfigurations, PushEnvironment, PushLaunchConfigurations, ReplaceEnvironmentVariables, ResetEnvironment,
    ResetLaunchConfigurations, SetEnvironmentVariable, SetLaunchConfiguration, TimerAction, UnsetEnvironmentVariable,
    UnsetLaunchConfiguration)
from launch.actions._groups import (
    ForEach, ForLoop, GroupAction, IncludeLaunchDescription, Log, LogDebug, LogError, LogInfo, LogWarning,
    OpaqueCoroutine, OpaqueFunction, Shutdown)
from launch.actions._processes import ExecuteLocal, ExecuteProcess
from launch.actions._events import EmitEvent, RegisterEventHandler, UnregisterEventHandler  # noqa: I100

_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.shutdown_action')
