#include "meniscus/app/ranks.hpp"

#include <chrono>
#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/linear/collective.hpp"

namespace meniscus {
namespace {

// Ranks that fail together fail at the same call, but not at the same moment.
constexpr std::chrono::seconds kPatience{10};

linear::Communicator world() { return linear::Communicator::world(); }

/// The exception of rank 0 as text to broadcast: empty for none, else 'i' (InvalidInput) or 'f'
/// (other) and the message.
std::string outcome_of(const std::function<void()>& action) {
  try {
    action();
    return {};
  } catch (const InvalidInput& error) {
    return std::string("i") + error.what();
  } catch (const std::exception& error) {
    return std::string("f") + error.what();
  }
}

/// Throws on all ranks what the outcome of an action on one of them says.
void throw_outcome(std::string outcome, int rank) {
  linear::broadcast(world(), outcome, rank);
  if (outcome.empty()) return;
  if (outcome[0] == 'i') throw InvalidInput(outcome.substr(1));
  throw RunFailure(outcome.substr(1));
}

int exit_status(const std::exception& failure) {
  return dynamic_cast<const InvalidInput*>(&failure) != nullptr ? 2 : 1;
}

}  // namespace

int num_ranks() { return world().size(); }
bool is_first_rank() { return world().rank() == 0; }
bool any_rank(bool local) { return linear::any(world(), local); }

void on_first_rank(const std::function<void()>& action) {
  if (num_ranks() == 1) return action();
  linear::barrier(world());
  throw_outcome(is_first_rank() ? outcome_of(action) : std::string(), 0);
}

void on_first_and_last_rank(const std::function<void()>& first, const std::function<void()>& last) {
  const int last_rank = num_ranks() - 1;
  if (last_rank == 0) {
    first();
    return last();
  }
  std::string outcome;
  if (is_first_rank()) outcome = outcome_of(first);
  if (world().rank() == last_rank) outcome = outcome_of(last);
  throw_outcome(outcome, 0);
  throw_outcome(outcome, last_rank);
}

std::string text_of_first_rank(std::string text) {
  linear::broadcast(world(), text);
  return text;
}

void require_all_failed(const std::exception& failure) {
  if (linear::all_arrive(world(), kPatience)) return;
  std::fputs(fmt::format("meniscus: rank {} alone: {}\n", world().rank(), failure.what()).c_str(),
             stderr);
  linear::abort(world(), exit_status(failure));
}

int on_all_ranks(const std::function<int()>& command) {
  if (num_ranks() == 1) return command();
  if (!is_first_rank()) log::set_level(log::Level::error);
  try {
    return command();
  } catch (const std::exception& failure) {
    require_all_failed(failure);
    if (is_first_rank()) throw;
    return exit_status(failure);
  }
}

}  // namespace meniscus
