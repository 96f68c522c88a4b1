// SPDX-License-Identifier: MIT
#include "renderer/sensor/coco.h"

#include <map>

#include "renderer/json/json.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

/// Pixels of an object, added column by column from the top.
class PixelMask {
 public:
  void add(int x, int y, std::uint64_t number) {
    if (area_ == 0) left_ = right_ = x, top_ = bottom_ = y;
    right_ = std::max(right_, x);
    top_ = std::min(top_, y);
    bottom_ = std::max(bottom_, y);
    if (number != next_ || runs_.empty()) {
      runs_.push_back(number - next_);
      runs_.push_back(0);
    }
    ++runs_.back();
    next_ = number + 1;
    ++area_;
  }

  Json annotation(std::uint64_t id, std::int32_t object, int width, int height) const {
    Json counts = Json::array();
    for (const std::uint64_t run : runs_) counts.push_back(run);
    const std::uint64_t pixels = std::uint64_t(width) * std::uint64_t(height);
    if (next_ < pixels) counts.push_back(pixels - next_);
    Json mask;
    mask["size"] = Json::array({height, width});
    mask["counts"] = std::move(counts);
    Json made;
    made["id"] = id;
    made["image_id"] = 1;
    made["category_id"] = object + 1;
    made["iscrowd"] = 0;
    made["area"] = area_;
    made["bbox"] = Json::array({left_, top_, right_ - left_ + 1, bottom_ - top_ + 1});
    made["segmentation"] = std::move(mask);
    return made;
  }

 private:
  std::vector<std::uint64_t> runs_;  ///< run lengths, alternately outside and inside, beginning
                                     ///< outside
  std::uint64_t next_ = 0, area_ = 0;
  int left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
};

}  // namespace

std::vector<unsigned char> coco_of(const ScanOutput& output) {
  const int width = output.rays.width, height = output.rays.height;
  std::map<std::int32_t, PixelMask> masks;
  for (int x = 0; x < width; ++x)
    for (int y = 0; y < height; ++y) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x);
      const Echo& echo = output.scan.echoes[pixel * static_cast<std::size_t>(output.returns)];
      if (echo.object >= 0)
        masks[echo.object].add(x, y, std::uint64_t(x) * std::uint64_t(height) + std::uint64_t(y));
    }
  Json image;
  image["id"] = 1;
  image["width"] = width;
  image["height"] = height;
  image["file_name"] = "";
  Json categories = Json::array(), annotations = Json::array();
  std::uint64_t id = 0;
  for (const auto& [object, mask] : masks) {
    Json category;
    category["id"] = object + 1;
    category["name"] = instance_object(output.scene, static_cast<std::size_t>(object)).name;
    category["supercategory"] = "object";
    categories.push_back(std::move(category));
    annotations.push_back(mask.annotation(++id, object, width, height));
  }
  Json file;
  file["images"] = Json::array({std::move(image)});
  file["categories"] = std::move(categories);
  file["annotations"] = std::move(annotations);
  const std::string text = file.dump() + "\n";
  return {text.begin(), text.end()};
}

}  // namespace minkray
