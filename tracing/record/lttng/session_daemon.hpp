// SPDX-License-Identifier: Apache-2.0
// The LTTng session daemon: found, started when none runs, and known to be usable.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace tracing {

// Makes sure that a session daemon answers and that it lives in the same container as this process. Starts one when
// there is none; the started daemon survives this process and holds none of its files open. Returns whether it was
// started. Blocks until the daemon is ready, about 20 ms. Throws TraceError.
bool ensure_session_daemon();

// Whether a launch, or `launch trace`, has started the daemon that serves this user, and this user may end it.
bool session_daemon_is_ours();

// Ends the daemon and starts another one. All its sessions end with it. Traced programs register with the new one.
// Throws TraceError.
void restart_session_daemon();

// Throws unless the process of the pid file `pid_file` is a running session daemon. A socket on a shared HOME can be
// reached from another container; its daemon would then record nothing of ours, without an error (LTTng bug 1371). A
// missing file is accepted.
void check_daemon_is_here(const std::string& pid_file);

// Where programs find the daemon that serves this user.
std::string session_daemon_directory();

// The process of the daemon that serves this user; 0 when there is none, or nothing tells of it.
pid_t session_daemon_pid();

// False when the daemon is known to be stopped (SIGSTOP). A traced program would wait for it at its start.
bool session_daemon_can_answer();

// Throws when the daemon is stopped, and nobody keeps it going (daemons_kept_going.hpp): it would block every call.
void check_daemon_not_stopped();

// Throws also when a consumer of the daemon is stopped: the daemon waits for it in most calls.
void check_daemons_not_stopped();

}  // namespace tracing
