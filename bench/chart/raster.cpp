#include "bench/chart/raster.hpp"

#include <cairo.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "base/error.hpp"

namespace tessera::chart {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Pen = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

std::string png_of(const Surface& surface) {
  std::string bytes;
  const auto append = [](void* to, const unsigned char* data, unsigned length) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  };
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS)
    throw output_error("a picture cannot be made: {}", cairo_status_to_string(status));
  return bytes;
}

}  // namespace

Picture picture_of_svg(const std::string& svg, double scale) {
  GError* error = nullptr;
  const auto fail = [&] {
    const std::string reason = error != nullptr ? error->message : "unknown reason";
    g_clear_error(&error);
    return output_error("a plot cannot be drawn: {}", reason);
  };
  const std::unique_ptr<RsvgHandle, decltype(&g_object_unref)> handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error), g_object_unref);
  if (handle == nullptr) throw fail();
  double width = 0, height = 0;
  if (rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height) == 0)
    throw output_error("a plot cannot be drawn: it has no size");
  const RsvgRectangle viewport{0, 0, std::ceil(width * scale), std::ceil(height * scale)};
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(viewport.width),
                                                   static_cast<int>(viewport.height)),
                        cairo_surface_destroy);
  const Pen pen(cairo_create(surface.get()), cairo_destroy);
  cairo_set_source_rgb(pen.get(), 1, 1, 1);
  cairo_paint(pen.get());
  if (rsvg_handle_render_document(handle.get(), pen.get(), &viewport, &error) == 0) throw fail();
  cairo_surface_flush(surface.get());
  Picture picture{cairo_image_surface_get_width(surface.get()), cairo_image_surface_get_height(surface.get()), {}};
  const unsigned char* const rows = cairo_image_surface_get_data(surface.get());
  const auto row_bytes = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  const auto width_pixels = static_cast<std::size_t>(picture.width),
             rows_count = static_cast<std::size_t>(picture.height);
  picture.rgb.reserve(width_pixels * rows_count * 3);
  for (std::size_t y = 0; y < rows_count; ++y)
    for (std::size_t x = 0; x < width_pixels; ++x) {
      std::uint32_t pixel = 0;  // 0xXXRRGGBB in the machine's own byte order
      std::memcpy(&pixel, rows + y * row_bytes + x * sizeof pixel, sizeof pixel);
      for (const int shift : {16, 8, 0}) picture.rgb.push_back(static_cast<unsigned char>(pixel >> shift));
    }
  return picture;
}

std::string png_of_pixels(int width, int height, const std::vector<std::uint32_t>& pixels) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    throw output_error("a picture of {} x {} pixels cannot be made", width, height);
  unsigned char* const rows = cairo_image_surface_get_data(surface.get());
  const auto row_bytes = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  const auto columns = static_cast<std::size_t>(width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y)
    std::memcpy(rows + y * row_bytes, pixels.data() + y * columns, columns * sizeof(std::uint32_t));
  cairo_surface_mark_dirty(surface.get());
  return png_of(surface);
}

std::string base64(const std::string& bytes) {
  const std::unique_ptr<gchar, void (*)(gpointer)> text(
      g_base64_encode(reinterpret_cast<const guchar*>(bytes.data()), bytes.size()), g_free);
  return text.get();
}

}  // namespace tessera::chart
