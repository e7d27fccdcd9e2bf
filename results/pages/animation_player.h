// Owns the script that plays recorded frames on a page.
#pragma once

namespace beltlife {

/// Plain JavaScript; finds its data in `#animation-data` (animation_data) and its controls by their ids.
/// `window.beltlife_animation` has play(), pause(), range(index), seek(ms) and state(), for whoever drives it by
/// script.
extern const char* const animation_player;

}  // namespace beltlife
