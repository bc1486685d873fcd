# SPDX-License-Identifier: Apache-2.0
"""The page of a result: one file without links to others, without scripts."""

from html import escape
from pathlib import Path

from . import curves, paper, pictures, tables


def _table(head, rows, words=False):
    cells = ''.join(f'<th>{escape(text)}</th>' for text in head)
    body = ''.join('<tr>' + ''.join(f'<td>{escape(text)}</td>' for text in row) + '</tr>' for row in rows)
    top = f'<thead><tr>{cells}</tr></thead>' if any(head) else ''
    return f'<div class="scroll"><table{" class=words" if words else ""}>{top}<tbody>{body}</tbody></table></div>'


def _section(title, content, kind=''):
    return f'<section{f" class={kind}" if kind else ""}><h2>{escape(title)}</h2>{content}</section>'


def _figure(svg, caption):
    return f'<figure>{svg}<figcaption>{escape(caption)}</figcaption></figure>'


def _warnings(result):
    texts = result['warnings'] + [f"{one['step']} was not measured: {one['reason']}" for one in result['failures']]
    texts += [f"Not possible here: {one['what']}: {one['reason']}" for one in result['left_out']]
    if not texts:
        return ''
    return _section('To be known before reading', '<ul>' + ''.join(f'<li>{escape(text)}</li>' for text in texts) + '</ul>',
                    'warning')


def _experiment(experiment):
    session = experiment['session']
    about = (f"{experiment['generations']} generations of processes, {experiment['blocks']} blocks of four batches of "
             f"{experiment['batch_seconds']} s for each combination. Session: {', '.join(session['events'])}, "
             f"contexts: {', '.join(session['contexts']) or 'none'}, {session['subbuffers']} × {session['subbuffer_size']} for "
             f"each {'process' if session['buffers'] == 'pid' else 'user'} and processor. The session lost "
             f"{experiment['lost_events']} events and wrote {experiment['trace_bytes'] / 1e6:,.1f} MB.")
    parts = [_section('What tracing adds to a message, beside the paper',
                      f'<p class="faint">{escape(about)}</p>' + _table(*tables.beside_the_paper(experiment))
                      + f'<p class="faint">In brackets: intervals of 95 %. The paper: {escape(paper.TITLE)}. '
                      f'{escape(paper.SYSTEM)}. {escape(paper.PROCEDURE)}.</p>')]
    for processes in sorted((int(key) for key in experiment['aggregates']), reverse=True):
        boxes, names = pictures.latencies(experiment, processes)
        parts.append(_section(f'Latencies, {tables.where(processes)} (as figure 7 of the paper)', names
                              + '<div class="pictures">' + ''.join(map('<figure>{}</figure>'.format, boxes)) + '</div>'
                              '<p class="faint">Box: quartiles and median; dashed: mean; bars: least and most.</p>'))
        for which, title in (('overhead_of_mean', 'Added to the mean'), ('overhead_of_median', 'Added to the median')):
            lines, names = pictures.overheads(experiment, processes, which)
            parts.append(_section(f'{title}, {tables.where(processes)} (as figure 8 of the paper)', names
                                  + '<div class="pictures">' + ''.join(map('<figure>{}</figure>'.format, lines)) + '</div>'))
    parts.append(_section('All combinations together (as figure 9 of the paper)', '<div class="pictures">'
                          + _figure(pictures.aggregate(experiment), 'From each latency the untraced mean of its combination '
                                    'is subtracted. Dashed: mean.') + '</div>'))
    for processes in sorted((int(key) for key in experiment['aggregates']), reverse=True):
        parts.append(_section(f'Every combination, {tables.where(processes)} (µs)',
                              _table(*tables.combinations(experiment, processes))))
    return ''.join(parts)


def html(result):
    """The whole page."""
    style = Path(__file__).with_name('page.css').read_text()
    parts = [_warnings(result)]
    if 'experiment' in result:
        parts.append(_experiment(result['experiment']))
    for name, group in tables.groups(result).items():
        picture = curves.PICTURES.get(name, lambda figures: '')(group)
        parts.append(_section(name[0].upper() + name[1:], picture + _table(*tables.figures(group))))
    parts.append(_section('The machine', _table(*tables.machine(result), words=True)))
    return (f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Evaluation, {escape(result["written"])}</title>'
            f'<meta name="viewport" content="width=device-width"><style>{style}</style></head><body><h1>Evaluation</h1>'
            f'<p class="faint">{escape(result["written"])}, preset {escape(result["preset"])}, '
            f'{result["took_s"]:.0f} s; docs/evaluation.md explains every figure</p>{"".join(parts)}</body></html>\n')
