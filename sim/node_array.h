// Owns the storage of per-node numbers: aligned, with two ghost entries at either end instead of index arithmetic.
#pragma once

#include <new>
#include <vector>

namespace beltlife {

template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  template <class U>
  bool operator==(const AlignedAllocator<U>&) const {
    return true;
  }
};

/// Numbers at nodes 0 .. n-1 of a closed belt, with ghosts at -2, -1, n, n+1. Node 0 is aligned for vector loads.
class NodeArray {
 public:
  static constexpr int ghosts = 2;

  NodeArray() = default;
  explicit NodeArray(int n) : n_(n), values_(static_cast<std::size_t>(n) + offset + 8, 0.0) {}

  int size() const { return n_; }
  double* data() { return values_.data() + offset; }
  const double* data() const { return values_.data() + offset; }
  double& operator[](int i) { return data()[i]; }
  double operator[](int i) const { return data()[i]; }

  /// Copies the ends into the ghosts.
  void fill_ghosts() {
    double* p = data();
    p[-2] = p[n_ - 2];
    p[-1] = p[n_ - 1];
    p[n_] = p[0];
    p[n_ + 1] = p[1];
  }

  bool operator==(const NodeArray&) const = default;

 private:
  static constexpr int offset = 8;
  int n_ = 0;
  std::vector<double, AlignedAllocator<double>> values_;
};

}  // namespace beltlife
