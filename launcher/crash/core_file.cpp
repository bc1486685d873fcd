// SPDX-License-Identifier: Apache-2.0
#include "launcher/crash/core_file.hpp"

#include <elf.h>
#include <signal.h>
#include <sys/procfs.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

namespace launch {
namespace {

constexpr std::size_t kMostNotes = 256UL << 20U;  // bytes; 100,000 mappings have 10 MiB

// A value at a place of some bytes; nothing beyond their end.
template <typename Value>
std::optional<Value> value_at(std::string_view bytes, std::size_t place) {
  if (place > bytes.size() || bytes.size() - place < sizeof(Value)) {
    return std::nullopt;
  }
  Value value;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

std::string read(std::ifstream& file, std::uint64_t place, std::size_t size) {
  std::string bytes(size, '\0');
  file.clear();
  file.seekg(static_cast<std::streamoff>(place));
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

// NT_FILE: the number of mappings, the size of a page, three numbers for each mapping, then the paths.
std::vector<MappedFile> mapped_files(std::string_view note) {
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  std::vector<MappedFile> files;
  const auto count = value_at<std::uint64_t>(note, 0);
  const auto page = value_at<std::uint64_t>(note, kWord);
  if (!count || !page || *count > note.size() / (3 * kWord)) {
    return files;
  }
  std::size_t path = (2 + 3 * static_cast<std::size_t>(*count)) * kWord;
  for (std::size_t i = 0; i < *count && path < note.size(); ++i) {
    const std::size_t entry = (2 + 3 * i) * kWord;
    const std::size_t end = std::min(note.find('\0', path), note.size());
    files.push_back({*value_at<std::uint64_t>(note, entry), *value_at<std::uint64_t>(note, entry + kWord),
                     *value_at<std::uint64_t>(note, entry + 2 * kWord) * *page,
                     std::string(note.substr(path, end - path))});
    path = end + 1;
  }
  return files;
}

// The program is the file in which its own headers are mapped.
std::uint64_t address_of_headers(std::string_view note) {
  for (std::size_t i = 0;; i += sizeof(Elf64_auxv_t)) {
    const auto entry = value_at<Elf64_auxv_t>(note, i);
    if (!entry || entry->a_type == AT_NULL) {
      return 0;
    }
    if (entry->a_type == AT_PHDR) {
      return entry->a_un.a_val;
    }
  }
}

void read_signal(std::string_view note, CoreFile& core) {
  const auto info = value_at<siginfo_t>(note, 0);
  if (!info) {
    return;
  }
  core.signal = info->si_signo;
  if (info->si_code > 0 && info->si_code != SI_KERNEL) {
    constexpr int kWithAddress[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP};
    core.has_address =
        std::find(std::begin(kWithAddress), std::end(kWithAddress), core.signal) != std::end(kWithAddress);
    core.address = reinterpret_cast<std::uintptr_t>(info->si_addr);
  } else if (info->si_code <= 0) {
    core.sender = info->si_pid;
  }
}

void read_notes(std::string_view notes, CoreFile& core, std::uint64_t& headers) {
  const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  for (std::size_t place = 0;;) {
    const auto head = value_at<Elf64_Nhdr>(notes, place);
    if (!head) {
      return;
    }
    const std::size_t content = place + sizeof *head + padded(head->n_namesz);
    if (content > notes.size() || notes.size() - content < head->n_descsz) {
      return;
    }
    const std::string_view note = notes.substr(content, head->n_descsz);
    if (head->n_type == NT_PRPSINFO) {
      if (const auto process = value_at<prpsinfo_t>(note, 0)) {
        core.pid = process->pr_pid;
      }
    } else if (head->n_type == NT_SIGINFO) {
      read_signal(note, core);
    } else if (head->n_type == NT_FILE) {
      core.files = mapped_files(note);
    } else if (head->n_type == NT_AUXV) {
      headers = address_of_headers(note);
    }
    place = content + padded(head->n_descsz);
  }
}

}  // namespace

const MappedFile* CoreFile::file_at(std::uint64_t where) const {
  const auto found = std::find_if(files.begin(), files.end(),
                                  [where](const MappedFile& file) { return file.begin <= where && where < file.end; });
  return found == files.end() ? nullptr : &*found;
}

std::optional<CoreFile> read_core_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const auto header = value_at<Elf64_Ehdr>(read(file, 0, sizeof(Elf64_Ehdr)), 0);
  if (!header || std::memcmp(header->e_ident, ELFMAG, SELFMAG) != 0 || header->e_ident[EI_CLASS] != ELFCLASS64 ||
      header->e_type != ET_CORE || header->e_phentsize != sizeof(Elf64_Phdr)) {
    return std::nullopt;
  }
  CoreFile core;
  std::uint64_t headers = 0;
  const std::string table = read(file, header->e_phoff, header->e_phnum * sizeof(Elf64_Phdr));
  for (std::size_t i = 0; i < header->e_phnum; ++i) {
    const auto segment = value_at<Elf64_Phdr>(table, i * sizeof(Elf64_Phdr));
    if (segment && segment->p_type == PT_NOTE && segment->p_filesz <= kMostNotes) {
      read_notes(read(file, segment->p_offset, segment->p_filesz), core, headers);
    }
  }
  if (core.pid == 0) {
    return std::nullopt;
  }
  if (const MappedFile* const program = core.file_at(headers)) {
    core.program = program->path;
  }
  return core;
}

}  // namespace launch
