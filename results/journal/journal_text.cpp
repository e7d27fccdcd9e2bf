// Lines of a study's log: see journal_text.h.
#include "results/journal/journal_text.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>
#include <string_view>

#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;  // keys in the order in which people read them

constexpr int format = 1;
/// With what every log begins, so that a file which is none is never taken for one that was cut short.
constexpr std::string_view beginning = "{\"beltlife_journal\":";

[[noreturn]] void refuse(const std::filesystem::path& path, int line, std::string what, std::string allowed) {
  throw BadInput({Problem{path.string(), line, "", std::move(what), std::move(allowed)}});
}

/// A text file by lines; zlib reads plain files as well as compressed ones.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& path) : path_(path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) refuse(path, 0, "is a directory", "a file inside it");
    errno = 0;
    file_ = gzopen(path.c_str(), "rbe");
    if (!file_) refuse(path, 0, fmt::format("cannot be read: {}", std::strerror(errno)), "");
  }
  ~Lines() { gzclose(file_); }
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;

  /// Up to `count` bytes without passing them.
  std::string_view peek(std::size_t count) {
    while (buffer_.size() - at_ < count && fill()) {
    }
    return std::string_view(buffer_).substr(at_, count);
  }

  /// The next line without its end; `whole` tells whether it has one. False at the end of the file.
  bool next(std::string& line, bool& whole) {
    std::size_t searched = at_;
    while (true) {
      const std::size_t end = buffer_.find('\n', searched);
      if (end != buffer_.npos) {
        line.assign(buffer_, at_, end - at_);
        at_ = end + 1;
        whole = true;
        return true;
      }
      const std::size_t kept = buffer_.size() - at_;
      if (!fill()) break;
      searched = at_ + kept;
    }
    line.assign(buffer_, at_);
    at_ = buffer_.size();
    whole = false;
    return !line.empty();
  }

  bool compressed() { return gzdirect(file_) == 0; }

 private:
  bool fill() {
    buffer_.erase(0, at_);
    at_ = 0;
    constexpr unsigned chunk = 1U << 18;
    const std::size_t old = buffer_.size();
    buffer_.resize(old + chunk);
    const int got = gzread(file_, buffer_.data() + old, chunk);
    buffer_.resize(old + static_cast<std::size_t>(std::max(got, 0)));
    int code = Z_OK;
    const std::string why = gzerror(file_, &code);
    // A compressed file that ends early is no log that was cut short: nobody writes logs compressed.
    if (got < 0 || code == Z_BUF_ERROR) refuse(path_, 0, fmt::format("cannot be read to its end: {}", why), "");
    return got > 0;
  }

  std::filesystem::path path_;
  gzFile file_ = nullptr;
  std::string buffer_;
  std::size_t at_ = 0;
};

std::string spelled(const ordered_json& line) {
  return line.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

StudyHead head_of(const json& line) {
  StudyHead h;
  const auto take = [&](const char* key, std::string& text) { text = line.at(key).get<std::string>(); };
  take("driver", h.driver);
  take("version", h.version);
  take("revision", h.revision);
  take("compiler", h.compiler);
  take("command_line", h.command_line);
  take("scene_path", h.scene_path);
  take("scene_text", h.scene_text);
  take("study_path", h.study_path);
  take("study_text", h.study_text);
  take("lanes", h.lanes);
  line.at("parameters").get_to(h.parameters);
  line.at("quantities").get_to(h.quantities);
  return h;
}

/// Throws a JSON exception if the line is no point, std::invalid_argument if it is one that does not fit the head.
StudyPoint point_of_line(const json& line, const StudyHead& head) {
  StudyPoint p;
  p.number = line.at("point").get<std::size_t>();
  for (const json& setting : line.at("settings"))
    setting.is_string() ? p.settings.emplace_back(setting.get<std::string>())
                        : p.settings.emplace_back(setting.get<double>());
  const auto state = line.at("state").get<std::string>();
  const auto* const known = std::find(point_state_names.begin(), point_state_names.end(), state);
  if (known == point_state_names.end()) throw std::invalid_argument(fmt::format("has an unknown state '{}'", state));
  p.answer.state = static_cast<PointState>(known - point_state_names.begin());
  line.at("values").get_to(p.answer.values);
  line.at("processor_s").get_to(p.answer.processor_s);
  p.answer.reason = line.value("reason", "");
  if (p.settings.size() != head.parameters.size())
    throw std::invalid_argument(
        fmt::format("has {} settings, but the head names {} parameters", p.settings.size(), head.parameters.size()));
  const std::size_t wanted = p.answer.ok() ? head.quantities.size() : 0;
  if (p.answer.values.size() != wanted)
    throw std::invalid_argument(fmt::format("has {} values instead of {}", p.answer.values.size(), wanted));
  return p;
}

/// A log while it is read, line by line.
struct Reading {
  const std::filesystem::path& path;
  JournalText text;
  std::set<std::size_t> numbers;

  void head(const json& line) {
    if (!line.is_object() || !line.contains("beltlife_journal")) refuse_file();
    if (line["beltlife_journal"] != format)
      refuse(path, 1, fmt::format("is a log of format {}", line["beltlife_journal"].dump()),
             fmt::format("format {}", format));
    try {
      text.head = head_of(line);
    } catch (const json::exception&) {
      refuse(path, 1, "is no whole head of a log", "");
    }
  }

  void entry(const json& line, int number) {
    try {
      if (line.is_object() && line.contains("answer")) {
        text.answer = line["answer"];
        return;
      }
      StudyPoint point = point_of_line(line, *text.head);
      if (!numbers.insert(point.number).second)
        refuse(path, number, fmt::format("is point {} a second time", point.number), "every point once");
      text.points.push_back(std::move(point));
    } catch (const json::exception&) {
      refuse_line(number);
    } catch (const std::invalid_argument& e) {
      refuse(path, number, e.what(), "");
    }
  }

  [[noreturn]] void refuse_line(int number) const {
    refuse(path, number, "is neither a point nor an answer",
           "the lines that beltlife wrote; only the last one may be cut short");
  }
  [[noreturn]] void refuse_file() const {
    refuse(path, 0, "is not the log of a study", "a log that beltlife began, or a new file");
  }
};

}  // namespace

JournalText read_journal_text(const std::filesystem::path& path) {
  Lines lines(path);
  Reading reading{path, {}, {}};
  JournalText& text = reading.text;
  // An empty file, or the first bytes of a head, may become a log.
  const std::string_view first = lines.peek(beginning.size());
  if (first != beginning.substr(0, first.size())) reading.refuse_file();
  std::string line;
  bool whole = true;
  for (int number = 1; lines.next(line, whole); ++number) {
    if (text.cut_short) reading.refuse_line(number - 1);
    const json entry = whole ? json::parse(line, nullptr, false) : json(json::value_t::discarded);
    if (entry.is_discarded()) {
      text.cut_short = true;
      continue;
    }
    number == 1 ? reading.head(entry) : reading.entry(entry, number);
    text.bytes += line.size() + 1;
  }
  text.compressed = lines.compressed();
  std::sort(text.points.begin(), text.points.end(),
            [](const StudyPoint& a, const StudyPoint& b) { return a.number < b.number; });
  return std::move(reading.text);
}

bool begins_as_journal(const std::filesystem::path& path) { return Lines(path).peek(beginning.size()) == beginning; }

std::string head_line(const StudyHead& h) {
  return spelled({{"beltlife_journal", format},
                  {"driver", h.driver},
                  {"version", h.version},
                  {"revision", h.revision},
                  {"compiler", h.compiler},
                  {"command_line", h.command_line},
                  {"scene_path", h.scene_path},
                  {"scene_text", h.scene_text},
                  {"study_path", h.study_path},
                  {"study_text", h.study_text},
                  {"lanes", h.lanes},
                  {"parameters", h.parameters},
                  {"quantities", h.quantities}});
}

std::string point_line(const StudyPoint& p) {
  ordered_json settings = ordered_json::array();
  for (const Setting& setting : p.settings) std::visit([&](const auto& value) { settings.push_back(value); }, setting);
  ordered_json line;
  line["point"] = p.number;
  line["settings"] = std::move(settings);
  line["state"] = to_string(p.answer.state);
  line["values"] = p.answer.values;
  line["processor_s"] = p.answer.processor_s;
  if (!p.answer.ok()) line["reason"] = p.answer.reason;
  return spelled(line);
}

std::string answer_line(const json& answer) { return spelled({{"answer", ordered_json(answer)}}); }

std::string storable(const std::string& text) {
  std::string clean = json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
  std::replace(clean.begin(), clean.end(), '\0', ' ');
  return clean;
}

}  // namespace beltlife
