// The frame of a page: see page.h.
#include "results/pages/page.h"

#include <fmt/format.h>

#include "results/pages/assets.h"
#include "results/pages/html.h"

namespace beltlife {
std::string page_html(const std::string& title, const std::vector<Section>& sections) {
  const std::string heading = html_escaped(title);
  std::string links, body;
  for (const Section& section : sections) {
    if (!section.title.empty() && !section.html.empty())
      links += fmt::format("<a href=\"#{}\">{}</a> ", html_escaped(section.id), html_escaped(section.title));
    body += section.html;
  }
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\">\n<title>" +
         heading + "</title>\n<style>" + page_style + "</style></head><body>\n<h1>" + heading + "</h1>\n<nav>" + links +
         "</nav>\n" + body + "</body></html>\n";
}

}  // namespace beltlife
