# SPDX-License-Identifier: Apache-2.0
"""
Which findings a report must have, by the rules of docs/report.md ("What the findings say"), from its figures.

The figures themselves are held against the trace by the other checks.
"""

import dataclasses

MS = 1_000_000


@dataclasses.dataclass
class Candidate:
    subject: str
    measure: object = 0  # the greatest is named; all alike: any may be
    causes: tuple = ()  # callbacks: if a finding names one of them, or tells what it suffers from, this is not told once more


def period_text(period):
    for size, unit in ((1_000_000_000, 's'), (MS, 'ms'), (1000, 'us')):
        if period >= size:
            return f'{period / size:.4g} {unit}'
    return f'{period} ns'


def label(callback):
    names = {'timer': f"timer {period_text(callback.get('period_ns') or 0)}", 'subscription': f"subscription {callback.get('topic')}",
             'service': f"service {callback.get('service')}", 'client': f"client of {callback.get('service')}"}
    name = names.get(callback['owner'], f"callback {callback['address']:#x}")
    return f"{callback['node']}, {name}" if callback['node'] else name


def usual_worst(times):
    return times['p99_ns'] if times['count'] >= 500 else times['p90_ns'] if times['count'] >= 50 else times['p50_ns']


def is_frequent(count, of):
    return count >= 5 and count >= 0.01 * of


def suffers(callback):
    """Whether it waits often enough, and long enough, for another callback of its thread."""
    if not callback['held_up_by'] or not is_frequent(callback['held_up'], callback['duration']['count']):
        return False
    each = callback['held_up_ns'] // callback['held_up']
    return each >= MS and each >= 0.05 * (callback.get('period_ns') or 0)


def of_timer(callback):
    period, interval, jitter = callback['period_ns'], callback['interval'], callback['jitter']
    if jitter['count'] >= 2:
        off = usual_worst(jitter)
        if is_frequent(callback['missed'], jitter['count'] + callback['missed']) or (off >= 0.1 * period and off >= 100_000):
            yield 'worst_jitter', 0
    drift = abs(interval['p50_ns'] - period) if interval['count'] else 0
    is_late = any(is_frequent(callback.get(what, 0), interval['count']) for what in ('missed', 'overruns'))
    if interval['count'] >= 10 and not is_late and drift >= 50_000 and drift >= 0.01 * period:
        yield 'drifting_timer', min(1, drift / period)


def of_callback(callback, span):
    took, overruns = callback['duration'], callback.get('overruns', 0)
    if callback['owner'] == 'timer' and callback['period_ns']:
        yield from of_timer(callback)
    if is_frequent(overruns, took['count']) or (overruns and overruns * 4 >= took['count']):
        yield 'overrun', overruns / took['count']
    if took['count'] >= 50:
        long = took['p99_ns'] if took['count'] >= 500 else took['p90_ns']
        if long >= MS and long >= 10 * max(took['p50_ns'], 1):
            yield 'long_tail', min(10_000, long / max(took['p50_ns'], 1))
    if callback['unfinished'] >= 2:
        yield 'unfinished', callback['unfinished']
    if took['count'] >= 2 and span > 0 and took['mean_ns'] * took['count'] / span >= 0.3:
        yield 'dominating_callback', min(1, took['mean_ns'] * took['count'] / span)
    if callback.get('longest_runnable_ns', 0) >= MS:
        yield 'starved_callback', callback['longest_runnable_ns']


def of_chain(chain, callback_times):
    response = chain['response']
    if chain['budget_ns']:
        if chain['over_budget'] and response['count']:
            yield 'over_budget', (response['count'] >= 5, chain['over_budget'] / response['count'])
        return
    work = sum(step['executor']['p50_ns'] for step in chain['steps'] if step.get('executor', {}).get('count'))
    work += sum(callback_times.get((step['vpid'], f"{step['node']}, {step['callback']}"), 0) for step in chain['steps'])
    if response['count'] >= 5 and response['p50_ns'] >= 10 * MS and work >= 10 * MS:
        yield 'slowest_chain', response['p50_ns']


def chain_label(chain):
    nodes = [step['node'] or '?' for step in chain['steps']]
    between = [f'{len(nodes) - 2} more'] if len(nodes) > 3 else nodes[1:-1]
    return (f"{chain['name']}: " if chain['name'] else '') + ' -> '.join([nodes[0], *between, *nodes[-1:]] if len(nodes) > 1 else nodes)


def candidates(report):
    """By kind of finding."""
    found = {}

    def add(kind, *candidate):
        found.setdefault(kind, []).append(Candidate(*candidate))

    span = (report['end_ns'] or 0) - (report['begin_ns'] or 0)
    held_up = {}
    for callback in report['callbacks']:
        for kind, measure in of_callback(callback, span):
            add(kind, label(callback), measure, (label(callback),))
        if suffers(callback):
            held_up[callback['held_up_by']] = True
    for blocking in held_up:
        add('blocking_callback', blocking, 0, (blocking,))
    times = {(callback['vpid'], label(callback)): callback['duration'].get('p50_ns', 0) for callback in report['callbacks']}
    for chain in report['chains']:
        for kind, measure in of_chain(chain, times):
            add(kind, chain_label(chain), measure)
    for one in report['subscriptions']:
        subject, callback = f"{one['topic']} to {one['node'] or '?'}", f"{one['node']}, subscription {one['topic']}"
        dropped = sum(one[place] for place in ('not_executed', 'overwritten', 'overwritten_in_buffer', 'lost'))
        if dropped:
            add('dropped_messages', subject, (min(1, 4 * dropped / (one['delivered'] + dropped)), dropped))
        if one['executor']['count'] and usual_worst(one['executor']) >= MS:
            add('longest_wait', subject, 0, (callback,))
    for executor in report['executors']:
        if executor['callbacks'] >= 2 and (executor['utilisation'] or 0) >= 0.5:
            add('busiest_executor', str(executor['vpid']), min(1, executor['utilisation']), (executor['longest_callback'],))
    for call in report['calls']:
        unanswered = call['requests'] - call['responses'] - call['in_flight']
        if unanswered > 0:
            add('unanswered', call['service'], unanswered / call['requests'])
    for start in report['starts']:
        if (start['ready_after_ns'] or 0) >= 3_000_000_000:
            add('slowest_start', f"{start['process']} [{start['vpid']}]", start['ready_after_ns'])
    for stay in report['lifecycle']:
        if stay['state'] == 'active' and stay['allocations']:
            add('memory_in_active', stay['node'] or '?', stay['allocations'] / (stay['end_ns'] - stay['begin_ns']))
    return found


def without_hosts(report, subject):
    """Where there are several hosts, "left: /ping" for "/ping"."""
    for host in {process['host'] for process in report['processes'] if process['host']}:
        subject = subject.replace(f'{host}: ', '')
    return subject


def faults(report):
    """What is wrong with the findings of a report: sentences."""
    found = candidates(report)
    told = {finding['kind']: without_hosts(report, finding['subject']) for finding in report['findings']}
    causes = set()  # callbacks that a finding is about
    for kind, subject in told.items():
        for candidate in found.get(kind, ()):
            if subject.endswith(candidate.subject) and kind != 'busiest_executor':
                causes.update(candidate.causes)
    blocking = told.get('blocking_callback', '')
    sufferers = {label(one) for one in report['callbacks']
                 if one['held_up_by'] and blocking.endswith(one['held_up_by']) and suffers(one)}

    def is_told_elsewhere(candidate):
        return any(cause in causes or cause in sufferers for cause in candidate.causes)

    for kind, subject in told.items():
        mine = [one for one in found.get(kind, ()) if subject.endswith(one.subject) or f'[{one.subject}]' in subject]
        if not mine:
            yield f'{kind} of {subject}: no rule says so'
            continue
        for other in found[kind]:
            if other.measure > max(one.measure for one in mine) and not is_told_elsewhere(other):
                yield f'{kind} of {subject} ({mine[0].measure}), and not of {other.subject} ({other.measure})'
    for kind, ones in found.items():
        for candidate in ones:
            if kind not in told and not is_told_elsewhere(candidate):
                yield f'{kind} of {candidate.subject} ({candidate.measure}) is not told'
