// SPDX-License-Identifier: Apache-2.0
#include "actions/test/disk_fault.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "actions/process/resource_settings.hpp"

namespace launch {

namespace {

std::string text_of(const std::optional<Template>& value) {
  return value ? value->describe() : "";
}

}  // namespace

std::vector<AttributeSpec> DiskFaultFields::attributes() {
  return {{"path", AttributeType::kText, false, "the log directory", "with fill_disk: a directory, whose disk is full",
           true},
          {"free", AttributeType::kText, false, "nothing",
           "with fill_disk: for what there is room nevertheless, in bytes, or with K, M or G", true}};
}

DiskFaultFields::DiskFaultFields(const Fields& fields)
    : where_(fields.where()), path_(fields.optional_text("path")), free_(fields.optional_text("free")) {
  Scope nothing;
  if (free_ && free_->is_literal()) {
    parse_bytes(free_->perform(nothing), free_->where());
  }
}

std::string DiskFaultFields::identity() const {
  return fmt::format("disk {} {}", text_of(path_), text_of(free_));
}

DiskFault DiskFaultFields::perform(Scope& scope) const {
  DiskFault fault;
  fault.where = path_ ? path_->where() : where_;
  if (path_) {
    const std::string path = path_->perform(scope);
    if (path.empty()) {
      throw LaunchError("the path of the disk is empty", fault.where, {}, Finding::kWrongValue);
    }
    fault.directory = std::filesystem::absolute(path).lexically_normal().string();
  }
  if (free_) {
    fault.free = parse_bytes(free_->perform(scope), free_->where());
  }
  return fault;
}

}  // namespace launch
