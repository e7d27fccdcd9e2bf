// Owns the frame of a page: head, style, heading, list of links, and the sections in their order.
#pragma once

#include <string>
#include <vector>

namespace beltlife {

/// A part of a page that can be linked.
struct Section {
  std::string id;     ///< of the element that `html` begins with
  std::string title;  ///< in the list of links; the page's own first section has none
  std::string html;   ///< empty: there is nothing to say
};

/// One self-contained page: nothing from elsewhere.
std::string page_html(const std::string& title, const std::vector<Section>& sections);

}  // namespace beltlife
