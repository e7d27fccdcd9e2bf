// Owns the way of a finished file to disk: written beside its target, renamed when whole.
#pragma once

#include <filesystem>
#include <vector>

namespace beltlife {

/// Puts the bytes at `path`, an older file of that name staying as it was until they are whole. Throws BadInput,
/// leaving nothing behind, if they cannot be written.
void write_whole_file(const std::filesystem::path& path, const std::vector<char>& bytes);

}  // namespace beltlife
