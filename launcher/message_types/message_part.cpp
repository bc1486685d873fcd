// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/message_part.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

MessagePart::MessagePart(std::shared_ptr<const MessageType> message, const FieldPath& path, const LocatedText& text)
    : type_{FieldKind::kMessage, std::move(message)} {
  for (const FieldPath::Part& part : path.parts) {
    const SourceRange where = text.range(part.begin, part.end - part.begin);
    if (const auto* const index = std::get_if<std::size_t>(&part.step)) {
      if (type_.many == Many::kOne) {
        const std::size_t begin = path.parts.front().begin;
        throw LaunchError(fmt::format("'{}' has no elements: it is {}", text.text().substr(begin, part.begin - begin),
                                      to_string(type_)),
                          where);
      }
      if (type_.many == Many::kArray && *index >= type_.count) {
        throw LaunchError(fmt::format("{} has no element {}", to_string(type_), *index), where,
                          fmt::format("the last one is [{}]", type_.count - 1));
      }
      type_ = type_.element();
      positions_.push_back(*index);
      continue;
    }
    const auto& name = std::get<std::string>(part.step);
    if (type_.many != Many::kOne || type_.kind != FieldKind::kMessage) {
      throw LaunchError(fmt::format("{} has no field '{}'", to_string(type_), name), where,
                        type_.many != Many::kOne ? "choose an element first, such as [0]" : "");
    }
    const MessageField* const field = type_.message->find(name);
    if (field == nullptr) {
      throw LaunchError(fmt::format("{} has no field '{}'", type_.message->name, name), where,
                        did_you_mean(name, type_.message->field_names()));
    }
    positions_.push_back(static_cast<std::size_t>(field - type_.message->fields.data()));
    const FieldType next = field->type;  // `field` lives in the type that is replaced
    type_ = next;
  }
}

const MessageValue* MessagePart::find(const MessageValue& message) const {
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
