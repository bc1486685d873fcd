// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/relay_daemon_end.hpp"

#include <fmt/core.h>

#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include "base/text/quoted_text.hpp"
#include "tracing/record/lttng/consumer_priority.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {

void keep_relay_daemon(DaemonsKeptGoing& daemons, const std::string& address) {
  std::vector<pid_t> connected = consumers_of(session_daemon_pid());
  connected.push_back(session_daemon_pid());
  const RelayConnection connection(relay_ports(address), std::move(connected));
  daemons.keep_relay_daemons([connection] { return connection.stopped_daemons(); });
}

std::optional<RelayConnection> connection_of(const SessionSummary& session) {
  if (session.snapshot || session.path.empty() || session.path.starts_with('/')) {
    return std::nullopt;
  }
  return RelayConnection(relay_ports(session.path), consumers_of(session_daemon_pid()));
}

std::string end_it_later(const std::string& session_name) {
  return fmt::format("then end the session with `launch trace stop {}`", launch::shell_quoted(session_name));
}

std::optional<Absence> look_for_relay_daemon(const SessionSummary& session) {
  std::optional<RelayConnection> connection = connection_of(session);
  if (!connection) {
    return std::nullopt;
  }
  const RelayConnection::State state = connection->look();
  if (state == RelayConnection::State::kSilent) {
    throw TraceError(fmt::format("the relay daemon that gets the trace of session '{}' is stopped", session.name),
                     "continue it with `kill -CONT` and its process id, " + end_it_later(session.name));
  }
  if (state != RelayConnection::State::kEnded) {
    return std::nullopt;
  }
  return Absence{.text = "the relay daemon was gone before the session ended: what was recorded since then is lost",
                 .is_loss = true};
}

Absence lost_with_consumer() {
  return {.text =
              "LTTng's consumer daemon and its connection to the relay daemon ended before the session: what was "
              "recorded since then is lost, and LTTng does not tell how much",
          .is_loss = true};
}

std::optional<Absence> wait_for_relay_daemon(const SessionSummary& session) {
  constexpr std::chrono::seconds kLongest{2};
  constexpr std::chrono::milliseconds kPause{50};
  const auto latest = std::chrono::steady_clock::now() + kLongest;
  while (true) {
    try {
      return look_for_relay_daemon(session);
    } catch (const TraceError&) {
      if (std::chrono::steady_clock::now() > latest) {
        throw;
      }
    }
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace tracing
