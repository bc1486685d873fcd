// SPDX-License-Identifier: Apache-2.0
#include "tests/support/trace_writer/random_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

namespace tracing::testing {
namespace {

void name_it(std::string& declaration, const std::string& name) {
  declaration.replace(declaration.rfind('@'), 1, name);
}

std::string integer(std::uint32_t size, std::uint32_t alignment, bool is_signed, const char* rest = "") {
  return fmt::format("integer {{ size = {}; align = {}; signed = {}; {} }}", size, alignment, is_signed ? 1 : 0, rest);
}

}  // namespace

std::uint32_t RandomFields::number_alignment(std::uint32_t size) const {
  return natural_ && std::has_single_bit(size) && size >= 8 ? size : 8;
}

RandomField RandomFields::random_integer() {
  if (below(6) == 0) {  // a bit field
    const auto size = static_cast<std::uint32_t>(1 + below(40));
    return {integer(size, 1, below(2) == 0) + " @;", 1, [this, size](BitWriter& out) { out.number(random_(), size); }};
  }
  const std::uint32_t size = 8U << below(4);
  const std::uint32_t alignment = number_alignment(size);
  const bool is_signed = below(2) == 0;
  return {integer(size, alignment, is_signed, below(2) == 0 ? "base = 16;" : "") + " @;", alignment,
          [this, size, alignment](BitWriter& out) {
            out.align(alignment);
            out.number(random_(), size);
          }};
}

RandomField RandomFields::random_real() {
  const bool is_double = below(2) == 0;
  const std::uint32_t size = is_double ? 64 : 32;
  const std::uint32_t alignment = number_alignment(size);
  return {fmt::format("floating_point {{ exp_dig = {}; mant_dig = {}; align = {}; }} @;", is_double ? 11 : 8,
                      is_double ? 53 : 24, alignment),
          alignment, [this, is_double, size, alignment](BitWriter& out) {
            const double value = static_cast<double>(below(1'000'000)) / 7 - 70'000;
            out.align(alignment);
            out.number(is_double ? std::bit_cast<std::uint64_t>(value)
                                 : std::bit_cast<std::uint32_t>(static_cast<float>(value)),
                       size);
          }};
}

RandomField RandomFields::random_string() {
  return {"string @;", 8, [this](BitWriter& out) {
            out.align(8);
            out.text(std::string(below(20), static_cast<char>('a' + below(26))));
          }};
}

// Characters, as many as the field before says.
RandomField RandomFields::random_text_sequence() {
  const std::uint32_t alignment = number_alignment(16);
  const std::size_t name = lengths_++;
  return {fmt::format("{} __length{};\n{} @[ __length{} ];", integer_text(16), name,
                      integer(8, 8, true, "encoding = UTF8;"), name),
          alignment, [this, alignment](BitWriter& out) {
            const std::uint64_t length = below(12);
            out.align(alignment);
            out.number(length, 16);
            for (std::uint64_t i = 0; i < length; ++i) {
              out.number('a' + below(26), 8);
            }
          }};
}

RandomField RandomFields::random_text_array() {
  const std::uint64_t length = 1 + below(17);
  return {integer(8, 8, true, "encoding = UTF8;") + fmt::format(" @[{}];", length), 8, [this, length](BitWriter& out) {
            out.align(8);
            const std::uint64_t used = below(length + 1);
            for (std::uint64_t i = 0; i < length; ++i) {
              out.number(i < used ? 'x' : 0, 8);
            }
          }};
}

RandomField RandomFields::random_enumeration() {
  const std::uint32_t size = 8U << below(3);
  return {fmt::format("enum : {} {{ \"A\" = 0, B = 1 ... 3, \"c d\" = 7 }} @;", integer_text(size)),
          number_alignment(size), [this, size, alignment = number_alignment(size)](BitWriter& out) {
            out.align(alignment);
            out.number(below(9), size);
          }};
}
std::string RandomFields::integer_text(std::uint32_t size) const {
  return fmt::format("integer {{ size = {}; align = {}; signed = 0; }}", size, number_alignment(size));
}

RandomField RandomFields::random_array(int depth) {
  RandomField element = random_field(depth - 1, false);
  const std::uint64_t length = below(5);
  name_it(element.declaration, fmt::format("@[{}]", length));
  element.write = [length, alignment = element.alignment, each = element.write](BitWriter& out) {
    out.align(alignment);  // also when there are no elements
    for (std::uint64_t i = 0; i < length; ++i) {
      each(out);
    }
  };
  return element;
}

// A field before it holds its length.
RandomField RandomFields::random_sequence(int depth) {
  if (below(3) == 0) {
    return random_text_sequence();
  }
  RandomField element = random_field(depth - 1, false);
  const std::uint32_t alignment = number_alignment(32);
  name_it(element.declaration, fmt::format("@[ __length{} ]", lengths_));
  element.declaration = fmt::format("{} __length{};\n{}", integer_text(32), lengths_++, element.declaration);
  element.write = [this, alignment, of_elements = element.alignment, each = element.write](BitWriter& out) {
    const std::uint64_t length = below(6);
    out.align(alignment);
    out.number(length, 32);
    out.align(of_elements);
    for (std::uint64_t i = 0; i < length; ++i) {
      each(out);
    }
  };
  element.alignment = std::max(element.alignment, alignment);
  return element;
}

RandomField RandomFields::random_variant(int depth) {
  std::vector<RandomField> options;
  for (std::uint64_t i = 0, count = 2 + below(2); i < count; ++i) {
    options.push_back(random_field(depth - 1, false));
  }
  const std::uint32_t size = 8;
  std::string labels;
  std::string declarations;
  for (std::size_t i = 0; i < options.size(); ++i) {
    labels += fmt::format("{}\"option{}\" = {}", i == 0 ? "" : ", ", i, i);
    std::string declaration = options[i].declaration;
    name_it(declaration, fmt::format("option{}", i));
    declarations += declaration;
  }
  const std::size_t tag = lengths_++;
  return {fmt::format("enum : {} {{ {} }} _tag{};\nvariant <_tag{}> {{ {} }} @;", integer_text(size), labels, tag, tag,
                      declarations),
          8, [this, options](BitWriter& out) {
            const std::size_t chosen = below(options.size());
            out.align(8);
            out.number(chosen, size);
            options[chosen].write(out);
          }};
}

RandomField RandomFields::random_structure(int depth) {
  const RandomField inside = structure(depth - 1);
  return {fmt::format("struct {{ {} }} @;", inside.declaration), inside.alignment, inside.write};
}

// Contexts that LTTng records, which readers look at for each event.
RandomField RandomFields::usual_contexts() {
  return {integer(32, 8, true) + " _vpid;" + integer(32, 8, true) + " _vtid;" +
              integer(8, 8, true, "encoding = UTF8;") + " _procname[17];",
          8, [this](BitWriter& out) {
            out.align(8);
            out.number(below(1000), 32);
            out.number(random_(), 32);
            const std::uint64_t used = below(16);
            for (std::uint64_t i = 0; i < 17; ++i) {
              out.number(i < used ? 'n' : 0, 8);
            }
          }};
}

// A type that needs a field before it can't be an element or an option.
RandomField RandomFields::random_field(int depth, bool as_member) {
  const std::uint64_t kinds = depth > 0 ? 10 : 6;
  for (;;) {
    const std::uint64_t kind = below(kinds);
    if (kind <= 1) {
      return random_integer();
    }
    if (kind == 2) {
      return random_real();
    }
    if (kind == 3) {
      return random_string();
    }
    if (kind == 5) {
      return random_enumeration();
    }
    if (kind == 9) {
      return random_structure(depth);
    }
    if (!as_member) {
      continue;
    }
    if (kind == 4) {
      return random_text_array();
    }
    if (kind == 6) {
      return random_array(depth);
    }
    if (kind == 7) {
      return random_sequence(depth);
    }
    return random_variant(depth);
  }
}

// The members of a structure.
RandomField RandomFields::structure(int depth) {
  std::vector<RandomField> members;
  std::string declaration;
  std::uint32_t alignment = 1;
  const std::uint64_t count = below(6);
  for (std::uint64_t i = 0; i < count; ++i) {
    members.push_back(random_field(depth, true));
    std::string member = members.back().declaration;
    name_it(member, fmt::format("_field{}", i));
    declaration += member + "\n";
    alignment = std::max(alignment, members.back().alignment);
  }
  return {declaration, alignment, [members, alignment](BitWriter& out) {
            out.align(alignment);
            for (const RandomField& member : members) {
              member.write(out);
            }
          }};
}

}  // namespace tracing::testing
