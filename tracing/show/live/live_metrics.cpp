// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/live/live_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tracing/model/objects/object_names.hpp"

namespace tracing {
namespace {

constexpr double kNanoseconds = 1e9;

std::string header_of(const char* name, const char* type, const char* unit, const char* help) {
  std::string text = fmt::format("# TYPE {} {}\n", name, type);
  if (unit != nullptr) {
    text += fmt::format("# UNIT {} {}\n", name, unit);
  }
  return text + fmt::format("# HELP {} {}\n", name, help);
}

// The name of a label and its value in quotes: `topic="/scan"`.
std::string metric_label(const char* name, const std::string& value) {
  std::string text = std::string(name) + "=\"";
  for (const char c : value) {
    if (c == '\\' || c == '"') {
      text += '\\';
    }
    if (c == '\n') {
      text += "\\n";
    } else {
      text += c;
    }
  }
  return text + '"';
}

}  // namespace

void LiveMetrics::Histogram::add(std::int64_t took_ns) {
  const auto* const bound = std::lower_bound(kBounds.begin(), kBounds.end(), took_ns);
  ++buckets[static_cast<std::size_t>(bound - kBounds.begin())];
  sum_ns += took_ns;
  ++count;
}

void LiveMetrics::Histogram::add(const Histogram& other) {
  for (std::size_t i = 0; i < buckets.size(); ++i) {
    buckets[i] += other.buckets[i];
  }
  sum_ns += other.sum_ns;
  count += other.count;
}

LiveMetrics::Histogram& LiveMetrics::at(std::vector<Histogram>& histograms, ObjectId id) {
  if (id >= histograms.size()) {
    histograms.resize(id + 1);
  }
  return histograms[id];
}

void LiveMetrics::on_event(const Event& event) {
  ++events_;
  analysis_.on_event(event);
}

void LiveMetrics::on_loss(const Loss& loss) {
  lost_ += loss.kind == Loss::Kind::kEvents ? loss.count.value_or(0) : 0;
  analysis_.on_loss(loss);
}

void LiveMetrics::on_callback(const CallbackInstance& instance) {
  if (instance.finished) {
    at(callbacks_, instance.callback).add(instance.end_ns - instance.begin_ns);
  }
}

void LiveMetrics::on_message(const MessageFlow& message) {
  const Publication& from = message.publication;
  const std::int64_t begin_ns = from.rclcpp_ns != 0 ? from.rclcpp_ns
                                : from.rcl_ns != 0  ? from.rcl_ns
                                                    : from.published_ns;
  if (message.subscription != kNoObject && message.callback != kNoObject && begin_ns != 0) {
    at(latencies_, message.subscription).add(message.callback_begin_ns - begin_ns);
  }
}

void LiveMetrics::write(std::string& text, const char* name, const std::string& labels, const Histogram& histogram) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < histogram.buckets.size(); ++i) {
    count += histogram.buckets[i];
    const std::string bound =
        i < kBounds.size() ? fmt::format("{}", static_cast<double>(kBounds[i]) / kNanoseconds) : "+Inf";
    text += fmt::format("{}_bucket{{{},le=\"{}\"}} {}\n", name, labels, bound, count);
  }
  text += fmt::format("{}_count{{{}}} {}\n", name, labels, histogram.count);
  text += fmt::format("{}_sum{{{}}} {:.9f}\n", name, labels, static_cast<double>(histogram.sum_ns) / kNanoseconds);
}

std::string LiveMetrics::text() const {
  const ObjectModel& objects = analysis_.objects();
  // Several objects may have the same labels. They make one series.
  std::map<std::string, Histogram> callbacks;
  std::map<std::string, Histogram> latencies;
  std::map<std::string, std::uint64_t> missed;
  std::map<std::string, std::uint64_t> dropped;
  const auto labels_of_callback = [&](ObjectId id) {
    const CallbackObject& callback = objects.callbacks()[id];
    return metric_label("node", node_name(objects, callback)) + "," +
           metric_label("callback", callback_source(objects, callback));
  };
  const auto labels_of_subscription = [&](ObjectId id) {
    const EndpointObject& subscription = objects.subscriptions()[id];
    return metric_label("topic", subscription.topic == kNoObject ? "" : objects.topics()[subscription.topic].name) +
           "," + metric_label("node", subscription.node == kNoObject ? "" : objects.nodes()[subscription.node].name);
  };
  const std::vector<std::uint64_t> missed_of = analysis_.missed_periods();
  for (ObjectId id = 0; id < callbacks_.size(); ++id) {
    if (callbacks_[id].count == 0) {
      continue;
    }
    const std::string labels = labels_of_callback(id);
    callbacks[labels].add(callbacks_[id]);
    if (objects.callbacks()[id].owner == CallbackObject::Owner::kTimer) {
      missed[labels] += id < missed_of.size() ? missed_of[id] : 0;  // from 0 on: who counts must see the first one
    }
  }
  const std::vector<std::uint64_t> dropped_of = analysis_.dropped_messages();
  for (ObjectId id = 0; id < std::max(latencies_.size(), dropped_of.size()); ++id) {
    const bool has_messages = id < latencies_.size() && latencies_[id].count > 0;
    const std::uint64_t count = id < dropped_of.size() ? dropped_of[id] : 0;
    if (!has_messages && count == 0) {
      continue;
    }
    const std::string labels = labels_of_subscription(id);
    dropped[labels] += count;
    if (has_messages) {
      latencies[labels].add(latencies_[id]);
    }
  }

  std::string text = header_of("launch_trace_events", "counter", nullptr, "Events that were recorded.");
  text += fmt::format("launch_trace_events_total {}\n", events_);
  text += header_of("launch_trace_lost_events", "counter", nullptr,
                    "Events that the tracer has dropped, as far as it counts them.");
  text += fmt::format("launch_trace_lost_events_total {}\n", lost_);
  text += header_of("launch_callback_duration_seconds", "histogram", "seconds", "Runs of callbacks.");
  for (const auto& [labels, histogram] : callbacks) {
    write(text, "launch_callback_duration_seconds", labels, histogram);
  }
  text += header_of("launch_message_latency_seconds", "histogram", "seconds",
                    "From the publication of a message to its callback.");
  for (const auto& [labels, histogram] : latencies) {
    write(text, "launch_message_latency_seconds", labels, histogram);
  }
  text += header_of("launch_messages_dropped", "counter", nullptr, "Messages that a subscription did not get.");
  for (const auto& [labels, count] : dropped) {
    text += fmt::format("launch_messages_dropped_total{{{}}} {}\n", labels, count);
  }
  text += header_of("launch_timer_missed_periods", "counter", nullptr, "Periods of a timer without a call.");
  for (const auto& [labels, count] : missed) {
    text += fmt::format("launch_timer_missed_periods_total{{{}}} {}\n", labels, count);
  }
  return text;
}

}  // namespace tracing
