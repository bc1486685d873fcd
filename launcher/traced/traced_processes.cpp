// SPDX-License-Identifier: Apache-2.0
#include "launcher/traced/traced_processes.hpp"

#include <fmt/format.h>
#include <fnmatch.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "launcher/traced/python_nodes.hpp"
#include "tracing/record/account/counters/event_counters.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/plan/buffer_sizes.hpp"
#include "tracing/record/plan/load_addresses.hpp"
#include "tracing/record/plan/preload.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace launch {

namespace {

// Compares the pattern with the label of the process and with the name of its node.
bool matches(const std::string& pattern, const ProcessSpec& spec) {
  const auto is_meant = [&pattern](const std::string& name) {
    return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
  };
  return is_meant(spec.name) || std::any_of(spec.other_names.begin(), spec.other_names.end(), is_meant);
}

bool may_block(const tracing::TraceConfig& config) {
  return config.ust.blocking_timeout != 0 ||
         std::any_of(config.channels.begin(), config.channels.end(),
                     [](const tracing::ChannelConfig& channel) { return channel.blocking_timeout != 0; });
}

constexpr double kNanosecondsPerMillisecond = 1e6;
// Milliseconds. A process of the stack waits so long while the session daemon works, and no second if it does not.
constexpr const char* kLongestRegistration = "30000";

std::string nanoseconds_of(double milliseconds) {
  return fmt::format("{:.0f}", milliseconds * kNanosecondsPerMillisecond);
}

}  // namespace

TracedProcesses::TracedProcesses(tracing::TracedRun& run, ProcessChoices choices)
    : run_(run), choices_(std::move(choices)), tracetools_(choices_.tracetools, run_.prefix()) {}

std::vector<std::string> unknown_nodes(const ProcessChoices& choices, const std::vector<ProcessSpec>& processes) {
  std::vector<std::string> warnings;
  for (const std::string& pattern : choices.nodes.value_or(std::vector<std::string>())) {
    if (std::none_of(processes.begin(), processes.end(),
                     [&](const ProcessSpec& spec) { return matches(pattern, spec); })) {
      warnings.push_back(fmt::format("nothing that is launched now is called '{}', which 'nodes' names", pattern));
    }
  }
  return warnings;
}

void TracedProcesses::expect(const std::vector<ProcessSpec>& processes, bool all) {
  const auto traced = static_cast<std::size_t>(
      std::count_if(processes.begin(), processes.end(), [this](const ProcessSpec& spec) { return traces(spec); }));
  const auto processors = static_cast<std::size_t>(::get_nprocs_conf());
  tracing::TraceConfig& config = run_.config();
  if (choices_.auto_buffers) {
    config.ust.subbuffer_size = tracing::sufficient_subbuffer_size(config, traced, processors);
  }
  if (std::string warning = tracing::buffer_warning(config, traced, processors); !warning.empty()) {
    run_.warn(std::move(warning));
  }
  for (const ProcessSpec& spec : processes) {
    if (traces(spec) && records_programs()) {
      tracetools_.look_at(spec);
    }
  }
  if (std::string warning = tracetools_.ineffective(config, settings_of_tracetools()); !warning.empty()) {
    run_.warn(std::move(warning));
  }
  if (choices_.python_nodes) {
    std::vector<ProcessSpec> recorded;
    std::copy_if(processes.begin(), processes.end(), std::back_inserter(recorded),
                 [this](const ProcessSpec& spec) { return traces(spec) && records_programs(); });
    if (std::string warning = python_nodes_without_events(recorded, run_.prefix()); !warning.empty()) {
      run_.warn(std::move(warning));
    }
  }
  if (all) {
    for (std::string& warning : unknown_nodes(choices_, processes)) {
      run_.warn(std::move(warning));
    }
  }
}

std::vector<std::string> TracedProcesses::settings_of_tracetools() const {
  std::vector<std::string> settings;
  const auto add = [&settings](bool is_given, const char* name) {
    if (is_given) {
      settings.emplace_back(name);
    }
  };
  add(run_.config().max_overhead != 0, "max-overhead");
  add(choices_.callback_deadline != 0, "snapshot-on-late-callback");
  add(choices_.message_deadline != 0, "snapshot-on-late-message");
  return settings;
}

bool TracedProcesses::traces(const ProcessSpec& spec) const {
  return spec.traced &&
         (!choices_.nodes || std::any_of(choices_.nodes->begin(), choices_.nodes->end(),
                                         [&](const std::string& pattern) { return matches(pattern, spec); }));
}

void TracedProcesses::prepare(ProcessSpec& spec, const std::function<void(const std::string&)>& warn) {
  if (!traces(spec)) {
    std::string& variable = spec.environment["LD_PRELOAD"];
    const std::string library = run_.prefix() + "/lib/launch/liblaunch_untraced.so";
    if (variable.find(library) == std::string::npos) {
      variable = tracing::append_preload(variable, {library});
    }
    // The process must not wait for a session daemon.
    spec.environment.emplace("LTTNG_UST_REGISTER_TIMEOUT", "0");
    return;
  }
  if (!tracing::session_daemon_can_answer()) {
    // Otherwise the process would wait for three seconds, three times, before its main().
    spec.environment.emplace("LTTNG_UST_REGISTER_TIMEOUT", "0");
  }
  spec.environment.emplace("TRACETOOLS_REGISTER_TIMEOUT", kLongestRegistration);
  if (records_programs()) {
    TracetoolsChoice::preload(tracetools_.look_at(spec), spec.environment);
    // Of a process that was not there when the session began.
    if (const std::string warning = tracetools_.ineffective(run_.config(), settings_of_tracetools());
        warn && !warning.empty()) {
      warn(warning);
    }
  }
  if (choices_.python_nodes && records_programs()) {
    give_python_nodes_events(run_.prefix(), spec.environment);
  }
  if (!run_.preload().empty()) {
    std::string& variable = spec.environment["LD_PRELOAD"];
    variable = tracing::append_preload(variable, run_.preload());
  }
  if (tracing::records_load_addresses(run_.config().all_events_ust())) {
    spec.tells_load_addresses = true;
    spec.environment.erase(tracing::kWithoutLoadAddresses);
  } else if (!spec.tells_load_addresses) {
    spec.environment.emplace(tracing::kWithoutLoadAddresses, "1");
  }
  if (const tracing::CounterDirectory* const counters = run_.counters()) {
    spec.environment.emplace(tracing::kEventCountersVariable, counters->path().string());
  }
  if (choices_.callback_deadline != 0) {
    spec.environment.emplace("TRACETOOLS_CALLBACK_DEADLINE", nanoseconds_of(choices_.callback_deadline));
  }
  if (choices_.message_deadline != 0) {
    spec.environment.emplace("TRACETOOLS_MESSAGE_DEADLINE", nanoseconds_of(choices_.message_deadline));
  }
  if (may_block(run_.config())) {
    spec.environment.emplace("LTTNG_UST_ALLOW_BLOCKING", "1");
  }
}

}  // namespace launch
