// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/ros2_decoder.hpp"

#include <string_view>
#include <unordered_map>

namespace tracing::ros2 {

namespace {

using Problems = std::vector<std::string>;

struct Maker {
  std::size_t kind = 0;
  std::vector<FieldPlace> (*places)(const Event&, Problems&) = nullptr;
};

template <class Struct>
std::vector<FieldPlace> find_places(const Event& event, Problems& problems) {
  return field_places<Struct>(event, [&](const std::string& problem) { problems.push_back(problem); });
}

const std::unordered_map<std::string_view, Maker>& makers() {
  static const std::unordered_map<std::string_view, Maker> makers = [] {
    std::unordered_map<std::string_view, Maker> all;
    std::size_t kind = 0;
#define TRACING_MAKER(given_, name_, struct_, ...) all[struct_::kName] = {++kind, find_places<struct_>};
    TRACETOOLS_EVENT_TABLE(TRACING_MAKER, )
#undef TRACING_MAKER
    return all;
  }();
  return makers;
}

// What the event is called in provider `ros2`.
std::string name_in_ros2(std::string_view name, Decoder::Provider provider) {
  constexpr std::string_view kCaret = "ros2_caret:";
  if (provider == Decoder::Provider::kRos2 || !name.starts_with(kCaret)) {
    return std::string(name);
  }
  name.remove_prefix(kCaret.size());
  return name == "dds_write" ? std::string(RmwPublish::kName) : "ros2:" + std::string(name);
}

}  // namespace

const AnyEvent* Decoder::decode(const Event& event) {
  const bool is_decoded =
      visit(event, [this]<class Struct>(Struct& fields) { decoded_.emplace<Struct>(std::move(fields)); });
  return is_decoded ? &decoded_ : nullptr;
}

const Decoder::Plan& Decoder::make_plan(const Event& event) {
  const std::size_t id = event.event_class->id;
  if (id >= plans_.size()) {
    plans_.resize(id + 1);
  }
  Plan& plan = plans_[id];
  plan.is_known = true;
  const auto maker = makers().find(name_in_ros2(event.name(), provider_));
  if (maker != makers().end()) {
    Problems problems;
    plan.kind = maker->second.kind;
    plan.places = maker->second.places(event, problems);
    for (const std::string& problem : problems) {
      report_(problem);
    }
  }
  return plan;
}

}  // namespace tracing::ros2
