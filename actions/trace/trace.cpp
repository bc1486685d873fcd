// SPDX-License-Identifier: Apache-2.0
// <trace session-name="…"/>: records the run. Takes effect before any process starts, wherever it stands in the file.
#include <fmt/format.h>
#include <fnmatch.h>
#include <lttng/domain.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "actions/trace/machines_trace.hpp"
#include "actions/trace/trace_scope.hpp"
#include "actions/trace/trace_settings.hpp"
#include "base/diagnostics/diagnostic.hpp"
#include "base/environment/test_run_variables.hpp"
#include "launcher/traced/machine_recorder.hpp"
#include "launcher/visit/at_machine.hpp"
#include "launcher/visit/launch_context.hpp"
#include "tracing/model/chains/chain_definition.hpp"
#include "tracing/record/plan/context_fields.hpp"
#include "tracing/record/plan/event_rule.hpp"
#include "tracing/record/plan/ros_events.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/tracer.hpp"

namespace launch {

namespace {

using Chain = tracing::ChainDefinition;

void perform_chain_name(const Fields& fields, Scope& scope, Chain& chain) {
  chain.name = fields.text("name").perform(scope);
  if (chain.name.empty()) {
    throw LaunchError("the name of the chain is empty", fields.where("name"),
                      "launch report shows the chain by its name");
  }
}

void perform_chain_nodes(const Fields& fields, Scope& scope, Chain& chain) {
  chain.nodes = perform_names(fields, "nodes", scope);
  if (chain.nodes.size() < 2) {
    throw LaunchError(fmt::format("chain '{}' needs two nodes at least", chain.name), fields.where("nodes"),
                      "name the node where it begins, and the node where it ends");
  }
  for (std::string& node : chain.nodes) {
    if (node.front() != '/' && node.front() != '*') {
      node.insert(node.begin(), '/');
    }
  }
}

void perform_budget(const Fields& fields, Scope& scope, Chain& chain) {
  const double milliseconds = fields.number("budget")->perform(scope);
  if (!(milliseconds > 0)) {
    throw LaunchError(fmt::format("the budget of chain '{}' is not above 0", chain.name), fields.where("budget"),
                      "write milliseconds, such as 50, or leave out the budget");
  }
  chain.budget_ns = std::llround(milliseconds * 1e6);
}

const std::vector<Setting<Chain>>& chain_settings() {
  static const std::vector<Setting<Chain>> settings = {
      {.attribute = {"name", AttributeType::kText, true, "", "its name"}, .perform = perform_chain_name},
      {.attribute = {"nodes", AttributeType::kWords, true, "",
                     "the nodes that it passes, from the first to the last; * matches any text, and other nodes "
                     "may lie between"},
       .perform = perform_chain_nodes},
      {.attribute = {"budget", AttributeType::kFloat, false, "none",
                     "milliseconds that it may take from an input to the first output that it causes"},
       .perform = perform_budget}};
  return settings;
}

std::vector<Chain> perform_chains(const std::vector<const Fields*>& items, Scope& scope) {
  std::vector<Chain> chains;
  for (const Fields* const item : items) {
    Chain chain;
    perform_settings(chain_settings(), *item, scope, chain);
    const bool is_twice =
        std::any_of(chains.begin(), chains.end(), [&](const Chain& other) { return other.name == chain.name; });
    if (is_twice) {
      throw LaunchError(fmt::format("there are two chains '{}'", chain.name), item->where(),
                        "give each chain a name of its own");
    }
    chains.push_back(std::move(chain));
  }
  return chains;
}

// A session does not begin with an unknown context field.
void find_unknown_context_fields(const std::vector<std::string>& fields, lttng_domain_type domain,
                                 const SourceRange& where, LaunchContext& context) {
  if (!context.exploration().is_on()) {
    return;
  }
  for (const std::string& name : fields) {
    try {
      tracing::ContextField(name, domain);
    } catch (const tracing::TraceError& error) {
      context.exploration().remark(
          {Severity::kError, error.what(), where, error.remedy(), Finding::kUnknownContextField});
    }
  }
}

// An event of ROS 2 that does not exist is never recorded.
void find_unknown_events(const std::vector<std::string>& rules, const SourceRange& where, LaunchContext& context) {
  if (!context.exploration().is_on()) {
    return;
  }
  std::vector<std::string> names;
  for (const tracing::RosEvent& event : tracing::all_ros_events()) {
    names.push_back(event.name);
  }
  for (const std::string& pattern : tracing::event_patterns(rules)) {
    const bool known = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
    });
    const std::string help = did_you_mean(pattern.find(':') == std::string::npos ? "ros2:" + pattern : pattern, names);
    const bool lacks_provider = std::find(names.begin(), names.end(), "ros2:" + pattern) != names.end();
    if (lacks_provider) {
      context.exploration().remark({Severity::kWarning, fmt::format("event '{}' has no provider", pattern), where,
                                    fmt::format("did you mean 'ros2:{}'?", pattern), Finding::kUnknownEvent});
    } else if (pattern.starts_with("ros2:") && !known) {
      context.exploration().remark({Severity::kWarning, fmt::format("ROS 2 has no event '{}'", pattern), where,
                                    help.empty() ? "launch trace --help tells how to list them" : help,
                                    Finding::kUnknownEvent});
    }
  }
}

class Trace : public Action {
 public:
  explicit Trace(const Fields& fields) : Action(fields.where(), fields.condition()), fields_(fields) {
    check_settings(trace_settings(), fields_);
    for (const Fields* channel : fields_.items("channel")) {
      check_settings(channel_settings(), *channel);
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
    MachinesTrace::Settings settings{.only = other_machine(context), .prefix = context.own_prefix()};
    const bool only_here = fields_.has("machine") && !settings.only;
    settings.collects = perform_collect(context, only_here);
    const AtMachine here(context, nullptr);
    Scope& scope = context.scope();
    TraceRequest request;
    request.config.launch_events = true;
    perform_settings(trace_settings(), fields_, scope, request);
    complete_session(request.config, scope);
    for (const Fields* channel : fields_.items("channel")) {
      perform_settings(channel_settings(), *channel, scope, request.config.channels.emplace_back());
    }
    find_faults(request.config, context);
    complete_choices(request.choices, context);
    request.config.snapshot_mode = request.config.snapshot_mode || request.choices.flight_recorder();
    if (!only_here) {
      find_settings_of_one_machine(request, settings.only, context);
    }
    std::unique_ptr<TraceScope> scope_here;
    if (!settings.only) {
      scope_here = std::make_unique<TraceScope>(request, tracing::make_lttng_tracer(), context.own_prefix(), where());
    }
    if (only_here) {
      context.requests().scopes.push_back(std::move(scope_here));
    } else {
      context.requests().scopes.push_back(std::make_unique<MachinesTrace>(
          std::move(request), std::move(scope_here), context.machines().recorders(), std::move(settings), where()));
    }
  }

 private:
  // The one that the trace is for, if it is not this one.
  std::optional<std::string> other_machine(LaunchContext& context) const {
    if (!fields_.has("machine")) {
      return std::nullopt;
    }
    const Template& machine = fields_.text("machine");
    const std::shared_ptr<MachineView> view =
        context.machines().find(machine.perform(context.scope()), machine.where());
    return view == nullptr ? std::nullopt : std::optional(view->name());
  }

  bool perform_collect(LaunchContext& context, bool only_here) const {
    if (!fields_.has("collect")) {
      return true;
    }
    const Template& text = fields_.text("collect");
    if (only_here) {
      throw LaunchError("collect is for recordings of other machines, and this trace has none", text.where(),
                        "leave it out", Finding::kExclusive);
    }
    const std::string given = text.perform(context.scope());
    if (given != "end" && given != "none") {
      throw LaunchError(fmt::format("collect is expected to be end or none, got '{}'", given), text.where());
    }
    return given == "end";
  }

  // Settings that have no effect, or another one, on several machines.
  void find_settings_of_one_machine(const TraceRequest& request, const std::optional<std::string>& only,
                                    LaunchContext& context) const {
    const auto refuse = [&](const SourceRange& where) {
      if (only) {
        throw LaunchError(
            fmt::format("this setting of <trace> works on this machine only, and the trace is one of machine '{}'",
                        *only),
            where, {}, Finding::kExclusive);
      }
      context.machines().require_only_this_machine(where);
    };
    const tracing::TraceConfig& config = request.config;
    const std::pair<const char*, bool> used[] = {
        {"dual-session", config.dual_session},  {"url", !config.url.empty()},
        {"live-timer", config.live_timer != 0}, {"events-kernel", !config.events_kernel.empty()},
        {"syscalls", !config.syscalls.empty()}, {"append-trace", config.append_trace}};
    for (const auto& [setting, is_used] : used) {
      if (is_used && fields_.has(setting)) {
        refuse(fields_.where(setting));
      }
    }
    const std::vector<const Fields*> channels = fields_.items("channel");
    for (const Fields* const channel : channels) {
      for (const char* const setting : {"events-kernel", "syscalls"}) {
        if (channel->has(setting)) {
          refuse(channel->where(setting));
        }
      }
    }
  }

  // What follows from several settings, or from the environment.
  void complete_session(tracing::TraceConfig& config, Scope& scope) const {
    if (const auto suffix = scope.environment.find(kSessionSuffixVariable); suffix != scope.environment.end()) {
      config.session_name += suffix->second;
    }
    config.base_path = tracing::trace_base_path(config.base_path, scope.environment);
    if (config.dual_session && !fields_.has("events-ust")) {
      config.events_ust = tracing::initialisation_ros_events();
    }
    if (!fields_.has("context-fields-kernel")) {
      config.context_fields_kernel = config.context_fields_ust;
    }
  }

  void complete_choices(TraceChoices& choices, LaunchContext& context) const {
    if (!fields_.has("report")) {
      choices.report = context.wishes().report;
    } else if (choices.report && fields_.has("url")) {
      throw LaunchError("report needs the trace on this machine, but url sends it to a relay daemon",
                        fields_.text("url").where(), "leave out report, and use launch report where the trace is");
    }
    const std::vector<const Fields*> chains = fields_.items("chain");
    choices.chains = perform_chains(chains, context.scope());
    for (std::size_t i = 0; i < chains.size(); ++i) {
      const tracing::ChainDefinition& chain = choices.chains[i];
      for (const std::string& node : chain.nodes) {
        choices.chain_nodes.push_back({node, fmt::format("chain '{}'", chain.name), chains[i]->where("nodes")});
      }
    }
    if (!choices.chains.empty() && fields_.has("url")) {
      throw LaunchError("chains need the trace on this machine, but url sends it to a relay daemon",
                        fields_.text("url").where(),
                        "leave out the chains, and write chains.json where the trace is (docs/report.md)");
    }
  }

  void find_faults(const tracing::TraceConfig& config, LaunchContext& context) const {
    if (fields_.has("events-ust")) {
      find_unknown_events(config.events_ust, fields_.where("events-ust"), context);
    }
    const std::vector<const Fields*> channels = fields_.items("channel");
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const tracing::ChannelConfig& channel = config.channels[i];
      find_unknown_events(channel.events_ust, channels[i]->where("events-ust"), context);
      if (channel.context_fields) {
        find_unknown_context_fields(*channel.context_fields,
                                    channel.events_ust.empty() ? LTTNG_DOMAIN_KERNEL : LTTNG_DOMAIN_UST,
                                    channels[i]->where("context-fields"), context);
      }
    }
    if (fields_.has("context-fields") && !config.events_ust.empty()) {
      find_unknown_context_fields(config.context_fields_ust, LTTNG_DOMAIN_UST, fields_.where("context-fields"),
                                  context);
    }
    if (fields_.has("context-fields-kernel") && !(config.events_kernel.empty() && config.syscalls.empty())) {
      find_unknown_context_fields(config.context_fields_kernel, LTTNG_DOMAIN_KERNEL,
                                  fields_.where("context-fields-kernel"), context);
    }
  }

  Fields fields_;
};

// `launch trace` has all settings but this one.
std::vector<AttributeSpec> trace_attributes() {
  std::vector<AttributeSpec> attributes = declared_attributes(trace_settings());
  attributes.push_back({"machine", AttributeType::kText, false, "all machines of the launch",
                        "record this machine only; local is the one where launch runs", true});
  attributes.push_back({"collect", AttributeType::kText, false, "end",
                        "end: recordings of other machines are fetched when all processes have ended; none: they stay "
                        "there",
                        true});
  return attributes;
}

}  // namespace

ActionType trace_action() {
  return {
      .tag = "trace",
      .help = "Records the run with LTTng, from before the first process starts until the last one has ended.",
      .attributes = trace_attributes(),
      .items = {{.tag = "channel",
                 .help = "a further channel of one domain, whose events have buffers of their own",
                 .attributes = declared_attributes(channel_settings()),
                 .extension = true},
                {.tag = "chain",
                 .help = "a chain of callbacks that cause one another, which launch report shows by this name",
                 .attributes = declared_attributes(chain_settings()),
                 .extension = true}},
      .make = [](const Fields& fields) { return std::make_shared<Trace>(fields); },
  };
}

}  // namespace launch
