// Owns the change of a record's sampling rate without aliasing.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace beltlife {

/// A record as a function of time, by a Kaiser-windowed sinc of 64 zeros to either side: flat to 0.9 of the lower of
/// both Nyquist frequencies, nothing (-100 dB) above it. Beyond its ends the record is taken as zero: hand over what
/// has no mean, and expect errors within 64 periods of the lower rate from the ends.
class BandLimited {
 public:
  /// `signal` must outlive it. `other_rate_hz`: at which it is going to be read.
  BandLimited(std::span<const double> signal, double sample_rate_hz, double other_rate_hz);

  static constexpr double zeros = 64;
  static constexpr double flat_share = 0.9;
  double at(double time_s) const;
  /// Nearer than this to an end (s), values lack what lies beyond it.
  double reach_s() const { return reach_s_; }

 private:
  std::span<const double> signal_;
  double rate_, cutoff_share_, reach_s_;
};

/// Number of samples that a record has at another rate; each stands for one period.
std::size_t resampled_size(std::size_t samples, double rate_hz, double new_rate_hz);

}  // namespace beltlife
