#include "meniscus/io/checksum.hpp"

namespace meniscus::io {

std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037ULL;  // offset basis and prime as the hash defines them
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return hash;
}

}  // namespace meniscus::io
