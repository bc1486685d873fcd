// SPDX-License-Identifier: Apache-2.0
// A condition on the fields of a message or of an event: `data > 3`, `not frame == 'map' && len(ranges) > 5`.
//
//   condition   and { ("or" | "||") and }
//   and         not { ("and" | "&&") not }
//   not         ("not" | "!") not | "(" condition ")" | comparison
//   comparison  operand { relation operand }      a chain such as 1 < x < 3 holds if each relation in it does
//   relation    == != < <= > >= =~ (a regular expression in quotes that matches somewhere in the text)
//   operand     FieldPath | len(FieldPath) | number | text in ' or " | true | false
//
// A comparison with a field that is not there, or of a text with a number, does not hold. An operand alone holds if it
// is there and is not 0, false or empty. MessageCondition and EventCondition know the fields; who uses a condition uses
// these.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/conditions/field_path.hpp"

namespace launch {

// What stands in a field; a bool is 0 or 1. Anything that is neither a number nor a text counts by the number of its
// parts.
struct FieldParts {
  std::size_t count = 0;
};
struct FieldContent {
  std::variant<std::int64_t, std::uint64_t, double, std::string_view, FieldParts> value;
  std::optional<std::string_view> label = std::nullopt;  // of an enumeration; a text is compared with the label
};

class FieldCondition {
 public:
  // Fields of events have no declared type. A word behind `field ==` is therefore taken for a text that lacks its
  // quotes, and no field. A backslash in a text of an event stays, unless a quote or a backslash follows. In a text of
  // a message it makes any next character plain, unless the text is a regular expression.
  enum class Of { kMessages, kEvents };

  // Throws LaunchError at the place of a mistake.
  FieldCondition(const LocatedText& text, Of of);

  // All fields that are named, in the order of the text.
  const std::vector<FieldPath>& fields() const { return fields_; }

  // `look_up` returns the content of fields()[i], or nothing if there is no such field.
  using LookUp = std::function<std::optional<FieldContent>(std::size_t i)>;
  bool holds(const LookUp& look_up) const;

  // The parts of the text, for checks of types.
  enum class Relation { kEqual, kNotEqual, kLessOrEqual, kGreaterOrEqual, kMatches, kLess, kGreater };
  struct Operand {
    enum class Kind { kField, kLength, kNumber, kText, kBool };
    Kind kind = Kind::kNumber;
    std::variant<std::int64_t, std::uint64_t, double, std::string> value;
    SourceRange where;
    std::size_t field = 0;                                    // of kField and kLength: its place in fields()
    std::function<bool(std::string_view)> matches = nullptr;  // of a text behind =~
  };
  struct Node {
    enum class Kind { kOr, kAnd, kNot, kComparison };
    Kind kind = Kind::kComparison;
    std::vector<Node> parts;          // of all but a comparison
    std::vector<Operand> operands;    // of a comparison
    std::vector<Relation> relations;  // between its operands
  };
  const Node& root() const { return root_; }

 private:
  std::vector<FieldPath> fields_;
  Node root_;
};

}  // namespace launch
