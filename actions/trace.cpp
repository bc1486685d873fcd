// <trace session-name="…"/>: records the run. Takes effect before any process starts, wherever it stands in the file.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "actions/trace_scope.hpp"
#include "launcher/core/fields.hpp"
#include "launcher/core/launch_context.hpp"

namespace launch {

namespace {

using Words = std::optional<std::vector<Template>>;

// LTTng's timers are 32 bits wide: more than 71 minutes is as good as never.
std::uint32_t microseconds(const NumberField& field, Scope& scope) {
  return static_cast<std::uint32_t>(std::min<double>(field.perform(scope), std::numeric_limits<std::uint32_t>::max()));
}

class Trace : public Action {
 public:
  explicit Trace(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        session_name_(fields.text("session-name")),
        append_timestamp_(fields.boolean("append-timestamp", false)),
        base_path_(fields.optional_text("base-path")),
        append_trace_(fields.boolean("append-trace", false)),
        fail_on_loss_(fields.boolean("fail-on-loss", false)),
        events_ust_(fields.optional_words("events-ust")),
        events_kernel_(fields.optional_words("events-kernel")),
        syscalls_(fields.optional_words("syscalls")),
        context_fields_(fields.optional_words("context-fields")),
        subbuffer_size_ust_(fields.number("subbuffer-size-ust")),
        subbuffer_size_kernel_(fields.number("subbuffer-size-kernel")),
        init_channel_(fields.boolean("init-channel", false)),
        subbuffer_count_ust_(fields.number("subbuffer-count-ust")),
        read_timer_ust_(fields.number("read-timer-ust")),
        switch_timer_ust_(fields.number("switch-timer-ust")),
        snapshot_mode_(fields.boolean("snapshot-mode", false)),
        dual_session_(fields.boolean("dual-session", false)) {
    for (std::optional<NumberField>* size :
         {&subbuffer_size_ust_, &subbuffer_size_kernel_, &subbuffer_count_ust_, &read_timer_ust_, &switch_timer_ust_}) {
      if (*size) {
        (*size)->require_not_negative();
      }
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    tracing::TraceConfig config;
    config.session_name = session_name_.perform(scope);
    if (config.session_name.empty()) {
      throw LaunchError("the session name is empty", session_name_.where());
    }
    if (config.session_name.find('/') != std::string::npos) {
      throw LaunchError(fmt::format("the session name '{}' has a slash", config.session_name), session_name_.where(),
                        "name the directory with base-path");
    }
    if (append_timestamp_.perform(scope)) {
      config.session_name += tracing::session_timestamp();
    }
    config.base_path =
        tracing::trace_base_path(base_path_ ? base_path_->perform(scope) : std::string(), scope.environment);
    config.append_trace = append_trace_.perform(scope);
    config.fail_on_loss = fail_on_loss_.perform(scope);
    config.snapshot_mode = snapshot_mode_.perform(scope);
    config.dual_session = dual_session_.perform(scope);
    if (config.dual_session) {
      config.events_ust = tracing::initialisation_ros_events();
    }
    const auto replace = [&scope](std::vector<std::string>& words, const Words& given) {
      if (given) {
        words.clear();
        for (const Template& word : *given) {
          if (std::string text = word.perform(scope); !text.empty()) {
            words.push_back(std::move(text));
          }
        }
      }
    };
    replace(config.events_ust, events_ust_);
    replace(config.events_kernel, events_kernel_);
    replace(config.syscalls, syscalls_);
    replace(config.context_fields_ust, context_fields_);
    config.context_fields_kernel = config.context_fields_ust;
    if (subbuffer_size_ust_) {
      config.subbuffer_size_ust = static_cast<std::uint64_t>(subbuffer_size_ust_->perform(scope));
    }
    if (subbuffer_size_kernel_) {
      config.subbuffer_size_kernel = static_cast<std::uint64_t>(subbuffer_size_kernel_->perform(scope));
    }
    config.init_channel = init_channel_.perform(scope);
    if (subbuffer_count_ust_) {
      config.subbuffer_count_ust = static_cast<std::uint64_t>(subbuffer_count_ust_->perform(scope));
    }
    if (read_timer_ust_) {
      config.read_timer_ust = microseconds(*read_timer_ust_, scope);
    }
    if (switch_timer_ust_) {
      config.switch_timer_ust = microseconds(*switch_timer_ust_, scope);
    }
    context.requests().scopes.push_back(
        std::make_unique<TraceScope>(std::move(config), tracing::make_lttng_tracer(), context.own_prefix(), where()));
  }

 private:
  Template session_name_;
  BooleanField append_timestamp_;
  std::optional<Template> base_path_;
  BooleanField append_trace_;
  BooleanField fail_on_loss_;
  Words events_ust_;
  Words events_kernel_;
  Words syscalls_;
  Words context_fields_;
  std::optional<NumberField> subbuffer_size_ust_;
  std::optional<NumberField> subbuffer_size_kernel_;
  BooleanField init_channel_;
  std::optional<NumberField> subbuffer_count_ust_;
  std::optional<NumberField> read_timer_ust_;
  std::optional<NumberField> switch_timer_ust_;
  BooleanField snapshot_mode_;
  BooleanField dual_session_;
};

}  // namespace

ActionType trace_action() {
  return {
      .tag = "trace",
      .help = "Records the run with LTTng, from before the first process starts until the last one has ended.",
      .attributes =
          {{"session-name", AttributeType::kText, true, "", "name of the session and of the trace's directory"},
           {"append-timestamp", AttributeType::kBoolean, false, "false", "append -YYYYMMDDHHMMSS to the name"},
           {"base-path", AttributeType::kText, false, "$ROS_TRACE_DIR, $ROS_HOME/tracing or ~/.ros/tracing",
            "directory that will hold the trace's directory"},
           {"append-trace", AttributeType::kBoolean, false, "false", "allow a trace directory that exists"},
           {"fail-on-loss", AttributeType::kBoolean, false, "false", "exit with 1 when events were lost"},
           {"events-ust", AttributeType::kCommandLine, false, "all events of provider ros2",
            "userspace events; * matches any text"},
           {"events-kernel", AttributeType::kCommandLine, false, "none", "kernel tracepoints"},
           {"syscalls", AttributeType::kCommandLine, false, "none", "system calls"},
           {"context-fields", AttributeType::kCommandLine, false, "procname vpid vtid", "fields added to every event"},
           {"subbuffer-size-ust", AttributeType::kInteger, false, "32768", "bytes"},
           {"init-channel", AttributeType::kBoolean, false, "false",
            "initialisation events in a channel of their own, ros2_init"},
           {"subbuffer-count-ust", AttributeType::kInteger, false, "2; 4 in snapshot mode",
            "sub-buffers for each processor"},
           {"read-timer-ust", AttributeType::kInteger, false, "200", "microseconds between two reads of the buffers"},
           {"switch-timer-ust", AttributeType::kInteger, false, "0",
            "microseconds until a part-full sub-buffer is written; 0: never"},
           {"subbuffer-size-kernel", AttributeType::kInteger, false, "131072", "bytes"},
           {"snapshot-mode", AttributeType::kBoolean, false, "false",
            "keep the newest events in memory until recorded"},
           {"dual-session", AttributeType::kBoolean, false, "false", "be the snapshot half of a dual session"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<Trace>(fields); },
  };
}

}  // namespace launch
