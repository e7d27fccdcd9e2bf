// Owns the fingerprint of a file that a study's answers depend on.
#pragma once

#include <filesystem>
#include <string>

namespace beltlife {

/// "1234 bytes, crc32 0a1b2c3d"; "nothing" of a file that cannot be read.
std::string checksum_of(const std::filesystem::path& path);

}  // namespace beltlife
