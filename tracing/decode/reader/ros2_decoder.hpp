// SPDX-License-Identifier: Apache-2.0
// Turns recorded events of ros2_tracing into structs.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tracing/decode/reader/event.hpp"
#include "tracing/decode/reader/ros2_events.hpp"
#include "tracing/decode/reader/struct_fields.hpp"

namespace tracing::ros2 {

class Decoder {
 public:
  // Calls `report` once per event class for fields that are missing or have an unexpected type: "ros2:rmw_publish has
  // no field timestamp". Such events are decoded all the same. Extra fields are ignored.
  // `provider`: whose events are decoded. Those of CARET have the names of ROS 2's, and dds_write stands for
  // rmw_publish.
  enum class Provider { kRos2, kCaret };
  explicit Decoder(std::function<void(const std::string&)> report, Provider provider = Provider::kRos2)
      : report_(std::move(report)), provider_(provider) {}

  // The event as a struct, valid until the next call; null when it is not one of the 42.
  const AnyEvent* decode(const Event& event);

  // Calls `use` with the event as a struct, without a copy in between. Returns false when it is not one of the 42.
  template <class Use>
  bool visit(const Event& event, const Use& use) {
    const Plan& plan = plan_for(event);
    if (plan.kind == 0) {
      return false;
    }
    kVisits<Use>[plan.kind](event, plan.places, use);
    return true;
  }

 private:
  // The facts about an event class, known since its first event.
  struct Plan {
    bool is_known = false;
    std::size_t kind = 0;            // place of the struct in AnyEvent; 0: none
    std::vector<FieldPlace> places;  // of the struct's fields
  };

  template <class Use>
  using Visit = void (*)(const Event&, const std::vector<FieldPlace>&, const Use&);
  template <class Use, std::size_t kind>
  static void visit_as(const Event& event, const std::vector<FieldPlace>& places, const Use& use) {
    if constexpr (kind != 0) {
      std::variant_alternative_t<kind, AnyEvent> fields;
      read_fields(event, places, fields);
      use(fields);
    }
  }
  template <class Use, std::size_t... kinds>
  static constexpr std::array<Visit<Use>, sizeof...(kinds)> visits_of(std::index_sequence<kinds...>) {
    return {visit_as<Use, kinds>...};
  }
  template <class Use>
  static constexpr std::array<Visit<Use>, kEventCount + 1> kVisits =
      visits_of<Use>(std::make_index_sequence<kEventCount + 1>());

  const Plan& plan_for(const Event& event) {
    const std::size_t id = event.event_class->id;
    return id < plans_.size() && plans_[id].is_known ? plans_[id] : make_plan(event);
  }
  const Plan& make_plan(const Event& event);

  std::function<void(const std::string&)> report_;
  Provider provider_;
  std::vector<Plan> plans_;  // by EventClass::id
  AnyEvent decoded_;
};

}  // namespace tracing::ros2
