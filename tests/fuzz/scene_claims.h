// Owns what must hold of any text that is taken for a scene: read and compiled, or refused at a place and in words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/scene/scene_io.h"

namespace beltlife::scene_claims {

struct Verdict {
  std::vector<Problem> problems;    ///< why the text is no drive; empty: it was read and compiled
  std::vector<std::string> broken;  ///< claims that do not hold, in words
};

/// Reads the text as a file's, compiles what was read with few elements, and writes and rereads it. Claims: every
/// problem names file, line, key and what is allowed (a text that is no TOML has no key); a scene that is written and
/// reread is written as the same text; a compiled drive holds finite numbers only.
Verdict judge(std::string_view text);

}  // namespace beltlife::scene_claims
