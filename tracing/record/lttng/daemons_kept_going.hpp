// SPDX-License-Identifier: Apache-2.0
// LTTng's daemons at the end of a session: one that is stopped (SIGSTOP) would hold up the end for ever, and the
// session would stay. So it is continued.
#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tracing/record/lttng/kept_going.hpp"

namespace tracing {

// Continues the session daemon and its consumers, as far as this user may, if they are stopped now or later in the life
// of this object. A process that a debugger holds is left alone.
class DaemonsKeptGoing {
 public:
  DaemonsKeptGoing();
  ~DaemonsKeptGoing();
  DaemonsKeptGoing(const DaemonsKeptGoing&) = delete;
  DaemonsKeptGoing& operator=(const DaemonsKeptGoing&) = delete;

  // Also continues the relay daemons that `stopped` finds, from now on.
  void keep_relay_daemons(std::function<std::vector<pid_t>()> stopped);

  // A sentence for each process that was continued.
  std::vector<std::string> notes() const;

 private:
  void look();
  void continue_process(pid_t pid, const char* what);

  const KeepsGoing keeps_going_;
  std::function<std::vector<pid_t>()> relay_daemons_;
  std::map<pid_t, std::string> continued_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace tracing
