// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/lttng_error.hpp"

#include <fmt/core.h>
#include <lttng/lttng-error.h>

#include <chrono>
#include <cstdlib>
#include <vector>

#include "base/processes/process_stat.hpp"
#include "tracing/record/lttng/answer_limit.hpp"
#include "tracing/record/lttng/consumer_priority.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/relay_connection.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

// "`kill -9 4711` ends WHAT". The process id is unknown if the daemon writes it to a file of its own (--pidfile).
std::string ending_the_daemon(const char* kill, const char* what) {
  const pid_t daemon = session_daemon_pid();
  return daemon > 0 ? fmt::format("`{} {}` ends {}", kill, daemon, what)
                    : fmt::format("`{}` and the process id of lttng-sessiond ends {}", kill, what);
}

std::string remedy_for(int code) {
  switch (code) {
    case LTTNG_ERR_NO_SESSIOND:
    case LTTNG_ERR_CONNECT_FAIL:
      return "no LTTng session daemon runs for this user any more: its sessions are gone, their traces end where they "
             "are";
    case LTTNG_ERR_SESS_NOT_FOUND:
    case LTTNG_ERR_SESSION_NOT_EXIST:
    case LTTNG_ERR_NO_SESSION:
      return "`launch trace list` shows the sessions that exist";
    case LTTNG_ERR_EPERM:
      return "run as the user who owns the session, or as a member of the group `tracing` to use root's session daemon";
    case LTTNG_ERR_RELAYD_CONNECT_FAIL:
    case LTTNG_ERR_RELAYD_VERSION_FAIL:
      return "start a relay daemon there: lttng-relayd --daemonize";
    case LTTNG_ERR_NOT_SNAPSHOT_SESSION:
      return "create the session in snapshot mode";
    // Its consumer was killed.
    case LTTNG_ERR_FATAL:
    case LTTNG_ERR_NO_USTCONSUMERD:
      return "restart lttng-sessiond: its consumer has ended, and it starts no other one. " +
             ending_the_daemon("kill", "it") + " with all its sessions; the next trace starts a new one";
    case LTTNG_ERR_UST_CONSUMER64_FAIL:
    case LTTNG_ERR_ENABLE_CONSUMER_FAIL:
      return "lttng-consumerd did not start: check the installation of lttng-tools";
    default:
      return {};
  }
}

std::string remedy_for_silence() {
  const pid_t daemon = session_daemon_pid();
  if (launch::read_process_stat(daemon).state == 'T') {
    return fmt::format("LTTng's session daemon is stopped: continue it with `kill -CONT {}`", daemon);
  }
  for (const pid_t consumer : consumers_of(daemon)) {
    if (launch::read_process_stat(consumer).state == 'T') {
      return fmt::format("LTTng's consumer is stopped: continue it with `kill -CONT {}`", consumer);
    }
  }
  // The session daemon itself makes the connection for a new session.
  const std::vector<pid_t> relay_daemons = stopped_relay_daemons(daemon);
  if (!relay_daemons.empty()) {
    return fmt::format("the relay daemon is stopped: continue it with `kill -CONT {}`", relay_daemons.front());
  }
  return ending_the_daemon("kill -9", "LTTng's session daemon") +
         " with all its sessions; the next trace starts a new one";
}

}  // namespace

TraceError lttng_error(int code, const std::string& doing) {
  if (AnswerLimit::was_unanswered()) {
    return TraceError(fmt::format("cannot {}: LTTng does not answer, it was waited for {} s", doing,
                                  std::chrono::seconds(kLongestSilence).count()),
                      remedy_for_silence());
  }
  const int positive = std::abs(code);
  return TraceError(fmt::format("cannot {}: {}", doing, lttng_strerror(-positive)), remedy_for(positive));
}

int check_lttng(int result, const std::string& doing) {
  if (result >= 0) {
    return result;
  }
  const bool gave_up = AnswerLimit::was_unanswered();
  const TraceError error = lttng_error(result, doing);
  if (gave_up) {
    throw TraceError(error);
  }
  if (result == -LTTNG_ERR_FATAL || result == -LTTNG_ERR_NO_USTCONSUMERD) {
    throw ConsumerEnded(error.what(), error.remedy());
  }
  throw TraceError(error);
}

}  // namespace tracing
