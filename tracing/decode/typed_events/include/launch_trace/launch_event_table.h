// SPDX-License-Identifier: Apache-2.0
#pragma once

// The one declaration of the events of provider `launch`: the steps of the launcher. Its tracepoints and the structs
// of typed_events.hpp come from it. A row is EVENT(given, name, Struct, group, field...), as in
// tracetools/event_table.h, with three more types of fields: int32, uint32 and real (a double).
//
// `time` is the CLOCK_MONOTONIC time in nanoseconds at which the step happened or began, `duration` is in nanoseconds.
// Steps before the session exists are fired as soon as it does. `file` and `line` are the place in the launch file
// that asked for the step, "" and 0 when there is none.
// clang-format off
#define LAUNCH_EVENT_TABLE(EVENT, given) \
  /* A launch file was read and checked. */ \
  EVENT(given, load, Load, launch, (int64, time), (int64, duration), (string, name), (string, file), (uint32, line)) \
  /* Another launch file was included: read, checked and visited. */ \
  EVENT(given, include, Include, launch, \
    (int64, time), (int64, duration), (string, name), (string, file), (uint32, line)) \
  /* The actions of the launch file, or of a timer, were visited. */ \
  EVENT(given, visit, Visit, launch, (int64, time), (int64, duration), (string, name), (string, file), (uint32, line)) \
  /* The condition that a process waits for holds: its `depends_on` of this line. */ \
  EVENT(given, ready, Ready, launch, \
    (int64, time), (string, process), (string, condition), (string, file), (uint32, line)) \
  /* A process is about to be started; it has no label until it runs. */ \
  EVENT(given, spawn, Spawn, launch, (int64, time), (string, process), (string, file), (uint32, line)) \
  /* The program of the process runs. */ \
  EVENT(given, exec, Exec, launch, (int64, time), (string, process), (int32, pid), (string, file), (uint32, line)) \
  /* The process has ended; -N when signal N ended it. */ \
  EVENT(given, exit, Exit, launch, \
    (int64, time), (string, process), (int32, pid), (int32, exit_code), (string, file), (uint32, line)) \
  /* The process has ended and will be started again. */ \
  EVENT(given, respawn, Respawn, launch, \
    (int64, time), (string, process), (int32, pid), (int32, exit_code), (string, file), (uint32, line)) \
  /* A signal was sent to the process and its group. */ \
  EVENT(given, signal, Signal, launch, \
    (int64, time), (string, process), (int32, signal), (string, file), (uint32, line)) \
  /* The threads of the process get processors in another way from now on, or, without a change, as before. */ \
  EVENT(given, scheduling, Scheduling, launch, \
    (int64, time), (string, process), (string, change), (string, file), (uint32, line)) \
  /* A condition on what nodes do begins to hold, or holds no longer: `change` says which in a sentence. */ \
  EVENT(given, condition, Condition, launch, \
    (int64, time), (string, condition), (string, change), (string, file), (uint32, line)) \
  /* A class of events was dropped from the trace, because recording cost more than max-overhead. From `time` on, */ \
  /* `events` (a list of names) are no longer recorded. `rate` is that of all processes before the cut, in events a */ \
  /* second; `share` is the share of a processor. */ \
  EVENT(given, cut, Cut, launch, \
    (int64, time), (string, event_class), (string, events), (uint64, rate), (real, share))
// clang-format on
