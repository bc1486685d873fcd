// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/inits_in_order.hpp"

#include <algorithm>
#include <type_traits>
#include <variant>

namespace tracing {

void InitsInOrder::keep(const Origin& origin, std::int64_t init_ns, const ros2::KnownCaretEvent& event) {
  OfProcess& of = kept_[origin.process];
  of.events.push_back({init_ns, origin, event});
  const auto own = [&](std::string_view& text) { text = of.texts.emplace_back(text); };
  if (auto* const caret = std::get_if<ros2::CaretEvent>(&of.events.back().event)) {
    own(caret->text);
    return;
  }
  std::visit(
      [&](auto& known) {
        using Struct = std::decay_t<decltype(known)>;
        if constexpr (!std::is_same_v<Struct, std::monostate>) {
          Struct::for_each_field(known, [&]<ros2::FieldType type>(std::string_view, auto& member) {
            if constexpr (type == ros2::FieldType::kString) {
              own(member);
            }
          });
        }
      },
      std::get<ros2::AnyEvent>(of.events.back().event));
}

const std::vector<InitsInOrder::Kept>& InitsInOrder::in_order(OfProcess& of) {
  std::stable_sort(of.events.begin(), of.events.end(),
                   [](const Kept& left, const Kept& right) { return left.init_ns < right.init_ns; });
  // What was recorded when it happened may have come once more.
  const auto is_same = [](const Kept& left, const Kept& right) {
    return left.init_ns == right.init_ns && left.event == right.event;
  };
  of.events.erase(std::unique(of.events.begin(), of.events.end(), is_same), of.events.end());
  return of.events;
}

}  // namespace tracing
