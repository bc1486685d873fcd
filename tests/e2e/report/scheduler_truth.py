# SPDX-License-Identifier: Apache-2.0
"""
What threads did on the machine, computed from the events of the kernel's scheduler that babeltrace2 prints, with nothing of the
reader and the analysis of this project.
"""

import collections
import re
import subprocess

SWITCH = re.compile(r'\[(\d+)\.(\d{9})\] .*? sched_switch: \{ cpu_id = (\d+) \}, .*prev_tid = (\d+), .*prev_state = (\d+), .*next_tid = (\d+),')
WAKING = re.compile(r'\[(\d+)\.(\d{9})\] .*? sched_wak\w+: .* tid = (\d+), .*target_cpu = (\d+)')
ACTIVE = re.compile(r'\[(\d+)\.(\d{9})\] .*? ros2:(?:callback_start|callback_end|rmw_publish|rclcpp_intra_publish): .*?vtid = (\d+)')
CAN_GO_ON = (0, 256)  # its state when it was switched off: running, or pushed off by the kernel


class Scheduler:
    """
    `states`: thread, state, begin, end, processor, who had the processor longest while the thread waited for it. A thread's list
    begins with its first change that is in the trace. In a trace of one process id namespace.
    """

    def __init__(self, trace):
        self.states = collections.defaultdict(list)
        self.first_activity = {}
        self.turns = collections.defaultdict(list)  # by processor: thread, begin, end
        now = {}  # by thread: state, since when, processor
        text = subprocess.run(['babeltrace2', '--clock-seconds', trace], check=True, stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True).stdout
        for line in text.splitlines():
            if match := SWITCH.match(line):
                seconds, nanoseconds, cpu, before, state, after = map(int, match.groups())
                time = seconds * 10**9 + nanoseconds
                self.turn(cpu, before, after, time)
                if before:
                    self.change(now, before, 'runnable' if state in CAN_GO_ON else 'blocked', time, cpu, 'goes')
                if after:
                    self.change(now, after, 'running', time, cpu, 'comes')
            elif match := WAKING.match(line):
                seconds, nanoseconds, thread, cpu = map(int, match.groups())
                if now.get(thread, ('', 0, 0))[0] == 'blocked':
                    self.change(now, thread, 'runnable', seconds * 10**9 + nanoseconds, cpu, 'is woken')
            elif match := ACTIVE.match(line):
                self.first_activity.setdefault(int(match[3]), int(match[1]) * 10**9 + int(match[2]))

    def turn(self, cpu, before, after, time):
        turns = self.turns[cpu]
        if turns and turns[-1][0] == before:
            turns[-1][2] = time
        elif turns:
            turns.pop()  # some kernels pass over switches; until when it had the processor is not known
        turns.append([after, time, None])

    def change(self, now, thread, state, time, cpu, how):
        """If a kernel passes over it that a thread comes, it was last where it goes, and who had that meanwhile is not known."""
        if thread in now:
            was, since, on = now[thread]
            if time > since:
                # A thread stays where it was until it is woken for another processor.
                place = cpu if how == 'goes' else on
                self.states[thread].append((thread, was, since, time, place, self.instead(was, place, since, time) if how == 'comes' else None))
        now[thread] = state, time, cpu

    def instead(self, state, cpu, begin, end):
        """The thread that had this processor for most of the time; None if none had, or of another state."""
        if state != 'runnable':
            return None
        had = collections.Counter()
        for thread, since, until in reversed(self.turns[cpu]):
            if until is not None and until <= begin:
                break
            if thread and (took := min(end if until is None else until, end) - max(since, begin)) > 0:
                had[thread] += took
        return max(had, key=lambda thread: (had[thread], -thread), default=None)

    def rows(self, thread):
        """From the first activity of the thread on."""
        since = self.first_activity.get(thread)
        return [row for row in self.states[thread] if since is not None and row[3] > since]

    def parts(self, thread, begin, end):
        """
        How long the thread was running, runnable and blocked in this time, at whose end it certainly ran: if it seems to have
        waited then, the kernel has passed over a switch.
        """
        took = collections.Counter()
        for _, state, since, until, *_ in self.states[thread]:
            if until <= end:
                took[state] += max(0, until - max(begin, since))
        took['running'] = end - begin - took['runnable'] - took['blocked']
        return took
