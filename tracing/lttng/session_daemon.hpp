// SPDX-License-Identifier: Apache-2.0
// The LTTng session daemon: found, started when none runs, and known to be usable.
#pragma once

#include <sys/types.h>

#include <string>

namespace tracing {

// Makes sure that a session daemon answers and that it lives in the same container as we do. Starts one when there is
// none; that one survives this process and holds none of its files open. Returns whether it was started. Blocks until
// the daemon is ready, about 20 ms. Throws TraceError.
bool ensure_session_daemon();

// Throws unless the process of the pid file `pid_file` is a running session daemon. A socket on a shared HOME can be
// reached from another container, whose daemon would then record nothing of ours, silently (LTTng bug 1371). No such
// file is no objection.
void check_daemon_is_here(const std::string& pid_file);

// Where programs find the daemon that serves this user.
std::string session_daemon_directory();

// The process of the daemon that serves this user; 0 when its pid file can't be read.
pid_t session_daemon_pid();

// False when it is known to be stopped. A program that starts would wait for it.
bool session_daemon_can_answer();

// Throws when the daemon is stopped: it would block every call for ever.
void check_daemon_not_stopped();

}  // namespace tracing
