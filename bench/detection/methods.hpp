#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/detection.hpp"
#include "core/object_model.hpp"
#include "views.hpp"

namespace credo {

/// A way to find objects, made ready for some models.
struct Method {
  std::string name;
  std::function<std::unique_ptr<Detector>(std::vector<ObjectModel> const&)> make;
};

/// All there are. The views must outlive the methods (one of them is the truth). `bpa` tells what
/// is likelier than `told_from`: 0.25 is its default; what it finds at a precision takes less.
[[nodiscard]] std::vector<Method> all_methods(std::vector<TableView> const& views,
                                              double told_from);

}  // namespace credo
