// Owns what pages embed of the files in assets/, which the build turns into texts.
#pragma once

namespace beltlife {

extern const char* const page_style;        ///< assets/page.css
extern const char* const animation_player;  ///< assets/player.js

}  // namespace beltlife
