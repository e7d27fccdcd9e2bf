// Claims about texts taken for scenes: see scene_claims.h.
#include "tests/fuzz/scene_claims.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "sim/model.h"

namespace beltlife::scene_claims {
namespace {

namespace fs = std::filesystem;

/// The text as a file, because only a file's scene knows its lines.
class TextFile {
 public:
  explicit TextFile(std::string_view text)
      : path_(fs::temp_directory_path() / ("beltlife_claims_" + std::to_string(getpid()) + ".toml")) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  ~TextFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

bool has(const std::string& text, std::string_view part) { return text.find(part) != text.npos; }

void check_problem(const Problem& p, const std::string& file, int lines, std::vector<std::string>& broken) {
  const auto claim = [&](bool holds, const std::string& words) {
    if (!holds) broken.push_back(words + ": " + to_string(p));
  };
  const bool no_toml = has(p.what, "not TOML") || has(p.what, "nested too deep");
  const bool too_large = has(p.what, "too large");
  claim(p.file == file, "names another file");
  claim(!p.what.empty(), "says nothing");
  claim(too_large || (p.line >= 1 && p.line <= lines), "names no line of the file");
  claim(too_large || no_toml || !p.key.empty(), "names no key");
  const bool remedy = !p.allowed.empty() || has(p.what, "wanted ") || has(p.what, "missing table [");
  claim(no_toml || remedy, "does not say what is allowed");
}

void check_numbers(const Model& m, std::vector<std::string>& broken) {
  bool finite = std::isfinite(m.belt.element_length) && m.belt.element_length > 0 && std::isfinite(m.belt.node_mass) &&
                std::isfinite(m.contact.stiffness) && std::isfinite(m.initial.q.arm_angle);
  for (int i = 0; i < m.belt.nodes; ++i)
    finite = finite && std::isfinite(m.initial.q.x[i]) && std::isfinite(m.initial.q.y[i]);
  for (int b = 0; b < m.bodies; ++b)
    finite = finite && std::isfinite(m.inverse_inertia[b]) && std::isfinite(m.speed_ratio[b]) && m.speed_ratio[b] > 0;
  if (!finite) broken.emplace_back("the compiled drive holds a number that is not finite");
}

void check_rewriting(const SceneSpec& scene, std::vector<std::string>& broken) {
  const std::string once = write_scene(scene);
  try {
    if (write_scene(parse_scene(once, "rewritten")) != once) broken.emplace_back("rereads as another scene:\n" + once);
  } catch (const BadInput& bad) {
    broken.emplace_back(std::string("cannot reread what it wrote: ") + bad.what() + "\n" + once);
  }
}

}  // namespace

Verdict judge(std::string_view text) {
  const TextFile file(text);
  Verdict verdict;
  try {
    SceneFile read = read_scene(file.path());
    check_rewriting(read.scene, verdict.broken);
    read.scene.belt.elements = std::min(read.scene.belt.elements, 64);  // positions of more cost only time
    try {
      check_numbers(compile(read.scene, file.path().string()), verdict.broken);
    } catch (const BadInput& bad) {
      throw located(read, bad);
    }
  } catch (const BadInput& bad) {
    verdict.problems = bad.problems();
    if (verdict.problems.empty()) verdict.broken.emplace_back("is refused without a problem");
    const int lines = 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    for (const Problem& problem : verdict.problems) check_problem(problem, file.path().string(), lines, verdict.broken);
  }
  return verdict;
}

}  // namespace beltlife::scene_claims
