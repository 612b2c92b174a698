#include "meniscus/app/bracket.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "meniscus/core/error.hpp"

namespace meniscus {

const char* word_for(Verdict verdict) {
  constexpr std::array kWords{"steady", "broken", "undecided", "failed"};
  return kWords.at(static_cast<std::size_t>(verdict));
}

const char* word_for(Bracket::Result result) {
  constexpr std::array kWords{"open",       "critical",  "all steady",
                              "all broken", "undecided", "failed"};
  return kWords.at(static_cast<std::size_t>(result));
}

bool Bracket::has(Verdict verdict) const {
  return std::ranges::any_of(verdicts_, [&](const auto& each) { return each.second == verdict; });
}

std::optional<double> Bracket::nearest(Verdict verdict) const {
  const auto near_end = verdicts_.find(bisection_.from);
  if (near_end == verdicts_.end()) return std::nullopt;
  const bool is_of_near_end = verdict == near_end->second;
  const auto distance = [&](double value) { return std::abs(value - bisection_.from); };
  std::optional<double> nearest;
  for (const auto& [value, each] : verdicts_)
    if (each == verdict && (!nearest || (distance(value) > distance(*nearest)) == is_of_near_end))
      nearest = value;
  return nearest;
}

double Bracket::between(double a, double b) const {
  return rounded(bisection_.is_logarithmic ? std::copysign(std::sqrt(a * b), a) : 0.5 * (a + b));
}

std::optional<double> Bracket::middle() const {
  const auto a = steady(), b = broken();
  if (!a || !b) return std::nullopt;
  return between(*a, *b);
}

std::optional<double> Bracket::relative_width() const {
  const auto a = steady(), b = broken();
  if (!a || !b) return std::nullopt;
  return std::abs(*a - *b) / std::max(std::abs(*a), std::abs(*b));
}

bool Bracket::is_far_end_due() const {
  constexpr std::size_t kMostMiddles = 3;
  return verdicts_.size() > kMostMiddles && (!steady() || !broken());
}

std::optional<double> Bracket::wanted() const {
  if (result() != Result::open) return std::nullopt;
  if (!verdicts_.contains(bisection_.from)) return bisection_.from;
  if (is_far_end_due()) return bisection_.to;
  const auto a = steady(), b = broken();
  const double middle = between(a.value_or(bisection_.to), b.value_or(bisection_.to));
  return verdicts_.contains(middle) ? bisection_.to : middle;
}

Bracket::Result Bracket::result() const {
  if (has(Verdict::failed)) return Result::failed;
  if (has(Verdict::undecided)) return Result::undecided;
  if (const auto middle = this->middle()) {
    const bool is_narrow = *relative_width() <= bisection_.tolerance || verdicts_.contains(*middle);
    return is_narrow ? Result::critical : Result::open;
  }
  if (!verdicts_.contains(bisection_.to)) return Result::open;
  return steady() ? Result::all_steady : Result::all_broken;
}

}  // namespace meniscus
