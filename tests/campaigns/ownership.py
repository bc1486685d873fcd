# SPDX-License-Identifier: Apache-2.0
"""
Launches of processes that are hard to find or to end (daemons without environment, processes whose main thread has ended,
that nobody may look into, that start themselves again and again, trees of all of them, launches in launches), ended in
random ways: Ctrl-C, and launcher, guardian and spare guardian stopped and killed, one or two of them, at any moment.
Nothing is left. What is left when all three are killed at once is counted apart. Every other run is contained: there
nothing is left in any case.
"""

import ctypes
import os
import signal
import subprocess
import time
from pathlib import Path
from xml.sax.saxutils import quoteattr

from .campaign import Outcome

RUNS = 240
PR_SET_CHILD_SUBREAPER = 36
PATIENCE = 60.0  # seconds until everything has ended
SHAPES = ('leaderless', 'hidden', 'empty', 'tracer', 'endless', 'leaderless-daemon', 'hidden-daemon', 'empty-daemon',
          'tree', 'launch')
# What happens to guardian (G), spare (S) and launcher (L), one after the other. A pause between two steps has a random
# length. In the last way all three are killed.
WAYS = {
    'Ctrl-C': ('INT G',),
    'Ctrl-C three times': ('INT G', 'wait 1.1', 'INT G', 'wait 1.1', 'INT G'),
    'L': ('KILL L',),
    'G': ('KILL G',),
    'S': ('KILL S', 'wait 0.2', 'INT G'),
    'G, L': ('KILL G', 'pause', 'KILL L'),
    'L, G': ('KILL L', 'pause', 'KILL G'),
    'L, S': ('KILL L', 'pause', 'KILL S'),
    'S, L': ('KILL S', 'pause', 'KILL L'),
    'G, S': ('KILL G', 'pause', 'KILL S'),
    'S, G': ('KILL S', 'pause', 'KILL G'),
    'the group': ('KILL group',),
    'L stopped': ('STOP L', 'wait 0.1', 'TERM G'),
    'S stopped; L, G': ('STOP S', 'wait 0.3', 'KILL L', 'pause', 'KILL G'),
    'G stopped; S, L': ('STOP G', 'wait 2', 'KILL S', 'pause', 'KILL L'),
    'all three': ('KILL G', 'KILL S', 'KILL L'),
}
# Of a contained launch also the process outside (O) and the first of the namespace (F).
CONTAINED_WAYS = {
    'O': ('KILL O',),
    'F': ('KILL F',),
    'O, F': ('KILL O', 'pause', 'KILL F'),
    'O stopped; F': ('STOP O', 'KILL F', 'CONT O'),
    'F stopped; G, S, L': ('STOP F', 'KILL G', 'KILL S', 'KILL L'),
    'all five': ('KILL O', 'KILL G', 'KILL S', 'KILL L', 'KILL F'),
}


def runs(place, random, count):
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    apart = [(way, False) for way in WAYS]
    contained = [(way, True) for way in WAYS | CONTAINED_WAYS]
    random.shuffle(contained)
    for number in range(count):
        kind = contained if number % 2 else apart
        yield run(place, random, *kind[number // 2 % len(kind)])


def run(place, random, way, contained):
    place.end_daemons()
    place.run += 1
    place.path().mkdir()
    before = processes()
    # Nobody can end a launcher that one of its processes traces when both guardians have gone.
    possible = [shape for shape in SHAPES if shape != 'tracer' or way not in ('G, S', 'S, G')]
    shapes = [random.choice(possible) for _ in range(random.randint(1, 4))]
    with place.path('launch.log').open('wb') as log:
        words = ('--contain',) if contained else ()
        process = subprocess.Popen((place.program, *words, launch_file(place, random, shapes)), stdout=log, stderr=log,
                                   start_new_session=True)
    chain = wait_for_start(process.pid, contained)
    time.sleep(random.choice((0.0, random.uniform(0, 0.3), 0.5, 1.0)))
    strike((WAYS | CONTAINED_WAYS)[way], chain, random)
    begin = time.monotonic()
    left = set()
    may_leave = way == 'all three' and not contained
    while time.monotonic() - begin < (2 if may_leave else PATIENCE):
        reap()
        left = processes() - before
        if not left:
            break
        time.sleep(0.02)
    outcome = Outcome(f'killed: {way}' + (', contained' if contained else ''), numbers={'end took s': time.monotonic() - begin})
    if left:
        named = sorted(f'{name(pid)} ({pid})' for pid in left)
        if may_leave:
            outcome.result += ', something is left'
        else:
            outcome.wrong.append(f'{way}, {shapes}: left {", ".join(named)}')
            outcome.wrong.append(place.path('launch.log').read_text(encoding='utf-8', errors='replace')[-2000:])
    end(before)
    process.wait()
    return outcome


def end(before):
    """Some start themselves again and again, so one round is not enough."""
    until = time.monotonic() + PATIENCE
    while (left := processes() - before) and time.monotonic() < until:
        for pid in sorted(left, reverse=True):
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        reap()


def launch_file(place, random, shapes):
    process = place.build / 'tests/unit/process/hostile_process'
    tree = place.build / 'tests/e2e/supervision/random_tree'
    lines = []
    for number, shape in enumerate(shapes):
        command = f'{process} {shape}'
        if shape == 'tree':
            command = f'{tree} {random.randrange(100000)}'
        elif shape == 'tracer':
            command = f'sh -c "(sleep 0.3; kill -USR2 $$) & exec {process} tracer"'
        elif shape == 'launch':
            inner = place.path(f'inner-{number}.launch.xml')
            inner.write_text(f'<launch><executable cmd="{process} {random.choice(SHAPES[:8])}" sigterm_timeout="0.1" '
                             'sigkill_timeout="0.1"/></launch>')
            command = f'{place.program} {inner}'
        timeout = random.choice((0.05, 0.3))
        lines.append(f'<executable cmd={quoteattr(command)} name="x" sigterm_timeout="{timeout}" '
                     f'sigkill_timeout="{timeout}"/>')
    path = place.path('system.launch.xml')
    path.write_text('<launch>\n' + '\n'.join(lines) + '\n</launch>\n', encoding='utf-8')
    return path


def strike(steps, pids, random):
    for step in steps:
        what, _, whom = step.partition(' ')
        if what == 'wait':
            time.sleep(float(whom))
        elif what == 'pause':
            time.sleep(random.choice((0.0, 0.0, random.uniform(0, 0.003), random.uniform(0, 0.3))))
        else:
            number = signal.Signals[f'SIG{what}']
            try:
                if whom == 'group':
                    os.killpg(pids.get('O', pids['G']), number)
                elif pids[whom] > 0:
                    os.kill(pids[whom], number)
            except ProcessLookupError:
                pass


def wait_for_start(started, contained):
    """The process that was started, then by their letters; 0 for what has ended already."""
    letters = 'OFGSL' if contained else 'GSL'
    until = time.monotonic() + PATIENCE
    while time.monotonic() < until:
        chain = {letters[0]: started}
        for letter in letters[1:]:
            chain[letter] = first_child(list(chain.values())[-1]) if list(chain.values())[-1] else 0
        if chain['L'] and name(chain['S']) == 'guardian-spare':
            return chain
        time.sleep(0.001)
    return chain | dict.fromkeys(letters[1:], 0)


def first_child(parent):
    try:
        children = Path(f'/proc/{parent}/task/{parent}/children').read_text(encoding='ascii').split()
    except OSError:
        children = []
    return int(children[0]) if children else 0


def name(pid):
    try:
        return Path(f'/proc/{pid}/comm').read_text(encoding='utf-8').strip()
    except OSError:
        return ''


def processes():
    """All that live: the campaign has a process namespace of its own. A main thread that has ended is no death."""
    found = set()
    for path in Path('/proc').glob('[0-9]*'):
        try:
            fields = (path / 'stat').read_text(encoding='utf-8', errors='replace').rsplit(')', 1)[1].split()
        except OSError:
            continue
        if fields[0] not in 'ZX' or int(fields[17]) > 1:
            found.add(int(path.name))
    return found


def reap():
    """What the guardians leave becomes a child of this program."""
    try:
        while os.waitpid(-1, os.WNOHANG)[0] != 0:
            pass
    except ChildProcessError:
        pass
