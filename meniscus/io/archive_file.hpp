#pragma once

#include <filesystem>

#include "meniscus/core/archive.hpp"

namespace meniscus::io {

/// Writes an archive as HDF5 (names are group paths) to a temporary name in the same folder, syncs
/// and renames it. The file under `path` is always whole. No times are stored: the same archive
/// gives the same bytes. Before the HDF5 image stand 512 bytes of text with its length and
/// checksum; HDF5's own tools skip them. So no fault of a disk is read as a state. A name can be a
/// group or an array, not both. Throws RunFailure when the disk refuses; nothing is left behind
/// then.
void write_archive(const std::filesystem::path& path, const Archive& archive);
/// Throws InvalidInput naming the file when it is missing, corrupt, or not one of ours.
[[nodiscard]] Archive read_archive(const std::filesystem::path& path);

}  // namespace meniscus::io
