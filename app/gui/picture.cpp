#include "app/gui/picture.h"

#include <png.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <system_error>

#include "core/error.h"

namespace jnd::app::gui {
namespace {

constexpr int kBytesPerPixel = 4;

std::size_t num_bytes(const Picture& picture) {
  return static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) *
         kBytesPerPixel;
}

}  // namespace

void write_png(const std::filesystem::path& file, const Picture& picture) {
  if (picture.width <= 0 || picture.height <= 0 || picture.rgba.size() != num_bytes(picture)) {
    throw core::Error(file.string() + ": expected a picture of at least one pixel, found " +
                      std::to_string(picture.width) + " x " + std::to_string(picture.height));
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGBA;
  std::filesystem::path unfinished = file;
  unfinished += ".tmp";
  std::error_code ignored;
  if (png_image_write_to_file(&image, unfinished.c_str(), 0, picture.rgba.data(), 0, nullptr) ==
      0) {
    std::filesystem::remove(unfinished, ignored);
    throw core::Error(file.string() + ": the picture cannot be written: " + image.message);
  }
  std::error_code problem;
  std::filesystem::rename(unfinished, file, problem);
  if (!problem) return;
  std::filesystem::remove(unfinished, ignored);
  throw core::Error(file.string() + ": the picture cannot be written: " + problem.message());
}

Picture read_png(const std::filesystem::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0) {
    throw core::Error(file.string() + ": expected a PNG picture: " + image.message);
  }
  image.format = PNG_FORMAT_RGBA;
  Picture picture = {.width = static_cast<int>(image.width),
                     .height = static_cast<int>(image.height)};
  picture.rgba.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, picture.rgba.data(), 0, nullptr) == 0) {
    throw core::Error(file.string() + ": expected a PNG picture: " + image.message);
  }
  return picture;
}

Picture cut_out(const Picture& picture, int x, int y, int width, int height) {
  const int left = std::clamp(x, 0, picture.width);
  const int top = std::clamp(y, 0, picture.height);
  Picture part = {.width = std::clamp(x + width, left, picture.width) - left,
                  .height = std::clamp(y + height, top, picture.height) - top};
  part.rgba.resize(num_bytes(part));
  const std::size_t row = static_cast<std::size_t>(part.width) * kBytesPerPixel;
  for (int i = 0; i < part.height; ++i) {
    const auto from =
        static_cast<std::size_t>(top + i) * static_cast<std::size_t>(picture.width) +
        static_cast<std::size_t>(left);
    std::memcpy(part.rgba.data() + static_cast<std::size_t>(i) * row,
                picture.rgba.data() + from * kBytesPerPixel, row);
  }
  return part;
}

}  // namespace jnd::app::gui
