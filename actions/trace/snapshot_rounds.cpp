// SPDX-License-Identifier: Apache-2.0
#include "actions/trace/snapshot_rounds.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "base/monotonic_clock.hpp"
#include "launcher/process/health_watch.hpp"
#include "launcher/visit/machines.hpp"
#include "tracing/record/session/snapshot.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kBetweenTellingOfSnapshots{5};
constexpr std::size_t kMostWishes = 100;  // for one snapshot; more say nothing new

void add_once(std::vector<std::string>& all, const std::string& one) {
  if (std::find(all.begin(), all.end(), one) == all.end()) {
    all.push_back(one);
  }
}

std::int64_t nanoseconds_since_epoch() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

std::string shown_machine(const std::string& machine) {
  return machine == kLocalMachine ? "this machine" : fmt::format("machine '{}'", machine);
}

}  // namespace

// The snapshot of a machine.
struct SnapshotRounds::Part {
  MachineRecorder* recorder = nullptr;  // null: this machine
  std::unique_ptr<MachineRecording> recording;
  std::string directory;  // there
  bool fetching = false;
  tracing::MachinePart result = {};

  // Once, and only of what was written there.
  void leave(bool remove) {
    if (!directory.empty() && recording) {
      recording->leave(remove);
      recording.reset();
    }
  }
};

struct SnapshotRounds::Round {
  std::vector<std::string> reasons;
  std::map<std::string, std::vector<std::string>> died;  // by machine
  std::vector<std::string> late;
  std::vector<Answer> answers;
  std::int64_t moment = 0;
  std::int64_t time_ns = 0;  // of the moment, since the epoch
  std::string directory;
  std::vector<Part> parts;
  std::size_t pending = 0;
};

SnapshotRounds::SnapshotRounds(EventLoop& loop, Settings settings, TraceScope* here,
                               std::vector<MachineRecorder*> machines, RunScope::Tell tell,
                               RunScope::SnapshotObserver observer, Unrecorded unrecorded)
    : loop_(loop),
      settings_(std::move(settings)),
      here_(here),
      machines_(std::move(machines)),
      tell_(std::move(tell)),
      observer_(std::move(observer)),
      unrecorded_(std::move(unrecorded)) {}

SnapshotRounds::~SnapshotRounds() {
  *lives_ = false;
}

void SnapshotRounds::want(Wish wish) {
  if (closed_) {
    if (wish.answer) {
      wish.answer({.error = "the trace is ending"});
    }
    return;
  }
  const bool is_known = !wish.answer && std::any_of(wanted_.begin(), wanted_.end(), [&](const Wish& other) {
    return other.reason == wish.reason && other.machine == wish.machine;
  });
  if (is_known || wanted_.size() >= kMostWishes) {
    if (wish.answer) {
      wish.answer({.error = "too many snapshots are wanted at once"});
    }
    return;
  }
  if (wanted_.empty()) {
    moment_ = monotonic_time();
    // What happens at once, such as the ends of several processes, is in one snapshot.
    loop_.post([this, lives = lives_] {
      if (*lives) {
        begin_next();
      }
    });
  }
  wanted_.push_back(std::move(wish));
}

void SnapshotRounds::begin_next() {
  if (taking_ || wanted_.empty()) {
    return;
  }
  taking_ = std::make_unique<Round>();
  Round& round = *taking_;
  for (Wish& wish : std::exchange(wanted_, {})) {
    add_once(round.reasons, wish.reason);
    if (!wish.died.empty()) {
      add_once(round.died[wish.machine], wish.died);
    }
    for (const std::string& event : wish.late) {
      add_once(round.late, event);
    }
    if (wish.answer) {
      round.answers.push_back(std::move(wish.answer));
    }
  }
  round.moment = moment_;
  round.time_ns = nanoseconds_since_epoch() - (monotonic_time() - moment_);
  const std::time_t now = std::time(nullptr);
  round.directory = fmt::format("{}/{}-{:%Y%m%d-%H%M%S}-{}", settings_.directory, tracing::kSnapshotName,
                                fmt::localtime(now), numbers_++);
  if (here_ != nullptr) {
    round.parts.emplace_back().result.machine = kLocalMachine;
  }
  for (MachineRecorder* const recorder : machines_) {
    Part& part = round.parts.emplace_back();
    part.recorder = recorder;
    part.result.machine = recorder->machine();
  }
  // Whatever ends the launch now, the directory says what is not there.
  for (Part& part : round.parts) {
    part.result.problem =
        fmt::format("the launch has not brought the snapshot of {} here", shown_machine(part.result.machine));
  }
  write_verdict(round);
  round.pending = round.parts.size();
  for (Part& part : round.parts) {
    part.recorder == nullptr ? take_here(round) : take_there(round, part);
  }
}

void SnapshotRounds::take_here(Round& round) {
  here_->take_part_of_snapshot(loop_, {.reasons = round.reasons, .died = round.died[""], .moment = round.moment},
                               [this, lives = lives_, &round](const tracing::TakenSnapshot& taken) {
                                 if (!*lives) {
                                   return;
                                 }
                                 tracing::MachinePart& result = round.parts.front().result;
                                 std::error_code failed;
                                 if (taken.error.empty()) {
                                   fs::rename(taken.directory, fs::path(round.directory) / kLocalMachine, failed);
                                 }
                                 if (!taken.error.empty() || failed) {
                                   has_none(round.parts.front(), fmt::format("no snapshot of this machine: {}",
                                                                             failed ? failed.message() : taken.error));
                                 } else {
                                   result.problem.clear();
                                   result.folder = kLocalMachine;
                                 }
                                 one_taken(round);
                               });
}

void SnapshotRounds::take_there(Round& round, Part& part) {
  part.recording = part.recorder->take_snapshot(
      {.reasons = round.reasons, .died = round.died[part.result.machine], .moment = round.moment},
      [this, lives = lives_, &round, &part](const MachineRecording::Outcome& outcome) {
        if (!*lives) {
          return;
        }
        if (outcome.lost) {
          part.result.problem = fmt::format("{}: no snapshot of machine '{}'", outcome.error, part.result.machine);
        } else if (!outcome.well || outcome.directory.empty()) {
          has_none(part, fmt::format("no snapshot of machine '{}': {}", part.result.machine,
                                     outcome.error.empty() ? "nothing is written there" : outcome.error));
        } else {
          part.directory = outcome.directory;
          part.result.problem =
              fmt::format("the launch has not fetched the snapshot of machine '{}', which is in '{}' there",
                          part.result.machine, part.directory);
        }
        one_taken(round);
      });
}

void SnapshotRounds::has_none(Part& part, const std::string& problem) const {
  part.result.nothing = settings_.is_used && !settings_.is_used(part.result.machine);
  part.result.problem = part.result.nothing ? "" : problem;
}

void SnapshotRounds::one_taken(Round& round) {
  if (--round.pending == 0) {
    taken(round);
  }
}

void SnapshotRounds::taken(Round& round) {
  write_verdict(round);
  if (observer_ && here_ != nullptr && !round.parts.front().result.folder.empty()) {
    observer_(round.reasons, round.directory + "/" + kLocalMachine, round.late);
  }
  waiting_.push_back(std::move(taking_));
  keep_newest();
  if (waiting_.size() == 1) {
    fetch_next();
  }
  begin_next();
  check_end();
}

// Those that come home one after another: the oldest is here first, and is whole.
void SnapshotRounds::fetch_next() {
  if (waiting_.empty()) {
    return;
  }
  Round& round = *waiting_.front();
  round.pending = 1;
  for (Part& part : round.parts) {
    if (part.directory.empty()) {
      continue;
    }
    if (!settings_.collects) {
      part.result.left_there = part.directory;
      part.result.problem.clear();
      continue;
    }
    ++round.pending;
    part.fetching = true;
    part.recording->fetch(round.directory + "/" + part.result.machine, [this, lives = lives_, &round, &part](
                                                                           const MachineRecording::Outcome& fetched) {
      if (!*lives) {
        return;
      }
      part.fetching = false;
      if (fetched.well) {
        part.result.folder = part.result.machine;
        part.result.problem.clear();
      } else {
        part.result.left_there = part.directory;
        part.result.problem = fmt::format("the snapshot of machine '{}' could not be fetched: {}; it is in '{}' there",
                                          part.result.machine, fetched.error, part.directory);
      }
      part.leave(fetched.well);
      one_fetched(round);
    });
    if (hurried_) {
      part.recording->hurry();
    }
  }
  watch_fetching();
  loop_.post([this, lives = lives_, &round] {
    if (*lives) {
      one_fetched(round);
    }
  });
}

void SnapshotRounds::watch_fetching() {
  fetching_ = loop_.after(kBetweenTellingOfSnapshots, [this] {
    for (const Part& part : waiting_.front()->parts) {
      if (part.fetching) {
        tell_(false, fmt::format("fetching the snapshot of machine '{}': {} so far", part.result.machine,
                                 size_text(part.recording->fetched())));
      }
    }
    watch_fetching();
  });
}

void SnapshotRounds::one_fetched(Round& round) {
  if (--round.pending == 0) {
    finish(round);
  }
}

void SnapshotRounds::finish(Round& round) {
  fetching_.reset();
  const bool complete = write_verdict(round);
  tell_(false, fmt::format("snapshot of {} machines written to: {} ({})", round.parts.size(), round.directory,
                           fmt::join(round.reasons, ", ")));
  for (const Part& part : round.parts) {
    if (!part.result.problem.empty()) {
      tell_(true, part.result.problem);
    } else if (!part.result.left_there.empty()) {
      tell_(false,
            fmt::format("the snapshot of machine '{}' stays there: {}", part.result.machine, part.result.left_there));
    }
  }
  if (!complete && settings_.collects) {
    tell_(true, "the snapshot of all machines is incomplete");
  }
  for (const Answer& answer : std::exchange(round.answers, {})) {
    answer({.directory = round.directory, .complete = complete});
  }
  kept_.push_back(std::move(waiting_.front()));
  waiting_.pop_front();
  keep_newest();
  fetch_next();
  check_end();
}

// Returns whether all is complete. What is wrong with the disk here is told.
bool SnapshotRounds::write_verdict(const Round& round) {
  std::vector<tracing::MachinePart> all;
  for (const Part& part : round.parts) {
    all.push_back(part.result);
  }
  for (tracing::MachinePart& part : unrecorded_()) {
    all.push_back(std::move(part));
  }
  const tracing::SnapshotReasons reasons{.reasons = round.reasons, .time_ns = round.time_ns};
  try {
    return tracing::write_machines_verdict(round.directory, settings_.session, all, &reasons);
  } catch (const std::exception& error) {
    tell_(true, error.what());
    return false;
  }
}

void SnapshotRounds::keep_newest() {
  while (kept_.size() + waiting_.size() > settings_.limit) {
    if (!kept_.empty()) {
      drop(*kept_.front());
      kept_.pop_front();
    } else if (waiting_.size() > 2) {  // neither the one that is on its way, nor the newest
      drop(*waiting_[1]);
      waiting_.erase(waiting_.begin() + 1);
    } else {
      break;
    }
  }
}

void SnapshotRounds::drop(Round& round) {
  std::error_code failed;
  fs::remove_all(round.directory, failed);
  for (Part& part : round.parts) {
    part.leave(true);
  }
  for (const Answer& answer : std::exchange(round.answers, {})) {
    answer({.error = "newer snapshots have taken the place of this one (snapshot-limit)"});
  }
}

void SnapshotRounds::end(std::function<void()> done) {
  closed_ = true;
  ended_ = std::move(done);
  loop_.post([this, lives = lives_] {
    if (*lives) {
      check_end();
    }
  });
}

void SnapshotRounds::check_end() {
  if (ended_ && wanted_.empty() && !taking_ && waiting_.empty()) {
    for (const auto& round : kept_) {
      for (Part& part : round->parts) {
        part.leave(false);
      }
    }
    kept_.clear();
    std::exchange(ended_, nullptr)();
  }
}

void SnapshotRounds::hurry() {
  hurried_ = true;
  if (!waiting_.empty()) {
    for (Part& part : waiting_.front()->parts) {
      if (part.fetching) {
        part.recording->hurry();
      }
    }
  }
}

}  // namespace launch
