// Fingerprint by zlib: see file_checksum.h.
#include "results/journal/file_checksum.h"

#include <fmt/format.h>
#include <zlib.h>

#include <fstream>
#include <iterator>

namespace beltlife {

std::string checksum_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return "nothing";
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  return fmt::format("{} bytes, crc32 {:08x}", bytes.size(), sum);
}

}  // namespace beltlife
