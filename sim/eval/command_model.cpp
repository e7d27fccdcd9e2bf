// The model that is another program: see command_model.h.
#include "sim/eval/command_model.h"

#include <fmt/format.h>
#include <string.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>

#include "sim/eval/child_process.h"
#include "sim/eval/parallel_for.h"

namespace beltlife {
namespace {

using Json = nlohmann::json;

constexpr std::size_t shown_lines = 3;    // of standard error, in a reason
constexpr std::size_t shown_bytes = 120;  // of an answer that is not understood

/// Written by hand to keep the study's order; numbers in the shortest form that reads back to the bit.
std::string input_of(const std::vector<std::string>& names, const Point& point) {
  std::string text = "{";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Json value = std::visit([](const auto& v) { return Json(v); }, point.at(i));
    text += fmt::format("{}{}: {}", i == 0 ? "" : ", ", Json(names[i]).dump(), value.dump());
  }
  return text + "}\n";
}

/// A program may print any bytes, but reasons go into journals and tables: valid UTF-8 on one line.
std::string plain(std::string_view text) {
  const std::string valid = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string line = Json::parse(valid).get<std::string>();
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  const std::size_t first = line.find_first_not_of(' ');
  return first == std::string::npos ? "" : line.substr(first, line.find_last_not_of(' ') + 1 - first);
}

std::string beginning(std::string_view text) {
  return plain(text.substr(0, shown_bytes)) + (text.size() > shown_bytes ? "..." : "");
}

/// The last lines of standard error on one line, as the end of a reason; nothing if there are none.
std::string last_words(std::string_view text) {
  std::string words;
  for (std::size_t lines = 0; !text.empty() && lines < shown_lines;) {
    const std::size_t cut = text.find_last_of('\n');
    const std::string line = plain(cut == std::string_view::npos ? text : text.substr(cut + 1));
    text = cut == std::string_view::npos ? std::string_view() : text.substr(0, cut);
    if (line.empty()) continue;
    words.insert(0, words.empty() ? line : line + " | ");
    ++lines;
  }
  return words.empty() ? "" : "; standard error ends: " + words;
}

/// Why there is no exit status 0; empty if there is.
std::string trouble_of(const ProgramOutcome& outcome, const CommandSpec& spec, const std::filesystem::path& folder) {
  switch (outcome.end) {
    case ProgramEnd::exited:
      return outcome.code == 0 ? "" : fmt::format("the program exited with status {}", outcome.code);
    case ProgramEnd::killed: {
      const char* name = sigdescr_np(outcome.code);
      return fmt::format("the program was killed by signal {} ({})", outcome.code, name ? name : "unknown");
    }
    case ProgramEnd::timed_out:
      return fmt::format("the program took longer than {} s", spec.timeout_s);
    case ProgramEnd::too_much_output:
      return fmt::format("the program printed more than {} MB", output_limit_bytes >> 20);
    case ProgramEnd::not_started:
      break;
  }
  std::error_code none;  // "no such file" may mean either
  if (!folder.empty() && !std::filesystem::is_directory(folder, none))
    return fmt::format("the program could not be started: no folder \"{}\"", folder.string());
  return fmt::format("the program \"{}\" could not be started: {}", spec.run.empty() ? "" : spec.run.front(),
                     std::generic_category().message(outcome.code));
}

/// Reads the quantities from what a program printed; why it cannot, or nothing.
std::string read_values(const std::string& output, const std::vector<std::string>& quantities,
                        std::vector<double>& values) {
  if (output.find_first_not_of(" \t\r\n") == std::string::npos) return "the program printed nothing";
  Json answer;
  try {
    answer = Json::parse(output);
  } catch (const Json::out_of_range&) {
    return "the program printed a number too large to be finite: " + beginning(output);
  } catch (const Json::parse_error&) {
    const bool no_number = output.find("NaN") != std::string::npos || output.find("Infinity") != std::string::npos;
    return fmt::format("the program printed no JSON object{}: {}", no_number ? " (JSON has no NaN or Infinity)" : "",
                       beginning(output));
  }
  if (!answer.is_object()) return "the program printed no JSON object: " + beginning(output);
  for (const std::string& name : quantities) {
    const auto found = answer.find(name);
    if (found == answer.end()) return fmt::format("the answer has no quantity \"{}\"", name);
    if (!found->is_number())
      return fmt::format("the answer's quantity \"{}\" is not a number: {}", name, beginning(found->dump()));
    values.push_back(found->get<double>());
    if (!std::isfinite(values.back())) return fmt::format("the answer's quantity \"{}\" is not finite", name);
  }
  return "";
}

Answer answer_of(const ProgramOutcome& outcome, const CommandSpec& spec, const std::filesystem::path& folder,
                 const std::vector<std::string>& quantities) {
  Answer answer;
  answer.processor_s = outcome.processor_s;
  answer.reason = trouble_of(outcome, spec, folder);
  if (answer.reason.empty()) answer.reason = read_values(outcome.output, quantities, answer.values);
  if (answer.reason.empty()) {
    answer.state = PointState::ok;
    return answer;
  }
  answer.values.clear();
  answer.reason += last_words(outcome.error_tail);
  answer.state = outcome.end == ProgramEnd::timed_out ? PointState::timed_out : PointState::failed;
  return answer;
}

}  // namespace

PointModel command_model(const CommandSpec& spec, const std::filesystem::path& folder, std::vector<std::string> names,
                         std::vector<std::string> quantities, int threads) {
  return [spec, folder, names = std::move(names), quantities = std::move(quantities), threads](
             const std::vector<Point>& points, const OnAnswer& on_answer) {
    std::vector<Answer> answers(points.size());
    std::mutex one_at_a_time;
    std::atomic<std::size_t> answered = 0;
    std::atomic<bool> refused = false;  // by on_answer: what is computed from then on would be lost
    parallel_for(static_cast<int>(points.size()), threads, [&](int index) {
      if (stop_requested() || refused) return;
      const std::size_t i = static_cast<std::size_t>(index);
      const ProgramOutcome outcome = run_program(spec.run, folder, input_of(names, points[i]), spec.timeout_s);
      answers[i] = answer_of(outcome, spec, folder, quantities);
      const std::lock_guard lock(one_at_a_time);
      if (refused) return;
      try {
        if (on_answer) on_answer(i, answers[i]);
      } catch (...) {
        refused = true;
        throw;
      }
      ++answered;
    });
    if (answered < points.size()) throw Interrupted();
    return answers;
  };
}

}  // namespace beltlife
