// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/streams/stream_cursor.hpp"

#include <exception>
#include <utility>

namespace tracing::ctf {

void StreamCursor::read_ahead(ReadAhead& threads) {
  stop_reading_ahead();
  threads_ = &threads;
  const bool has_more = block_ == nullptr || !block_->is_last;
  if (has_more && !is_filled_ahead_) {
    block_ahead_ = std::make_unique<EventBlock>(decoder_.block_size());
    ahead_.decoder = &decoder_;
    ahead_.block = block_ahead_.get();
    threads_->ask(ahead_);
  }
}

void StreamCursor::stop_reading_ahead() {
  if (threads_ == nullptr) {
    return;
  }
  if (block_ahead_ && !is_filled_ahead_) {
    threads_->wait(ahead_);
    is_filled_ahead_ = true;
  }
  threads_ = nullptr;
}

// Returns false at the end.
bool StreamCursor::next_block() {
  if (block_ && block_->is_last) {
    if (block_->error) {
      std::rethrow_exception(block_->error);
    }
    *block_ = EventBlock(0);  // the memory is needed no more
    block_->is_last = true;
    next_item_ = items_end_ = nullptr;
    return false;
  }
  if (!block_) {
    block_ = std::make_unique<EventBlock>(decoder_.block_size());
  }
  if (!block_ahead_) {
    decoder_.fill(*block_);
  } else {
    if (!is_filled_ahead_) {
      threads_->wait(ahead_);
    }
    is_filled_ahead_ = false;
    std::swap(block_, block_ahead_);
    if (threads_ == nullptr || block_->is_last) {
      block_ahead_.reset();
    } else {
      ahead_.block = block_ahead_.get();
      threads_->ask(ahead_);
    }
  }
  next_item_ = block_->items.get();
  items_end_ = next_item_ + block_->count;
  return true;
}

StreamCursor::Item StreamCursor::next_other(const EventBlock::Item& item) {
  if (item.kind == EventBlock::Item::Kind::kLoss) {
    loss_ = &block_->losses[item.index];
    return Item::kLoss;
  }
  if (item.kind == EventBlock::Item::Kind::kDamage) {
    const EventBlock::Damage& damage = block_->damages[item.index];
    if (damage.is_undescribed) {
      throw UndescribedPacket(damage.what);
    }
    throw DamagedPacket(damage.what);
  }
  event_ = item.event;
  is_fixed_ = false;
  const GeneralEvent& found = block_->others[item.index];
  const StructureDecoder* const decoders[] = {&layout().event_context(), &event_->context, &event_->payload};
  Record* const records[] = {&stream_context_, &event_context_, &payload_};
  for (std::size_t i = 0; i < found.members.size(); ++i) {
    *records[i] = {};
    if (decoders[i]->type() != nullptr) {
      records[i]->decoder = decoders[i];
      records[i]->fields = found.members[i];
    }
  }
  return Item::kEvent;
}

}  // namespace tracing::ctf
