// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/export/analysis_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>

#include "tracing/show/export/csv_text.hpp"

namespace tracing {

namespace {

struct TableText {
  const char* name;
  const char* columns;
};

// In the order of AnalysisModelWriter::Table.
constexpr TableText kTableTexts[] = {
    {"contexts", "context_handle,timestamp,pid,version"},
    {"nodes", "node_handle,timestamp,tid,rmw_handle,name,namespace,vpid"},
    {"rmw_publishers", "publisher_handle,timestamp,gid,vpid"},
    {"rcl_publishers", "publisher_handle,timestamp,node_handle,rmw_handle,topic_name,depth,vpid"},
    {"rmw_subscriptions", "subscription_handle,timestamp,gid,vpid"},
    {"rcl_subscriptions", "subscription_handle,timestamp,node_handle,rmw_handle,topic_name,depth,vpid"},
    {"subscription_objects", "subscription,timestamp,subscription_handle,vpid"},
    {"services", "service_handle,timestamp,node_handle,rmw_handle,service_name,vpid"},
    {"clients", "client_handle,timestamp,node_handle,rmw_handle,service_name,vpid"},
    {"timers", "timer_handle,timestamp,period,tid,vpid"},
    {"timer_node_links", "timer_handle,timestamp,node_handle,vpid"},
    {"callback_objects", "reference,timestamp,callback_object,vpid"},
    {"callback_symbols", "callback_object,timestamp,symbol,vpid"},
    {"callback_instances", "callback_object,timestamp,duration,intra_process,vpid"},
    {"rclcpp_publish_instances", "timestamp,message,vpid"},
    {"rcl_publish_instances", "publisher_handle,timestamp,message,vpid"},
    {"rmw_publish_instances", "timestamp,message,vpid"},
    {"rmw_take_instances", "subscription_handle,timestamp,message,source_timestamp,taken,vpid"},
    {"rcl_take_instances", "timestamp,message,vpid"},
    {"rclcpp_take_instances", "timestamp,message,vpid"},
    {"lifecycle_state_machines", "state_machine_handle,node_handle,vpid"},
    {"lifecycle_transitions", "state_machine_handle,start_label,goal_label,timestamp,vpid"},
};

template <class Cell>
void append(std::string& line, const Cell& cell) {
  if constexpr (std::is_same_v<Cell, bool>) {
    line += cell ? "True" : "False";
  } else if constexpr (std::is_integral_v<Cell>) {
    fmt::format_to(std::back_inserter(line), "{}", cell);
  } else if constexpr (std::is_same_v<Cell, ros2::Gid>) {
    std::string list = "[";
    for (std::size_t i = 0; i < cell.size; ++i) {
      list += fmt::format("{}{}", i == 0 ? "" : ", ", cell.bytes[i]);
    }
    append_csv_text(line, list + "]");
  } else {
    append_csv_text(line, cell);
  }
}

}  // namespace

AnalysisModelWriter::AnalysisModelWriter(const std::filesystem::path& directory,
                                         std::function<Window(std::int64_t first_ns)> window)
    : choose_window_(std::move(window)) {
  static_assert(std::size(kTableTexts) == kTables);
  std::error_code failed;
  std::filesystem::create_directories(directory, failed);
  if (failed) {
    throw OutputError(directory, failed.message());
  }
  for (std::size_t table = 0; table < kTables; ++table) {
    files_[table] = std::make_unique<OutputFile>(directory / fmt::format("{}.csv", kTableTexts[table].name));
    files_[table]->write(fmt::format("{}\n", kTableTexts[table].columns));
  }
}

void AnalysisModelWriter::finish() {
  for (const std::unique_ptr<OutputFile>& file : files_) {
    file->finish();
  }
}

bool AnalysisModelWriter::is_in_window(std::int64_t time_ns) const {
  return time_ns >= window_->begin_ns.value_or(time_ns) && (!window_->end_ns || time_ns < *window_->end_ns);
}

template <class... Cells>
void AnalysisModelWriter::row(Table table, const Cells&... cells) {
  line_.clear();
  ((append(line_, cells), line_ += ','), ...);
  line_.back() = '\n';
  files_[table]->write(line_);
}

template <class Struct>
void AnalysisModelWriter::on(const Event& event, const Struct& e) {
  const std::int64_t time = event.timestamp_ns;
  const std::int64_t vpid = event.vpid.value_or(0);
  const std::int64_t tid = event.vtid.value_or(0);
  constexpr auto is = []<class Other>(std::type_identity<Other>) { return std::is_same_v<Struct, Other>; };
#define IS(Name) is(std::type_identity<ros2::Name>())
  if constexpr (IS(RclInit)) {
    row(kContexts, e.context_handle, time, vpid, e.version);
  } else if constexpr (IS(RclNodeInit)) {
    row(kNodes, e.node_handle, time, tid, e.rmw_handle, e.node_name, e.namespace_, vpid);
  } else if constexpr (IS(RmwPublisherInit)) {
    row(kRmwPublishers, e.rmw_publisher_handle, time, e.gid, vpid);
  } else if constexpr (IS(RclPublisherInit)) {
    row(kRclPublishers, e.publisher_handle, time, e.node_handle, e.rmw_publisher_handle, e.topic_name, e.queue_depth,
        vpid);
  } else if constexpr (IS(RmwSubscriptionInit)) {
    row(kRmwSubscriptions, e.rmw_subscription_handle, time, e.gid, vpid);
  } else if constexpr (IS(RclSubscriptionInit)) {
    row(kRclSubscriptions, e.subscription_handle, time, e.node_handle, e.rmw_subscription_handle, e.topic_name,
        e.queue_depth, vpid);
  } else if constexpr (IS(RclcppSubscriptionInit)) {
    row(kSubscriptionObjects, e.subscription, time, e.subscription_handle, vpid);
  } else if constexpr (IS(RclcppSubscriptionCallbackAdded)) {
    row(kCallbackObjects, e.subscription, time, e.callback, vpid);
  } else if constexpr (IS(RclServiceInit)) {
    row(kServices, e.service_handle, time, e.node_handle, e.rmw_service_handle, e.service_name, vpid);
  } else if constexpr (IS(RclcppServiceCallbackAdded)) {
    row(kCallbackObjects, e.service_handle, time, e.callback, vpid);
  } else if constexpr (IS(RclClientInit)) {
    row(kClients, e.client_handle, time, e.node_handle, e.rmw_client_handle, e.service_name, vpid);
  } else if constexpr (IS(RclTimerInit)) {
    row(kTimers, e.timer_handle, time, e.period, tid, vpid);
  } else if constexpr (IS(RclcppTimerCallbackAdded)) {
    row(kCallbackObjects, e.timer_handle, time, e.callback, vpid);
  } else if constexpr (IS(RclcppTimerLinkNode)) {
    row(kTimerNodeLinks, e.timer_handle, time, e.node_handle, vpid);
  } else if constexpr (IS(RclcppCallbackRegister)) {
    row(kCallbackSymbols, e.callback, time, e.symbol, vpid);
  } else if constexpr (IS(RclLifecycleStateMachineInit)) {
    row(kLifecycleStateMachines, e.state_machine, e.node_handle, vpid);
  } else if constexpr (IS(CallbackStart)) {
    std::vector<Active>& active = active_[{processes_.of(event), tid}];
    // An exception has left an earlier instance without an end.
    std::erase_if(active, [&e](const Active& earlier) { return earlier.callback == e.callback; });
    active.push_back({e.callback, time, e.is_intra_process});
  } else if constexpr (IS(CallbackEnd)) {
    std::vector<Active>& active = active_[{processes_.of(event), tid}];
    const auto ended =
        std::find_if(active.begin(), active.end(), [&e](const Active& one) { return one.callback == e.callback; });
    if (ended == active.end()) {
      return;
    }
    if (is_in_window(ended->begin_ns)) {
      row(kCallbackInstances, e.callback, ended->begin_ns, time - ended->begin_ns, ended->intra_process, vpid);
    }
    active.erase(ended);
  } else if (!is_in_window(time)) {
    return;
  } else if constexpr (IS(RclcppPublish)) {
    row(kRclcppPublishInstances, time, e.message, vpid);
  } else if constexpr (IS(RclPublish)) {
    row(kRclPublishInstances, e.publisher_handle, time, e.message, vpid);
  } else if constexpr (IS(RmwPublish)) {
    row(kRmwPublishInstances, time, e.message, vpid);
  } else if constexpr (IS(RmwTake)) {
    row(kRmwTakeInstances, e.rmw_subscription_handle, time, e.message, e.source_timestamp, e.taken, vpid);
  } else if constexpr (IS(RclTake)) {
    row(kRclTakeInstances, time, e.message, vpid);
  } else if constexpr (IS(RclcppTake)) {
    row(kRclcppTakeInstances, time, e.message, vpid);
  } else if constexpr (IS(RclLifecycleTransition)) {
    row(kLifecycleTransitions, e.state_machine, e.start_label, e.goal_label, time, vpid);
  }
#undef IS
}

void AnalysisModelWriter::on_event(const Event& event) {
  if (!window_) {
    window_ = choose_window_ ? choose_window_(event.timestamp_ns) : Window();
  }
  if (const ros2::AnyEvent* const decoded = decoder_.decode(event)) {
    std::visit([&](const auto& fields) { on(event, fields); }, *decoded);
  }
}

}  // namespace tracing
