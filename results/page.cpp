// The frame of a page: see page.h.
#include "results/page.h"

#include <fmt/format.h>

#include "results/html.h"

namespace beltlife {
namespace {

constexpr const char* style = R"(
:root{color-scheme:light}body{font:16px/1.5 system-ui,Helvetica,sans-serif;color:#222;max-width:1040px;margin:0 auto;padding:1rem}
h1{font-size:1.6rem;margin:.2rem 0}h2{margin-top:2.2rem;border-bottom:2px solid #0b61a4}h3{font-size:1rem;margin:1.2rem 0 .3rem}
.lead{font-size:1.15rem}nav{font-size:.9rem;margin:.4rem 0 1rem}nav a{color:#0b61a4;margin-right:.9rem;white-space:nowrap}
table{border-collapse:separate;border-spacing:0;margin:.5rem 0 .8rem;font-size:.88rem;font-variant-numeric:tabular-nums}
th,td{padding:.2rem .6rem;border-bottom:1px solid #ddd;text-align:right;white-space:nowrap}th{vertical-align:bottom;white-space:normal}
th.w,td.w{text-align:left}td:first-child{position:sticky;left:0;background:#fff}.alarm{color:#b00020;font-weight:bold}.scroll{overflow-x:auto}tbody tr:hover{background:#f3f7fa}
#statics-tensions td+td,[id^=modes-rotational] td:last-child{white-space:normal}#life-pulleys{font-size:.82rem}#life-pulleys th,#life-pulleys td{padding:.15rem .5rem}
#key-numbers td,#provenance-table td{text-align:left}#key-numbers td{white-space:normal}#provenance-table td+td{white-space:normal;overflow-wrap:anywhere}
figure{margin:.5rem 0}figure svg{max-width:100%;height:auto}figcaption{font-size:.88rem;color:#555}
.charts{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,440px),1fr));gap:.5rem}
details>summary{cursor:pointer;font-weight:bold;padding:.4rem 0}pre{overflow-x:auto;font-size:.8rem;background:#f6f6f6;padding:.5rem}
[id$=-words] td:last-child{white-space:normal;min-width:20rem}.charts>div{min-width:0}p a{color:#0b61a4}
#noise figure,#responses figure,#steps figure,#errors figure,#points figure{max-width:600px}
@media(max-width:600px){[id^=study-] td:first-child{white-space:normal;overflow-wrap:anywhere;min-width:9rem}}
@media print{details{display:block}details>*{display:block}nav{display:none}.scroll{overflow:visible}figure{break-inside:avoid}})";

}  // namespace

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
         heading + "</title>\n<style>" + style + "</style></head><body>\n<h1>" + heading + "</h1>\n<nav>" + links +
         "</nav>\n" + body + "</body></html>\n";
}

}  // namespace beltlife
