# SPDX-License-Identifier: Apache-2.0
"""The case about the newest options of the commands on the graph."""

import re

from file_cases import case
from place import expect, expect_in


def listens(place, *words):
    """The output of a command that goes on until it is stopped, from its first table or number on."""
    running = place.start_launch(*words)
    text = running.wait_for('/chatter', 'window' if 'hz' in words else 'mean')
    running.end()
    return text


@case('70')
def newest_options(place):
    """the commands on the graph have the newest options of ros2"""
    place.node('demo_nodes_cpp', 'parameter_blackboard', '--ros-args', '-p', 'a:=1', '-p', 'b:=2.5').wait_for('ready')
    place.node('demo_nodes_cpp', 'talker').wait_for('Publishing')
    place.node('demo_nodes_cpp', 'add_two_ints_server')
    place.until(lambda: place.launch('node', 'list'), lambda text: '/add_two_ints_server' in text, 'no server')
    parameters_of(place)
    topics_of(place)
    services_of(place)


def parameters_of(place):
    text = place.launch('param', 'get', 'use_sim_time')
    for node in ('/add_two_ints_server:', '/parameter_blackboard:', '/talker:'):
        expect_in(node, text)
    expect(place.launch('param', 'get', '/parameter_blackboard', 'a', 'b') ==
           'a:\n  Integer value is: 1\nb:\n  Double value is: 2.5\n', 'param get of two')
    expect(place.launch('param', 'set', '/parameter_blackboard', 'a', '5', 'b', '7.5') ==
           'a: Set parameter successful\nb: Set parameter successful\n', 'param set of two')
    text = place.launch('param', 'list', '--timeout', '10')
    for node in ('/add_two_ints_server:', '/parameter_blackboard:', '/talker:'):
        expect_in(node, text)
    expect_in('\n  a\n  b\n', text)


def topics_of(place):
    for words in (('hz', '--all'), ('hz', '/chatter', '/rosout'), ('bw', '--all'), ('bw', '/chatter', '/rosout')):
        text = listens(place, 'topic', *words)
        expect_in('Subscribed to [/rosout]', text)
        expect(re.search(r'^ *topic +.*\n=+\n', text, re.MULTILINE), f'no table: {text}')
    file = place.own / 'messages.yaml'
    file.write_text('data: one\n---\ndata: two\n')
    echo = place.start_launch('topic', 'echo', '/words', 'std_msgs/msg/String')
    place.launch('topic', 'pub', '--yaml-file', file, '--times', '2', '/words', 'std_msgs/msg/String')
    echo.wait_for("data: one\n---", "data: two\n---")


def services_of(place):
    text = place.launch('service', 'info', '--verbose', '/add_two_ints')
    expect(re.search(r'^Service type hash: RIHS01_[0-9a-f]{64}$', text, re.MULTILINE), text)
    for part in ('- Request Reader : ', '- Response Writer : '):
        expect_in(part, text)
    expect_in('sum=3', place.launch('service', 'call', '/add_two_ints', 'example_interfaces/srv/AddTwoInts', '{a: 1, b: 2}',
                                    '--qos-reliability', 'reliable'))
