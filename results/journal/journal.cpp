// The log of a study and the model that remembers by it: see journal.h.
#include "results/journal/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <stdexcept>

#include "results/journal/journal_text.h"
#include "results/journal/study_difference.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

using nlohmann::json;

constexpr const char* elsewhere = "the same study; else another --out, or delete the log";

[[noreturn]] void refuse(const std::filesystem::path& path, int line, std::string what, std::string allowed) {
  throw BadInput({Problem{path.string(), line, "", std::move(what), std::move(allowed)}});
}

/// Settings as text that differs whenever a bit differs.
std::string key_of(const Point& point) {
  std::string key;
  for (const Setting& setting : point) {
    if (const auto* number = std::get_if<double>(&setting)) {
      char bytes[sizeof(double)];
      std::memcpy(bytes, number, sizeof bytes);
      key += 'n';
      key.append(bytes, sizeof bytes);
    } else {
      const auto& text = std::get<std::string>(setting);
      key += fmt::format("t{} ", text.size()) + text;
    }
  }
  return key;
}

void warn_of_revision(const std::filesystem::path& path, const StudyHead& log, const StudyHead& now) {
  if (log.revision == now.revision && log.compiler == now.compiler) return;
  fmt::print(
      stderr,
      "warning: {} was begun by revision {} ({}), now it is {} ({}): its points may differ from what this program "
      "would find\n",
      path.string(), log.revision, log.compiler, now.revision, now.compiler);
}

}  // namespace

StudyRecord read_journal(const std::filesystem::path& path) {
  JournalText text = read_journal_text(path);
  if (!text.head)
    refuse(path, 0, "is not the log of a study, or was stopped before its first line was whole",
           "a log that beltlife wrote");
  return {std::move(*text.head), std::move(text.points), std::move(text.answer)};
}

Journal::Journal(std::filesystem::path path, const StudyHead& head) : path_(std::move(path)) {
  // No child process may inherit the lock.
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0)
    refuse(path_, 0, fmt::format("no log can be written here: {}", std::strerror(errno)),
           "a file name in an existing folder in which you may write");
  try {
    open(head);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

Journal::~Journal() { ::close(file_); }

void Journal::open(const StudyHead& head) {
  struct stat status {};
  if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode))
    refuse(path_, 0, "is not a regular file", "the name of a new file, or a log");
  while (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    if (errno == EWOULDBLOCK)
      refuse(path_, 0, "is being written by another process", "to wait until that has ended, or another --out");
    refuse(path_, 0, fmt::format("cannot be locked: {}", std::strerror(errno)), "a folder on a local disk");
  }
  JournalText text = read_journal_text(path_);
  if (text.compressed) refuse(path_, 0, "is compressed and cannot be gone on with", "a plain log: gunzip it first");
  if (text.head) {
    if (const auto difference = first_difference(*text.head, head)) refuse(path_, 1, *difference, elsewhere);
    warn_of_revision(path_, *text.head, head);
  }
  whole_ = text.bytes;
  torn_ = text.cut_short;
  record_ = {text.head.value_or(head), std::move(text.points), std::move(text.answer)};
  if (text.head) return;
  for (std::string* s : {&record_.head.command_line, &record_.head.scene_path, &record_.head.study_path})
    *s = storable(*s);
  try {
    write(head_line(record_.head), "its head");
  } catch (const BadInput&) {
    ::unlink(path_.c_str());  // a log without a head is worth nothing
    throw;
  }
}

void Journal::write(const std::string& line, const std::string& what) {
  const auto fail = [&](int why) {
    refuse(path_, 0,
           fmt::format("{} could not be written: {}; the {} points before it are safe", what, std::strerror(why),
                       record_.points.size()),
           "free space and run the same command again: it goes on");
  };
  const auto cut = [&] { return ::ftruncate(file_, static_cast<off_t>(whole_)) == 0; };
  if (torn_ && !cut()) fail(errno);
  torn_ = false;
  for (std::size_t done = 0; done < line.size();) {
    const ssize_t wrote = ::write(file_, line.data() + done, line.size() - done);
    if (wrote > 0) {
      done += static_cast<std::size_t>(wrote);
    } else if (wrote == 0 || errno != EINTR) {
      const int why = wrote == 0 ? ENOSPC : errno;
      torn_ = !cut();
      fail(why);
    }
  }
  whole_ += line.size();
}

void Journal::append(StudyPoint point) {
  const StudyHead& head = record_.head;
  const std::size_t values = point.answer.ok() ? head.quantities.size() : 0;
  if (point.settings.size() != head.parameters.size() || point.answer.values.size() != values)
    throw std::logic_error(fmt::format("point {} does not fit the head of its log", point.number));
  auto& points = record_.points;
  const auto at = std::lower_bound(points.begin(), points.end(), point.number,
                                   [](const StudyPoint& p, std::size_t number) { return p.number < number; });
  if (at != points.end() && at->number == point.number)
    throw std::logic_error(fmt::format("point {} is in its log already", point.number));
  if (!point.answer.reason.empty()) point.answer.reason = storable(point.answer.reason);
  write(point_line(point), fmt::format("point {}", point.number));
  points.insert(at, std::move(point));
}

void Journal::finish(const json& answer) {
  const std::string line = answer_line(answer);
  if (!record_.answer.is_null() && answer_line(record_.answer) == line) return;
  write(line, "the answer");
  record_.answer = json::parse(line)["answer"];
}

JournaledModel::JournaledModel(PointModel model, Journal& journal) : model_(std::move(model)), journal_(journal) {
  for (const StudyPoint& p : journal.record().points)
    if (!known_.emplace(key_of(p.settings), Known{p.number, false, p.answer}).second)
      refuse(journal.path(), 0, fmt::format("point {} has the settings of an earlier one", p.number), elsewhere);
}

JournaledModel::Known& JournaledModel::ask(const std::string& key) {
  const auto other_course = [&](const std::string& what) {
    refuse(journal_.path(), 0, what + ": the log belongs to another course of the study", elsewhere);
  };
  const auto [at, fresh] = known_.try_emplace(key);
  Known& known = at->second;
  if (known.asked) return known;
  if (!fresh && known.number != asked_)
    other_course(fmt::format("point {} is asked for as point {}", known.number, asked_));
  if (fresh) {
    const auto& points = journal_.record().points;
    const auto same = std::lower_bound(points.begin(), points.end(), asked_,
                                       [](const StudyPoint& p, std::size_t number) { return p.number < number; });
    if (same != points.end() && same->number == asked_) {
      known_.erase(at);
      other_course(fmt::format("point {} has other settings there than are asked for", asked_));
    }
    known.number = asked_;
  }
  known.asked = true;
  ++asked_;
  return known;
}

std::vector<Answer> JournaledModel::evaluate(const std::vector<Point>& points, const OnAnswer& on_answer) {
  // References into the map stay valid while it grows.
  std::vector<Known*> wanted;
  std::vector<Point> fresh;
  std::vector<std::vector<std::size_t>> waiting;  // for each fresh point
  std::unordered_map<const Known*, std::size_t> place;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Known& known = ask(key_of(points[i]));
    wanted.push_back(&known);
    const bool pending = !known.answer && !place.emplace(&known, fresh.size()).second;
    if (known.answer || pending) ++remembered_;
    if (known.answer) continue;
    if (!pending) {
      fresh.push_back(points[i]);
      waiting.emplace_back();
    }
    waiting[place.at(&known)].push_back(i);
  }
  if (on_answer)
    for (std::size_t i = 0; i < points.size(); ++i)
      if (wanted[i]->answer) on_answer(i, *wanted[i]->answer);

  std::mutex mutex;
  const auto take = [&](std::size_t k, const Answer& answer) {
    const std::lock_guard lock(mutex);
    Known& known = *wanted[waiting[k].front()];
    if (known.answer) return;
    Answer kept = answer;
    if (!kept.reason.empty()) kept.reason = storable(kept.reason);  // the same now as when it comes from the log
    journal_.append({known.number, fresh[k], kept});
    known.answer = std::move(kept);
    ++evaluated_;
    if (on_answer)
      for (std::size_t i : waiting[k]) on_answer(i, *known.answer);
  };
  if (!fresh.empty()) {
    const std::vector<Answer> answers = model_(fresh, take);
    for (std::size_t k = 0; k < answers.size(); ++k) take(k, answers[k]);  // of a model that called nobody
  }
  std::vector<Answer> results;
  for (const Known* known : wanted) results.push_back(known->answer.value());
  return results;
}

}  // namespace beltlife
