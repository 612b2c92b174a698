#include "meniscus/report/rasterize.hpp"

#include <cmath>
#include <cstring>
#include <memory>

#include <cairo.h>
#include <librsvg/rsvg.h>

#include "meniscus/core/error.hpp"

namespace meniscus::report {
namespace {

struct Release {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
  void operator()(GError* error) const { g_error_free(error); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

[[noreturn]] void fail(GError* raw) {
  const Owned<GError> error(raw);
  throw RunFailure(fmt::format("a picture could not be drawn: {}", error->message));
}

Owned<cairo_surface_t> picture_surface(std::string_view svg, double scale) {
  GError* error = nullptr;
  const Owned<RsvgHandle> handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error));
  if (handle == nullptr) fail(error);
  gdouble width = 0.0, height = 0.0;
  if (rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height) == 0) {
    throw RunFailure("a picture could not be drawn: it has no size");
  }
  const auto to_px = [&](double length) { return static_cast<int>(std::lround(scale * length)); };
  Owned<cairo_surface_t> surface(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, to_px(width), to_px(height)));
  const Owned<cairo_t> context(cairo_create(surface.get()));
  cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
  cairo_paint(context.get());
  const RsvgRectangle page{0.0, 0.0, scale * width, scale * height};
  if (rsvg_handle_render_document(handle.get(), context.get(), &page, &error) == 0) fail(error);
  if (const cairo_status_t status = cairo_status(context.get()); status != CAIRO_STATUS_SUCCESS) {
    throw RunFailure(
        fmt::format("a picture could not be drawn: {}", cairo_status_to_string(status)));
  }
  cairo_surface_flush(surface.get());
  return surface;
}

cairo_status_t append(void* to, const unsigned char* bytes, unsigned int size) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), size);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Pixels pixels_of(std::string_view svg, double scale) {
  const Owned<cairo_surface_t> surface = picture_surface(svg, scale);
  Pixels pixels{cairo_image_surface_get_width(surface.get()),
                cairo_image_surface_get_height(surface.get()),
                {}};
  const auto row_size = static_cast<std::size_t>(pixels.width) * 4;
  pixels.bytes.resize(row_size * static_cast<std::size_t>(pixels.height));
  const unsigned char* data = cairo_image_surface_get_data(surface.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  for (std::size_t row = 0; row < static_cast<std::size_t>(pixels.height); ++row) {
    std::memcpy(pixels.bytes.data() + row * row_size, data + row * stride, row_size);
  }
  return pixels;
}

std::string png_of(std::string_view svg, double scale) {
  const Owned<cairo_surface_t> surface = picture_surface(svg, scale);
  std::string bytes;
  if (cairo_surface_write_to_png_stream(surface.get(), append, &bytes) != CAIRO_STATUS_SUCCESS) {
    throw RunFailure("a picture could not be written as .png");
  }
  return bytes;
}

}  // namespace meniscus::report
