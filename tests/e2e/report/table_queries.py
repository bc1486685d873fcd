# SPDX-License-Identifier: Apache-2.0
"""The tables of sums, of objects and of the machine that `launch report --sql` writes, as rows that the own computation gives, too."""


def parts(*names):
    """Number, sum, smallest and largest of distributions."""
    return ', '.join(f'{name}_count, CAST(round(coalesce({name}_mean_ns, 0) * {name}_count) AS INTEGER), {name}_min_ns, {name}_max_ns'
                     for name in names)


def of_process(table, column='process'):
    return f'JOIN processes ON {table}.{column} = processes.id'


def quality(table, filtered):
    return f"""SELECT '{table[:-1]}', processes.vpid, topics.name, reliable, history_depth, {filtered} FROM {table}
      JOIN topics ON topic = topics.id LEFT JOIN nodes ON {table}.node = nodes.id LEFT JOIN processes ON nodes.process = processes.id"""


DELIVERIES = {
    'subscription_statistics': f'''SELECT processes.vpid, node, topic, received, intra_process, delivered, not_executed, overwritten,
      overwritten_in_buffer, lost, lost_by_publisher, lost_in_transport, filtered, before_first, after_last
      FROM subscription_statistics {of_process("subscription_statistics")}''',
    'topic_statistics': '''SELECT name, publishers, subscriptions, published, received, published_only, received_only,
      intra_process_published, intra_process_received FROM topic_statistics''',
    'quality': quality('publishers', 'NULL') + ' UNION ALL ' + quality('subscriptions', 'filtered'),
}
SERVED = {
    'callbacks': f'''SELECT vpid, address, kind, nodes.name, CASE kind WHEN 'subscription' THEN topics.name WHEN 'timer' THEN period_ns
      ELSE service END FROM callbacks {of_process("callbacks")} LEFT JOIN nodes ON node = nodes.id LEFT JOIN topics ON topic = topics.id
      WHERE kind NOT IN ('client', 'unknown') AND callbacks.id IN (SELECT callback FROM callback_instances)''',
    'node_statistics': f'''SELECT vpid, node_statistics.name, callbacks, callback_ns
      FROM node_statistics {of_process("node_statistics")}''',
    'call_statistics': f'''SELECT clients.vpid, nullif(client, ''), servers.vpid, nullif(server, ''), service, requests, responses,
      {parts("round_trip", "request", "in_service", "response")} FROM call_statistics
      LEFT JOIN processes AS clients ON client_process = clients.id LEFT JOIN processes AS servers ON server_process = servers.id''',
    'actions': f'''SELECT actions.name, vpid, client, goals, answers, results, cancels, feedback, {parts("acceptance", "execution")}
      FROM actions {of_process("actions", "client_process")}''',
    'execution_statistics': f'''SELECT vpid, node, kind, service, count, {parts("duration")}
      FROM execution_statistics {of_process("execution_statistics")}''',
    'lifecycle_statistics': f'''SELECT vpid, node, state, begin_ns, end_ns
      FROM lifecycle_statistics {of_process("lifecycle_statistics")}''',
}
MACHINES = {
    'trace': 'SELECT begin_ns, end_ns, events FROM trace',
    'hosts': 'SELECT name, processes FROM hosts',
    'processes': 'SELECT vpid, name, host, events FROM processes',
    'threads': f'SELECT vpid, vtid FROM threads {of_process("threads")}',
    'losses': 'SELECT coalesce(sum(events), 0), coalesce(sum(packets), 0) FROM losses',
    'tracing_cost': 'SELECT vpid, events FROM tracing_cost',
    'starts': '''SELECT vpid, process, file, line, exec_ns - spawn_ns, exec_ns + init_after_ns, exec_ns + node_after_ns,
      exec_ns + ready_after_ns, exec_ns + callback_after_ns, exec_ns + publication_after_ns FROM starts''',
    'launcher_events': 'SELECT time_ns, kind, subject, what, file, line FROM launcher_events',
    'allocations': '''SELECT vpid, address, start_ns, allocations, allocated_bytes FROM allocations
      JOIN callback_instances ON callback_instance = callback_instances.id
      JOIN callbacks ON callback = callbacks.id JOIN processes ON process = processes.id''',
}
# Where the first column tells the process.
OF_ONE_PROCESS = ('subscription_statistics', 'callbacks', 'node_statistics', 'execution_statistics', 'lifecycle_statistics')
