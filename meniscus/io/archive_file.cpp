#include "meniscus/io/archive_file.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "meniscus/core/child_process.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/checksum.hpp"
#include "meniscus/io/hdf5_handle.hpp"

namespace meniscus::io {
namespace {

constexpr std::string_view magic = "Meniscus archive";
constexpr int format_version = 2;
// HDF5 looks for its signature at bytes 0, 512, 1024, …, so it opens the file with our text in
// front.
constexpr std::size_t prefix_size = 512;

std::string prefix(std::string_view image) {
  std::string text = fmt::format("{} {}\nbytes {}\nchecksum {:016x}\n", magic, format_version,
                                 image.size(), checksum(image));
  MENISCUS_ASSERT(text.size() <= prefix_size, "{} bytes", text.size());
  text.resize(prefix_size, '\0');
  return text;
}

/// Access to a file in memory, with `image` in it already unless that is empty.
Hdf5Handle memory_access(std::string_view image) {
  constexpr std::size_t growth = std::size_t{1} << 20U;  // bytes; any size does
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "H5Pcreate");
  hdf5_check(H5Pset_fapl_core(access, growth, false), "H5Pset_fapl_core");
  if (!image.empty()) {
    void* start = const_cast<char*>(image.data());  // copied by the call
    hdf5_check(H5Pset_file_image(access, start, image.size()), "H5Pset_file_image");
  }
  return access;
}

/// Creates one array at a path of groups, without the time of its creation.
void write_array(hid_t file, const std::string& name, hid_t type, const Hdf5Handle& space,
                 const void* values) {
  MENISCUS_ASSERT(!name.empty(), "an array without a name");
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "H5Pcreate");
  hdf5_check(H5Pset_create_intermediate_group(links, 1), "H5Pset_create_intermediate_group");
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "H5Pcreate");
  hdf5_check(H5Pset_obj_track_times(creation, false), "H5Pset_obj_track_times");
  const Hdf5Handle set(H5Dcreate2(file, name.c_str(), type, space, links, creation, H5P_DEFAULT),
                       H5Dclose, ("H5Dcreate of " + name).c_str());
  if (H5Sget_simple_extent_npoints(space) == 0) return;
  hdf5_check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "H5Dwrite");
}

template <class T>
void write_numbers(hid_t file, const std::string& name, hid_t type, const std::vector<T>& values) {
  const hsize_t size = values.size();
  const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, "H5Screate_simple");
  write_array(file, name, type, space, values.data());
}

/// A text is one string of its own length; an empty one has no value (HDF5 knows no empty string).
void write_text(hid_t file, const std::string& name, const std::string& text) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "H5Tcopy");
  hdf5_check(H5Tset_size(type, std::max<std::size_t>(text.size(), 1)), "H5Tset_size");
  hdf5_check(H5Tset_strpad(type, H5T_STR_NULLPAD), "H5Tset_strpad");
  const Hdf5Handle space(H5Screate(text.empty() ? H5S_NULL : H5S_SCALAR), H5Sclose, "H5Screate");
  write_array(file, name, type, space, text.data());
}

std::string hdf5_image(const Archive& archive) {
  const Hdf5Handle file(H5Fcreate("archive", H5F_ACC_TRUNC, H5P_DEFAULT, memory_access({})),
                        H5Fclose, "H5Fcreate");
  for (const auto& [name, values] : archive.reals) {
    write_numbers(file, name, H5T_NATIVE_DOUBLE, values);
  }
  for (const auto& [name, values] : archive.integers) {
    write_numbers(file, name, H5T_NATIVE_INT64, values);
  }
  for (const auto& [name, text] : archive.texts) write_text(file, name, text);
  hdf5_check(H5Fflush(file, H5F_SCOPE_GLOBAL), "H5Fflush");
  const ssize_t size = hdf5_check(H5Fget_file_image(file, nullptr, 0), "H5Fget_file_image");
  std::string image(static_cast<std::size_t>(size), '\0');
  hdf5_check(H5Fget_file_image(file, image.data(), image.size()), "H5Fget_file_image");
  return image;
}

template <class T>
std::vector<T> read_values(hid_t set, hid_t memory_type, std::size_t size) {
  std::vector<T> values(size);
  if (size == 0) return values;
  hdf5_check(H5Dread(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "H5Dread");
  return values;
}

void read_array(hid_t file, const std::string& name, Archive& archive) {
  const Hdf5Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, "H5Dopen");
  const Hdf5Handle type(H5Dget_type(set), H5Tclose, "H5Dget_type");
  const Hdf5Handle space(H5Dget_space(set), H5Sclose, "H5Dget_space");
  const auto size = static_cast<std::size_t>(
      hdf5_check(H5Sget_simple_extent_npoints(space), "H5Sget_simple_extent_npoints"));
  const H5T_class_t kind = H5Tget_class(type);
  if (kind == H5T_FLOAT) {
    archive.reals[name] = read_values<double>(set, H5T_NATIVE_DOUBLE, size);
  } else if (kind == H5T_INTEGER) {
    archive.integers[name] = read_values<std::int64_t>(set, H5T_NATIVE_INT64, size);
  } else if (kind == H5T_STRING && size <= 1) {
    const std::vector<char> text = read_values<char>(set, type, size * H5Tget_size(type));
    archive.texts[name] = std::string(text.begin(), text.end());
  } else {
    throw Hdf5Failure(name + " has a type that no archive has");
  }
}

herr_t collect_name(hid_t group, const char* name, const H5L_info_t* /*info*/, void* names) {
  const hid_t object = H5Oopen(group, name, H5P_DEFAULT);
  if (object < 0) return -1;
  if (H5Iget_type(object) == H5I_DATASET) {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  }
  return H5Oclose(object);
}

Archive parse_image(std::string_view image) {
  const Hdf5Handle file(H5Fopen("archive", H5F_ACC_RDONLY, memory_access(image)), H5Fclose,
                        "H5Fopen");
  std::vector<std::string> names;
  hdf5_check(H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, collect_name, &names), "H5Lvisit");
  Archive archive;
  for (const std::string& name : names) read_array(file, name, archive);
  return archive;
}

/// The HDF5 image of a file of ours, proved whole.
std::string_view checked_image(const std::filesystem::path& path, std::string_view bytes) {
  if (!bytes.starts_with(magic)) reject_input("{}: not a Meniscus checkpoint", path.string());
  int version = 0;
  unsigned long long size = 0, sum = 0;
  const std::string text(bytes.substr(magic.size(), prefix_size - magic.size()));
  const int read = std::sscanf(text.c_str(), " %d bytes %llu checksum %llx", &version, &size, &sum);
  if (read >= 1 && version != format_version) {
    reject_input("{}: a checkpoint of format {}; this program reads format {}", path.string(),
                 version, format_version);
  }
  if (bytes.size() < prefix_size || bytes.size() - prefix_size < size) {
    reject_input("{}: the checkpoint is cut short after {} bytes", path.string(), bytes.size());
  }
  const std::string_view image = bytes.substr(prefix_size);
  if (bytes.substr(0, prefix_size) != prefix(image)) {
    reject_input("{}: the checkpoint is corrupt (its checksum differs)", path.string());
  }
  return image;
}

}  // namespace

void write_archive(const std::filesystem::path& path, const Archive& archive) {
  const Hdf5Silence silence;
  std::string image;
  try {
    image = hdf5_image(archive);
  } catch (const Hdf5Failure& failure) {
    throw RunFailure(fmt::format("{}: cannot be written: {}", path.string(), failure.what()));
  }
  write_file(path, prefix(image) + image);
}

Archive read_archive(const std::filesystem::path& path) {
  const Hdf5Silence silence;
  const std::string bytes = read_file(path);
  const std::string_view image = checked_image(path, bytes);
  // A damaged image can leave HDF5 in a state that it cannot close, or end the process.
  constexpr std::size_t kLeast = std::size_t{1} << 30U;  // bytes
  const ChildResult tried = try_in_child([&] { parse_image(image); },
                                         {.seconds = 60, .memory = kLeast + 10 * image.size()});
  if (!tried.failure.empty())
    reject_input("{}: the checkpoint cannot be read: {}", path.string(), tried.failure);
  return parse_image(image);
}

}  // namespace meniscus::io
