# SPDX-License-Identifier: Apache-2.0
"""The tables of a result as Markdown, and their place in docs/evaluation.md."""

import re

from . import compare, tables
from .results import figures_of as all_figures_of

BEGIN = '<!-- results: all -->'
END = '<!-- end of results -->'
# A mark names the groups of figures, with semicolons between them, or `all`.
_MARKS = re.compile(r'(<!-- results: (.*?) -->\n).*?(<!-- end of results -->)', re.S)


def _table(head, rows):
    head = head if any(head) else ['', *[''] * (len(rows[0]) - 1)]
    lines = ['| ' + ' | '.join(head) + ' |', '| ' + ' | '.join('---' for _ in head) + ' |']
    lines += ['| ' + ' | '.join(text.replace('|', '\\|') for text in row) + ' |' for row in rows]
    return '\n'.join(lines)


def beside_earlier(before, after):
    """What an earlier result says of the experiment, whether the intervals overlap, and which figures have changed."""
    ours, theirs = all_figures_of(before), all_figures_of(after)
    common = [name for name in ours if name in theirs and ours[name].group == 'experiment']
    overlap = [ours[name].low <= theirs[name].high and theirs[name].low <= ours[name].high for name in common]
    rows = [[ours[name].name, *(tables.with_interval(vars(one[name])) for one in (ours, theirs)), 'yes' if same else 'no']
            for name, same in zip(common, overlap) if 'Hz' not in name]
    parts = [f"### Beside an earlier run\n\nThe run of {before['written']} and this one, µs."]
    if rows:
        parts += [_table(['added to a message', 'the earlier run', 'this run', 'the intervals overlap'], rows),
                  f'Of the {len(common)} intervals of the experiment, with those of each combination, {sum(overlap)} overlap.']
    return parts + [f'```\n{compare.compare(before, after).text()}```']


def tables_of(result, earlier=None):
    """All tables of a result; with an earlier one, also what has changed since."""
    day = result['written'][:10]
    parts = [f"Preset {result['preset']}, {day}, {result['took_s']:.0f} s."]
    parts += [f'**{warning}**' for warning in result['warnings']]
    parts += [f"{one['step']} was not measured: {one['reason']}." for one in result['failures']]
    parts += [f"Not possible here: {one['what']}: {one['reason']}." for one in result['left_out']]
    parts.append(_table(*tables.machine(result)))
    if 'experiment' in result:
        experiment = result['experiment']
        parts += ['### What tracing adds to a message', _table(*tables.beside_the_paper(experiment)),
                  f"The session lost {experiment['lost_events']} events."]
        for processes in sorted((int(key) for key in experiment['aggregates']), reverse=True):
            parts += [f'### Every combination, {tables.where(processes)}', 'Times in microseconds.',
                      _table(*tables.combinations(experiment, processes))]
    parts += [f'### {name[0].upper() + name[1:]}\n\n{_table(*tables.figures(group))}'
              for name, group in tables.groups(result).items()]
    if earlier:
        parts += beside_earlier(earlier, result)
    return '\n\n'.join(parts) + '\n'


def figures_of(result, names):
    """The tables of these groups, with what a reader must know of them."""
    groups = tables.groups(result)
    parts = [f"Preset {result['preset']}, {result['written'][:10]}, {result['machine']['processors']} processors "
             f"({result['machine']['processor']})."]
    parts += [f'**{warning}**' for warning in result['warnings']]
    parts += [_table(*tables.figures(groups[name])) if name in groups else f'{name}: not measured.' for name in names]
    return '\n\n'.join(parts) + '\n'


def put_into(page, result, earlier=None):
    """The text of a page of documentation with the tables between its marks replaced; None if it has no marks."""
    def replacement(mark):
        text = tables_of(result, earlier) if mark[2] == 'all' else figures_of(result, mark[2].split('; '))
        return f'{mark[1]}\n{text}\n{mark[3]}'

    replaced, count = _MARKS.subn(replacement, page)
    return replaced if count else None
