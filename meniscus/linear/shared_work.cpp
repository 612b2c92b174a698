#include "meniscus/linear/shared_work.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>

#include <nlohmann/json.hpp>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/collective.hpp"
#include "meniscus/linear/petsc_objects.hpp"

namespace meniscus::linear {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

/// What a rank made, or why it could not.
struct Share {
  std::vector<Archive> pieces;
  std::string error;
  bool is_input_wrong = false;  // the error is an InvalidInput
};

constexpr const char* kNoText = "an error without a text";

Share made(std::span<const int> owner, int rank, const MakePiece& make) {
  Share share;
  try {
    for (std::size_t k = 0; k < owner.size(); ++k)
      if (owner[k] == rank) make(k, share.pieces.emplace_back());
  } catch (const InvalidInput& error) {
    share = {{}, error.what(), true};
  } catch (const std::exception& error) {
    share = {{}, error.what()};
    if (share.error.empty()) share.error = kNoText;
  }
  return share;
}

/// The arrays of a piece, by their bytes.
template <class Number>
json packed(const std::map<std::string, std::vector<Number>>& arrays) {
  json all = json::object();
  for (const auto& [name, numbers] : arrays) {
    Bytes bytes(sizeof(Number) * numbers.size());
    if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
    all[name] = json::binary(std::move(bytes));
  }
  return all;
}

template <class Number>
void unpack(const json& all, std::map<std::string, std::vector<Number>>& arrays) {
  for (const auto& [name, value] : all.items()) {
    const Bytes& bytes = value.get_binary();
    std::vector<Number>& numbers = arrays[name];
    numbers.resize(bytes.size() / sizeof(Number));
    if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  }
}

Bytes packed(const Share& share) {
  json pieces = json::array();
  for (const Archive& piece : share.pieces)
    pieces.push_back({{"reals", packed(piece.reals)},
                      {"integers", packed(piece.integers)},
                      {"texts", piece.texts}});
  return json::to_msgpack({{"error", share.error},
                           {"is_input_wrong", share.is_input_wrong},
                           {"pieces", std::move(pieces)}});
}

Share unpacked(const Bytes& bytes) {
  const json all = json::from_msgpack(bytes);
  Share share;
  all.at("error").get_to(share.error);
  all.at("is_input_wrong").get_to(share.is_input_wrong);
  for (const json& piece : all.at("pieces")) {
    Archive& archive = share.pieces.emplace_back();
    unpack(piece.at("reals"), archive.reals);
    unpack(piece.at("integers"), archive.integers);
    piece.at("texts").get_to(archive.texts);
  }
  return share;
}

/// The bytes of every rank, by rank.
std::vector<Bytes> exchanged(Communicator communicator, Bytes own) {
  std::vector<Bytes> all(static_cast<std::size_t>(communicator.size()));
  all[static_cast<std::size_t>(communicator.rank())] = std::move(own);
  for (int rank = 0; rank < communicator.size(); ++rank) {
    Bytes& bytes = all[static_cast<std::size_t>(rank)];
    auto length = static_cast<std::int64_t>(bytes.size());
    MPI_Bcast(&length, 1, MPI_INT64_T, rank, mpi_communicator(communicator));
    MENISCUS_ASSERT(length <= std::numeric_limits<int>::max(), "{} bytes of one rank", length);
    bytes.resize(static_cast<std::size_t>(length));
    MPI_Bcast(bytes.data(), static_cast<int>(length), MPI_UINT8_T, rank,
              mpi_communicator(communicator));
  }
  return all;
}

void take_all(std::span<const int> owner, int rank, const std::vector<Share>& shares,
              const TakePiece& take) {
  std::vector<std::size_t> next(shares.size(), 0);
  for (std::size_t k = 0; k < owner.size(); ++k)
    if (owner[k] != rank) {
      const auto from = static_cast<std::size_t>(owner[k]);
      take(k, shares[from].pieces[next[from]++]);
    }
}

}  // namespace

std::vector<int> ranks_for(std::span<const double> work, int num_ranks) {
  MENISCUS_ASSERT(num_ranks > 0, "{} ranks", num_ranks);
  std::vector<std::size_t> by_size(work.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  std::ranges::stable_sort(by_size, std::ranges::greater(), [&](std::size_t k) { return work[k]; });
  std::vector<double> load(static_cast<std::size_t>(num_ranks), 0.0);
  std::vector<int> ranks(work.size());
  for (const std::size_t k : by_size) {
    const auto least = std::ranges::min_element(load);
    ranks[k] = static_cast<int>(least - load.begin());
    *least += work[k];
  }
  return ranks;
}

void share_work(Communicator communicator, std::span<const double> work, const MakePiece& make,
                const TakePiece& take) {
  const std::vector<int> owner = ranks_for(work, communicator.size());
  if (communicator.size() == 1) {
    for (std::size_t k = 0; k < owner.size(); ++k) {
      Archive unused;
      make(k, unused);
    }
    return;
  }
  const int rank = communicator.rank();
  std::vector<Share> shares;
  for (const Bytes& bytes : exchanged(communicator, packed(made(owner, rank, make))))
    shares.push_back(unpacked(bytes));
  for (const Share& share : shares) {
    if (share.is_input_wrong) throw InvalidInput(share.error);
    if (!share.error.empty()) throw RunFailure(share.error);
  }
  take_all(owner, rank, shares, take);
}

std::vector<double> shared_numbers(Communicator communicator, std::size_t count, std::size_t width,
                                   const FindNumbers& find) {
  const auto num_ranks = static_cast<std::size_t>(communicator.size());
  const auto first = [&](std::size_t rank) { return count * rank / num_ranks; };
  const auto own = static_cast<std::size_t>(communicator.rank());
  std::vector<double> part = find(first(own), first(own + 1));
  if (num_ranks == 1) return part;
  std::vector<std::int32_t> counts;
  for (std::size_t rank = 0; rank < num_ranks; ++rank)
    counts.push_back(static_cast<std::int32_t>(width * (first(rank + 1) - first(rank))));
  std::vector<double> all(width * count);
  gather(communicator, part, counts, all);
  return all;
}

}  // namespace meniscus::linear
