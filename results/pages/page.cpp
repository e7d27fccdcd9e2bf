// The frame of a page: see page.h.
#include "results/pages/page.h"

#include <fmt/format.h>

#include "results/pages/html.h"

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
.run{display:flex;flex-wrap:wrap;gap:1rem;align-items:center}.run canvas{display:block;max-width:100%}.run>div{flex:1 1 20rem;min-width:0}.run p{margin:.3rem 0}.player{display:flex;flex-wrap:wrap;gap:.4rem .9rem;align-items:center;margin:.5rem 0;font-size:.95rem}
.player button,.player select{font:inherit;padding:.25rem .6rem;min-height:2.2rem}.player button{min-width:5rem}.player .time{flex:1 1 14rem;display:flex;gap:.4rem;align-items:center}.player .time input{flex:1;min-width:0;min-height:2.2rem}
.scale{display:flex;gap:.5rem;align-items:center;font-size:.88rem;max-width:30rem}.colours{flex:1;height:.7rem;background:linear-gradient(90deg,rgb(20,90,210),rgb(220,30,40));print-color-adjust:exact;-webkit-print-color-adjust:exact}.printed{display:none}
p,li{overflow-wrap:break-word}
@media(max-width:600px){td:first-child{white-space:normal;min-width:6rem;max-width:11rem;overflow-wrap:break-word}[id^=study-] td:first-child{white-space:normal;overflow-wrap:anywhere;min-width:9rem}}
@media print{.player,#animation-now{display:none}.printed{display:inline}details{display:block}details>*{display:block}nav{display:none}.scroll{overflow:visible}figure,tr{break-inside:avoid}
h2,h3{break-after:avoid}details::details-content{content-visibility:visible;block-size:auto}a,p a{color:inherit;text-decoration:none}
body{font-size:11pt;max-width:none;padding:0}table{font-size:8pt}th,td{white-space:normal;padding:.1rem .3rem}td:first-child{position:static}pre{white-space:pre-wrap;overflow-wrap:anywhere}})";

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
