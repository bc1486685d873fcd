# SPDX-License-Identifier: Apache-2.0
"""
The reference engine, from the packages on PYTHONPATH: says what a launch file would start, or runs it.

    reference_engine.py arguments FILE              the arguments that it requires, as JSON
    reference_engine.py record FILE [NAME:=VALUE …]  what it would start, as a record of `compare`; nothing is started
    reference_engine.py run FILE [NAME:=VALUE …]     runs it, as `ros2 launch` does
"""

import asyncio
import itertools
import json
import os
import sys

import stand_ins

stand_ins.install()
BEFORE = dict(os.environ)

import launch  # noqa: E402
import launch.actions.execute_local as execute_local  # noqa: E402
import yaml  # noqa: E402

QUIET = 0.3  # seconds without a new process, action or timer: everything is visited
record = {'outcome': 'ok', 'exception': None, 'message': None, 'processes': [], 'composable': [], 'logs': [], 'shutdown': False}


class Transport:
    """Of a process that has not started, and does not end."""

    numbers = itertools.count(100000)

    def __init__(self):
        self.number = next(self.numbers)

    def get_pid(self):
        return self.number

    def close(self):
        pass

    send_signal = terminate = kill = get_pipe_transport = get_returncode = lambda self, *_: None


async def note_process(protocol_class, cmd=None, cwd=None, env=None, shell=False, **_):
    """In place of async_execute_process()."""
    environment = dict(os.environ if env is None else env)
    changes = {name: environment.get(name) for name in environment.keys() | BEFORE.keys() if environment.get(name) != BEFORE.get(name)}
    protocol = protocol_class()
    argv, params = [], []
    for word in cmd if isinstance(cmd, (list, tuple)) else [cmd]:
        is_parameters = argv[-1:] == ['--params-file'] and os.path.isfile(word) and os.path.basename(word).startswith('launch_params_')
        if is_parameters:
            with open(word, encoding='utf-8') as file:
                params.append(yaml.safe_load(file))
            word = f'@params:{len(params) - 1}'
        argv.append(word)
    record['processes'].append({'name': '', 'argv': argv, 'params': params, 'cwd': cwd, 'env': changes, 'shell': bool(shell)})
    transport = Transport()
    protocol.connection_made(transport)
    name = protocol._ProcessProtocol__process_event_args['name']
    record['processes'][-1]['name'] = name.rpartition('-')[0] or name
    return transport, protocol


def patch():
    execute_local.async_execute_process = note_process

    async def fire_at_once(self, context):
        await asyncio.sleep(0)
        if not self._canceled_future.done():
            await context.emit_event(launch.actions.timer_action.TimerEvent(timer_action=self))
        self._completed_future.set_result(None)
    launch.actions.TimerAction._wait_to_fire_event = fire_at_once
    try:
        from launch_ros.actions import load_composable_nodes as loading
    except ImportError:
        return

    def note_nodes(self, requests, context):
        record['composable'].append({'target': self._LoadComposableNodes__final_target_container_name,
                                     'nodes': [stand_ins.load_request(request) for request in requests]})
    loading.LoadComposableNodes._load_in_sequence = note_nodes
    for name, module in list(sys.modules.items()):
        if name.startswith('launch_ros') and hasattr(module, 'get_ros_node'):
            module.get_ros_node = lambda context: stand_ins.SilentNode()


def description_of(path):
    from launch.launch_description_sources import AnyLaunchDescriptionSource
    return launch.LaunchDescription([launch.actions.IncludeLaunchDescription(AnyLaunchDescriptionSource(path),
                                                                             launch_arguments=arguments_of(sys.argv[3:]))])


def arguments_of(words):
    return [tuple(word.split(':=', 1)) for word in words]


def finish():
    sys.stdout.flush()
    os.write(REAL_OUTPUT, (json.dumps(record, default=str) + '\n').encode())
    os._exit(0)


async def watch():
    """Ends the process when nothing new has come for a while. Time in which the engine reads a file does not count, because it blocks the loop."""
    before = None
    while True:
        await asyncio.sleep(QUIET)
        now = (len(record['processes']), len(record['composable']), len(asyncio.all_tasks()))
        if now == before:
            finish()
        before = now


def start_watch(context):
    context.asyncio_loop.create_task(watch())


def do_record(path):
    patch()
    class Errors(launch.logging.logging.Handler):
        def emit(self, one):
            if one.levelno >= launch.logging.logging.ERROR and 'Caught exception in launch' in one.getMessage():
                record.update(outcome='visit-error', message=one.getMessage())
    launch.logging.get_logger('launch').addHandler(Errors())
    service = launch.LaunchService(noninteractive=True)
    service.include_launch_description(launch.LaunchDescription([launch.actions.OpaqueFunction(function=start_watch)]))
    service.include_launch_description(description_of(path))
    service.run(shutdown_when_idle=True)
    finish()


def main():
    global REAL_OUTPUT
    REAL_OUTPUT = os.dup(1)
    command, path = sys.argv[1], os.path.abspath(sys.argv[2])
    if command == 'run':
        os.dup2(REAL_OUTPUT, 1)
        service = launch.LaunchService(noninteractive=True)
        service.include_launch_description(description_of(path))
        sys.exit(service.run())
    os.dup2(2, 1)  # what launch files print
    try:
        if command == 'arguments':
            from launch.launch_description_sources import AnyLaunchDescriptionSource
            found = AnyLaunchDescriptionSource(path).get_launch_description(launch.LaunchContext()).get_launch_arguments()
            record.clear()
            record.update({one.name: (one.choices or [f'x_{one.name}'])[0] for one in found if one.default_value is None})
            finish()
        do_record(path)
    except Exception as error:  # of any kind: a file is a program
        record.update(outcome='load-error', exception=type(error).__name__, message=str(error)[-300:])
        finish()


main()
