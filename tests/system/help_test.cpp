// Owns the claims about what the command teaches: help with examples, version, the reference of all fields.
#include <set>
#include <sstream>

#include "sim/scene/scene.h"
#include "tests/system/command.h"

namespace beltlife::system_test {
namespace {

std::string asked(const Arguments& arguments) {
  const Answer answer = beltlife(arguments);
  EXPECT_EQ(answer.code, 0) << testing::PrintToString(arguments) << answer.err;
  EXPECT_EQ(answer.err, "");
  return answer.out;
}

/// The names under "Subcommands:" in the help.
std::vector<std::string> commands() {
  std::istringstream help(asked({"--help"}));
  std::vector<std::string> names;
  bool listed = false;
  for (std::string line; std::getline(help, line);) {
    if (listed && line.size() > 2 && line.starts_with("  ") && line[2] != ' ')
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    if (line.starts_with("Subcommands:")) listed = true;
    if (line.empty()) listed = false;
  }
  return names;
}

TEST(Help, OfEveryCommandHasAnExampleThatNamesIt) {
  const auto names = commands();
  EXPECT_GE(names.size(), 3u);
  for (const char* known : {"check", "simulate", "life"})
    EXPECT_NE(std::find(names.begin(), names.end(), known), names.end());
  for (const std::string& name : names) {
    // Commands of commands may keep their examples one level down, as long as the first level shows one.
    const std::string help = asked({name, "--help"});
    const auto examples = help.find("Example");
    ASSERT_NE(examples, help.npos) << name << "\n" << help;
    EXPECT_NE(help.find("beltlife " + name + " ", examples), help.npos) << help;
  }
}

TEST(Help, OfTheProgramNamesTheExitCodes) {
  const std::string help = asked({"--help"});
  for (const char* part : {"Examples:", "0 done", "1 usage", "2 bad input", "3 ran but failed"})
    EXPECT_NE(help.find(part), help.npos) << part;
}

TEST(Help, ExamplesNameScenesThatExist) {
  for (const std::string& name : commands()) {
    std::istringstream words(asked({name, "--help"}));
    for (std::string word; words >> word;)
      if (word.starts_with("sim/scenes/") && !fs::exists(fs::path(BELTLIFE_SOURCE) / word))
        ADD_FAILURE() << name << ": " << word;
  }
}

TEST(Version, IsANumberAndARevision) {
  const std::string text = asked({"--version"});
  int major = -1, minor = -1, patch = -1;
  EXPECT_EQ(std::sscanf(text.c_str(), "%d.%d.%d", &major, &minor, &patch), 3) << text;
  EXPECT_GE(major, 0);
}

/// Collects every key of a Spec, and of the Specs inside it.
struct Keys {
  std::set<std::string> found;

  template <class T, class... Rest>
  void operator()(const char* key, T& value, const Rest&...) {
    found.insert(key);
    descend(value);
  }
  template <class T>
  void descend(T& value) {
    if constexpr (requires { value.visit(*this); }) value.visit(*this);
  }
  template <class T>
  void descend(std::optional<T>&) {
    T inside{};
    descend(inside);
  }
  template <class T>
  void descend(std::vector<T>&) {
    T inside{};
    descend(inside);
  }
};

TEST(Fields, ListEveryKeyOfASceneWithItsMeaning) {
  Keys keys;
  SceneSpec{}.visit(keys);
  EXPECT_GT(keys.found.size(), 60u);
  const std::string reference = asked({"--fields"});
  for (const std::string& key : keys.found) EXPECT_NE(reference.find(key), reference.npos) << key;
}

TEST(StandardOutput, ThatTakesNothingIsAFailure) {
  // A full disk must not look like success to a script.
  Arguments shell{"-c", "\"$0\" check \"$1\" > /dev/full", BELTLIFE_COMMAND, scene("two_pulley")};
  std::vector<char*> argv{const_cast<char*>("sh")};
  for (std::string& word : shell) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execv("/bin/sh", argv.data());
    _exit(127);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
}

}  // namespace
}  // namespace beltlife::system_test
