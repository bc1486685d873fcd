// SPDX-License-Identifier: Apache-2.0
// <channel> in <trace>: separate buffers for some events.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "launcher/language/fields.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace launch {

enum class Tracepoints { kUserspace /* PROVIDER:NAME */, kKernel /* NAME */ };

// An optional list of words, and its place.
class WordsField {
 public:
  WordsField(const Fields& fields, std::string_view attribute);

  bool given() const { return words_.has_value(); }
  const SourceRange& where() const { return where_; }
  // The names, without empty ones that empty substitutions leave. A substitution may give several names at once, as in
  // context-fields="$(var fields)". Empty when the attribute is not given.
  std::vector<std::string> perform(Scope& scope) const;
  // The event rules. A substitution may give a rule with blanks, or several names. Throws LaunchError.
  std::vector<std::string> perform_events(Scope& scope, Tracepoints of) const;

 private:
  std::vector<std::string> performed_words(Scope& scope) const;

  std::optional<std::vector<Template>> words_;
  SourceRange where_;
};

// A number that must not be negative. LTTng's timers are 32 bits wide, so more than 71 minutes count as never.
std::optional<NumberField> count_field(const Fields& fields, std::string_view attribute);
std::uint64_t count(const NumberField& field, Scope& scope);
std::uint32_t microseconds(const NumberField& field, Scope& scope);

class ChannelFields {
 public:
  static ItemSpec item();

  explicit ChannelFields(const Fields& fields);
  // Throws LaunchError.
  tracing::ChannelConfig perform(Scope& scope) const;
  // Of its events, which a check looks at.
  const SourceRange& events_where() const { return events_ust_.where(); }
  const SourceRange& context_where() const { return context_fields_.where(); }

 private:
  Template name_;
  WordsField events_ust_;
  WordsField events_kernel_;
  WordsField syscalls_;
  WordsField context_fields_;
  std::optional<NumberField> subbuffer_size_;
  std::optional<NumberField> subbuffer_count_;
  std::optional<NumberField> read_timer_;
  std::optional<NumberField> switch_timer_;
  std::optional<BooleanField> overwrite_;
  std::optional<NumberField> blocking_timeout_;
};

}  // namespace launch
