// SPDX-License-Identifier: Apache-2.0
// A condition on the fields of an event: `data > 3 && topic_name == "/chatter"`.
//
//   expression = and { "||" and }        comparison = FIELD [operator value]
//   and        = not { "&&" not }        operator   = == != < <= > >= =~ (a regular expression that matches somewhere)
//   not        = "!" not | "(" expression ")" | comparison
//
// A field is a field of the payload, a member of one of its structures (`a.b`), an element (`gid[0]`), or one of
// `cpu_id`, `vpid`, `vtid` and `procname`. A comparison with a field that the event does not have is false. A field
// alone is true if the event has it and it is not 0, false or empty.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tracing/reader/event.hpp"

namespace tracing {

// The text is not an expression. `column` counts from 0.
class ExpressionError : public std::runtime_error {
 public:
  ExpressionError(const std::string& what, std::size_t column) : std::runtime_error(what), column_(column) {}
  std::size_t column() const { return column_; }

 private:
  std::size_t column_;
};

class FieldExpression {
 public:
  // Throws ExpressionError.
  explicit FieldExpression(std::string_view text);
  FieldExpression(FieldExpression&&) noexcept;
  FieldExpression& operator=(FieldExpression&&) noexcept;
  ~FieldExpression();

  bool holds(const Event& event) const;

  struct Node;

 private:
  std::unique_ptr<const Node> root_;
};

}  // namespace tracing
