// SPDX-License-Identifier: Apache-2.0
// The fields of a random trace: every kind that CTF has, also within one another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "tests/support/trace_writer/bit_writer.hpp"

namespace tracing::testing {

// A field: its declaration in the metadata, with @ for its name, and a function that writes a value.
struct RandomField {
  std::string declaration;
  std::uint32_t alignment = 1;
  std::function<void(BitWriter&)> write;
};

class RandomFields {
 public:
  // `random`, which must live on, decides the shapes and the values. `natural`: numbers are aligned to their size.
  RandomFields(std::function<std::uint64_t()>& random, bool natural) : random_(random), natural_(natural) {}
  // The functions of its fields refer to it.
  RandomFields(const RandomFields&) = delete;
  RandomFields& operator=(const RandomFields&) = delete;

  // The members of a structure.
  RandomField structure(int depth);
  // Contexts that LTTng records, which readers look at for each event.
  RandomField usual_contexts();

 private:
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }
  std::uint32_t number_alignment(std::uint32_t size) const;
  std::string integer_text(std::uint32_t size) const;
  RandomField random_integer();
  RandomField random_real();
  RandomField random_string();
  RandomField random_text_sequence();
  RandomField random_text_array();
  RandomField random_enumeration();
  RandomField random_array(int depth);
  RandomField random_sequence(int depth);
  RandomField random_variant(int depth);
  RandomField random_structure(int depth);
  RandomField random_field(int depth, bool as_member);

  std::function<std::uint64_t()>& random_;
  bool natural_;
  std::size_t lengths_ = 0;
};

}  // namespace tracing::testing
