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
  const auto is_at = [&](double value) {
    const auto found = verdicts_.find(value);
    return found != verdicts_.end() && found->second == verdict;
  };
  const bool is_at_from = is_at(bisection_.from), is_at_to = is_at(bisection_.to);
  if (!is_at_from && !is_at_to) return std::nullopt;
  if (is_at_from && is_at_to) return bisection_.to;
  const double end = is_at_from ? bisection_.from : bisection_.to;
  double nearest = end;
  for (const auto& [value, each] : verdicts_)
    if (each == verdict && std::abs(value - end) > std::abs(nearest - end)) nearest = value;
  return nearest;
}

std::optional<double> Bracket::middle() const {
  const auto a = steady(), b = broken();
  if (!a || !b) return std::nullopt;
  const double middle =
      bisection_.is_logarithmic ? std::copysign(std::sqrt(*a * *b), *a) : 0.5 * (*a + *b);
  return rounded(middle);
}

std::optional<double> Bracket::relative_width() const {
  const auto a = steady(), b = broken();
  if (!a || !b) return std::nullopt;
  return std::abs(*a - *b) / std::max(std::abs(*a), std::abs(*b));
}

std::vector<double> Bracket::wanted() const {
  std::vector<double> wanted;
  for (const double end : {bisection_.from, bisection_.to})
    if (!verdicts_.contains(end)) wanted.push_back(end);
  if (!wanted.empty() || result() != Result::open) return wanted;
  return {*middle()};
}

Bracket::Result Bracket::result() const {
  if (has(Verdict::failed)) return Result::failed;
  if (!verdicts_.contains(bisection_.from) || !verdicts_.contains(bisection_.to))
    return Result::open;
  if (has(Verdict::undecided)) return Result::undecided;
  if (!broken()) return Result::all_steady;
  if (!steady()) return Result::all_broken;
  const bool is_narrow = *relative_width() <= bisection_.tolerance || verdicts_.contains(*middle());
  return is_narrow ? Result::critical : Result::open;
}

}  // namespace meniscus
