# SPDX-License-Identifier: Apache-2.0
"""Write tracetools_trace/tools/tracepoints.py from the declaration of the events.

Usage: write_tracepoints.py event_table.h tracepoints.py
"""

import re
import sys


def read_events(table):
    """Return name and group of each event of provider ros2."""
    rows = re.search(r'#define TRACETOOLS_EVENT_TABLE\(.*?\n\n', table, re.DOTALL).group()
    events = re.findall(r'^  EVENT\(given, (\w+), \w+, (\w+),', rows, re.MULTILINE)
    if not events or len(events) != rows.count('EVENT(given, '):
        sys.exit('a row of the table of events does not read "  EVENT(given, name, Struct, group, field...)"')
    return events


def main():
    table, output = sys.argv[1:]
    with open(table, encoding='utf-8') as file:
        events = read_events(file.read())
    lines = ['# SPDX-License-Identifier: Apache-2.0', '"""The userspace events of ROS 2\'s instrumentation."""', '']
    lines += [f"{name} = 'ros2:{name}'" for name, _ in events]
    for variable, names in (('_all', [name for name, _ in events]),
                            ('_initialisation', [name for name, group in events if group == 'init'])):
        lines += ['', f'{variable} = [', *(f'    {name},' for name in names), ']']
    with open(output, 'w', encoding='utf-8') as file:
        file.write('\n'.join(lines) + '\n')


main()
