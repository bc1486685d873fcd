// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/caret_events.hpp"

#include <algorithm>

namespace tracing::ros2 {

namespace {

using Kind = CaretEvent::Kind;

struct Row {
  std::string_view name;
  Kind kind;
  // Names of fields; empty: it has none.
  std::string_view first, second, number, text;
};

constexpr Row kRows[] = {
    {"construct_executor", Kind::kExecutor, "executor_addr", "", "", "executor_type_name"},
    {"construct_static_executor", Kind::kExecutor, "executor_addr", "entities_collector_addr", "",
     "executor_type_name"},
    {"executor_entity_collector_to_executor", Kind::kExecutor, "executor_addr", "entities_collector_addr", "", ""},
    {"add_callback_group", Kind::kExecutorGroup, "executor_addr", "callback_group_addr", "", "group_type_name"},
    {"add_callback_group_static_executor", Kind::kCollectorGroup, "entities_collector_addr", "callback_group_addr", "",
     "group_type_name"},
    {"callback_group_to_executor_entity_collector", Kind::kCollectorGroup, "entities_collector_addr",
     "callback_group_addr", "", "group_type_name"},
    {"callback_group_add_timer", Kind::kTimer, "callback_group_addr", "timer_handle", "", ""},
    {"callback_group_add_subscription", Kind::kSubscription, "callback_group_addr", "subscription_handle", "", ""},
    {"callback_group_add_service", Kind::kService, "callback_group_addr", "service_handle", "", ""},
    {"callback_group_add_client", Kind::kClient, "callback_group_addr", "client_handle", "", ""},
    {"dds_bind_addr_to_stamp", Kind::kSourceTimestamp, "", "", "source_stamp", ""},
    {"sim_time", Kind::kSimulatedTime, "", "", "stamp", ""},
};

}  // namespace

CaretDecoder::Plan CaretDecoder::plan_of(const EventClass& event_class) {
  Plan plan;
  constexpr std::string_view kProvider = "ros2_caret:";
  if (!event_class.name.starts_with(kProvider)) {
    return plan;
  }
  plan.is_known = true;
  const auto index_of = [&](std::string_view field) {
    return field.empty() ? std::nullopt : event_class.index_of(field);
  };
  plan.init = index_of("init_timestamp");
  const std::string_view name = std::string_view(event_class.name).substr(kProvider.size());
  const auto row = std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& one) { return one.name == name; });
  if (row == std::end(kRows)) {
    plan.has_counterpart = true;
    return plan;
  }
  plan.kind = row->kind;
  plan.first = index_of(row->first);
  plan.second = index_of(row->second);
  plan.number = index_of(row->number);
  plan.text = index_of(row->text);
  return plan;
}

const CaretDecoder::Decoded* CaretDecoder::decode(const Event& event) {
  const Plan& plan = plans_.of(*event.event_class, [&] { return plan_of(*event.event_class); });
  if (!plan.is_known) {
    return nullptr;
  }
  decoded_.init_ns = plan.init ? event.field(*plan.init).integer() : std::nullopt;
  if (plan.has_counterpart) {
    const AnyEvent* const known = counterparts_.decode(event);
    if (known == nullptr) {
      return nullptr;
    }
    decoded_.event = *known;
    return &decoded_;
  }
  CaretEvent known{.kind = plan.kind, .text = {}};
  known.first = plan.first ? event.field(*plan.first).unsigned_integer().value_or(0) : 0;
  known.second = plan.second ? event.field(*plan.second).unsigned_integer().value_or(0) : 0;
  known.number = plan.number ? event.field(*plan.number).integer().value_or(0) : 0;
  known.text = plan.text ? event.field(*plan.text).string().value_or("") : "";
  decoded_.event = known;
  return &decoded_;
}

}  // namespace tracing::ros2
