// SPDX-License-Identifier: Apache-2.0
// The end of a trace of several machines: recordings come home, and get one verdict.
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include "actions/trace/machines_trace.hpp"
#include "base/diagnostics/diagnostic.hpp"
#include "base/text/quoted_text.hpp"
#include "launcher/process/health_watch.hpp"
#include "tracing/record/lttng/installed_program.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kBetweenProgress{5};
// To describe a trace in one line, up to this many bytes are read.
constexpr std::uintmax_t kLargestDescribed = 100'000'000;

std::uintmax_t bytes_below(const fs::path& directory) {
  std::uintmax_t bytes = 0;
  std::error_code failed;
  fs::recursive_directory_iterator entry(directory, failed);
  for (; !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
    std::error_code none;
    if (entry->is_regular_file(none)) {
      bytes += entry->file_size(none);
    }
  }
  return bytes;
}

}  // namespace

void MachinesTrace::end(EventLoop& loop, Tell tell, Completion done) {
  tell_ = std::move(tell);
  done_ = std::move(done);
  if (parts_.empty()) {
    here_->end(loop, tell_, [this](const std::exception_ptr& error) {
      note(error);
      end_of_this_machine_alone();
    });
    return;
  }
  snapshot_signal_.reset();
  snapshot_requests_source_.reset();
  snapshot_requests_ = UniqueFd();
  if (snapshots_) {
    snapshots_->end([this] { end_sessions(); });
  } else {
    end_sessions();
  }
}

void MachinesTrace::end_sessions() {
  wait_for(parts_.size() + (here_ ? 1 : 0), [this] { takes_snapshots() ? finish_snapshots() : finish(); });
  if (here_) {
    here_->config().nothing_to_record = !used_.contains(kLocalMachine);
    here_->end(*loop_, tell_, [this](const std::exception_ptr& error) {
      note(error);
      finished_one();
    });
  }
  for (const auto& part : parts_) {
    part->recorder->end(!used_.contains(part->result.machine),
                        [this, &part = *part](const MachineRecorder::Outcome& outcome) { on_ended(part, outcome); });
  }
}

// No other machine was in use when the trace began.
void MachinesTrace::end_of_this_machine_alone() {
  std::vector<std::string> problems;
  for (const tracing::MachinePart& part : results()) {
    if (!part.problem.empty()) {
      problems.push_back(part.problem);
    }
  }
  if (!problems.empty()) {
    try {
      if (!takes_snapshots()) {  // they have verdicts of their own
        tracing::note_problems(here_->config().trace_directory(), problems);
      }
    } catch (const std::exception& error) {
      note(std::make_exception_ptr(LaunchError(error.what(), origin_)));
    }
    for (const std::string& problem : problems) {
      tell_(true, problem);
    }
    fail_on_loss(false);
  }
  std::exchange(done_, nullptr)(error_);
}

void MachinesTrace::fail_on_loss(bool complete) {
  if (request_.config.fail_on_loss && !complete) {
    note(
        std::make_exception_ptr(LaunchError(fmt::format("the trace of session '{}' is incomplete", session()), origin_,
                                            "use larger sub-buffers, record fewer events, or leave out fail-on-loss")));
  }
}

void MachinesTrace::on_ended(Part& part, const MachineRecorder::Outcome& outcome) {
  const std::string& machine = part.result.machine;
  if (takes_snapshots()) {
    if (outcome.lost) {
      tell_(true, fmt::format("{}: what it still has of snapshots is in '{}' there", outcome.error, part.there));
    } else {
      if (!outcome.well) {
        note(std::make_exception_ptr(
            LaunchError(fmt::format("machine '{}': {}", machine, outcome.error), origin_, outcome.help)));
      } else if (!outcome.directory.empty() && settings_.collects) {
        tell_(true, fmt::format("what was not fetched from machine '{}' is in '{}' there", machine, part.there));
      }
      part.recorder->leave(false);
    }
    finished_one();
    return;
  }
  if (outcome.lost) {
    part.result.left_there = part.there;
    part.result.problem =
        fmt::format("{}: its recording is not here; what there is of it is in '{}' there", outcome.error, part.there);
    finished_one();
    return;
  }
  if (!outcome.well) {
    note(std::make_exception_ptr(
        LaunchError(fmt::format("machine '{}': {}", machine, outcome.error), origin_, outcome.help)));
    part.result.problem = fmt::format("machine '{}': {}", machine, outcome.error);
  }
  if (outcome.directory.empty()) {
    part.result.nothing = part.result.problem.empty() && !used_.contains(machine);
    if (part.result.problem.empty() && !part.result.nothing) {
      part.result.problem = fmt::format("machine '{}' has recorded nothing, though processes ran there", machine);
    }
    part.recorder->leave(false);
    finished_one();
    return;
  }
  part.there = outcome.directory;
  if (!settings_.collects) {
    part.result.left_there = part.there;
    part.recorder->leave(false);
    tell_(false, fmt::format("the recording of machine '{}' stays there: {}", machine, part.there));
    finished_one();
    return;
  }
  part.fetching = true;
  if (!fetching_) {
    watch_fetching();
  }
  part.recorder->fetch(directory() + "/" + machine,
                       [this, &part](const MachineRecorder::Outcome& fetched) { on_fetched(part, fetched); });
  if (hurried_) {
    part.recorder->hurry();
  }
}

void MachinesTrace::watch_fetching() {
  fetching_ = loop_->after(kBetweenProgress, [this] {
    for (const auto& part : parts_) {
      if (part->fetching) {
        tell_(false, fmt::format("fetching the recording of machine '{}': {} so far", part->result.machine,
                                 size_text(part->recorder->fetched())));
      }
    }
    watch_fetching();
  });
}

void MachinesTrace::on_fetched(Part& part, const MachineRecorder::Outcome& outcome) {
  part.fetching = false;
  const std::string& machine = part.result.machine;
  if (outcome.well) {
    part.result.folder = machine;
    part.recorder->leave(true);
  } else {
    part.result.left_there = part.there;
    part.result.problem = fmt::format("the recording of machine '{}' could not be fetched: {}; it is in '{}' there",
                                      machine, outcome.error, part.there);
    part.recorder->leave(false);
  }
  finished_one();
}

void MachinesTrace::finish_snapshots() {
  const std::size_t taken = snapshots_ ? snapshots_->taken() : 0;
  std::error_code none;
  if (here_) {
    fs::remove(here_->config().trace_directory(), none);  // if it is empty
  }
  if (taken == 0) {
    fs::remove(directory(), none);
    tell_(false, "no trace was written: no snapshot was taken");
    std::exchange(done_, nullptr)(error_);
    return;
  }
  tell_(false, fmt::format("snapshots are in: {}", directory()));
  worker_ = std::thread([this] {
    const std::string page = request_.choices.report && !hurried_ ? make_page() : "";
    loop_->post([this, page] {
      if (request_.choices.report) {
        tell_page(page);
      }
      std::exchange(done_, nullptr)(error_);
    });
  });
}

// On the thread.
std::string MachinesTrace::make_page() const {
  std::string page = directory() + "/report.html";
  tracing::program_output(settings_.prefix + "/lib/launch/launch-report", {directory(), "--html", page});
  return page;
}

void MachinesTrace::tell_page(const std::string& page) {
  std::error_code none;
  if (!page.empty() && fs::exists(page, none)) {
    tell_(false, "report: " + page);
  } else {
    tell_(request_.choices.report,
          fmt::format("{}: launch report {}", request_.choices.report ? "no report; see" : "what is in it",
                      shell_quoted(directory())));
  }
}

void MachinesTrace::finish() {
  fetching_.reset();
  const std::vector<tracing::MachinePart> all = results();
  bool complete = false;
  try {
    complete = tracing::write_machines_verdict(directory(), session(), all);
  } catch (const std::exception& error) {
    note(std::make_exception_ptr(LaunchError(error.what(), origin_)));
  }
  for (const tracing::MachinePart& part : all) {
    if (!part.problem.empty()) {
      tell_(true, part.problem);
    }
  }
  const bool describes = !hurried_;
  worker_ = std::thread([this, complete, describes, count = all.size()] {
    const std::string program = settings_.prefix + "/lib/launch/launch-report";
    std::string text;
    std::string page;
    if (describes) {
      if (bytes_below(directory()) <= kLargestDescribed) {
        text = tracing::program_output(program, {"--summary", directory()});
      }
      if (request_.choices.report) {
        page = make_page();
      }
    }
    loop_->post([this, complete, count, text, page] {
      tell_(false, fmt::format("trace of {} machines written to: {}{}", count, directory(),
                               text.empty() ? "" : fmt::format(" ({})", text)));
      tell_(!complete, fmt::format("the trace of all machines is {}", complete ? "complete" : "incomplete"));
      tell_page(page);
      fail_on_loss(complete);
      std::exchange(done_, nullptr)(error_);
    });
  });
}

}  // namespace launch
