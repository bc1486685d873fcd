// SPDX-License-Identifier: Apache-2.0
// A condition on the fields of an event: `data > 3 && topic_name == "/chatter"`.
//
//   expression = and { "||" and }        comparison = FIELD [operator value]
//   and        = not { "&&" not }        operator   = == != < <= > >= =~ (a regular expression that matches somewhere)
//   not        = "!" not | "(" expression ")" | comparison
//
// A field is a field of the payload, a member of one of its structures (`a.b`), an element (`gid[0]`), `cpu_id`, or a
// context such as `vpid`, if the payload has no field of this name. A comparison with a field that the event does not
// have is false. A field alone is true if the event has it and it is not 0, false or empty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tracing/decode/reader/event.hpp"

namespace tracing {

// The text is not an expression. `column` counts from 0.
class ExpressionError : public std::runtime_error {
 public:
  ExpressionError(const std::string& what, std::size_t column) : std::runtime_error(what), column_(column) {}
  std::size_t column() const { return column_; }

 private:
  std::size_t column_;
};

// Where a value is in an event: a field, then a member or an element of what stands there, and so on.
struct FieldPath {
  using Part = std::variant<std::string, std::size_t>;
  std::string first;
  std::vector<Part> rest;
};

// What stands there. Anything that is neither a number nor a text counts by the number of its parts.
struct FieldParts {
  std::size_t count = 0;
};
struct FieldContent {
  std::variant<std::int64_t, std::uint64_t, double, std::string_view, FieldParts> value;
  std::optional<std::string_view> label;  // of an enumeration; a text is compared with the label
};

class FieldExpression {
 public:
  // Throws ExpressionError.
  explicit FieldExpression(std::string_view text);
  FieldExpression(FieldExpression&&) noexcept;
  FieldExpression& operator=(FieldExpression&&) noexcept;
  ~FieldExpression();

  bool holds(const Event& event) const;
  // The same for an event that is stored in another way. `look_up` returns nothing for a field that the event lacks.
  using LookUp = std::function<std::optional<FieldContent>(const FieldPath&)>;
  bool holds(const LookUp& look_up) const;

  // The first names of all paths in the expression, in their order, each once.
  std::vector<std::string> fields() const;

  struct Node;

 private:
  std::unique_ptr<const Node> root_;
};

}  // namespace tracing
