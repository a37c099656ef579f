// Changed pictures with right checksums: with wrong ones libpng looks no further.

#include <zlib.h>

#include <cstring>

#include "target.hpp"

extern "C" {
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                    unsigned seed);
}

namespace {

constexpr std::size_t kSignature = 8;
constexpr std::size_t kWord = 4;

std::uint32_t word_at(const std::uint8_t* data) {
  return (std::uint32_t{data[0]} << 24U) | (std::uint32_t{data[1]} << 16U) |
         (std::uint32_t{data[2]} << 8U) | data[3];
}

void write_word(std::uint8_t* data, std::uint32_t word) {
  for (std::size_t i = 0; i < kWord; ++i) {
    data[i] = static_cast<std::uint8_t>(word >> (24U - 8U * i));
  }
}

/// Length, name, that many bytes, checksum over name and bytes; again and again.
void mend_checksums(std::uint8_t* data, std::size_t size) {
  std::size_t place = kSignature;
  while (place + 3 * kWord <= size) {
    const std::size_t length = word_at(data + place);
    if (length > size - place - 3 * kWord) {
      return;
    }
    const std::uint8_t* name = data + place + kWord;
    const auto checksum = crc32(0, name, static_cast<unsigned>(length + kWord));
    place += 2 * kWord + length;
    write_word(data + place, static_cast<std::uint32_t>(checksum));
    place += kWord;
  }
}

}  // namespace

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                    unsigned seed) {
  const std::size_t changed = LLVMFuzzerMutate(data, size, most);
  if (seed % 8 != 0) {
    mend_checksums(data, changed);
  }
  return changed;
}
