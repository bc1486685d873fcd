// SPDX-License-Identifier: Apache-2.0
// What all events of one class of streams share: their layout, and where they have the contexts that an Event has
// members for. Private to the reader.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "tracing/decode/ctf/event_layout.hpp"
#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/decode/reader/event.hpp"

namespace tracing {

class StreamClass {
 public:
  StreamClass(const ctf::TraceClass& trace, const ctf::StreamDeclaration& stream)
      : layout_(trace, stream), vpid_(context("vpid")), vtid_(context("vtid")), procname_(context("procname")) {
    has_usual_contexts_ = vpid_ && vpid_->offset && vtid_ && vtid_->offset && procname_ && procname_->offset;
    if (has_usual_contexts_) {
      usual_ = {*vpid_->offset, *vtid_->offset, *procname_->offset,
                layout_.event_context().fixed_places()[procname_->index].length};
    }
  }

  const ctf::StreamLayout& layout() const { return layout_; }

  // The name in the last event of a stream, which the next one mostly has, too.
  struct LastName {
    std::array<std::uint64_t, 2> words{};
    std::size_t length = 0;
  };

  // Leaves members alone whose contexts the stream does not have.
  [[gnu::always_inline]] void read_contexts(const ctf::Record& contexts, Event& event, LastName& last_name) const {
    if (has_usual_contexts_ && contexts.base != nullptr) [[likely]] {
      event.vpid.emplace(number_at(contexts.base + usual_.vpid));
      event.vtid.emplace(number_at(contexts.base + usual_.vtid));
      const auto* const name = reinterpret_cast<const char*>(contexts.base + usual_.procname);
      event.procname.emplace(name, length_of_name(name, last_name));
      return;
    }
    if (vpid_) {
      read_number(contexts, *vpid_, event.vpid);
    }
    if (vtid_) {
      read_number(contexts, *vtid_, event.vtid);
    }
    if (procname_) {
      read_text(contexts, *procname_, event.procname);
    }
  }

 private:
  struct Context {
    std::size_t index = 0;                // in the structure
    std::optional<std::uint32_t> offset;  // bytes from its beginning, for a usual type with a fixed place
  };

  std::optional<Context> context(std::string_view name) const {
    const ctf::StructureDecoder& contexts = layout_.event_context();
    const std::optional<std::size_t> index = contexts.index_of(name);
    if (!index) {
      return std::nullopt;
    }
    Context context{*index, std::nullopt};
    const ctf::FieldClass& type = *contexts.type()->members[*index].type;
    const bool is_usual = type.access == ctf::NumberAccess::kSigned32 || type.is_characters();
    if (contexts.fixed_size() && is_usual) {
      context.offset = contexts.fixed_places()[*index].offset;
    }
    return context;
  }

  // Both functions write the value in its place: returning an optional takes longer than reading the value.
  [[gnu::always_inline]] static void read_number(const ctf::Record& contexts, const Context& context,
                                                 std::optional<std::int64_t>& value) {
    if (!context.offset || contexts.base == nullptr) {
      value = contexts[context.index].integer();
      return;
    }
    value.emplace(number_at(contexts.base + *context.offset));
  }
  [[gnu::always_inline]] static std::int64_t number_at(const std::uint8_t* bytes) {
    std::int32_t number = 0;
    std::memcpy(&number, bytes, sizeof number);
    return number;
  }
  [[gnu::always_inline]] static void read_text(const ctf::Record& contexts, const Context& context,
                                               std::optional<std::string_view>& value) {
    if (!context.offset || contexts.base == nullptr) {
      value = contexts[context.index].string();
      return;
    }
    const auto* const bytes = reinterpret_cast<const char*>(contexts.base + *context.offset);
    value.emplace(bytes, text_length(bytes, contexts.places[context.index].length));
  }
  [[gnu::always_inline]] std::size_t length_of_name(const char* name, LastName& last) const {
    if (usual_.procname_length < sizeof last.words) [[unlikely]] {
      return text_length(name, usual_.procname_length);
    }
    std::array<std::uint64_t, 2> words;
    std::memcpy(words.data(), name, sizeof words);
    if (words != last.words || last.length >= sizeof words) [[unlikely]] {
      last = {words, text_length(name, usual_.procname_length)};
    }
    return last.length;
  }
  // As strnlen(), for short texts behind which there are eight bytes to read.
  [[gnu::always_inline]] static std::size_t text_length(const char* bytes, std::size_t most) {
    if constexpr (std::endian::native != std::endian::little) {
      return strnlen(bytes, most);
    }
    constexpr std::uint64_t kOnes = 0x0101010101010101;
    constexpr std::uint64_t kHighBits = kOnes << 7;
    for (std::size_t at = 0; at < most; at += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + at, sizeof word);
      // The lowest high bit that is set stands in the first byte that is 0.
      if (const std::uint64_t zeros = (word - kOnes) & ~word & kHighBits) {
        return std::min(most, at + static_cast<std::size_t>(std::countr_zero(zeros)) / 8);
      }
    }
    return most;
  }

  ctf::StreamLayout layout_;
  std::optional<Context> vpid_;
  std::optional<Context> vtid_;
  std::optional<Context> procname_;
  // All three are there, at fixed places; bytes from the beginning of the structure.
  struct UsualContexts {
    std::uint32_t vpid = 0;
    std::uint32_t vtid = 0;
    std::uint32_t procname = 0;
    std::uint32_t procname_length = 0;
  };
  bool has_usual_contexts_ = false;
  UsualContexts usual_;
};

}  // namespace tracing
