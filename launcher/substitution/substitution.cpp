#include "launcher/substitution/substitution.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launch {

std::string Text::describe() const {
  return fmt::format("'{}'", text_);
}

std::string Template::perform(Scope& scope) const {
  std::string result;
  for (const SubstitutionPtr& part : parts_) {
    result += part->perform(scope);
  }
  return result;
}

std::string Template::describe() const {
  if (parts_.empty()) {
    return "''";
  }
  std::string result;
  for (const SubstitutionPtr& part : parts_) {
    result += (result.empty() ? "" : " + ") + part->describe();
  }
  return result;
}

bool Template::is_literal() const {
  return std::all_of(parts_.begin(), parts_.end(),
                     [](const SubstitutionPtr& part) { return dynamic_cast<const Text*>(part.get()) != nullptr; });
}

}  // namespace launch
