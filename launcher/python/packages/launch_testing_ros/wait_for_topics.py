# SPDX-License-Identifier: Apache-2.0
"""Waits for messages. They are received by `launch topic echo`, a process for each topic."""

import signal
import subprocess
import threading
import types
from collections import deque

from launch._script import _program


def _type_name(topic_type):
    """'std_msgs/msg/String' of that text, or of a class std_msgs.msg.String."""
    if isinstance(topic_type, str):
        return topic_type
    module = getattr(topic_type, '__module__', '').split('.')
    if not isinstance(topic_type, type) or len(module) < 2:
        raise TypeError(f"the type of a topic must be a class of messages or a text such as 'std_msgs/msg/String', got "
                        f'{topic_type!r}')
    return '/'.join((*module[:2], topic_type.__name__))


def _message(value):
    """The fields of a message as attributes."""
    if isinstance(value, dict):
        return types.SimpleNamespace(**{name: _message(content) for name, content in value.items()})
    return [_message(item) for item in value] if isinstance(value, list) else value


# Runs a program until the end of standard input, so until this process closes it or has ended.
_UNTIL_END_OF_INPUT = '"$@" </dev/null & exec >&- 2>&-; read -r _; kill $!; wait $!'
_ENDED_BY_SIGTERM = 128 + 15


def _unblock_signals():
    signal.pthread_sigmask(signal.SIG_SETMASK, [])


class _Topic:
    """The messages of one topic."""

    def __init__(self, name, topic_type, length, on_message):
        try:
            import yaml
        except ModuleNotFoundError as error:
            raise RuntimeError('WaitForTopics needs the Python package yaml (Debian: python3-yaml)') from error
        self._load = yaml.safe_load
        self.messages = deque(maxlen=length)
        self.problem = None
        self._on_message = on_message
        command = [_program.find(), 'topic', 'echo', name, _type_name(topic_type), '--full-length']
        # The launcher, in which launch_test runs tests, blocks signals, and a child would inherit that.
        self._process = subprocess.Popen(['sh', '-c', _UNTIL_END_OF_INPUT, 'sh', *command], stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                         preexec_fn=_unblock_signals)
        self._errors = []
        self._readers = [threading.Thread(target=self._read, daemon=True),
                         threading.Thread(target=self._read_errors, daemon=True)]
        for reader in self._readers:
            reader.start()

    def _read_errors(self):
        self._errors += self._process.stderr

    def _read(self):
        lines = []
        for line in self._process.stdout:
            if line.rstrip('\n') == '---':
                self.messages.append(_message(self._load(''.join(lines))))
                lines = []
                self._on_message()
            else:
                lines.append(line)
        self._readers[1].join()
        self._process.stdin.close()
        if self._process.wait() not in (0, _ENDED_BY_SIGTERM):
            self.problem = ''.join(self._errors).strip()
        self._on_message()

    def end(self):
        self._process.stdin.close()
        for reader in self._readers:
            reader.join()
        self._process.wait()
        self._process.stdout.close()
        self._process.stderr.close()


class WaitForTopics:
    """
    Waits until each of the topics has had a message.

    `topic_tuples` are pairs of a topic and its type: a class of messages, or a text such as 'std_msgs/msg/String'. With
    `with` an error is raised when messages are missing after `timeout` seconds; wait() returns whether all came.
    Messages have their fields as attributes; they are no objects of the class.
    """

    def __init__(self, topic_tuples, timeout=5.0, messages_received_buffer_length=10, trigger=None):
        if trigger is not None:
            raise RuntimeError('trigger of WaitForTopics is called with a node of rclpy, which this launcher does not have; '
                               'call the function between the construction and wait()')
        self.topic_tuples = list(topic_tuples)
        self.timeout = timeout
        self.messages_received_buffer_length = messages_received_buffer_length
        self._changed = threading.Condition()
        self._topics = {}

    def _notify(self):
        with self._changed:
            self._changed.notify_all()

    def wait(self):
        """Whether all topics have had a message within the time. Raises RuntimeError for what can't be received."""
        for name, topic_type in self.topic_tuples:
            if name not in self._topics:
                self._topics[name] = _Topic(name, topic_type, self.messages_received_buffer_length, self._notify)

        def is_over():
            return not self.topics_not_received() or any(topic.problem for topic in self._topics.values())

        with self._changed:
            self._changed.wait_for(is_over, self.timeout)
        for topic in self._topics.values():
            if topic.problem:
                self.shutdown()
                raise RuntimeError(topic.problem)
        return not self.topics_not_received()

    def shutdown(self):
        """Ends the subscriptions. What was received can still be asked for."""
        for topic in self._topics.values():
            topic.end()

    def topics_received(self):
        """The topics that have had a message."""
        return {name for name, topic in self._topics.items() if topic.messages}

    def topics_not_received(self):
        return {name for name, _ in self.topic_tuples} - self.topics_received()

    def received_messages(self, topic_name):
        """The last messages of a topic, the oldest first."""
        if topic_name not in self._topics or not self._topics[topic_name].messages:
            raise KeyError(f'No messages received for topic: {topic_name}')
        return list(self._topics[topic_name].messages)

    def __enter__(self):
        if not self.wait():
            missing = self.topics_not_received()
            self.shutdown()
            raise RuntimeError('Did not receive messages on these topics: ', missing)
        return self

    def __exit__(self, _kind, _error, _trace):
        self.shutdown()
