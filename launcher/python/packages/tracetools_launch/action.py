# SPDX-License-Identifier: Apache-2.0
"""Trace: records the run with LTTng, from before the first process starts until the last one has ended."""

from collections.abc import Mapping

from launch._entities import entity
from launch._values import LaunchFileError, boolean, items, mapping, number, text, words
from launch.action import Action
from tracetools_trace.tools import names


def _attributes(given, what='a channel'):
    """The attributes of XML for these arguments; their names have hyphens there."""
    attributes = []
    for name, value in mapping(given, what):
        if isinstance(value, bool):
            value = boolean(value, name)
        elif isinstance(value, (int, float)):
            value = number(value, name)
        elif isinstance(value, (list, tuple)):
            value = words(value, name)
        else:
            value = text(value, name)
        attributes.append((name.replace('_', '-'), value))
    return attributes


class Trace(Action):
    """
    `channels` and `chains` are mappings with the attributes of <channel> and <chain>.

    Further arguments are further attributes of <trace>.
    """

    def __init__(self, *, session_name, append_timestamp=False, base_path=None, append_trace=False, events_ust=None,
                 events_kernel=None, syscalls=None, context_fields=None, subbuffer_size_ust=None,
                 subbuffer_size_kernel=None, snapshot_mode=False, dual_session=False, channels=(), chains=(),
                 **kwargs):
        options = {'condition': kwargs.pop('condition', None)}
        # The arguments left in kwargs are further attributes of <trace>, with underscores.
        super().__init__(**options)
        context_fields_kernel = kwargs.pop('context_fields_kernel', None)
        if isinstance(context_fields, Mapping):
            domains = (names.DOMAIN_TYPE_USERSPACE, names.DOMAIN_TYPE_KERNEL)
            for domain in context_fields:
                if domain not in domains:
                    raise LaunchFileError(f"context_fields has a domain '{domain}': there are {' and '.join(domains)}")
            # A domain that is not named has no context fields.
            context_fields, context_fields_kernel = (context_fields.get(domain, []) for domain in domains)

        def given(values, what):
            return None if values is None else words([values] if isinstance(values, str) else values, what)

        def asked(value, what):
            return None if value is False else boolean(value, what)

        self._attributes = [
            ('session-name', text(session_name, 'session_name')),
            ('append-timestamp', asked(append_timestamp, 'append_timestamp')),
            ('base-path', None if base_path is None else text(base_path, 'base_path')),
            ('append-trace', asked(append_trace, 'append_trace')),
            ('events-ust', given(events_ust, 'events_ust')), ('events-kernel', given(events_kernel, 'events_kernel')),
            ('syscalls', given(syscalls, 'syscalls')), ('context-fields', given(context_fields, 'context_fields')),
            ('context-fields-kernel', given(context_fields_kernel, 'context_fields_kernel')),
            ('subbuffer-size-ust', None if subbuffer_size_ust is None else number(subbuffer_size_ust,
                                                                                  'subbuffer_size_ust')),
            ('subbuffer-size-kernel', None if subbuffer_size_kernel is None else number(subbuffer_size_kernel,
                                                                                        'subbuffer_size_kernel')),
            ('snapshot-mode', asked(snapshot_mode, 'snapshot_mode')),
            ('dual-session', asked(dual_session, 'dual_session'))]
        self._attributes += _attributes(kwargs)
        self._channels = [_attributes(channel)
                          for channel in items(channels, 'channels')]
        self._chains = [_attributes(chain, 'a chain') for chain in items(chains, 'chains')]

    def _tags(self):
        place = self._place_of('channels') or self._place()
        return [entity('trace', self._place(), self._with_places([*self._attributes, *self._when()]),
                       [entity('channel', place, channel) for channel in self._channels] +
                       [entity('chain', place, chain) for chain in self._chains])]
