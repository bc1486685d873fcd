// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/counters/session_pauses.hpp"

#include <algorithm>
#include <fstream>
#include <limits>

#include "base/monotonic_clock.hpp"

namespace tracing {
namespace {

constexpr std::uint64_t kNotYet = std::numeric_limits<std::uint64_t>::max();

// CLOCK_MONOTONIC, ns.
struct Pause {
  std::uint64_t begin = 0;
  std::uint64_t end = kNotYet;
};

std::string file_of(const std::string& counters, const std::string& name) {
  return counters + "/pauses-" + name;
}

void note(const char* what, const std::string& counters, const std::string& name) {
  if (counters.empty()) {
    return;
  }
  std::ofstream(file_of(counters, name), std::ios::app) << what << ' ' << launch::monotonic_time() << '\n';
}

std::vector<Pause> read_pauses(const std::string& counters, const std::string& name) {
  std::vector<Pause> pauses;
  std::ifstream file(file_of(counters, name));
  std::string what;
  for (std::uint64_t time = 0; file >> what >> time;) {
    if (what == "pause") {
      pauses.push_back({.begin = time});
    } else if (!pauses.empty() && pauses.back().end == kNotYet) {
      pauses.back().end = time;
    }
  }
  return pauses;
}

}  // namespace

void note_pause(const std::string& counters, const std::string& name) {
  note("pause", counters, name);
}

void note_resume(const std::string& counters, const std::string& name) {
  note("resume", counters, name);
}

bool was_paused(const std::string& counters, const std::string& name) {
  return !counters.empty() && !read_pauses(counters, name).empty();
}

void forgive_pauses(std::vector<EventCounts>& counts, const std::string& counters, const std::string& name) {
  if (counters.empty()) {
    return;
  }
  const std::vector<Pause> pauses = read_pauses(counters, name);
  for (EventCounts& process : counts) {
    const std::uint64_t until = process.reached != 0 ? process.reached : process.end != 0 ? process.end : kNotYet;
    const bool paused = std::any_of(pauses.begin(), pauses.end(), [&process, until](const Pause& pause) {
      return process.begin < pause.end && pause.begin < until;
    });
    if (paused) {
      process.missed = 0;
    }
  }
}

}  // namespace tracing
