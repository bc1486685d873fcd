// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/field_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

FieldPath::FieldPath(std::shared_ptr<const MessageType> message) : type_{FieldKind::kMessage, std::move(message)} {}

FieldPath::FieldPath(std::shared_ptr<const MessageType> message, const LocatedText& path)
    : FieldPath(std::move(message)) {
  const std::string_view text = path.text();
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '.') {
      ++at;
      continue;
    }
    if (text[at] == '[') {
      const std::size_t end = std::min(text.find(']', at), text.size());
      std::size_t index = 0;
      const auto [read, error] = std::from_chars(text.data() + at + 1, text.data() + end, index);
      if (error != std::errc() || read != text.data() + end || end == text.size()) {
        throw LaunchError("an index is a number in brackets, such as [0]", path.range(at, end - at));
      }
      if (type_.many == Many::kOne) {
        throw LaunchError(fmt::format("'{}' has no elements: it is {}", text.substr(0, at), to_string(type_)),
                          path.range(at, end + 1 - at));
      }
      if (type_.many == Many::kArray && index >= type_.count) {
        throw LaunchError(fmt::format("{} has no element {}", to_string(type_), index), path.range(at, end + 1 - at),
                          fmt::format("the last one is [{}]", type_.count - 1));
      }
      type_ = type_.element();
      positions_.push_back(index);
      at = end + 1;
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(".[", at), text.size());
    const std::string name(text.substr(at, end - at));
    if (type_.many != Many::kOne || type_.kind != FieldKind::kMessage) {
      throw LaunchError(fmt::format("{} has no field '{}'", to_string(type_), name), path.range(at, name.size()),
                        type_.many != Many::kOne ? "choose an element first, such as [0]" : "");
    }
    const MessageField* const field = type_.message->find(name);
    if (field == nullptr) {
      throw LaunchError(fmt::format("{} has no field '{}'", type_.message->name, name), path.range(at, name.size()),
                        did_you_mean(name, type_.message->field_names()));
    }
    positions_.push_back(static_cast<std::size_t>(field - type_.message->fields.data()));
    const FieldType next = field->type;  // `field` lives in the type that is replaced
    type_ = next;
    at = end;
  }
}

const MessageValue* FieldPath::find(const MessageValue& message) const {
  const MessageValue* value = &message;
  for (const std::size_t position : positions_) {
    if (position >= value->list().size()) {
      return nullptr;
    }
    value = &value->list()[position];
  }
  return value;
}

}  // namespace launch
