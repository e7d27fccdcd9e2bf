// Owns a list of limits while it is put together: each as what there is, what is wanted, and the words where it is
// broken.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "optimize/layout/layout_limits.h"

namespace beltlife {

class LimitList {
 public:
  /// `words` are asked for where the limit is broken alone: a search asks for many layouts.
  template <class Words>
  void at_least(std::string name, double measured, double bound, const char* unit, std::string key, Words words) {
    add(std::move(name), measured - bound, bound, false, unit, std::move(key), words);
  }
  template <class Words>
  void at_most(std::string name, double measured, double bound, const char* unit, std::string key, Words words) {
    add(std::move(name), bound - measured, bound, true, unit, std::move(key), words);
  }

  /// Where what is left is known rather than what there is: `left` to a lower bound.
  template <class Words>
  void left_of(std::string name, double left, double bound, const char* unit, std::string key, Words words) {
    add(std::move(name), left, bound, false, unit, std::move(key), words);
  }

  std::vector<LayoutLimit> take() { return std::move(limits_); }

 private:
  template <class Words>
  void add(std::string name, double left, double bound, bool at_most, const char* unit, std::string key, Words words) {
    limits_.push_back(
        {{std::move(name), left, unit, left < 0 ? words() : std::string(), std::move(key)}, bound, at_most});
  }

  std::vector<LayoutLimit> limits_;
};

}  // namespace beltlife
