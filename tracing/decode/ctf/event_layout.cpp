// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/event_layout.hpp"

#include <algorithm>
#include <bit>
#include <string>

namespace tracing::ctf {
namespace {

constexpr std::uint64_t kDenseIds = 1 << 16;

std::uint32_t aligned(std::uint32_t bit, std::uint32_t alignment) {
  return (bit + alignment - 1) / alignment * alignment;
}

[[noreturn]] void refuse(const std::string& what) {
  throw UnsupportedTrace("event header: " + what);
}

// The members `id` and `timestamp` of a structure of numbers that begins at `bit`.
HeaderLayout::Form form_of(const FieldClass& structure, std::uint32_t bit, std::string& clock) {
  HeaderLayout::Form form;
  bit = aligned(bit, structure.alignment);
  for (const FieldMember& member : structure.members) {
    if (!member.type->is_number() || member.type->kind == FieldKind::kReal) {
      refuse("not only integers");
    }
    bit = aligned(bit, member.type->alignment);
    if (member.name == "id") {
      form.id = {bit, member.type->size};
    }
    if (!member.type->clock.empty()) {
      form.time = {bit, member.type->size};
      clock = member.type->clock;
    }
    bit += member.type->size;
  }
  form.end = bit;
  return form;
}

HeaderLayout header_layout(const FieldClass& structure, bool is_big_endian) {
  HeaderLayout layout;
  layout.alignment = structure.alignment;
  layout.is_big_endian = is_big_endian;
  const FieldMember* variant = nullptr;
  FieldClass numbers;  // the structure before the variant
  numbers.kind = FieldKind::kStructure;
  for (const FieldMember& member : structure.members) {
    if (variant != nullptr) {
      refuse("a field behind a variant");
    }
    if (member.type->kind == FieldKind::kVariant) {
      variant = &member;
    } else {
      numbers.members.push_back(member);
    }
  }
  const HeaderLayout::Form before = form_of(numbers, 0, layout.clock);
  layout.first_id = before.id;
  layout.short_form = before;
  layout.short_form.id = {};
  if (variant == nullptr) {
    return layout;
  }

  if (variant->type->path != "id" || numbers.members.empty() || numbers.members.back().name != "id") {
    refuse("a variant that is not selected by the number of the event");
  }
  const FieldClass& selector = *numbers.members.back().type;
  for (const FieldMember& option : variant->type->members) {
    if (option.type->kind != FieldKind::kStructure) {
      refuse("a variant of something else than structures");
    }
    // Places count from the beginning of the header, so no part may have a larger alignment than the header.
    if (structure.alignment % option.type->alignment != 0) {
      refuse("a part with an alignment of its own");
    }
    const HeaderLayout::Form form = form_of(*option.type, before.end, layout.clock);
    const auto range = std::find_if(selector.ranges.begin(), selector.ranges.end(),
                                    [&](const EnumerationRange& each) { return each.label == option.name; });
    if (range == selector.ranges.end()) {
      refuse("an option that no value selects");
    }
    if (form.id.size > 0) {
      layout.has_long_form = true;
      layout.long_form = form;
      layout.long_first = static_cast<std::uint64_t>(range->first);
      layout.long_last = static_cast<std::uint64_t>(range->last);
    } else {
      layout.short_form = form;
    }
  }
  return layout;
}

}  // namespace

namespace {

bool is_simple(const StructureDecoder& decoder) {
  return decoder.is_simple() && decoder.size() <= EventLayout::kMostSimpleFields;
}

}  // namespace

StreamLayout::StreamLayout(const TraceClass& trace, const StreamDeclaration& stream)
    : event_context_(stream.event_context) {
  if (!stream.event_header) {
    refuse("there is none");
  }
  header_ = header_layout(*stream.event_header, trace.is_big_endian);
  if (header_.short_form.time.size == 0) {
    refuse("it has no time");
  }
  const auto clock = trace.clocks.find(header_.clock);
  if (clock == trace.clocks.end()) {
    refuse("its clock is not declared");
  }
  clock_ = &clock->second;
  for (std::size_t i = 0; i < trace.events.size(); ++i) {
    const EventDeclaration& event = trace.events[i];
    if (event.stream_id != stream.id) {
      continue;
    }
    auto layout = std::make_unique<EventLayout>(event, i);
    layout->is_simple = is_simple(event_context_) && is_simple(layout->context) && is_simple(layout->payload);
    if (layout->is_simple && event_context_.fixed_size() && layout->context.fixed_size() &&
        layout->payload.fixed_size()) {
      layout->context_offset = *event_context_.fixed_size();
      layout->payload_offset = layout->context_offset + *layout->context.fixed_size();
      layout->fixed_size = layout->payload_offset + *layout->payload.fixed_size();
    }
    if (event.id < kDenseIds) {
      if (event.id >= dense_.size()) {
        dense_.resize(event.id + 1);
      }
      dense_[event.id] = std::move(layout);
    } else {
      sparse_[event.id] = std::move(layout);
    }
  }
  find_usual_events();
}

void StreamLayout::find_usual_events() {
  constexpr std::uint32_t kByteBits = 8;   // bits
  constexpr std::uint32_t kWordBits = 64;  // bits
  const HeaderLayout::Number& id = header_.first_id;
  const HeaderLayout::Form& form = header_.short_form;
  const auto is_in_word = [](std::uint32_t bit, std::uint32_t size) { return size > 0 && bit + size <= kWordBits; };
  const auto mask = [](std::uint32_t size) { return ~std::uint64_t{0} >> (kWordBits - size); };
  usual_header_.is_known = !header_.is_big_endian && std::endian::native == std::endian::little &&
                           header_.alignment == kByteBits && is_in_word(id.bit, id.size) &&
                           is_in_word(form.time.bit % kByteBits, form.time.size) && form.id.size == 0 &&
                           form.end % kByteBits == 0;
  if (!usual_header_.is_known) {
    return;
  }
  usual_header_.id_shift = id.bit;
  usual_header_.id_mask = mask(id.size);
  usual_header_.time_byte = form.time.bit / kByteBits;
  usual_header_.time_shift = form.time.bit % kByteBits;
  usual_header_.time_mask = mask(form.time.size);
  usual_events_.resize(dense_.size());
  for (std::uint64_t number = 0; number < dense_.size(); ++number) {
    const bool is_of_long_form = header_.has_long_form && number >= header_.long_first && number <= header_.long_last;
    const EventLayout* const layout = dense_[number].get();
    if (layout != nullptr && layout->fixed_size && !is_of_long_form) {
      usual_events_[number] = {layout, form.end / kByteBits, form.end / kByteBits + *layout->fixed_size,
                               layout->context_offset, layout->payload_offset};
    }
  }
}

}  // namespace tracing::ctf
