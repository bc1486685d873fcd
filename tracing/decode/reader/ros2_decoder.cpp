// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/ros2_decoder.hpp"

#include <unordered_map>

#include "tracing/decode/reader/struct_fields.hpp"

namespace tracing::ros2 {

struct Decoder::Plan {
  void (*decode)(const Plan&, const Event&, AnyEvent&) = nullptr;  // null: not an event of ros2_tracing
  std::vector<std::uint8_t> index;  // indices in the recorded payload of the struct's fields, in order
};

namespace {

using Problems = std::vector<std::string>;

template <class Struct>
void decode_as(const Decoder::Plan& plan, const Event& event, AnyEvent& decoded) {
  read_fields(event, plan.index, decoded.emplace<Struct>());
}

template <class Struct>
Problems make_plan(const Event& event, Decoder::Plan& plan) {
  Problems problems;
  plan.index = field_indices<Struct>(event, [&](const std::string& problem) { problems.push_back(problem); });
  plan.decode = decode_as<Struct>;
  return problems;
}

using MakePlan = Problems (*)(const Event&, Decoder::Plan&);

const std::unordered_map<std::string_view, MakePlan>& plan_makers() {
#define TRACING_MAKER(given_, name_, struct_, ...) {struct_::kName, make_plan<struct_>},
  static const std::unordered_map<std::string_view, MakePlan> makers{TRACETOOLS_EVENT_TABLE(TRACING_MAKER, )};
#undef TRACING_MAKER
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

Decoder::Decoder(std::function<void(const std::string&)> report, Provider provider)
    : report_(std::move(report)), provider_(provider) {}
Decoder::~Decoder() = default;

const AnyEvent* Decoder::decode(const Event& event) {
  const Plan& plan = plan_for(event);
  if (plan.decode == nullptr) {
    return nullptr;
  }
  plan.decode(plan, event, decoded_);
  return &decoded_;
}

const Decoder::Plan& Decoder::plan_for(const Event& event) {
  const std::size_t id = event.event_class->id;
  if (id >= plans_.size()) {
    plans_.resize(id + 1);
  }
  if (plans_[id]) {
    return *plans_[id];
  }

  plans_[id] = std::make_unique<Plan>();
  const auto maker = plan_makers().find(name_in_ros2(event.name(), provider_));
  if (maker != plan_makers().end()) {
    for (const std::string& problem : maker->second(event, *plans_[id])) {
      report_(problem);
    }
  }
  return *plans_[id];
}

}  // namespace tracing::ros2
