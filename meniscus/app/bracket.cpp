#include "meniscus/app/bracket.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

double Bracket::width(double a, double b) {
  return std::abs(a - b) / std::max(std::abs(a), std::abs(b));
}

std::optional<double> Bracket::relative_width() const {
  const auto a = steady(), b = broken();
  if (!a || !b) return std::nullopt;
  return width(*a, *b);
}

std::optional<double> Bracket::wanted() const {
  constexpr std::size_t kMostMiddles = 3;
  if (result() != Result::open) return std::nullopt;
  if (!verdicts_.contains(bisection_.from)) return bisection_.from;
  if (const auto middle = this->middle()) return middle;
  // All agree with `from` so far.
  const double last = steady() ? *steady() : *broken(), middle = between(last, bisection_.to);
  const bool is_far_end_due = verdicts_.size() > kMostMiddles ||
                              width(last, bisection_.to) <= bisection_.tolerance ||
                              verdicts_.contains(middle);
  return is_far_end_due ? bisection_.to : middle;
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
