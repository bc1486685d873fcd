// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/substitution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace launch {

std::string Text::describe() const {
  return fmt::format("'{}'", text_);
}

Template::Template(std::vector<SubstitutionPtr> parts, SourceRange where)
    : body_(std::make_shared<const Body>(Body{std::nullopt, std::move(parts), std::move(where)})) {}

Template::Template(std::string literal, SourceRange where)
    : body_(std::make_shared<const Body>(Body{std::move(literal), {}, std::move(where)})) {}

std::string Template::perform(Scope& scope) const {
  std::string result;
  if (body_ == nullptr) {
    return result;
  }
  if (body_->literal) {
    return *body_->literal;
  }
  for (const SubstitutionPtr& part : body_->parts) {
    result += part->perform(scope);
  }
  return result;
}

std::string Template::describe() const {
  if (empty()) {
    return "''";
  }
  std::string result;
  for (const SubstitutionPtr& part : parts()) {
    result += (result.empty() ? "" : " + ") + part->describe();
  }
  return result;
}

bool Template::is_literal() const {
  return body_ == nullptr || body_->literal ||
         std::all_of(body_->parts.begin(), body_->parts.end(),
                     [](const SubstitutionPtr& part) { return dynamic_cast<const Text*>(part.get()) != nullptr; });
}

std::vector<SubstitutionPtr> Template::parts() const {
  if (body_ == nullptr) {
    return {};
  }
  if (body_->literal) {
    return {std::make_shared<const Text>(*body_->literal, body_->where)};
  }
  return body_->parts;
}

const SourceRange& Template::where() const {
  static const SourceRange nowhere;
  return body_ == nullptr ? nowhere : body_->where;
}

}  // namespace launch
