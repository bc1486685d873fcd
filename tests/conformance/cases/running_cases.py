# SPDX-License-Identifier: Apache-2.0
"""Cases about what runs: executors, nodes, containers, traces, and the commands on the graph."""

import os
import re
import shutil
import subprocess
from pathlib import Path

from file_cases import case, expect_findings
from place import NotRun, expect, expect_in

# Of the machine's session daemon, which records the nodes of all cases: these run before the others.
ALONE = ('60', '61', '91')


def counts(text, words):
    """The numbers in the line that begins with these words."""
    line = next((line for line in text.splitlines() if line.startswith(words)), None)
    expect(line is not None, f'no line {words!r}: {text}')
    return [int(number) for number in re.findall(r'\d+', line[len(words):])]


def expect_even(text, words, count):
    """Each of the first numbers of the line is at least half of the largest."""
    numbers = counts(text, words)[:count]
    expect(len(numbers) == count and min(numbers) * 2 >= max(numbers) > 0, f'{words} {numbers}')


@case('40')
def executor_by_groups(place):
    """a program with EventsCBGExecutor compiles and runs"""
    expect_in('ticks 5', place.run(place.compile('t.cpp')))


@case('41')
def ranges_of_arrays(place):
    """the range of a descriptor holds for each value of an array"""
    text = place.run(place.compile('t.cpp'))
    expect('FAIL' not in text, text)
    outcomes = re.findall(r'(?:values|double \d|NaN): (accepted|refused)', text)
    refused, accepted = 'refused', 'accepted'
    expect(outcomes == [refused, refused, accepted, accepted, refused, accepted, refused, refused], text)


@case('44')
def turns_of_an_exclusive_group(place):
    """callbacks of one exclusive group get their turns, in each executor"""
    text = place.run(place.compile('t.cpp'))
    for executor in ('single', 'multi'):
        expect_even(text, f'{executor} timers', 2)
        expect_even(text, f'{executor} subscriptions', 3)
    text = place.run(place.compile('w.cpp'))
    for words, count in {'multi 2 threads, 2 timers:': 2, 'multi 1 thread, 2 timers:': 2, 'multi 4 threads, 4 timers:': 4,
                         'multi 4 threads, reentrant:': 3, 'events, 3 timers:': 3}.items():
        expect_even(text, words, count)
    text = place.run(place.compile('u.cpp'))
    for executor in ('single', 'multi', 'events'):
        expect(counts(text, f'{executor}:')[1] == 20, f'requests that were served: {text}')


@case('45')
def level_of_a_node(place):
    """NodeOptions give one node a log level of its own"""
    text = place.run(place.compile('t.cpp'))
    expect_in('[loud]: seen', text)
    expect('not seen' not in text, text)


@case('46')
def subscription_switched_off(place):
    """callbacks of a subscription are switched off and on"""
    off, on = counts(place.run(place.compile('t.cpp')), 'off')
    expect(off == 0 < on, f'off {off}, on {on}')


@case('50')
def decimal_commas(place):
    """a program whose locale has decimal commas reads the same numbers"""
    locale = place.own / 'de_DE.UTF-8'
    made = shutil.which('localedef') and subprocess.run(('localedef', '-i', 'de_DE', '-f', 'UTF-8', locale), check=False,
                                                        capture_output=True).returncode
    if made != 0:
        raise NotRun('localedef has no de_DE here')
    program = place.compile('t.cpp')
    text = place.run(program, '--ros-args', '--params-file', 'p.yaml', '-p', 'd:=2.5', LOCPATH=str(place.own))
    expect_in('locale de_DE.UTF-8', text)
    for line in ('a: double 1.5', 'b: double_array [0.25, 0.001]', 'c: double 0.000005'):
        expect_in(line, text)


@case('60')
def substitutions_of_trace(place):
    """attributes of a trace are substituted, and the command that is shown can be copied"""
    expect_findings(place, {}, 'a.launch.xml')
    text = place.launch('a.launch.xml')
    expect_in('none lost', text)
    command = re.search(r'what is in it: launch report (.*)', text)
    expect(command is not None, text)
    report = place.run('bash', '-c', f'launch report {command[1]}')
    expect_in('Losses     no events lost', report)
    expect(re.search(r'traces/s True-\d{14}', place.launch('a.launch.xml', 'stamp:=True')), 'no time in the name')
    expect('trace written' not in place.launch('a.launch.xml', 'on:=False'), 'a trace though it was switched off')


@case('61')
def two_traces_at_once(place):
    """two traces of one run are read as one: each process and callback once"""
    place.launch('a.launch.py')
    traces = sorted(str(path) for path in (place.own / 'traces').iterdir())
    text = place.launch('report', *traces)
    expect_in('of 2 processes', text)
    section = text.split('\nCallbacks')[1].split('\n\n')[0]
    expect(len(re.findall(r'^  /p[io]ng,', section, re.MULTILINE)) == 3, section)
    section = text.split('\nExecutors')[1].split('\n\n')[0]
    expect(len(re.findall(r'^  /p[io]ng \[', section, re.MULTILINE)) == 2, section)


@case('91')
def messages_of_the_beginning(place):
    """a topic with messages at the start of a run alone has no rate"""
    # So long that the start of all processes is short beside it.
    place.launch(place.prefix / 'share/launch_examples/01_ping_pong.launch.xml', 'count:=60')
    row = re.search(r'^  /parameter_events +(\S+)', place.launch('report', next((place.own / 'traces').iterdir())), re.MULTILINE)
    expect(row is not None and row[1] == '-', f'the rate of a burst is {row and row[0]}')


def as_nobody(place):
    if os.geteuid() != 0 or shutil.which('setpriv') is None:
        raise NotRun('only root can start a process of another user')
    home = place.own / 'nobody'
    home.mkdir()
    os.chown(home, 65534, 65534)
    return ['setpriv', '--reuid', '65534', '--regid', '65534', '--clear-groups', 'env',
            *(f'{name}={home}' for name in ('HOME', 'ROS_HOME', 'ROS_LOG_DIR', 'XDG_RUNTIME_DIR', 'TMPDIR', 'LTTNG_HOME'))]


@case('63')
def nodes_of_two_users(place):
    """nodes of root and of another user hear each other"""
    nodes = place.prefix / 'lib/demo_nodes'
    other = place.start(*as_nobody(place), nodes / 'pong')
    own = place.start(nodes / 'ping', '--ros-args', '-p', 'count:=5')
    own.wait_for('ping 5 answered')
    expect_in('pong 5', other.end())


@case('66')
def node_of_another_user(place):
    """one node of a launch that runs as another user is heard"""
    running = place.start_launch('a.launch.xml', 'as:=' + ' '.join(as_nobody(place)))
    running.wait_for('ping 5 answered', 'pong 5')
    running.end()


@case('67')
def front_end_of_a_package(place):
    """launch files for launch_frontend_py run"""
    folder = os.environ.get('LAUNCH_FRONTEND_PY')
    if not folder:
        raise NotRun('LAUNCH_FRONTEND_PY names no folder with launch_frontend_py')
    if not (Path(folder) / 'launch_frontend_py/actions.py').exists():  # later releases have one module
        file = place.folder / 'a.launch.py'
        file.write_text(file.read_text().replace('launch_frontend_py.actions', 'launch_frontend_py'))
    text = place.launch('a.launch.py', PYTHONPATH=folder)
    expect_in('hello world', text)
    expect_in('node-2', text)


@case('72')
def executors_of_a_container(place):
    """a container takes the kind of its executor, and refuses one that there is not"""
    file = place.folder / 'b.launch.xml'
    text = file.read_text()

    def start(replaced, by):
        file.write_text(re.sub(replaced, by, text))
        return place.start_launch(file)

    for option in ('--executor-type events-cbg', '--executor-type multi-threaded', '--isolated'):
        running = start('--executor-type events-cbg', option)
        running.wait_for("Loaded node '/t'")
        running.end()
    running = start(' args="[^"]*"', '')
    running.wait_for("Loaded node '/t'")
    running.end()
    file.write_text(text.replace('"component_container"', '"component_container_events_cbg"')
                    .replace(' args="--executor-type events-cbg"', ''))
    running = place.start_launch(file)
    running.wait_for("Loaded node '/t'")
    running.end()
    start('events-cbg', 'nonsense').wait_for("unknown executor 'nonsense'")


@case('74')
def node_and_component(place):
    """a parameter file means the same to a node and to a component"""
    running = place.start_launch('a.launch.xml')
    running.wait_for("Loaded node '/composed'")
    dumps = [place.launch('param', 'dump', f'/{name}').splitlines()[1:] for name in ('alone', 'composed')]
    running.end()
    expect(dumps[0] == dumps[1], f'{set(dumps[0]) ^ set(dumps[1])}')
    for line in ('a: .nan', 'd: 5.0e-06', "i: '1_000'", "n: '1:30'", "p: '5'", 'q: 3.0'):
        expect_in(f'    {line}', '\n'.join(dumps[0]))


@case('75')
def tags(place):
    """the tags of YAML give a parameter its type"""
    place.node('demo_nodes_cpp', 'parameter_blackboard', '--ros-args', '--params-file', 'p.yaml').wait_for('ready')
    for name, value in {'s': 'String value is: true', 'b': 'Boolean value is: True', 'i': 'Integer value is: 0',
                        'f': 'Double value is: 10.0', 'q': 'Integer values are: [10, 0, -10]',
                        'm.float': 'Double value is: 1.1', 'strs': "String values are: ['1', 'yes']",
                        'bin': r"Byte values are: [b'\x01', b'\x02', b'\x03']"}.items():
        expect_in(value, place.launch('param', 'get', '/parameter_blackboard', name))


@case('75b')
def text_that_is_no_number(place):
    """a text that does not fit its tag is an error; a list of one tag after another is of one type"""
    program = place.prefix / 'lib/demo_nodes_cpp/parameter_blackboard'
    expect_in("'abc' is no integer", place.run(program, '--ros-args', '--params-file', 'bad.yaml', code=None))
    file = place.own / 'list.yaml'
    file.write_text('/**: {ros__parameters: {l: [!!float 1, 2.5]}}\n')
    place.node('demo_nodes_cpp', 'parameter_blackboard', '--ros-args', '--params-file', file).wait_for('ready')
    expect_in('Double values are: [1.0, 2.5]', place.launch('param', 'get', '/parameter_blackboard', 'l'))


@case('80')
def extra_arguments(place):
    """all extra arguments of components are applied"""
    running = place.start_launch('a.launch.xml')
    running.wait_for("Loaded node '/bare'", "Loaded node '/logger'")
    services = place.launch('service', 'list')
    expect(re.search(r'^/bare/.*parameter', services, re.MULTILINE) is None, services)
    expect(len(re.findall(r'^/logger/.*logger_level', services, re.MULTILINE)) == 2, services)
    expect('Node name: bare' not in place.launch('topic', 'info', '-v', '/rosout'), 'bare has /rosout')
    running.end()
