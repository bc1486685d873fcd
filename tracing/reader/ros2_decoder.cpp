// SPDX-License-Identifier: Apache-2.0
#include "tracing/reader/ros2_decoder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace tracing::ros2 {

namespace {

constexpr std::uint8_t kMissing = 0xff;

// Each function returns false, and leaves the member alone, when the recorded field has another type.
template <FieldType type, class Member>
bool read_field(FieldValue field, Member& member) {
  if constexpr (type == FieldType::kPointer || type == FieldType::kUint64) {
    const std::optional<std::uint64_t> value = field.unsigned_integer();
    if (value) member = *value;
    return value.has_value();
  } else if constexpr (type == FieldType::kInt64) {
    const std::optional<std::int64_t> value = field.integer();
    if (value) member = *value;
    return value.has_value();
  } else if constexpr (type == FieldType::kBool) {
    const std::optional<std::int64_t> value = field.integer();
    if (value) member = *value != 0;
    return value.has_value();
  } else if constexpr (type == FieldType::kString) {
    const std::optional<std::string_view> value = field.string();
    if (value) member = *value;
    return value.has_value();
  } else if constexpr (type == FieldType::kGid) {
    member.size = std::min(field.size(), member.bytes.size());
    for (std::size_t i = 0; i < member.size; ++i) {
      member.bytes[i] = static_cast<std::uint8_t>(field[i].unsigned_integer().value_or(0));
    }
    return field.is_array();
  } else {
    static_assert(type == FieldType::kPointers);
    member.resize(field.size());
    for (std::size_t i = 0; i < member.size(); ++i) member[i] = field[i].unsigned_integer().value_or(0);
    return field.is_array();
  }
}

constexpr std::string_view type_name(FieldType type) {
  switch (type) {
    case FieldType::kPointer:
      return "a pointer";
    case FieldType::kString:
      return "a string";
    case FieldType::kUint64:
      return "an unsigned integer";
    case FieldType::kInt64:
      return "an integer";
    case FieldType::kBool:
      return "a boolean";
    case FieldType::kGid:
      return "an array of bytes";
    case FieldType::kPointers:
      return "a sequence of pointers";
  }
  return "";
}

}  // namespace

struct Decoder::Plan {
  void (*decode)(const Plan&, const Event&, AnyEvent&) = nullptr;  // null: not an event of ros2_tracing
  std::vector<std::uint8_t> index;  // indices in the recorded payload of the struct's fields, in order
};

namespace {

using Problems = std::vector<std::string>;

template <class Struct>
void decode_as(const Decoder::Plan& plan, const Event& event, AnyEvent& decoded) {
  Struct& result = decoded.emplace<Struct>();
  const std::uint8_t* index = plan.index.data();
  Struct::for_each_field(result, [&]<FieldType type>(std::string_view, auto& member) {
    if (const std::uint8_t field = *index++; field != kMissing) read_field<type>(event.field(field), member);
  });
}

std::string problem_of(std::string_view event, std::string_view field, FieldType expected, bool recorded) {
  return recorded ? fmt::format("{}: field {} is not {}", event, field, type_name(expected))
                  : fmt::format("{} has no field {}", event, field);
}

// Finds the fields by name, because versions of ros2_tracing have different fields.
template <class Struct>
Problems make_plan(const Event& event, Decoder::Plan& plan) {
  Problems problems;
  Struct example;
  Struct::for_each_field(example, [&]<FieldType type>(std::string_view name, auto& member) {
    const std::optional<std::size_t> found = event.event_class->index_of(name);
    if (found && *found < kMissing && read_field<type>(event.field(*found), member)) {
      plan.index.push_back(static_cast<std::uint8_t>(*found));
      return;
    }
    plan.index.push_back(kMissing);
    problems.push_back(problem_of(Struct::kName, name, type, found.has_value()));
  });
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

}  // namespace

Decoder::Decoder(std::function<void(const std::string&)> report) : report_(std::move(report)) {}
Decoder::~Decoder() = default;

const AnyEvent* Decoder::decode(const Event& event) {
  const Plan& plan = plan_for(event);
  if (plan.decode == nullptr) return nullptr;
  plan.decode(plan, event, decoded_);
  return &decoded_;
}

const Decoder::Plan& Decoder::plan_for(const Event& event) {
  const std::size_t id = event.event_class->id;
  if (id >= plans_.size()) plans_.resize(id + 1);
  if (plans_[id]) return *plans_[id];

  plans_[id] = std::make_unique<Plan>();
  const auto maker = plan_makers().find(event.name());
  if (maker != plan_makers().end()) {
    for (const std::string& problem : maker->second(event, *plans_[id])) report_(problem);
  }
  return *plans_[id];
}

}  // namespace tracing::ros2
