// SPDX-License-Identifier: Apache-2.0
#include "launcher/traced/tracetools_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "launcher/process/spawn/program_search.hpp"
#include "launcher/traced/words_of_text.hpp"
#include "tracing/record/plan/event_rule.hpp"
#include "tracing/record/plan/preload.hpp"

namespace launch {
namespace {

using tracing::TracetoolsFinding;

constexpr const char* kLibrary = "libtracetools.so";
constexpr std::size_t kMostWords = 32;  // a program that another one starts stands at the beginning of a command

// The programs that a command names: its own, and files that this one may execute, as `gdb --args` does.
std::vector<std::string> programs_of(const ProcessSpec& spec) {
  std::vector<std::string> words = spec.argv;
  if (spec.shell) {
    words.clear();
    for (const std::string& text : spec.argv) {
      for (std::string& word : words_of_text(text)) {
        words.push_back(std::move(word));
      }
    }
  }
  std::vector<std::string> programs;
  for (std::size_t i = 0; i < std::min(words.size(), kMostWords); ++i) {
    std::filesystem::path path = words[i];
    if (i == 0 && !spec.shell) {
      try {
        path = find_program(spec);
      } catch (const std::system_error&) {
        return {};  // the start of the process will tell
      }
    } else if (words[i].find('/') == std::string::npos) {
      continue;
    }
    if (path.is_relative() && !spec.working_directory.empty()) {
      path = spec.working_directory / path;
    }
    std::error_code failed;
    if (std::filesystem::is_regular_file(path, failed) && ::access(path.c_str(), X_OK) == 0) {
      programs.push_back(path.string());
    }
  }
  return programs;
}

// A user's own choice, as a backend of tracetools, is not changed.
bool preloads_tracetools(const Environment& environment) {
  const auto variable = environment.find("LD_PRELOAD");
  return variable != environment.end() && variable->second.find(kLibrary) != std::string::npos;
}

bool is_recorded_by_ours_alone(const std::string& pattern) {
  return pattern.starts_with("ros2_ext:") || pattern.starts_with("ros2_deadline:");
}

}  // namespace

const TracetoolsFinding& TracetoolsChoice::look_at(const ProcessSpec& spec) {
  TracetoolsFinding finding;
  if (!preloads_tracetools(spec.environment)) {
    for (const std::string& program : programs_of(spec)) {
      finding = check_.check(program, spec.environment);
      if (finding.kind != TracetoolsFinding::Kind::kNone) {
        break;
      }
    }
  }
  if (finding.kind == TracetoolsFinding::Kind::kStandIn && mode_ == TracetoolsMode::kTheirs) {
    finding.kind = TracetoolsFinding::Kind::kTheirs;
    finding.reason = "tracetools=\"theirs\"";
  }
  const auto [known, is_new] = of_process_.insert_or_assign(spec.name, std::move(finding));
  if (is_new) {
    in_order_.push_back(spec.name);
  }
  return known->second;
}

void TracetoolsChoice::preload(const TracetoolsFinding& finding, Environment& environment) {
  if (finding.kind != TracetoolsFinding::Kind::kStandIn) {
    return;
  }
  std::string& variable = environment["LD_PRELOAD"];
  variable = tracing::append_preload(variable, {finding.library});
  environment.insert_or_assign("TRACETOOLS_STANDS_IN_FOR_VERSION", finding.version);
}

std::string TracetoolsChoice::ineffective(const tracing::TraceConfig& config,
                                          const std::vector<std::string>& settings) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_reason;
  for (; told_ < in_order_.size(); ++told_) {
    const std::string& process = in_order_[told_];
    const TracetoolsFinding& finding = of_process_.at(process);
    if (finding.kind != TracetoolsFinding::Kind::kTheirs) {
      continue;
    }
    const auto same = std::find_if(by_reason.begin(), by_reason.end(),
                                   [&](const auto& each) { return each.first == finding.reason; });
    if (same == by_reason.end()) {
      by_reason.push_back({finding.reason, {process}});
    } else {
      same->second.push_back(process);
    }
  }
  if (by_reason.empty()) {
    return {};
  }
  std::vector<std::string> lost = settings;
  for (const std::string& rule : config.all_events_ust()) {
    for (const std::string& pattern : tracing::event_patterns({rule})) {
      if (is_recorded_by_ours_alone(pattern) &&
          config.further_events_ust.end() ==
              std::find(config.further_events_ust.begin(), config.further_events_ust.end(), pattern)) {
        lost.push_back(fmt::format("events-ust '{}'", pattern));
      }
    }
  }
  lost.insert(lost.end(), {"counts of events and of losses", "recorded_after_s", "a longer wait for the session daemon",
                           "names in sessions that begin later"});
  std::vector<std::string> groups;
  for (const auto& [reason, processes] : by_reason) {
    groups.push_back(fmt::format("{} ({})", fmt::join(processes, ", "), reason));
  }
  return fmt::format("these processes keep the tracetools of their ROS 2: {}; without effect on them: {}",
                     fmt::join(groups, ", "), fmt::join(lost, ", "));
}

std::optional<std::string> TracetoolsChoice::refused() const {
  if (mode_ != TracetoolsMode::kOwn) {
    return std::nullopt;
  }
  for (const std::string& process : in_order_) {
    if (const TracetoolsFinding& finding = of_process_.at(process); finding.kind == TracetoolsFinding::Kind::kTheirs) {
      return fmt::format("tracetools=\"own\" cannot be had for {}: {}", process, finding.reason);
    }
  }
  return std::nullopt;
}

std::vector<tracing::TracetoolsUse> TracetoolsChoice::uses() const {
  std::vector<tracing::TracetoolsUse> uses;
  for (const std::string& process : in_order_) {
    const TracetoolsFinding& finding = of_process_.at(process);
    if (finding.kind == TracetoolsFinding::Kind::kStandIn || finding.kind == TracetoolsFinding::Kind::kTheirs) {
      uses.push_back({.process = process,
                      .is_own = finding.kind == TracetoolsFinding::Kind::kStandIn,
                      .theirs = finding.theirs,
                      .version = finding.version,
                      .reason = finding.reason});
    }
  }
  return uses;
}

}  // namespace launch
