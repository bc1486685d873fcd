// SPDX-License-Identifier: Apache-2.0
// What the items of <test> have in common.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

// The declarations.
AttributeSpec own_attribute(std::string name, AttributeType type, bool required, std::string fallback,
                            std::string help);
AttributeSpec process_attribute(bool required);
ItemSpec expectation_item(std::string tag, std::string help, std::vector<AttributeSpec> attributes);

// The number of an attribute, if it is given. Throws LaunchError for a literal below zero.
std::optional<NumberField> from_zero(const Fields& fields, const char* attribute);

Duration as_duration(double seconds);

// The process that an item speaks of, and the time that it gives.
class ExpectationSubject {
 public:
  explicit ExpectationSubject(const Fields& fields);
  const SourceRange& where() const { return where_; }

  template <typename What>
  Expectation of(What what, Scope& scope) const {
    Expectation expectation = perform(scope);
    expectation.what = std::move(what);
    return expectation;
  }

 private:
  Expectation perform(Scope& scope) const;

  SourceRange where_;
  std::optional<Template> process_;
  std::optional<NumberField> within_;
};

}  // namespace launch
