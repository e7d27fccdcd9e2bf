// Owns the way of a finished file to disk: written beside its target, renamed when whole.
#pragma once

#include <filesystem>
#include <span>

namespace beltlife {

/// Refuses, before anything is simulated, a path that cannot be written (missing folder, no permission, a
/// directory). Throws BadInput.
void check_writable(const std::filesystem::path& path);

/// Puts the bytes at `path`, an older file of that name staying as it was until they are whole. Throws BadInput,
/// leaving nothing behind, if they cannot be written.
void write_whole_file(const std::filesystem::path& path, std::span<const char> bytes);

}  // namespace beltlife
