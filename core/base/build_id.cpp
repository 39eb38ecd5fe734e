#include "core/base/build_id.h"

#include <cstring>
#include <exception>
#include <string_view>

#include <link.h>

#include "core/base/sha256.h"

namespace evenglow::core {
namespace {

std::string hex(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

/// Notes are padded to four bytes, or where the segment says so to eight (System V gABI, "Note Section").
std::size_t padded(std::size_t size, std::size_t alignment) {
  return (size + alignment - 1) / alignment * alignment;
}

/// The build id among the notes of a segment; empty: it holds none.
std::string id_among(std::string_view notes, std::size_t alignment) {
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) head;
    std::memcpy(&head, notes.data(), sizeof(head));
    const std::size_t content = sizeof(head) + padded(head.n_namesz, alignment);
    const std::size_t end = content + padded(head.n_descsz, alignment);
    if (end > notes.size()) return "";
    const std::string_view name = notes.substr(sizeof(head), head.n_namesz);
    if (head.n_type == NT_GNU_BUILD_ID && name == std::string_view("GNU\0", 4))
      return hex(notes.substr(content, head.n_descsz));
    notes.remove_prefix(end);
  }
  return "";
}

/// The first object is the program itself: its 1 ends the search.
int look(dl_phdr_info* object, std::size_t, void* found) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = object->dlpi_phdr[i];
    if (part.p_type != PT_NOTE) continue;
    // The system tells places in memory as numbers.
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto* begin = reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr);
    std::string id = id_among({begin, part.p_memsz}, part.p_align == 8 ? 8 : 4);
    if (id.empty()) continue;
    *static_cast<std::string*>(found) = std::move(id);
    break;
  }
  return 1;
}

}  // namespace

std::string build_id() {
  std::string id;
  ::dl_iterate_phdr(look, &id);
  if (!id.empty()) return id;
  try {
    return sha256_hex_of_file("/proc/self/exe");
  } catch (const std::exception&) {
    return "";
  }
}

}  // namespace evenglow::core
