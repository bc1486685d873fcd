// SPDX-License-Identifier: Apache-2.0
// <trace session-name="…"/>: records the run. Takes effect before any process starts, wherever it stands in the file.
#include <fmt/format.h>

#include "actions/trace/trace_chain.hpp"
#include "actions/trace/trace_findings.hpp"
#include "actions/trace/trace_scope.hpp"
#include "actions/trace/trace_settings.hpp"
#include "base/diagnostics/diagnostic.hpp"
#include "base/environment/test_run_variables.hpp"
#include "launcher/visit/launch_context.hpp"
#include "tracing/record/session/tracer.hpp"

namespace launch {

namespace {

class Trace : public Action {
 public:
  explicit Trace(const Fields& fields) : Action(fields.where(), fields.condition()), fields_(fields) {
    check_settings(trace_settings(), fields_);
    for (const Fields* channel : fields_.items("channel")) {
      check_settings(channel_settings(), *channel);
    }
    for (const Fields* chain : fields_.items("chain")) {
      chains_.emplace_back(*chain);
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
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
    context.requests().scopes.push_back(
        std::make_unique<TraceScope>(std::move(request), tracing::make_lttng_tracer(), context.own_prefix(), where()));
  }

 private:
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
    choices.chains = perform_chains(chains_, context.scope());
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      const tracing::ChainDefinition& chain = choices.chains[i];
      for (const std::string& node : chain.nodes) {
        choices.chain_nodes.push_back({node, fmt::format("chain '{}'", chain.name), chains_[i].nodes_where()});
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
  std::vector<ChainFields> chains_;
};

}  // namespace

ActionType trace_action() {
  return {
      .tag = "trace",
      .help = "Records the run with LTTng, from before the first process starts until the last one has ended.",
      .attributes = declared_attributes(trace_settings()),
      .items = {{.tag = "channel",
                 .help = "a further channel of one domain, whose events have buffers of their own",
                 .attributes = declared_attributes(channel_settings()),
                 .items = {},
                 .extension = true},
                ChainFields::item()},
      .make = [](const Fields& fields) { return std::make_shared<Trace>(fields); },
  };
}

}  // namespace launch
