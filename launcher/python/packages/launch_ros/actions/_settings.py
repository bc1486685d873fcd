# SPDX-License-Identifier: Apache-2.0
"""Actions that set something for later nodes of the scope."""

from launch._values import boolean, text
from launch.actions import TimerAction
from launch.actions._configurations import _Given, _Simple
from launch_ros._parameters import as_yaml


class PushRosNamespace(_Simple):
    namespace = _Given('namespace')

    def __init__(self, namespace, **kwargs):
        super().__init__('push_ros_namespace', [('namespace', text(namespace, 'namespace'))], **kwargs)


class PushROSNamespace(PushRosNamespace):
    pass


class SetParameter(_Simple):
    name = _Given('name')

    def __init__(self, name, value, **kwargs):
        self.value = value
        super().__init__('set_parameter', [('name', text(name, 'name')), ('value', as_yaml(value))], **kwargs)


class SetParametersFromFile(_Simple):

    def __init__(self, filename, **kwargs):
        super().__init__('set_parameters_from_file', [('filename', text(filename, 'filename'))], **kwargs)


class SetRemap(_Simple):
    src = _Given('from')
    dst = _Given('to')

    def __init__(self, src, dst, **kwargs):
        super().__init__('set_remap', [('from', text(src, 'src')), ('to', text(dst, 'dst'))], **kwargs)


class SetUseSimTime(_Simple):

    def __init__(self, value, **kwargs):
        self.value = value
        super().__init__('set_use_sim_time', [('value', boolean(value, 'value'))], **kwargs)


class SetROSLogDir(_Simple):
    log_dir = _Given('new_log_dir')

    def __init__(self, new_log_dir, **kwargs):
        super().__init__('set_ros_log_dir', [('new_log_dir', text(new_log_dir, 'new_log_dir'))], **kwargs)


class RosTimer(TimerAction):
    _tag = 'ros_timer'


class ROSTimer(RosTimer):
    pass
