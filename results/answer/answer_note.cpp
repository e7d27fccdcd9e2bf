// The reference of an answer: see answer_note.h.
#include "results/answer/answer_note.h"

namespace beltlife {
namespace {

void rows_of(const std::vector<AnswerNote>& notes, const std::string& above, std::string& out) {
  for (const AnswerNote& note : notes) {
    std::string path = above + note.name;
    for (int i = 0; i < note.named; ++i) path += ".NAME";
    out += "| `" + path + "` | " + note.type + (note.may_miss ? ", or absent" : "") + " | " + note.unit + " | " +
           note.meaning + " |\n";
    rows_of(note.parts, path + ".", out);
  }
}

}  // namespace

std::string answer_reference(const std::vector<AnswerNote>& notes) {
  std::string out = "| part | type | unit | meaning |\n|---|---|---|---|\n";
  rows_of(notes, "", out);
  return out;
}

}  // namespace beltlife
