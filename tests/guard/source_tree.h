// Owns how guard tests see the sources: the files of the repository, or of the folder where there is none.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace beltlife::guard_test {

namespace fs = std::filesystem;

inline const fs::path source = BELTLIFE_SOURCE;

/// What a shell command prints, and how it ends.
struct Output {
  int code = -1;
  std::string text;
};

inline Output shell(const std::string& command) {
  Output output;
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return output;
  std::array<char, 4096> buffer;
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
    output.text.append(buffer.data(), got);
  const int status = pclose(pipe);
  output.code = status < 0 ? status : (status >> 8) & 0xff;
  return output;
}

inline bool installed(const std::string& tool) { return shell("command -v " + tool).code == 0; }

/// `text` as one word of a shell command.
inline std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) {
    if (c == '\'') word += "'\\'";  // close, an escaped quotation mark, open again
    word += c;
  }
  word.push_back('\'');
  return word;
}

inline bool is_repository() {
  return installed("git") && fs::exists(source / ".git") && shell("git -C " + quoted(source) + " ls-files").code == 0;
}

/// Paths relative to the source folder: what git knows or would add (so that a new file is guarded before its commit),
/// else every file outside build folders.
inline std::vector<std::string> all_files() {
  std::vector<std::string> files;
  if (is_repository()) {
    const std::string list =
        shell("git -C " + quoted(source) + " ls-files -z --cached --others --exclude-standard").text;
    for (std::size_t at = 0, end; (end = list.find('\0', at)) != list.npos; at = end + 1) {
      std::string file = list.substr(at, end - at);
      if (fs::is_regular_file(source / file)) files.push_back(std::move(file));
    }
  } else {
    for (auto entry = fs::recursive_directory_iterator(source); entry != fs::recursive_directory_iterator(); ++entry) {
      const std::string file = entry->path().lexically_relative(source);
      if (entry->is_directory() && (file == ".git" || file.starts_with("build"))) entry.disable_recursion_pending();
      if (entry->is_regular_file()) files.push_back(file);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline bool is_cpp(const std::string& file) { return file.ends_with(".cpp") || file.ends_with(".h"); }

/// All C++ files below one of `folders`; all of them if none is named.
inline std::vector<std::string> cpp_files(const std::vector<std::string>& folders = {}) {
  std::vector<std::string> files;
  for (const std::string& file : all_files()) {
    const auto below = [&](const std::string& folder) { return file.starts_with(folder + "/"); };
    if (is_cpp(file) && (folders.empty() || std::any_of(folders.begin(), folders.end(), below))) files.push_back(file);
  }
  return files;
}

inline std::string text_of(const std::string& file) {
  std::ifstream in(source / file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<std::string> lines_of(const std::string& file) {
  std::ifstream in(source / file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace beltlife::guard_test
